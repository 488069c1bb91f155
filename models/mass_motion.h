// Decides the motion of one mass on a spring with a damper over one step of any length, the force moving in a straight
// line: exactly for the linear part, implicitly for a force that depends on where the step ends. Does not decide what
// that force is.
#pragma once

#include <cmath>
#include <limits>

namespace hysteron::mass_motion {

struct Motion {
  double position = 0;  ///< [m]
  double velocity = 0;  ///< [m/s]
};

/// The step of length h [s] of m x'' + d x' + k x = F(t), F linear in between. k > 0, and h sqrt(k/m) not far below 1:
/// for much shorter steps the closed form cancels.
/// Source: superposition of the static answer to F, of that to F', and of the free motion; e.g. Craig, Kurdila,
/// Fundamentals of Structural Dynamics (2006), section 6.
class ExactStep {
 public:
  ExactStep(double mass, double damping, double stiffness, double h) {
    const double a = damping / (2 * mass), square = stiffness / mass;
    free_motion(a, square, h);
    const double lag = damping / (stiffness * h);  // by which the answer to a ramp trails behind it
    to_both_.position = (1 - xx_) / stiffness;
    to_both_.velocity = -vx_ / stiffness;
    to_rise_.position = (1 - lag + xx_ * lag - xv_ / h) / stiffness;
    to_rise_.velocity = (1 / h + vx_ * lag - vv_ / h) / stiffness;
  }

  /// From `start`, the force going from `begin` to `end` [N].
  Motion operator()(const Motion& start, double begin, double end) const {
    const double rise = end - begin;
    return {xx_ * start.position + xv_ * start.velocity + to_both_.position * begin + to_rise_.position * rise,
            vx_ * start.position + vv_ * start.velocity + to_both_.velocity * begin + to_rise_.velocity * rise};
  }
  /// How far each newton of the force at the end moves the end [m/N]; positive.
  double yield() const { return to_rise_.position; }

 private:
  void free_motion(double a, double square, double h) {
    const double d = a * a - square;
    double c = 0, s = 0;  // exp(-a h) cosh(w h), exp(-a h) sinh(w h)/w, w^2 = d
    if (d < 0) {
      const double w = std::sqrt(-d), e = std::exp(-a * h);
      c = e * std::cos(w * h);
      s = e * std::sin(w * h) / w;
    } else {
      const double w = std::sqrt(d), slow = std::exp((w - a) * h), fast = std::exp(-(w + a) * h);
      c = 0.5 * (slow + fast);
      s = w * h > 0.5 ? 0.5 * (slow - fast) / w : w > 0 ? std::exp(-a * h) * std::sinh(w * h) / w : h * slow;
    }
    xx_ = c + a * s;
    xv_ = s;
    vx_ = -square * s;
    vv_ = c - a * s;
  }

  double xx_ = 0, xv_ = 0, vx_ = 0, vv_ = 0;
  Motion to_both_, to_rise_;
};

/// A force and how it changes with the place: [N], [N/m].
struct Force {
  double value = 0, slope = 0;
};

/// The place x [m] where x = free + yield F(x), from a place near it: damped Newton. Not a number where there is none.
template <class Law>
double end_position(double free, double yield, double x, const Law& force) {
  const auto off = [&](double place, const Force& f) { return place - free - yield * f.value; };
  Force now = force(x);
  double error = off(x, now);
  for (int i = 0; i < 60; ++i) {
    double move = -error / (1 - yield * now.slope);
    if (!std::isfinite(move)) break;
    if (std::fabs(move) <= 1e-14 * (std::fabs(x) + std::fabs(free))) return x + move;
    double next = x + move;
    Force there = force(next);
    for (int halved = 0; halved < 40 && !(std::fabs(off(next, there)) < std::fabs(error)); ++halved) {
      move *= 0.5;
      next = x + move;
      there = force(next);
    }
    if (!(std::fabs(off(next, there)) < std::fabs(error))) return x;  // as near as numbers come
    x = next;
    now = there;
    error = off(x, now);
  }
  return std::fabs(error) <= 1e-9 * (std::fabs(x) + std::fabs(free)) ? x : std::numeric_limits<double>::quiet_NaN();
}

/// Into how many steps a row of h [s] is cut for an explicit formula; [kg], [N/m]. One up to a radian of the free
/// motion; of an eighth of a radian each in longer rows, which costs Runge-Kutta two millionths of the ringing per
/// radian; 0 from ten radians on: there the linear motion is better taken exactly and the rest as a force that moves in
/// a straight line. In shorter rows that would be too crude: what sticks and slips beside the spring turns inside them.
inline int steps_of_row(double mass, double stiffness, double h) {
  const double square = h * h * stiffness / mass;
  return !(square > 1) ? 1 : square > 100 ? 0 : static_cast<int>(std::ceil(8 * std::sqrt(square)));
}

}  // namespace hysteron::mass_motion
