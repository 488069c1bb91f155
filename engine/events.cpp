#include "engine/events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/steps.h"

namespace hysteron {
namespace {

using steps::at;

constexpr int most_rounds = 100;       // of changes of mode at one instant, ENGINE 5
constexpr std::size_t chatter = 1000;  // so many changes of mode ...
constexpr double chatter_span = 1e-6;  // ... within this share of the span are no motion, ENGINE 5

}  // namespace

Events::Events(const Program& program, const Run& run, double begin, double until, double relative_tolerance,
               std::span<const double> absolute_tolerance)
    : program_(program),
      corners_(program, run, begin),
      clocks_(program, run, begin),
      path_(program, relative_tolerance, absolute_tolerance),
      span_(until - begin),
      due_(program.sampled_blocks.size(), 0),
      changes_(program.modal_blocks.size(), 0) {}

double Events::next() const { return std::min(corners_.next(), clocks_.next()); }
double Events::branch() const { return corners_.branch(); }

void Events::begin(Run& run, Work& work, double t, std::vector<double>& x) {
  starting_ = true;
  if (clocks_.next() <= t + same_instant(t)) sample(run, work, t, x, clocks_.take(t, run));
  settle(run, work, t, x, {});
  starting_ = false;
}

bool Events::follow(Run& run, Work& work, double t, std::vector<double>& x, std::span<const int> jumping) {
  if (starting_) return false;
  const bool moved = path_.follow(run, work, t, x, before_, jumping);
  paths_ += moved ? 1 : 0;
  return moved;
}

bool Events::pass(Run& run, Work& work, double t, std::vector<double>& x) {
  bool moved = false;
  evaluate_values(program_, run, work, t, x.data());
  before_ = work.y;
  if (corners_.next() <= t + same_instant(t)) {
    corners_.pass(t);
    run.branch = corners_.branch();
    moved = follow(run, work, t, x, program_.time_blocks);
  }
  if (clocks_.next() <= t + same_instant(t)) {
    evaluate_values(program_, run, work, t, x.data());
    before_ = work.y;
    const auto& due = clocks_.take(t, run);
    sample(run, work, t, x, due);
    blocks_.clear();
    for (const int i : due) blocks_.push_back(program_.sampled_blocks[at(i)]);
    moved |= follow(run, work, t, x, blocks_);
  }
  moved |= settle(run, work, t, x, {});
  return moved;
}

void Events::sample(Run& run, Work& work, double t, const std::vector<double>& x, std::span<const int> due) {
  hits_ += static_cast<long>(due.size());
  for (const int i : due) {
    due_[at(i)] = 1;
    work.views[at(program_.sampled_blocks[at(i)])].hit = run.hits[at(i)];
  }
  steps::begin(program_, run, work, t);
  work.due = due_.data();
  steps::run(program_.hit_values, program_, work, x.data());
  throw_if_unsolved(program_, work, t);
  work.due = nullptr;
  sampled_.assign(run.m.begin(), run.m.end());
  for (const int i : due) {
    due_[at(i)] = 0;
    const int block = program_.sampled_blocks[at(i)];
    const BlockInstance& b = program_.blocks[at(block)];
    View<double>& v = work.views[at(block)];
    if (b.kernel->update != nullptr) {
      steps::gather(b, work.y, work.u.data() + b.u_begin);
      v.x = v.m;
      v.out = sampled_.data() + b.m_begin;
      b.kernel->update(v);
    }
    std::copy_n(work.y.begin() + b.y_begin, b.sizes.outputs, sampled_.begin() + b.held_begin());
  }
  std::copy(sampled_.begin(), sampled_.end(), run.m.begin());
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
    before_ = work.y;
    std::vector<int> due;
    for (int i = 0; i < guards(); ++i)
      if (work.guard[at(i)] <= 0 || (round == 0 && std::find(fired.begin(), fired.end(), i) != fired.end()))
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
    change_modes(run, work, x, due);
    follow(run, work, t, x, blocks_);
    watch_chatter(t);
    changed = true;
  }
}

/// New modes and states from the old evaluation, then all at once.
void Events::change_modes(Run& run, Work& work, std::vector<double>& x, std::span<const int> due) {
  struct Change {
    int modal, block, mode;
  };
  std::vector<Change> list;
  auto states = x;
  blocks_.clear();
  for (const int i : due) {
    const int block = program_.modal_blocks[at(i)];
    const BlockInstance& b = program_.blocks[at(block)];
    View<double>& v = work.views[at(block)];
    v.x = x.data() + b.x_begin;
    const int before = run.mode[at(i)];
    const int next = b.kernel->next_mode(v);
    if (next == before) {
      if (work.guard[at(i)] > 0) continue;  // a root that was none
      fail_numerics("mode_without_end", b.path,
                    fmt::format("{} \"{}\" may not stay in mode {} and names no other", b.kernel->declaration.type,
                                b.path, before),
                    "check the parameters of the block: two thresholds coincide");
    }
    if (b.kernel->reset != nullptr) {
      v.mode_before = before;
      v.mode = next;
      v.out = states.data() + b.x_begin;
      b.kernel->reset(v);
    }
    list.push_back({i, block, next});
  }
  for (const auto& change : list) {
    run.mode[at(change.modal)] = change.mode;
    ++changes_[at(change.modal)];
    blocks_.push_back(change.block);
  }
  x = states;
}

void Events::watch_chatter(double t) {
  if (starting_) return;
  recent_.push_back(t);
  if (recent_.size() <= chatter) return;
  recent_.erase(recent_.begin());
  if (recent_.back() - recent_.front() > chatter_span * span_) return;
  const auto most = std::max_element(changes_.begin(), changes_.end()) - changes_.begin();
  const auto& block = program_.blocks[at(program_.modal_blocks[static_cast<std::size_t>(most)])];
  fail_numerics("chattering", block.path,
                fmt::format("{} \"{}\" (input \"{}\") changed its mode again and again: {} changes in {:.3g} s before "
                            "t = {:.9g} s",
                            block.kernel->declaration.type, block.path, program_.signals[at(block.source.front())].path,
                            chatter, recent_.back() - recent_.front(), t),
                "add hysteresis width to it, or a boundary layer (a finite slope instead of a jump)");
}

}  // namespace hysteron
