#include "engine/rowwise/advance_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/block/rows.h"
#include "engine/diagram/error.h"
#include "engine/diagram/index.h"
#include "engine/events/path.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

constexpr int most_rounds = 100;    // of changes of mode at one instant
constexpr int most_changes = 1000;  // within one row: no motion
// Of a row: a mode lasts so much too long, and moves what it moves by its rate over that time.
constexpr double root_width_of_row = 1e-12;
// Of a time constant: up to there the Runge-Kutta formula leaves less than 1e-7 (0.1^5/120) and costs less.
constexpr double short_length = 0.1;

}  // namespace

AdvanceLoop::AdvanceLoop(const AdvancePlan& plan, const AdvancePlan::LoopedPart& part, Run& run, Work& work,
                         std::vector<double>& x, std::unique_ptr<JetWork>& jets)
    : plan_(plan),
      part_(part),
      program_(*plan.program),
      jets_(jets),
      run_(run),
      work_(work),
      x_(x),
      before_(part.inputs.size()),
      now_(part.inputs.size()),
      states_(part.states.size()),
      began_(part.states.size()),
      scratch_(5 * part.states.size()),
      guard_(part.modal.size()) {
  begin_.g = end_.g = guard_;
  const auto asks_for_rates = [](const Step& step) { return step.order == Order::rate; };
  if (std::none_of(part.derivatives.begin(), part.derivatives.end(), asks_for_rates)) matrices_.emplace(plan, part);
}

void AdvanceLoop::start(bool accept) {
  for (std::size_t i = 0; i < before_.size(); ++i) before_[i] = work_.y[at(part_.inputs[i])];
  if (matrices_) matrices_->bind(run_);
  known_.clear();
  now_in_ = nullptr;
  is_affine_ = std::all_of(part_.blocks.begin(), part_.blocks.end(),
                           [&](int b) { return plan_.graph.linear[at(b)] || affine_in_modes(program_, run_, b); });
  values();
  if (!accept) return;
  accept_values();
  settle();
}

void AdvanceLoop::move(double h, int path_steps) {
  bool changed = false;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    now_[i] = work_.y[at(part_.inputs[i])];
    changed = changed || now_[i] != before_[i];
  }
  if (h > 0) {
    follow_row(h);
  } else {
    if (changed && part_.follows_jumps) follow_jump(path_steps);
    values();
    accept_values();
    settle();
  }
  std::copy(now_.begin(), now_.end(), before_.begin());
}

/// Time stands still: states that count it do, too.
void AdvanceLoop::follow_jump(int path_steps) {
  const int pieces = std::max(path_steps, jump_pieces);
  PathPoint path;
  path.jumping = plan_.jumping.data();
  path.rate_independent = plan_.rate_independent.data();
  work_.path = &path;
  for (int i = 0; i < pieces; ++i) {
    step(static_cast<double>(i) / pieces, i + 1 == pieces ? 1.0 : (i + 1.0) / pieces, jump_duration / pieces,
         jump_duration);
    if (i + 1 == pieces) break;
    values();
    accept_values();
  }
  work_.path = nullptr;
}

void AdvanceLoop::follow_row(double h) {
  if (part_.modal.empty()) {
    step(0, 1, h, h);
    values();
    return accept_values();
  }
  double place = 0;
  for (int changes = 0; place < 1; ++changes) {
    if (changes == most_changes) report_unsettled("chattering", changes);
    place = to_the_next_change(place, h);
  }
}

/// From `begin` on, a share of the row of h [s], to its end or right behind the first place where a mode may not stay;
/// where that is; it has changed there. guard_ holds the guards at `begin`, and then those at the end.
double AdvanceLoop::to_the_next_change(double begin, double h) {
  for (std::size_t i = 0; i < began_.size(); ++i) began_[i] = x_[at(part_.states[i])];
  const auto reach = [&](double end, std::vector<double>& g) {
    put_states(began_);
    step(begin, end, (end - begin) * h, h);
    values();
    return look_at_guards(g);
  };
  begin_.t = begin;
  begin_.g = guard_;
  end_.t = 1;
  if (!reach(1, end_.g)) {
    guard_ = end_.g;
    accept_values();
    return 1;
  }
  double last = 1;
  first_root(begin_, end_, root_width_of_row, [&](double place, std::vector<double>& g) {
    reach(last = place, g);
    return 0;
  });
  if (last != end_.t) reach(end_.t, end_.g);
  accept_values();
  settle();
  return end_.t;
}

/// One step; begin, end: shares of the way of the inputs; their rates are their way over `duration`.
void AdvanceLoop::step(double begin, double end, double length, double duration) {
  const std::size_t n = part_.states.size();
  for (std::size_t i = 0; i < n; ++i) states_[i] = x_[at(part_.states[i])];
  for (std::size_t i = 0; i < now_.size(); ++i) work_.rate[at(part_.inputs[i])] = (now_[i] - before_[i]) / duration;
  const auto rates = [&](double c, const double* states, double* rates) {
    put_inputs(begin + c * (end - begin));
    for (std::size_t i = 0; i < n; ++i) x_[at(part_.states[i])] = states[i];
    derivatives();
    for (std::size_t i = 0; i < n; ++i) rates[i] = work_.dx[at(part_.states[i])];
  };
  ExponentialStep* exact = in_this_mode(length);
  const bool whole_row = begin == 0 && end == 1;
  if (exact != nullptr && is_affine_)
    exact->along_a_line(states_.data(), length, whole_row, rates);
  else if (exact != nullptr)
    (*exact)(states_.data(), length, whole_row, rates);
  else
    block_detail::runge_kutta(static_cast<int>(n), states_.data(), length, scratch_.data(), rates);
  put_states(states_);
  put_inputs(end);
}

/// The step with the slopes of the modes as they are; nullptr where there is none: of too many states, driven by rates,
/// along a jump, where nothing is quick within the length [s], or where something grows, as friction that falls does at
/// its steepest only.
ExponentialStep* AdvanceLoop::in_this_mode(double length) {
  const std::size_t n = part_.states.size();
  if (!matrices_ || n == 0 || n > ExponentialStep::most_states || work_.path != nullptr || !(length > 0))
    return nullptr;
  if (now_in_ == nullptr) {
    std::vector<int> modes;
    for (const int block : part_.modal) modes.push_back(run_.mode[at(plan_.block(block).mode_index)]);
    auto found = std::find_if(known_.begin(), known_.end(), [&](const InMode& m) { return m.modes == modes; });
    if (found == known_.end())
      found = known_.insert(found, {std::move(modes), ExponentialStep(static_cast<int>(n), slopes())});
    now_in_ = &found->step;
  }
  if (is_affine_) return std::isnan(now_in_->growth()) ? nullptr : now_in_;
  return now_in_->growth() * length <= 1 && now_in_->fastest() * length > short_length ? now_in_ : nullptr;
}

/// Of the rates of the states over these, where the loop is.
std::vector<double> AdvanceLoop::slopes() {
  const std::size_t n = part_.states.size();
  if (!jets_) jets_ = std::make_unique<JetWork>(program_);
  jets_->refresh(run_);
  steps::begin(program_, run_, *jets_, run_.t);
  for (const int s : part_.inputs) jets_->y[at(s)] = work_.y[at(s)];
  std::vector<Jet> x(x_.begin(), x_.end());
  for (std::size_t i = 0; i < n; ++i) x[at(part_.states[i])].slope[i] = 1;
  steps::run(part_.derivatives, program_, *jets_, x.data());
  std::vector<double> list;
  for (const int to : part_.states)
    for (std::size_t i = 0; i < n; ++i) list.push_back(jets_->dx[at(to)].slope[i]);
  return list;
}

void AdvanceLoop::put_inputs(double place) {
  for (std::size_t i = 0; i < now_.size(); ++i)
    work_.y[at(part_.inputs[i])] = place == 1 ? now_[i] : before_[i] + place * (now_[i] - before_[i]);
}

void AdvanceLoop::put_states(const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) x_[at(part_.states[i])] = values[i];
}

/// Along the path of a jump time stands still for what is not rate-independent, linear blocks included.
void AdvanceLoop::derivatives() {
  if (matrices_ && work_.path == nullptr)
    matrices_->derivatives(work_, x_.data());
  else
    steps::run(part_.derivatives, program_, work_, x_.data());
}

void AdvanceLoop::values() {
  if (matrices_)
    matrices_->values(work_, x_.data());
  else
    steps::run(part_.values, program_, work_, x_.data());
}

void AdvanceLoop::accept_values() {
  for (const int block : part_.memory) {
    const BlockInstance& b = plan_.block(block);
    std::copy_n(work_.m.begin() + b.m_begin, b.sizes.memory, run_.m.begin() + b.m_begin);
  }
}

/// Guards where the values are. True: a mode may not stay.
bool AdvanceLoop::look_at_guards(std::vector<double>& g) {
  bool due = false;
  for (std::size_t i = 0; i < part_.modal.size(); ++i) {
    const BlockInstance& b = plan_.block(part_.modal[i]);
    View<double>& v = work_.views[at(part_.modal[i])];
    steps::gather(b, work_.y, work_.u.data() + b.u_begin);
    v.x = x_.data() + b.x_begin;
    v.out = &g[i];
    b.kernel->guard(v);
    due = due || g[i] <= 0;
  }
  return due;
}

/// Modes change until each may stay.
void AdvanceLoop::settle() {
  for (int round = 0; look_at_guards(guard_); ++round) {
    if (round == most_rounds) report_unsettled("modes_do_not_settle", round);
    change_modes(guard_);
    values();
    accept_values();
  }
}

/// New states from the values with the old modes, then all at once.
void AdvanceLoop::change_modes(const std::vector<double>& g) {
  reset_ = x_;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (g[i] > 0) continue;
    const BlockInstance& b = plan_.block(part_.modal[i]);
    View<double>& v = work_.views[at(part_.modal[i])];
    v.x = x_.data() + b.x_begin;
    const int before = v.mode, after = b.kernel->next_mode(v);
    if (after == before)
      fail_numerics("mode_without_end", b.path,
                    fmt::format("{} \"{}\" may not stay in mode {} and names no other", b.kernel->declaration.type,
                                b.path, before),
                    "check the parameters of the block: two thresholds coincide");
    v.mode_before = before;
    v.mode = after;
    v.out = reset_.data() + b.x_begin;
    if (b.kernel->reset != nullptr) b.kernel->reset(v);
    run_.mode[at(b.mode_index)] = after;
  }
  now_in_ = nullptr;
  x_ = reset_;
}

void AdvanceLoop::report_unsettled(const char* code, int changes) const {
  const BlockInstance& b = plan_.block(part_.modal.front());
  fail_numerics(code, b.path,
                fmt::format("the loop of {} \"{}\" changes its modes again and again: {} times before the next row",
                            b.kernel->declaration.type, b.path, changes),
                "give one of its blocks hysteresis, or put a lag into the loop");
}

}  // namespace hysteron
