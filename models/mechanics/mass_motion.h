// Decides the motion of one mass on a linear spring with a damper over one step of any length: exactly where the force
// is a straight line or a parabola in time; and how a force that hangs on the place becomes one. Does not decide what
// that force is.
#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace hysteron::mass_motion {

struct Motion {
  double position = 0;  ///< [m]
  double velocity = 0;  ///< [m/s]
};

/// The step of length h [s] of m x'' + d x' + k x = F(t), F a parabola or a straight line in between. k > 0, and h
/// sqrt(k/m) not far below a tenth: for much shorter steps the closed form cancels.
/// Source: superposition of the static answers to F, F' and F'', and of the free motion; e.g. Craig, Kurdila,
/// Fundamentals of Structural Dynamics (2006), section 6.
class ExactStep {
 public:
  ExactStep(double mass, double damping, double stiffness, double h) {
    const double a = damping / (2 * mass), square = stiffness / mass;
    free_motion(a, square, h);
    // The static answer to (t/h)^n is a polynomial that starts at some place with some velocity; the free motion takes
    // these away.
    const double lag = damping / (stiffness * h), swing = mass / (stiffness * h * h);
    to_both_ = answer(stiffness, 1, 0, 1, 0, h);
    to_rise_ = answer(stiffness, -lag, 1, 1 - lag, 1, h);
    const double bend = 2 * (lag * lag - swing);
    to_bend_ = answer(stiffness, bend, -2 * lag, 1 - 2 * lag + bend, 2 - 2 * lag, h);
  }

  /// From `start`, the force going from `begin` to `end` [N].
  Motion operator()(const Motion& start, double begin, double end) const {
    return (*this)(start, begin, end - begin, 0);
  }
  /// The force being begin + rise t/h + bend (t/h)^2.
  Motion operator()(const Motion& start, double begin, double rise, double bend) const {
    return {xx_ * start.position + xv_ * start.velocity + to_both_.position * begin + to_rise_.position * rise +
                to_bend_.position * bend,
            vx_ * start.position + vv_ * start.velocity + to_both_.velocity * begin + to_rise_.velocity * rise +
                to_bend_.velocity * bend};
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

  /// From rest, of a static answer that begins at x0 [N] with x0' [N per h] and ends so: all over k.
  Motion answer(double k, double x0, double v0, double x1, double v1, double h) const {
    return {(x1 - xx_ * x0 - xv_ * v0 / h) / k, (v1 / h - vx_ * x0 - vv_ * v0 / h) / k};
  }

  double xx_ = 0, xv_ = 0, vx_ = 0, vv_ = 0;
  Motion to_both_, to_rise_, to_bend_;
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
    if (!(std::fabs(off(next, there)) < std::fabs(error))) break;  // as near as numbers come, or no root is near
    x = next;
    now = there;
    error = off(x, now);
  }
  // Where rounding of the force ends the search a millionth of a millionth of it is left, times its yield.
  return std::fabs(error) <= 1e-9 * (std::fabs(x) + std::fabs(free)) ? x : std::numeric_limits<double>::quiet_NaN();
}

/// A long step under a force from outside that goes straight from `begin` to `end` [N] and one that hangs on the place,
/// force(x), taken as a straight line from `before` [N] at the start to its value at the end, which is found.
template <class Law>
Motion step_to_balance(const ExactStep& step, const Motion& start, double begin, double end, double before,
                       const Law& force) {
  const double free = step(start, begin + before, end).position;
  const double reached = end_position(free, step.yield(), free + step.yield() * before, force);
  return {reached, step(start, begin + before, end + force(reached).value).velocity};
}

/// A force at three places, and the parabola through them at a place so near to one of them that it may stand for the
/// force itself: not a number elsewhere, and where two of the three are the same.
struct NearPlaces {
  std::array<double, 3> x, force;

  double at(double place, double near) const {
    const double first = x[1] - x[0], second = x[2] - x[1], both = x[2] - x[0];
    // A hundredth of the way: what the parabola misses there is that share of what it misses between them.
    if (!(100 * std::fabs(place - near) <= std::fabs(first) + std::fabs(second)) || first == 0 || second == 0 ||
        both == 0)
      return std::numeric_limits<double>::quiet_NaN();
    const double rise = (force[1] - force[0]) / first;
    const double bend = ((force[2] - force[1]) / second - rise) / both;
    return force[0] + (place - x[0]) * (rise + (place - x[1]) * bend);
  }
};

/// No force besides.
struct NoForce {
  double operator()(const Motion&) const { return 0; }
};

/// A step under a force from outside that goes straight from `begin` to `end` [N] and one that hangs on the motion,
/// taken as the parabola through its values at the start, in the middle and at the end. It has two parts: pull(x) [N]
/// of the place, which is dear, and besides(motion) [N], which is not. Twice around, which is right to the fourth power
/// of the length for a force of the place, and three times where one of the velocity may be among the second part. From
/// the second time on the places have hardly moved, and the pull there follows from the first one's. half: the step of
/// half the length. Source: exponential time differencing, Cox, Matthews, J. Comput. Phys. 176 (2002) 430-455.
template <class Pull, class Besides = NoForce>
Motion step_under(const ExactStep& whole, const ExactStep& half, const Motion& start, double begin, double end,
                  const Pull& pull, const Besides& besides = {}, int rounds = 2) {
  const double held = pull(start.position), first = held + besides(start), rise = end - begin;
  double middle = first, last = first;
  const auto turn = [&] { return 4 * middle - 3 * first - last; };
  const auto bend = [&] { return 2 * (first - 2 * middle + last); };
  const auto halfway = [&] { return half(start, begin + first, 0.5 * (rise + turn()), 0.25 * bend()); };
  const auto behind = [&] { return whole(start, begin + first, rise + turn(), bend()); };
  const Motion in_middle = halfway();
  const double held_middle = pull(in_middle.position);
  middle = held_middle + besides(in_middle);
  last = 2 * middle - first;
  const Motion at_end = behind();
  const double held_last = pull(at_end.position);
  last = held_last + besides(at_end);
  const NearPlaces known{{start.position, in_middle.position, at_end.position}, {held, held_middle, held_last}};
  const auto again = [&](const Motion& now, const Motion& near) {
    const double force = known.at(now.position, near.position);
    return (std::isnan(force) ? pull(now.position) : force) + besides(now);
  };
  for (int round = 1; round < rounds; ++round) {
    middle = again(halfway(), in_middle);
    last = again(behind(), at_end);
  }
  return behind();
}

/// Whether ExactStep is exact but for rounding; [kg], [N s/m], [N/m], [s]. Its answer to a parabola is what is left of
/// terms (radians)^-4 and (damping/(stiffness h))^4 as large: from a twentieth of a radian on, and up to a thousand,
/// six digits of it stand.
inline bool has_exact_step(double mass, double damping, double stiffness, double h) {
  return h * h * stiffness > 0.0025 * mass && damping < 1e3 * stiffness * h;
}

/// Into how many steps a row of h [s] is cut; [kg], [N/m]: one up to a radian of the free motion; 0 from ten radians
/// on, where what happens between the rows is left out; in between eight, whatever the row, so that halving it halves
/// them too, and who halves rows until nothing changes sees what they miss.
inline int steps_of_row(double mass, double stiffness, double h) {
  const double square = h * h * stiffness / mass;
  return !(square > 1) ? 1 : square > 100 ? 0 : 8;
}

}  // namespace hysteron::mass_motion
