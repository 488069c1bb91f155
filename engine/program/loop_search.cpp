#include "engine/program/loop_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/program/loop_equations.h"
#include "engine/program/nominal.h"

namespace hysteron {
namespace {

using namespace loop_equations;

constexpr int newton_steps_allowed = 60;
constexpr int halvings_allowed = 30;
constexpr double enough_descent = 1e-4;  // of what a linear loop would give (Armijo)
constexpr int doublings_allowed = 60;

void note_best(LoopSolver& s, int n, double norm) {
  if (!(norm < s.best_norm)) return;
  s.best_norm = norm;
  s.best_weakest = s.weakest;
  std::copy_n(s.v.begin(), n, s.best.begin());
  std::copy_n(s.residual.begin(), n, s.best_residual.begin());
}

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

/// Newton with all tears at once.
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

}  // namespace

bool search_loop(LoopSolver& s, const Program& program, const Loop& loop) {
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

}  // namespace hysteron
