// Decides how a mass steps through a row while its spring or guide remembers the way that it came: the linear motion
// exactly, what they and all that is not linear hold along the way. Does not decide what they hold.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "blocks/mechanics/mass_spring_damper.h"
#include "engine/block/rows.h"
#include "models/mechanics/mass_motion.h"
#include "models/mechanics/mass_spring_damper.h"

namespace hysteron::blocks {

/// Of a mass whose states x are position, velocity, and what Held remembers, which says what the mass is pulled with:
///   pull_at(x)         in these states [N]
///   place(x, speed)    it stands there from now on, and moves about as fast as that [m/s]
///   pull(way)          where the mass has moved by `way` [m] in one direction from there [N]
///   force(way)         the same, with how it changes with the place
///   move(way, x)       leaves in x what it remembers behind that way
/// mass_motion::step_under, and in the longest rows step_to_balance; Runge-Kutta for the mass alone where rows are too
/// short for that, or nothing drives it back.
template <class Held>
class StepUnderMemory {
 public:
  StepUnderMemory(const mass_spring_damper::Params<double>& law, Held held)
      : law_(law), beyond_(law), held_(std::move(held)) {}

  bool takes(double) const { return true; }

  void operator()(double* x, const double* from, const double* to, double h) {
    const int steps = mass_motion::steps_of_row(law_.mass, law_.stiffness, h);
    if (steps == 0) return long_row(x, *from, *to, h);
    for (int i = 0; i < steps; ++i) {
      const double begin = *from + (*to - *from) * i / steps;
      const double end = i + 1 == steps ? *to : *from + (*to - *from) * (i + 1) / steps;
      short_row(x, begin, end, h / steps);
    }
  }

 private:
  /// What is held is a function of the way since the last turning point: a row in which the motion turns is two.
  void short_row(double* x, double from, double to, double h) {
    const double rise = (to - from) / h;
    double left = h;
    for (int legs = 0; legs < 4 && left > 0; ++legs) {
      const double begin = to - rise * left;
      const double gain = mass_spring_damper::acceleration(law_, x[0], x[1], begin + held_.pull_at(x));
      held_.place(x, x[1] + 0.5 * left * gain);
      double length = left;
      auto end = leg(x, begin, to, length);
      if (legs < 3 && x[1] * end.velocity < 0) {
        for (int i = 0; i < 2; ++i) {
          length = std::min(left, length * std::clamp(x[1] / (x[1] - end.velocity), 0.0, 1.5));
          end = leg(x, begin, begin + rise * length, length);
        }
      }
      arrive(x, end);
      left = length < left ? left - length : 0;
    }
  }

  /// The mass alone, on a spring of which what is held is a part.
  mass_motion::Motion leg(const double* x, double from, double to, double h) {
    const mass_motion::Motion begin{x[0], x[1]};
    const auto at = [&](double place) { return held_.pull(place - x[0]); };
    if (mass_motion::has_exact_step(law_.mass, law_.damping, law_.stiffness, h)) {
      const auto &whole = row_.of(law_, h), &half = half_row_.of(law_, h / 2);
      if (beyond_.is_none()) return mass_motion::step_under(whole, half, begin, from, to, at);
      return mass_motion::step_under(whole, half, begin, from, to, at, beyond_, beyond_.rounds());
    }
    std::array<double, 2> moved{x[0], x[1]};
    std::array<double, 10> work;
    block_detail::runge_kutta(2, moved.data(), h, work.data(), [&](double c, const double* now, double* rate) {
      const double force = from + c * (to - from) + at(now[0]);
      rate[0] = now[1];
      rate[1] = mass_spring_damper::acceleration(law_, now[0], now[1], force);
    });
    return {moved[0], moved[1]};
  }

  void long_row(double* x, double from, double to, double h) {
    const auto& step = row_.of(law_, h);
    const mass_motion::Motion begin{x[0], x[1]};
    const double beside = beyond_(begin), before = held_.pull_at(x) + beside;
    const double expected = step(begin, from + before, to + before).position;
    // Of the mean speed as it is expected: a force that falls while the speed rises would balance at several places.
    held_.place(x, (expected - x[0]) / h);
    arrive(x, mass_motion::step_to_balance(step, begin, from, to, held_.force(0).value + beside, [&](double place) {
             const auto held = held_.force(place - x[0]), more = beyond_.behind_row(x[0], place, h);
             return mass_motion::Force{held.value + more.value, held.slope + more.slope};
           }));
  }

  void arrive(double* x, const mass_motion::Motion& end) {
    held_.move(end.position - x[0], x);
    x[0] = end.position;
    x[1] = end.velocity;
  }

  mass_spring_damper::Params<double> law_;
  BeyondLinear beyond_;
  Held held_;
  RowStep row_, half_row_;
};

}  // namespace hysteron::blocks
