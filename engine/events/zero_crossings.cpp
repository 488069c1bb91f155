#include "engine/events/zero_crossings.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <stdexcept>

#include "engine/diagram/index.h"
#include "engine/program/needed.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

// The parabola through three points of a smooth function is this good, as a share of their range, and its vertex as a
// share of the step: a quarter of a sine differs from its parabola by 2 % of its range at most.
constexpr double parabola_error = 0.05, vertex_error = 0.1;
// Of an extremum its place is needed to a thousandth of the step: it misses a millionth of the curvature.
constexpr int bits_of_place = 12;
constexpr std::uintmax_t most_looks = 40;

/// May a smooth function with these values at the beginning, the middle and the end of a step fall to zero between.
bool may_reach_zero(double a, double b, double c) {
  const double curvature = 2 * (a + c - 2 * b), slope = 4 * b - 3 * a - c;  // a + slope s + curvature s^2
  if (!(curvature > 0)) return false;
  const double vertex = -slope / (2 * curvature);
  if (vertex < -vertex_error || vertex > 1 + vertex_error) return false;
  return a + slope * vertex / 2 < parabola_error * (std::max({a, b, c}) - std::min({a, b, c}));
}

}  // namespace

ZeroCrossings::ZeroCrossings(const Program& program, bool kinks) : program_(program), x_(at(std::max(1, program.n_x))) {
  std::vector<int> inputs;
  const auto read = [&](int block) {
    const auto& source = program.blocks[at(block)].source;
    inputs.insert(inputs.end(), source.begin(), source.end());
  };
  for (const int block : program.modal_blocks) {
    read(block);
    rates_ = rates_ || program.blocks[at(block)].kernel->guard_wants_rate;
  }
  for (const int block : kinks ? program.kinked_blocks : std::vector<int>{}) {
    const auto& own = program.blocks[at(block)];
    const auto reached = program.downstream_of(block, true);
    bool matters = own.sizes.states > 0, remembered = false, switches = false;
    for (std::size_t b = 0; b < program.blocks.size(); ++b) {
      if (!reached[b]) continue;
      const auto& other = program.blocks[b];
      remembered = remembered || other.sizes.memory > 0 || other.sizes.history;
      switches = switches || other.mode_index >= 0 || other.sizes.kinks > 0;
      matters = matters || other.sizes.states > 0 || other.mode_index >= 0 || remembered;
    }
    if (!matters) continue;
    kinked_.push_back({block, remembered, switches, own.sides_index >= 0});
    kinks_ += at(own.sizes.kinks);
    read(block);
  }
  values_ = steps_for(program, inputs);
  for (WatchedValues* v : {&begin_, &middle_, &end_}) v->g.resize(functions());
  side_.resize(functions());
  seen_.resize(functions());
  side_behind_.assign(functions(), 0.0);
  last_.t = last_.before = -std::numeric_limits<double>::infinity();
  forget();
}

const ZeroCrossings::Kinked& ZeroCrossings::kinked(std::size_t function) const {
  std::size_t end = guards();
  for (const auto& k : kinked_) {
    end += at(program_.blocks[at(k.block)].sizes.kinks);
    if (function < end) return k;
  }
  throw std::logic_error("no such kink");
}

bool ZeroCrossings::choose_sides(Run& run, Work& work, double t, const std::vector<double>& x) {
  if (program_.n_sides == 0) return false;
  const auto before = run.sides;
  run.sides.resize(at(program_.n_sides), 1);
  x_ = x;
  evaluate(run, work, t, end_.g);
  const double* g = end_.g.data() + guards();
  for (const auto& k : kinked_) {
    const auto& b = program_.blocks[at(k.block)];
    for (int i = 0; i < b.sizes.kinks; ++i, ++g)
      if (k.keeps_sides && *g != 0) run.sides[at(b.sides_index + i)] = *g > 0 ? 1 : -1;
  }
  forget();
  return run.sides != before;
}

void ZeroCrossings::evaluate(const Run& run, Work& work, double t, std::vector<double>& g) {
  if (rates_) {
    evaluate_guards(program_, run, work, t, x_.data());
  } else {
    evaluate_steps(program_, run, work, t, x_.data(), values_);
    steps::guards(program_, work, x_.data());
  }
  throw_if_unsolved(program_, work, t);
  std::copy(work.guard.begin(), work.guard.end(), g.begin());
  auto* out = g.data() + guards();
  for (const auto& k : kinked_) {
    const BlockInstance& b = program_.blocks[at(k.block)];
    View<double>& v = work.views[at(k.block)];
    steps::gather(b, work.y, work.u.data() + b.u_begin);
    v.x = x_.data() + b.x_begin;
    v.out = out;
    b.kernel->kinks(v);
    out += b.sizes.kinks;
  }
}

/// The crossing of function i in the bracket from the beginning of the step to `behind`, which is left right behind it;
/// what is returned stands right before it.
WatchedValues ZeroCrossings::locate(const Run& run, Work& work, const Step& step, std::size_t i,
                                    WatchedValues& behind) {
  WatchedValues all = behind, before = begin_;
  WatchedValues a{begin_.t, {std::max(side_[i] * begin_.g[i], std::numeric_limits<double>::min())}};
  WatchedValues b{behind.t, {side_[i] * behind.g[i]}};
  first_root(a, b, root_width(step.from, step.to), [&](double t, std::vector<double>& g) {
    step.states(t, x_);
    evaluate(run, work, all.t = t, all.g);
    g[0] = side_[i] * all.g[i];
    (g[0] <= 0 ? behind : before) = all;
    return 0;
  });
  return before;
}

/// The extremum towards zero between the ends of the step.
WatchedValues ZeroCrossings::lowest(const Run& run, Work& work, const Step& step, std::size_t i) {
  WatchedValues found{step.to, end_.g}, trial{0, end_.g};
  const auto look = [&](double share) {
    trial.t = step.from + share * (step.to - step.from);
    step.states(trial.t, x_);
    evaluate(run, work, trial.t, trial.g);
    const double height = side_[i] * trial.g[i];
    if (height < side_[i] * found.g[i]) found = trial;
    return height;
  };
  std::uintmax_t looks = most_looks;
  boost::math::tools::brent_find_minima(look, 0.0, 1.0, bits_of_place, looks);
  return found;
}

/// Where inside the step function i has the other sign than at its beginning.
std::optional<ZeroCrossings::Bracket> ZeroCrossings::bracket(const Run& run, Work& work, const Step& step,
                                                             std::size_t i) {
  const double a = side_[i] * begin_.g[i], b = side_[i] * middle_.g[i], c = side_[i] * end_.g[i];
  const bool guard = i < guards();
  const bool falls_at_end = guard ? c <= 0 : c < 0;
  if (guard && a <= 0) return std::nullopt;  // due before the step began
  if (guard ? b <= 0 : b < 0) return Bracket{middle_, !falls_at_end};
  if (falls_at_end) return guard && step.ends_are_known ? std::nullopt : std::optional(Bracket{end_, false});
  if (!may_reach_zero(a, b, c)) return std::nullopt;
  auto deepest = lowest(run, work, step, i);
  const double depth = side_[i] * deepest.g[i];
  if (guard ? depth > 0 : depth >= 0) return std::nullopt;
  return Bracket{std::move(deepest), true};
}

std::optional<ZeroCrossings::Found> ZeroCrossings::first(const Run& run, Work& work, const Step& step,
                                                         const Noticed& noticed) {
  auto found = look(run, work, step, noticed);
  if (functions() == 1) return found;
  // A function with a corner at the kink (what a rectifier does to a level) may have crossed before it.
  while (found && found->bent) {
    const auto behind = side_behind_;
    auto earlier = look(run, work, {step.from, found->before, step.states, false}, noticed);
    if (!earlier) {
      last_ = *found;
      side_behind_ = behind;
      break;
    }
    earlier->bent = true;
    found = std::move(earlier);
  }
  return found;
}

/// At the end of a step that is too short for anything to be located in it.
std::optional<ZeroCrossings::Found> ZeroCrossings::left_its_side(const Run& run, const Step& step) {
  std::size_t kink = guards();
  for (const auto& k : kinked_) {
    const auto& b = program_.blocks[at(k.block)];
    for (int i = 0; i < b.sizes.kinks; ++i, ++kink)
      if (k.keeps_sides && run.sides[at(b.sides_index + i)] * end_.g[kink] < 0)
        return forget(), Found{step.to, step.from, {}, step.to, false};
  }
  return std::nullopt;
}

std::optional<ZeroCrossings::Found> ZeroCrossings::look(const Run& run, Work& work, const Step& step,
                                                        const Noticed& noticed) {
  const auto look_at = [&](double t, WatchedValues& into) {
    step.states(t, x_);
    evaluate(run, work, into.t = t, into.g);
  };
  if (step.to - step.from <= 2 * root_width(step.from, step.to)) {
    if (program_.n_sides == 0) return forget(), std::nullopt;
    look_at(step.to, end_);
    return left_its_side(run, step);
  }
  if (end_.t == step.from)
    std::swap(begin_, end_);
  else
    look_at(step.from, begin_);
  look_at(step.from + (step.to - step.from) / 2, middle_);
  look_at(step.to, end_);
  const double width = 2 * root_width(step.from, step.to);
  const bool at_crossing = step.from >= last_.before - width && step.from <= last_.t + width;
  for (std::size_t i = 0; i < functions(); ++i) {
    // A kink that the step begins at: its side is the one that it goes to.
    const double side = begin_.g[i] != 0 ? begin_.g[i] : middle_.g[i];
    side_[i] = i < guards() || side >= 0 ? 1 : -1;
    if (at_crossing && side_behind_[i] != 0) side_[i] = side_behind_[i];
  }
  std::size_t kink = guards();
  for (const auto& k : kinked_) {
    const auto& b = program_.blocks[at(k.block)];
    for (int j = 0; j < b.sizes.kinks; ++j, ++kink)
      if (k.keeps_sides) side_[kink] = run.sides[at(b.sides_index + j)];
  }
  WatchedValues before, behind;
  bool bent = false;
  for (std::size_t i = 0; i < functions(); ++i) {
    auto here = bracket(run, work, step, i);
    if (here) {
      const bool is_kink = i >= guards();
      const Kinked* k = is_kink ? &kinked(i) : nullptr;
      const bool ask = is_kink && !k->keeps_sides && !k->switches;
      const double seen = here->seen.t;
      if (ask && here->missed && !noticed.missed(seen, k->remembered)) here.reset();
      if (here) {
        auto a = locate(run, work, step, i, here->seen);
        if (ask && !here->missed && !noticed.passed(a.t, here->seen.t, step.to)) {
          here.reset();
        } else {
          seen_[i] = seen;
          bent = bent || (is_kink && !k->keeps_sides);
          if (behind.g.empty() || here->seen.t < behind.t) before = std::move(a), behind = std::move(here->seen);
        }
      }
    }
    if (!here) side_[i] = 0;  // not asked for any more
  }
  if (behind.g.empty()) return std::nullopt;
  forget();
  last_ = {behind.t, before.t, {}, behind.t, bent};
  for (std::size_t i = 0; i < functions(); ++i) {
    const bool crosses = side_[i] != 0 && side_[i] * behind.g[i] <= 0;
    side_behind_[i] = crosses && i >= guards() ? -side_[i] : 0;
    if (!crosses) continue;
    if (i < guards())
      last_.guards.push_back(static_cast<int>(i));
    else
      last_.seen = std::max(last_.seen, seen_[i]);
  }
  return last_;
}

}  // namespace hysteron
