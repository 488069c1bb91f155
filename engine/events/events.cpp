#include "engine/events/events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "engine/events/start_order.h"
#include "engine/program/histories.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

constexpr int most_rounds = 100;       // of changes of mode at one instant
constexpr std::size_t chatter = 1000;  // so many changes of mode ...
constexpr double chatter_span = 1e-6;  // ... within this share of the span are no motion
// At this pace the run would take ten million changes of mode, a minute and more.
constexpr long endless = 100'000;
constexpr double endless_span = 1e-2;

}  // namespace

Events::Events(const Program& program, const Run& run, double begin, double until, double relative_tolerance,
               std::span<const double> absolute_tolerance)
    : program_(program),
      breakpoints_(program, run, begin),
      clocks_(program, run, begin),
      sampling_(program),
      path_(program, relative_tolerance, absolute_tolerance),
      span_(until - begin),
      milestone_(begin),
      ranks_(start_ranks(program)),
      changes_(program.modal_blocks.size(), 0) {}

double Events::next() const { return std::min(breakpoints_.next(), clocks_.next()); }
double Events::branch() const { return breakpoints_.branch(); }

void Events::take(double t, Run& run) {
  instant_.breakpoint = breakpoints_.next() <= t + same_instant(t);
  if (instant_.breakpoint) breakpoints_.pass(t);
  instant_.hits.clear();
  if (clocks_.next() > t + same_instant(t)) return;
  instant_.hits = clocks_.take(t, run);
  breakpoints_.jumped(t);
}

bool Events::cross(Run& run, Work& work, double t, std::vector<double>& x) {
  bool moved = false;
  evaluate_values(program_, run, work, t, x.data());
  before_ = work.y;
  if (instant_.breakpoint) {
    run.branch = breakpoints_.branch();
    moved = follow(run, work, t, x, program_.time_blocks);
  }
  if (instant_.hits.empty()) return moved;
  evaluate_values(program_, run, work, t, x.data());
  before_ = work.y;
  sampling_(run, work, t, x.data(), instant_.hits, program_.hit_values);
  if (program_.n_histories > 0) run.branch = breakpoints_.branch();  // its echoes end pieces, too
  blocks_.clear();
  for (const int i : instant_.hits) blocks_.push_back(program_.sampled_blocks[at(i)]);
  return follow(run, work, t, x, blocks_) || moved;
}

bool Events::pass(Run& run, Work& work, double t, std::vector<double>& x) {
  const bool moved = cross(run, work, t, x);
  hits_ += static_cast<long>(instant_.hits.size());
  paths_ += moved ? 1 : 0;
  return settle(run, work, t, x, {}) || moved;
}

void Events::begin(Run& run, Work& work, double t, std::vector<double>& x) {
  starting_ = true;
  const auto memory = run.m;
  const int last = ranks_.empty() ? 0 : *std::max_element(ranks_.begin(), ranks_.end());
  rest_histories(program_, run, work, t, x.data());
  bool changed = true;
  for (settling_ = 0; (changed || settling_ <= last) && settling_ < last + most_rounds; ++settling_) {
    // What was sampled has seen what had not settled: sample again.
    if (changed) {
      run.m = memory;
      cross(run, work, t, x);
    }
    changed = rest_histories(program_, run, work, t, x.data());
    if (settle(run, work, t, x, {})) {
      rest_histories(program_, run, work, t, x.data());
      changed = true;
    }
  }
  settling_ = std::numeric_limits<int>::max();
  hits_ += static_cast<long>(instant_.hits.size());
  starting_ = false;
}

bool Events::follow(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> jumping) {
  return !starting_ && path_.follow(run, work, t, x, before_, jumping);
}

bool Events::due(const Run& run, Work& work, double t, const std::vector<double>& x) const {
  evaluate_guards(program_, run, work, t, x.data());
  throw_if_unsolved(program_, work, t);
  return std::any_of(work.guard.begin(), work.guard.end(), [](double g) { return g <= 0; });
}

bool Events::settle(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> fired) {
  if (program_.modal_blocks.empty()) return false;
  bool changed = false;
  for (int round = 0;; ++round) {
    evaluate_guards(program_, run, work, t, x.data());
    throw_if_unsolved(program_, work, t);
    std::vector<int> due;
    for (int i = 0; i < guards(); ++i)
      if (ranks_[at(i)] <= settling_ &&
          (work.guard[at(i)] <= 0 || (round == 0 && std::find(fired.begin(), fired.end(), i) != fired.end())))
        due.push_back(i);
    if (due.empty()) return changed;
    if (round == most_rounds) {
      std::vector<std::string> names;
      for (const int i : due) names.push_back(program_.blocks[at(program_.modal_blocks[at(i)])].path);
      fail_numerics("modes_do_not_settle", names.front(),
                    fmt::format("after {} changes of mode at t = {:.9g} s these blocks still change: {}", most_rounds,
                                t, fmt::join(names, ", ")),
                    "they switch each other to and fro: give one of them hysteresis, or put a lag between them");
    }
    const auto changes = find_changes(run, work, x, due);
    if (changes.empty()) return changed;
    if (on_change && !starting_) on_change(changes);
    paths_ += apply(run, work, t, x, changes) ? 1 : 0;
    for (const auto& change : changes) ++changes_[at(change.modal)];
    watch_chatter(t);
    changed = true;
  }
}

std::vector<ModeChange> Events::find_changes(const Run& run, Work& work, const std::vector<double>& x,
                                             std::span<const int> due) const {
  std::vector<ModeChange> list;
  for (const int i : due) {
    const int block = program_.modal_blocks[at(i)];
    const BlockInstance& b = program_.blocks[at(block)];
    View<double>& v = work.views[at(block)];
    v.x = x.data() + b.x_begin;
    const int before = run.mode[at(i)];
    const int next = b.kernel->next_mode(v);
    if (next != before) {
      list.push_back({i, block, before, next});
      continue;
    }
    if (work.guard[at(i)] > 0) continue;  // a root that was none
    fail_numerics(
        "mode_without_end", b.path,
        fmt::format("{} \"{}\" may not stay in mode {} and names no other", b.kernel->declaration.type, b.path, before),
        "check the parameters of the block: two thresholds coincide");
  }
  return list;
}

/// New states from one evaluation with the old modes, then all at once.
bool Events::apply(Run& run, Work& work, double t, std::vector<double>& x, std::span<const ModeChange> changes) {
  evaluate_guards(program_, run, work, t, x.data());
  before_ = work.y;
  states_ = x;
  blocks_.clear();
  for (const auto& change : changes) {
    blocks_.push_back(change.block);
    const BlockInstance& b = program_.blocks[at(change.block)];
    if (b.kernel->reset == nullptr) continue;
    View<double>& v = work.views[at(change.block)];
    v.x = x.data() + b.x_begin;
    v.mode_before = change.before;
    v.mode = change.after;
    v.out = states_.data() + b.x_begin;
    b.kernel->reset(v);
  }
  for (const auto& change : changes) run.mode[at(change.modal)] = change.after;
  x = states_;
  return follow(run, work, t, x, blocks_);
}

void Events::watch_chatter(double t) {
  if (starting_) return;
  recent_.push_back(t);
  if (recent_.size() > chatter) recent_.erase(recent_.begin());
  if (recent_.size() == chatter && t - recent_.front() <= chatter_span * span_)
    report_chatter(t, chatter, t - recent_.front());
  if (++since_milestone_ < endless) return;
  if (t - milestone_ <= endless_span * span_) report_chatter(t, endless, t - milestone_);
  milestone_ = t;
  since_milestone_ = 0;
}

void Events::report_chatter(double t, long changes, double within) const {
  const auto most = std::max_element(changes_.begin(), changes_.end()) - changes_.begin();
  const auto& block = program_.blocks[at(program_.modal_blocks[static_cast<std::size_t>(most)])];
  fail_numerics("chattering", block.path,
                fmt::format("{} \"{}\" (input \"{}\") changes its mode again and again: {} changes in the {:.3g} s "
                            "before t = {:.9g} s; to the end it would take {:.2g} of them",
                            block.kernel->declaration.type, block.path, program_.signals[at(block.source.front())].path,
                            changes, within, t, within > 0 ? static_cast<double>(changes) / within * span_ : INFINITY),
                "add hysteresis width to it, or a boundary layer (a finite slope instead of a jump)");
}

}  // namespace hysteron
