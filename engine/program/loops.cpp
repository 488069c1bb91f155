#include "engine/program/loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/loop_plan.h"
#include "engine/program/nominal.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

constexpr double share_of_tolerance = 1e-3;  // well below what the integrator notices
constexpr double roundings = 8 * std::numeric_limits<double>::epsilon();
constexpr int newton_steps_allowed = 60;
constexpr int halvings_allowed = 30;
constexpr double enough_descent = 1e-4;  // of what a linear loop would give (Armijo)
constexpr int doublings_allowed = 60;
constexpr double singular = 1e-13;  // of the other pivots: no slope to speak of
constexpr double fold = 1e-3;       // weaker slopes than this where the search ended are called by their name

template <class T>
T& number(WorkOf<T>& work, const Slot& slot) {
  auto& from = slot.order == Order::value ? work.y : slot.order == Order::rate ? work.rate : work.dx;
  return from[at(slot.index)];
}
double number(const Work& work, const Slot& slot) {
  const auto& from = slot.order == Order::value ? work.y : slot.order == Order::rate ? work.rate : work.dx;
  return from[at(slot.index)];
}

/// What stands outside the loop and what its blocks are made of, values only: slopes belong to the tears here.
template <class T>
void take(LoopSolver& s, const Program& program, const Loop& loop, WorkOf<T>& work, const T* x) {
  s.outside_is_finite = true;
  for (const Slot& slot : loop.outside) {
    const double value = value_of(number(work, slot));
    number(s.jets, slot) = Jet(value);
    s.outside_is_finite = s.outside_is_finite && std::isfinite(value);
  }
  const Run& run = *s.run;
  for (const int block : loop.blocks) {
    const BlockInstance& b = program.blocks[at(block)];
    for (int i = b.x_begin; i < b.x_begin + b.sizes.states; ++i) {
      s.x[at(i)] = Jet(value_of(x[i]));
      s.outside_is_finite = s.outside_is_finite && std::isfinite(s.x[at(i)].value);
    }
    for (int i = b.p_begin; i < b.p_begin + b.p_at.back(); ++i) s.jets.p[at(i)] = Jet(run.p[at(i)]);
    for (int i = b.m_begin; i < b.m_begin + b.memory_count(); ++i) s.jets.m_committed[at(i)] = Jet(run.m[at(i)]);
  }
}

/// F, its residual and its slopes at s.v. False where the residual is not finite.
bool evaluate(LoopSolver& s, const Program& program, const Loop& loop) {
  const int n = static_cast<int>(loop.tears.size());
  bool finite = true;
  for (int first = 0; first < n; first += Jet::directions) {
    const int last = std::min(n, first + Jet::directions);
    for (int j = 0; j < n; ++j) {
      Jet tear(s.v[at(j)]);
      if (j >= first && j < last) tear.slope[j - first] = 1;
      number(s.jets, loop.tears[at(j)]) = tear;
    }
    steps::run(loop.steps, program, s.jets, s.x.data());
    ++s.evaluations;
    for (int i = 0; i < n; ++i) {
      const Jet& made = number(s.jets, loop.tears[at(i)]);
      s.residual[at(i)] = made.value - s.v[at(i)];
      finite = finite && std::isfinite(s.residual[at(i)]);
      for (int j = first; j < last; ++j) s.slope[at(i * n + j)] = (i == j ? 1.0 : 0.0) - made.slope[j - first];
    }
  }
  return finite;
}

/// The error that tear i may keep.
double tight(const LoopSolver& s, int i) { return (s.run->loop_relative + roundings) * std::abs(s.v[at(i)]); }
/// The error with which it may be left where rounding allows no better: near zero, where terms of its size cancel.
double tolerance(const LoopSolver& s, const Loop& loop, int i) {
  return tight(s, i) + s.run->loop_absolute[at(loop.warm_begin + i)];
}

/// Factors the slopes: Gauss with row pivots. Rows and columns count in units of the tears' sizes, so that volts and
/// micrometres may stand in one loop. False if they are singular.
bool factor(LoopSolver& s, const Loop& loop) {
  const int n = static_cast<int>(loop.tears.size());
  // In tolerances, over the relative one: about the size of the number, never zero.
  for (int i = 0; i < n; ++i) s.scale[at(i)] = tolerance(s, loop, i);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) s.factors[at(i * n + j)] = s.slope[at(i * n + j)] * (s.scale[at(j)] / s.scale[at(i)]);
  double largest = 0;
  for (int i = 0; i < n * n; ++i) largest = std::max(largest, std::abs(s.factors[at(i)]));
  s.weakest = 1;
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(s.factors[at(i * n + k)]) > std::abs(s.factors[at(pivot * n + k)])) pivot = i;
    s.pivots[at(k)] = pivot;
    const double p = s.factors[at(pivot * n + k)];
    // Against what cancelled to make it: 1 - dF/dv, where both are about one.
    s.weakest = std::min(s.weakest, std::abs(p) / std::max(1.0, largest));
    if (!(std::abs(p) > singular * std::max(1.0, largest))) return false;
    for (int j = 0; pivot != k && j < n; ++j) std::swap(s.factors[at(k * n + j)], s.factors[at(pivot * n + j)]);
    for (int i = k + 1; i < n; ++i) {
      const double share = s.factors[at(i * n + k)] /= p;
      for (int j = k + 1; j < n; ++j) s.factors[at(i * n + j)] -= share * s.factors[at(k * n + j)];
    }
  }
  return true;
}

/// s.step = (I - dF/dv)^-1 s.right, after factor().
void back_substitute(LoopSolver& s, int n) {
  auto& b = s.step;
  for (int i = 0; i < n; ++i) b[at(i)] = s.right[at(i)] / s.scale[at(i)];
  for (int k = 0; k < n; ++k) {
    std::swap(b[at(k)], b[at(s.pivots[at(k)])]);
    for (int i = k + 1; i < n; ++i) b[at(i)] -= s.factors[at(i * n + k)] * b[at(k)];
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) b[at(k)] -= s.factors[at(k * n + j)] * b[at(j)];
    b[at(k)] /= s.factors[at(k * n + k)];
  }
  for (int i = 0; i < n; ++i) b[at(i)] *= s.scale[at(i)];
}

void note_best(LoopSolver& s, int n, double norm) {
  if (!(norm < s.best_norm)) return;
  s.best_norm = norm;
  s.best_weakest = s.weakest;
  std::copy_n(s.v.begin(), n, s.best.begin());
  std::copy_n(s.residual.begin(), n, s.best_residual.begin());
}

// --- one tear
// ---------------------------------------------------------------------------------------------------------

/// r(v) = F(v) - v with its slope's negative 1 - F', and what is known of its signs.
class Scalar {
 public:
  Scalar(LoopSolver& s, const Program& program, const Loop& loop) : s_(s), program_(program), loop_(loop) {}

  bool operator()(double start) {
    if (!look(start)) return search(start);
    for (int i = 0; i < newton_steps_allowed && !bracketed(); ++i) {
      const double step = newton_step();
      if (done(step)) return true;
      if (bracketed() || !std::isfinite(step)) break;
      if (!moved_ && !descend(step)) break;
    }
    return bracketed() ? inside_bracket() : search(start);
  }

 private:
  bool bracketed() const { return std::isfinite(above_) && std::isfinite(below_); }

  double newton_step() const {
    const double slope = s_.slope[0];
    return std::isfinite(slope) ? s_.residual[0] / slope : std::numeric_limits<double>::quiet_NaN();
  }

  /// Evaluates at v and remembers the sign.
  bool look(double v) {
    s_.v[0] = v;
    if (!evaluate(s_, program_, loop_)) return false;
    const double r = s_.residual[0];
    s_.weakest = std::abs(s_.slope[0]) / (1 + std::abs(1 - s_.slope[0]));
    note_best(s_, 1, std::abs(r));
    if (r >= 0) above_ = v;  // F(v) lies above v
    if (r <= 0) below_ = v;
    return true;
  }

  /// The solution is one step away, and the step is small. Takes a step that is only tolerable, to see whether it helps
  /// (moved_).
  bool done(double step) {
    moved_ = false;
    if (s_.residual[0] == 0) return true;
    if (!(std::abs(step) <= tolerance(s_, loop_, 0))) return false;
    if (std::abs(step) <= tight(s_, 0)) {
      s_.v[0] += step;
      return true;
    }
    const double from = s_.v[0], before = std::abs(s_.residual[0]);
    moved_ = look(from + step);
    if (moved_ && std::abs(s_.residual[0]) <= 0.5 * before) return false;
    if (!moved_ || std::abs(s_.residual[0]) > before) s_.v[0] = from;
    return true;
  }

  /// A step that brings the residual down, or to the other sign.
  bool descend(double step) {
    const double from = s_.v[0], before = std::abs(s_.residual[0]);
    double share = 1;
    for (int i = 0; i < halvings_allowed; ++i, share /= 2)
      if (look(from + share * step) &&
          (bracketed() || std::abs(s_.residual[0]) <= (1 - enough_descent * share) * before))
        return true;
    return false;
  }

  bool inside_bracket() {
    s_.bracketed = true;
    double before = std::numeric_limits<double>::infinity();
    moved_ = false;
    for (int i = 0; i < 8 * newton_steps_allowed; ++i, moved_ = false) {
      const double step = newton_step();
      const double low = std::min(above_, below_), high = std::max(above_, below_);
      double next = s_.v[0] + step;
      const bool newton = next >= low && next <= high && std::abs(s_.residual[0]) <= 0.5 * before;
      if (s_.residual[0] == 0 || (next >= low && next <= high && done(step))) return true;
      if (moved_) continue;
      if (high - low <= (i < newton_steps_allowed ? tight(s_, 0) : tolerance(s_, loop_, 0))) return !jumps();
      before = newton ? std::abs(s_.residual[0]) : std::numeric_limits<double>::infinity();
      if (!newton) next = low + 0.5 * (high - low);
      if (!look(next)) return false;
    }
    return false;
  }

  /// The two ends of the bracket lie side by side: is r small there, or does it change sign without being zero?
  bool jumps() {
    const double width = std::abs(above_ - below_);
    const double at_above = above_, at_below = below_;
    look(at_above);
    const double top = s_.residual[0], steep = std::abs(s_.slope[0]);
    look(at_below);
    const double bottom = -s_.residual[0];
    const double most = 1e3 * (1 + std::max(steep, std::abs(s_.slope[0]))) * (width + tolerance(s_, loop_, 0));
    s_.v[0] = at_above + (at_below - at_above) * (top + bottom > 0 ? top / (top + bottom) : 0.5);
    s_.jumps = top + bottom > most;
    return s_.jumps;
  }

  /// Newton found nothing: a change of sign at F(v), else on both sides of the start in doubling distances.
  bool search(double start) {
    above_ = below_ = std::numeric_limits<double>::quiet_NaN();
    const bool regular = look(start);
    const double first = s_.residual[0];
    if (regular && first == 0) return true;
    if (regular && look(start + first) && bracketed()) return inside_bracket();
    double distance = std::max(regular ? std::abs(first) : 0.0, 1e3 * tolerance(s_, loop_, 0));
    if (!(distance > 0) || !std::isfinite(distance)) distance = usual_size;
    struct Point {
      double v;
      bool known, above;
    };
    Point nearest[2];  // per side, the last point that was looked at
    nearest[0] = nearest[1] = {start, regular, regular && first >= 0};
    for (int i = 0; i < doublings_allowed; ++i, distance *= 2)
      for (int side = 0; side < 2; ++side) {
        const double v = start + (side == 0 ? distance : -distance);
        if (!look(v)) continue;
        Point& inner = nearest[side];
        const bool above = s_.residual[0] >= 0;
        if (inner.known && inner.above != above) {
          above_ = above ? v : inner.v;
          below_ = above ? inner.v : v;
          return inside_bracket();
        }
        inner = {v, true, above};
      }
    return false;
  }

  LoopSolver& s_;
  const Program& program_;
  const Loop& loop_;
  double above_ = std::numeric_limits<double>::quiet_NaN(), below_ = std::numeric_limits<double>::quiet_NaN();
  bool moved_ = false;
};

// --- several tears
// ----------------------------------------------------------------------------------------------------

class Several {
 public:
  Several(LoopSolver& s, const Program& program, const Loop& loop)
      : s_(s), program_(program), loop_(loop), n_(static_cast<int>(loop.tears.size())) {}

  /// From s.v on.
  bool operator()() {
    if (!evaluate(s_, program_, loop_)) return false;
    for (int i = 0; i < newton_steps_allowed; ++i) {
      for (int k = 0; k < n_; ++k) s_.weight[at(k)] = tolerance(s_, loop_, k);
      const double before = norm(s_.residual);
      const bool regular = factor(s_, loop_);
      note_best(s_, n_, before);
      if (before == 0) return true;
      if (!regular) return false;
      std::copy_n(s_.residual.begin(), n_, s_.right.begin());
      back_substitute(s_, n_);
      const bool small = within_tolerance();
      if (small && within_tight()) {
        for (int k = 0; k < n_; ++k) s_.v[at(k)] += s_.step[at(k)];
        return true;
      }
      // Where rounding allows no descent, a tolerable step is the end.
      if (!descend(before)) return small;
      if (small && norm(s_.residual) > 0.5 * before) return true;
    }
    return false;
  }

 private:
  double norm(const std::vector<double>& r) const {
    double sum = 0;
    for (int k = 0; k < n_; ++k) sum += r[at(k)] / s_.weight[at(k)] * (r[at(k)] / s_.weight[at(k)]);
    return std::sqrt(sum);
  }
  bool within_tolerance() const {
    for (int k = 0; k < n_; ++k)
      if (!(std::abs(s_.step[at(k)]) <= s_.weight[at(k)])) return false;
    return true;
  }
  bool within_tight() const {
    for (int k = 0; k < n_; ++k)
      if (std::abs(s_.step[at(k)]) > tight(s_, k)) return false;
    return true;
  }

  bool descend(double before) {
    std::copy_n(s_.v.begin(), n_, s_.trial.begin());  // where it stood
    double share = 1;
    for (int i = 0; i < halvings_allowed; ++i, share /= 2) {
      for (int k = 0; k < n_; ++k) s_.v[at(k)] = s_.trial[at(k)] + share * s_.step[at(k)];
      if (evaluate(s_, program_, loop_) && norm(s_.residual) <= (1 - enough_descent * share) * before) return true;
    }
    std::copy_n(s_.trial.begin(), n_, s_.v.begin());
    return false;
  }

  LoopSolver& s_;
  const Program& program_;
  const Loop& loop_;
  int n_;
};

bool solve(LoopSolver& s, const Program& program, const Loop& loop) {
  const auto n = loop.tears.size();
  s.best_norm = std::numeric_limits<double>::infinity();
  s.jumps = s.bracketed = false;
  const double* warm = s.run->warm.data() + loop.warm_begin;
  if (n == 1) return Scalar(s, program, loop)(warm[0]);
  std::copy_n(warm, n, s.v.begin());
  if (Several(s, program, loop)()) return true;
  std::fill_n(s.v.begin(), n, 0.0);
  return Several(s, program, loop)();
}

/// As solve(), and counts what it took.
bool solve_and_count(LoopSolver& s, const Program& program, int index) {
  const long before = s.evaluations;
  const bool solved = solve(s, program, program.loops[at(index)]);
  LoopCounters& c = s.counters[at(index)];
  const long took = s.evaluations - before;
  c.evaluations += took;
  c.most_evaluations = std::max(c.most_evaluations, static_cast<int>(took));
  ++(solved ? c.solved : c.failed);
  c.bracketed += solved && s.bracketed ? 1 : 0;
  return solved;
}

template <class T>
void give_up(const Program& program, WorkOf<T>& work, const Loop& loop) {
  const T none(std::numeric_limits<double>::quiet_NaN());
  for (const Step& step : loop.steps) {
    const BlockInstance& b = program.blocks[at(step.block)];
    if (step.order == Order::derivative)
      std::fill_n(work.dx.begin() + b.x_begin, b.sizes.states, none);
    else
      std::fill_n((step.order == Order::value ? work.y : work.rate).begin() + b.y_begin, b.sizes.outputs, none);
  }
}

/// The tears' slopes along the directions of `work`: what the steps make of the other slopes, through (I - F_v)^-1.
void find_slopes(LoopSolver& s, const Program& program, const Loop& loop, JetWork& work, const Jet* x) {
  const int n = static_cast<int>(loop.tears.size());
  steps::run(loop.steps, program, work, x);  // the tears stand still
  const bool regular = evaluate(s, program, loop) && factor(s, loop);
  for (int direction = 0; direction < Jet::directions; ++direction) {
    for (int i = 0; i < n; ++i) s.right[at(i)] = number(work, loop.tears[at(i)]).slope[direction];
    if (std::all_of(s.right.begin(), s.right.begin() + n, [](double r) { return r == 0; })) continue;
    if (regular)
      back_substitute(s, n);
    else
      std::fill_n(s.step.begin(), n, std::numeric_limits<double>::quiet_NaN());
    for (int i = 0; i < n; ++i) number(work, loop.tears[at(i)]).slope[direction] = s.step[at(i)];
  }
  for (int i = 0; i < n; ++i) number(work, loop.tears[at(i)]).value = s.v[at(i)];
}

}  // namespace

LoopSolver::LoopSolver(const Program& program)
    : jets(program, false), x(at(program.n_x)), counters(program.loops.size()) {
  std::size_t most = 0;
  for (const auto& loop : program.loops) most = std::max(most, loop.tears.size());
  for (auto* list : {&v, &residual, &trial, &scale, &right, &step, &weight, &best, &best_residual}) list->resize(most);
  slope.resize(most * most);
  factors.resize(most * most);
  pivots.resize(most);
  solved.resize(most);
}

template <class T>
void solve_loop(const Program& program, WorkOf<T>& work, int index, const T* x) {
  const Loop& loop = program.loops[at(index)];
  LoopSolver& s = *work.loops;
  take(s, program, loop, work, x);
  if (!s.outside_is_finite) return give_up(program, work, loop);  // the trouble lies elsewhere
  if (!solve_and_count(s, program, index)) {
    // A rate that only memory wished for is not missed for good: no reversal is seen at this instant.
    if (work.unsolved < 0 && loop.needed) work.unsolved = index;
    return give_up(program, work, loop);
  }
  for (std::size_t i = 0; i < loop.tears.size(); ++i) number(work, loop.tears[i]) = T(s.v[i]);
  if constexpr (std::is_same_v<T, Jet>) find_slopes(s, program, loop, work, x);
  if constexpr (std::is_same_v<T, Jet>)
    for (std::size_t i = 0; i < loop.tears.size(); ++i) s.solved[i] = number(work, loop.tears[i]);
  steps::run(loop.steps, program, work, x);
  // What is solved for is known better than what the steps make of it: with a high gain these magnify its rounding.
  for (std::size_t i = 0; i < loop.tears.size(); ++i) {
    if constexpr (std::is_same_v<T, Jet>) {
      number(work, loop.tears[i]) = s.solved[i];
    } else {
      T& made = number(work, loop.tears[i]);
      const double left = std::abs(made - s.v[i]);
      const double size = tolerance(s, loop, static_cast<int>(i)) / (s.run->loop_relative + roundings);
      double& worst = s.counters[at(index)].worst_residual;
      if (left > worst * size) worst = left / size;
      made = s.v[i];
    }
  }
}
template void solve_loop<double>(const Program&, WorkOf<double>&, int, const double*);
template void solve_loop<Jet>(const Program&, WorkOf<Jet>&, int, const Jet*);

void set_loop_accuracy(const Program& program, Run& run, double relative_tolerance, double absolute_tolerance) {
  if (program.loops.empty()) return;
  run.loop_relative = share_of_tolerance * relative_tolerance;
  const NominalSizes sizes = nominal_sizes(program, run);
  const double per_second = sizes.time_scale > 0 ? 1 / sizes.time_scale : 1.0;
  const auto length = parse_unit("m").dimension;
  for (const Loop& loop : program.loops)
    for (std::size_t i = 0; i < loop.tears.size(); ++i) {
      const Slot& slot = loop.tears[i];
      double size = 0;
      if (slot.order == Order::derivative) {
        size = sizes.states[at(slot.index)];
      } else {
        size = sizes.signals[at(slot.index)];
        if (!(size > 0)) size = program.signals[at(slot.index)].dimension == length ? usual_length : usual_size;
      }
      if (!loop.of_values()) size *= per_second;
      run.loop_absolute[at(loop.warm_begin) + i] = run.loop_relative * absolute_tolerance * size;
    }
}

void keep_loops(const Program& program, Run& run, const Work& work, bool values) {
  for (const Loop& loop : program.loops) {
    if (loop.of_values() != values || !loop.needed) continue;
    for (std::size_t i = 0; i < loop.tears.size(); ++i) run.warm[at(loop.warm_begin) + i] = number(work, loop.tears[i]);
  }
}

void throw_if_unsolved(const Program& program, const Work& work, double t) {
  if (work.unsolved < 0) return;
  const Loop& loop = program.loops[at(work.unsolved)];
  const LoopSolver& s = *work.loops;
  std::string text =
      fmt::format("no solution was found for the algebraic loop at t = {:.9g} s\n  {}", t, to_text(program, loop.path));
  const bool finite = std::isfinite(s.best_norm);
  for (std::size_t i = 0; i < loop.tears.size(); ++i) {
    const Slot& slot = loop.tears[i];
    const bool state = slot.order == Order::derivative;
    const SignalInfo* signal = state ? nullptr : &program.signals[at(slot.index)];
    const Unit unit = signal != nullptr ? signal->unit : Unit{};
    const std::string name = state ? program.state_names[at(slot.index)] : signal->path;
    const std::string kind = slot.order == Order::value  ? ""
                             : slot.order == Order::rate ? "rate of "
                                                         : "derivative of ";
    const std::string shown = (state ? "SI" : unit.text) + (slot.order == Order::value ? "" : state ? "" : "/s");
    const double start = s.run->warm[at(loop.warm_begin) + i];
    const auto show = [&](double si) {
      return slot.order == Order::value ? unit.from_si(si) : unit.difference_from_si(si);
    };
    text += finite
                ? fmt::format(
                      "\n  {}{}: from {:.6g} the search came to {:.6g} {}, where the blocks make {:.6g} of it "
                      "(residual {:.3g})",
                      kind, name, show(start), show(s.best[i]), shown, show(s.best[i] + s.best_residual[i]),
                      unit.difference_from_si(s.best_residual[i]))
                : fmt::format("\n  {}{}: at {:.6g} {}, where the search starts, the blocks make no finite number of it",
                              kind, name, show(start), shown);
  }
  if (s.jumps)
    text += "\n  what the blocks make jumps across that number: there is no value at which the loop agrees with itself";
  else if (finite && s.best_weakest < fold)
    text += fmt::format(
        "\n  the slope of the residual nearly vanishes there ({:.2g} of the loop's gain): a fold, behind which there "
        "is "
        "no solution, or a loop with gain one, which has none or any number",
        s.best_weakest);
  const Step& first = loop.path.front();
  fail_numerics(
      "loop_unsolved", program.blocks[at(first.block)].path, text,
      fmt::format(
          "give a start near the solution (\"simulate\": {{\"guess\": {{\"{}\": ...}}}}); or put a block with a "
          "state into the loop (a lag: the amplifier's or the sensor's dynamics), so that it is none any more; "
          "or use an explicit inverse block instead of the loop",
          loop.tears.front().order == Order::value ? program.signals[at(loop.tears.front().index)].path
                                                   : program.blocks[at(first.block)].path));
}

}  // namespace hysteron
