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
      enabled_(program),
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

bool Events::pass_corners(Run& run, Work& work, double t, std::vector<double>& x) {
  evaluate_values(program_, run, work, t, x.data());
  before_ = work.y;
  if (!instant_.breakpoint) return false;
  run.branch = breakpoints_.branch();
  return follow(run, work, t, x, program_.time_blocks);
}

/// Takes these samples. Returns true if the jumps of what they hold moved states.
bool Events::sample(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> due) {
  if (due.empty()) return false;
  evaluate_values(program_, run, work, t, x.data());
  before_ = work.y;
  sampling_(run, work, t, x.data(), due, program_.hit_values);
  if (program_.n_histories > 0) run.branch = breakpoints_.branch();  // its echoes end pieces, too
  blocks_.clear();
  for (const int i : due) blocks_.push_back(program_.sampled_blocks[at(i)]);
  return follow(run, work, t, x, blocks_);
}

bool Events::cross(Run& run, Work& work, double t, std::vector<double>& x) {
  const bool moved = pass_corners(run, work, t, x);
  return sample(run, work, t, x, enabled_.running(run, instant_.hits)) || moved;
}

/// The same where samples may switch what is sampled.
bool Events::cross_switching(Run& run, Work& work, double t, std::vector<double>& x) {
  bool moved = pass_corners(run, work, t, x);
  if (instant_.hits.empty()) return moved;
  early_ = true;
  moved = settle(run, work, t, x, {}) || moved;
  early_ = false;
  std::vector<double> memory = run.m, states = x;
  for (int round = 0;; ++round) {
    auto due = enabled_.running(run, instant_.hits);
    for (const int i : enabled_.triggered_samples(run)) due.push_back(i);
    const bool jumped = sample(run, work, t, x, due);
    evaluate_guards(program_, run, work, t, x.data());
    throw_if_unsolved(program_, work, t);
    auto switching = due_guards(run, work, {});
    std::erase_if(switching, [&](int i) { return !enabled_.enables(i) || enabled_.has_run(run, i); });
    moved = moved || jumped || !switching.empty();
    if (switching.empty()) break;
    if (round == most_rounds) report_unsettled(t, switching);
    const auto changes = find_changes(run, work, x, switching);
    run.m = memory;
    x = states;
    change(run, work, t, x, changes);
    memory = run.m;
    states = x;
  }
  skipped_ = instant_.hits;
  std::erase_if(skipped_,
                [&](int i) { return !is_off(program_, run, program_.blocks[at(program_.sampled_blocks[at(i)])]); });
  return moved;
}

/// Samples of this instant whose turn it is since these changes switched on what they stand in.
bool Events::sample_what_runs_now(Run& run, Work& work, double t, std::vector<double>& x,
                                  std::span<const ModeChange> changes) {
  if (starting_ || !enabled_.any()) return false;  // begin() takes all of them again
  auto due = enabled_.running(run, skipped_);
  std::erase_if(skipped_, [&](int i) { return std::find(due.begin(), due.end(), i) != due.end(); });
  std::vector<int> inside;
  enabled_.list_inside(changes, inside);
  for (const int i : enabled_.triggered_samples(run))
    if (std::find(inside.begin(), inside.end(), program_.sampled_blocks[at(i)]) != inside.end()) due.push_back(i);
  return sample(run, work, t, x, due);
}

bool Events::pass(Run& run, Work& work, double t, std::vector<double>& x) {
  skipped_.clear();
  const bool moved = enabled_.any() ? cross_switching(run, work, t, x) : cross(run, work, t, x);
  hits_ += static_cast<long>(instant_.hits.size());
  paths_ += moved ? 1 : 0;
  const bool settled = settle(run, work, t, x, {});
  skipped_.clear();
  return settled || moved;
}

bool Events::jump(Run& run, Work& work, double t, std::vector<double>& x, const std::function<void()>& change) {
  evaluate_values(program_, run, work, t, x.data());
  before_ = work.y;
  change();
  breakpoints_.jumped(t);
  if (program_.n_histories > 0) run.branch = breakpoints_.branch();
  const bool moved = follow(run, work, t, x, program_.time_blocks);
  paths_ += moved ? 1 : 0;
  if (next() <= t + same_instant(t)) return moved;
  return settle(run, work, t, x, {}) || moved;
}

void Events::go_on_as(const Events& other) {
  breakpoints_.go_on_as(other.breakpoints_);
  clocks_ = other.clocks_;
  milestone_ = other.milestone_;
  since_milestone_ = other.since_milestone_;
  recent_ = other.recent_;
  changes_ = other.changes_;
  hits_ = other.hits_;
  paths_ = other.paths_;
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

/// Guards that are not positive or, where a step saw a root of them, `fired`. What was triggered stops last.
std::vector<int> Events::due_guards(const Run& run, const Work& work, std::span<const int> fired) const {
  std::vector<int> due;
  bool others = false;
  for (int i = 0; i < guards(); ++i) {
    if (ranks_[at(i)] > settling_ || (early_ && !enabled_.comes_early(i))) continue;
    if (work.guard[at(i)] > 0 && std::find(fired.begin(), fired.end(), i) == fired.end()) continue;
    due.push_back(i);
    others = others || !enabled_.has_run(run, i);
  }
  if (others) std::erase_if(due, [&](int i) { return enabled_.has_run(run, i); });
  return due;
}

bool Events::settle(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> fired) {
  if (program_.modal_blocks.empty()) return false;
  bool changed = false;
  for (int round = 0;; ++round) {
    evaluate_guards(program_, run, work, t, x.data());
    throw_if_unsolved(program_, work, t);
    const auto due = due_guards(run, work, round == 0 ? fired : std::span<const int>{});
    if (due.empty()) return changed;
    if (round == most_rounds) report_unsettled(t, due);
    const auto changes = find_changes(run, work, x, due);
    if (changes.empty()) return changed;
    change(run, work, t, x, changes);
    paths_ += sample_what_runs_now(run, work, t, x, changes) ? 1 : 0;
    changed = true;
  }
}

/// These changes, with all that goes with them.
void Events::change(Run& run, Work& work, double t, std::vector<double>& x, std::span<const ModeChange> changes) {
  if (on_change && !starting_) on_change(changes);
  paths_ += apply(run, work, t, x, changes) ? 1 : 0;
  for (const auto& change : changes) ++changes_[at(change.modal)];
  watch_chatter(t);
}

void Events::report_unsettled(double t, std::span<const int> due) const {
  std::vector<std::string> names;
  for (const int i : due) names.push_back(program_.blocks[at(program_.modal_blocks[at(i)])].path);
  fail_numerics("modes_do_not_settle", names.front(),
                fmt::format("after {} changes of mode at t = {:.9g} s these blocks still change: {}", most_rounds, t,
                            fmt::join(names, ", ")),
                "they switch each other to and fro: give one of them hysteresis, or put a lag between them");
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
  enabled_.complete(run, list, starting_);
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
  enabled_.switch_off(run, work, changes);
  for (const auto& change : changes) run.mode[at(change.modal)] = change.after;
  x = states_;
  if (!starting_) enabled_.switch_on(run, x, changes);
  enabled_.list_inside(changes, blocks_);
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
