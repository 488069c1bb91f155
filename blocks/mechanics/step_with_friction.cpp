#include "blocks/mechanics/step_with_friction.h"

#include <array>
#include <cmath>

#include "engine/block/rows.h"

namespace hysteron::blocks {
namespace {

constexpr int most_legs = 16;     // of a row: it slides, turns, sticks, breaks away, again
constexpr int most_guesses = 60;  // at the instant at which it turns

}  // namespace

MotionState<double> StepWithFriction::operator()(const MotionState<double>& s, const ForceIn<double>& from,
                                                 const ForceIn<double>& to, double h) {
  Motion now{s.position, s.velocity};
  const int steps = mass_motion::steps_of_row(body_.mass, body_.stiffness, h);
  if (steps == 0) {
    now = long_row(now, from.force, to.force, h);
  } else {
    const double way = to.force - from.force;
    for (int i = 0; i < steps; ++i)
      now = short_row(now, from.force + way * i / steps, i + 1 == steps ? to.force : from.force + way * (i + 1) / steps,
                      h / steps);
  }
  return {now.position, now.velocity};
}

mass_motion::Motion StepWithFriction::short_row(Motion now, double from, double to, double h) {
  if (friction::is_absent(law_)) return slide(now, from, to, h, true);
  const double rise = (to - from) / h;
  double left = h;
  for (int leg = 0; leg < most_legs && left > 0; ++leg) {
    double begin = to - rise * left;
    if (std::fabs(now.velocity) <= law_.rest_speed) {
      now.velocity = 0;
      const double held = sticks(now.position, begin, rise, left);
      if (!(held < left)) return now;
      left -= held;
      begin = to - rise * left;
    }
    const bool up = now.velocity != 0 ? now.velocity > 0 : friction::pull(law_, now.position, begin) > 0;
    const auto on = [&](const Motion& m) { return up ? m.velocity : -m.velocity; };
    const Motion end = slide(now, begin, to, left, up);
    if (!(on(end) < 0)) return end;
    // It turns before that: where the speed would be zero on a straight line, each third time in the middle.
    double early = 0, late = left, speed_early = on(now), speed_late = on(end);
    Motion turned = now;
    double when = 0;
    for (int i = 0; i < most_guesses && late - early > 1e-12 * h; ++i) {
      const double guess = early + (late - early) * speed_early / (speed_early - speed_late);
      when = i % 3 == 2 || !(guess > early && guess < late) ? 0.5 * (early + late) : guess;
      turned = slide(now, begin, begin + rise * when, when, up);
      const double speed = on(turned);
      (speed < 0 ? late : early) = when;
      (speed < 0 ? speed_late : speed_early) = speed;
      if (std::fabs(speed) <= law_.rest_speed) break;
    }
    now = {turned.position, 0};
    left -= when;
  }
  return now;
}

double StepWithFriction::sticks(double place, double from, double rise, double h) const {
  const double pull = friction::pull(law_, place, from);
  const double reserve = law_.breakaway - std::fabs(pull);
  if (reserve < 0 || (reserve == 0 && pull * rise >= 0)) return 0;
  if (rise == 0) return h;
  return std::fmax(0, ((rise > 0 ? law_.breakaway : -law_.breakaway) - pull) / rise);
}

mass_motion::Motion StepWithFriction::slide(const Motion& begin, double from, double to, double h, bool up) {
  const double side = up ? 1 : -1, dry = side * law_.coulomb;
  const bool falls = law_.stribeck_velocity > 0 && law_.breakaway != law_.coulomb;
  const auto more = [&](double velocity) {
    return falls ? side * (law_.coulomb - friction::sliding_force(law_, velocity)) : 0.0;
  };
  if (mass_motion::has_exact_step(body_.mass, body_.damping, body_.stiffness, h)) {
    const auto& whole = row_.of(body_, h);
    if (!falls && beyond_.is_none()) return whole(begin, from - dry, to - dry);
    const auto& half = half_row_.of(body_, h / 2);
    const auto besides = [&](const Motion& m) { return more(m.velocity) + beyond_(m); };
    return mass_motion::step_under(
        whole, half, begin, from - dry, to - dry, [](double) { return 0.0; }, besides, 3);
  }
  std::array<double, 2> moved{begin.position, begin.velocity};
  std::array<double, 10> work;
  block_detail::runge_kutta(2, moved.data(), h, work.data(), [&](double c, const double* now, double* rate) {
    rate[0] = now[1];
    rate[1] = mass_spring_damper::acceleration(body_, now[0], now[1], from + c * (to - from) - dry + more(now[1]));
  });
  return {moved[0], moved[1]};
}

mass_motion::Motion StepWithFriction::long_row(const Motion& begin, double from, double to, double h) {
  const double pull = friction::pull(law_, begin.position, to);
  if (std::fabs(pull) <= law_.breakaway) return {begin.position, 0};
  const bool up = pull > 0;
  const double dry = up ? law_.coulomb : -law_.coulomb, beside = beyond_(begin);
  const Motion end =
      mass_motion::step_to_balance(row_.of(body_, h), begin, from - dry, to - dry, beside,
                                   [&](double place) { return beyond_.behind_row(begin.position, place, h); });
  return {end.position, (up ? end.velocity : -end.velocity) > 0 ? end.velocity : 0};
}

}  // namespace hysteron::blocks
