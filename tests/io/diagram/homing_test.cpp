// diagrams/motion/homing.json against the same motion in closed form: a lag from one velocity to the next.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "blocks/register_all.h"
#include "engine/simulate/simulate.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

constexpr double lag = 0.02, meets = 1.7e-3, leaves = 1.9e-3;  // [s], [m] where the switch closes and opens again

/// From t0 on the velocity goes from v0 to c with the time constant of the drive.
struct Phase {
  double t0, x0, v0, c;
  double v(double t) const { return c + (v0 - c) * std::exp(-(t - t0) / lag); }
  double x(double t) const { return x0 + c * (t - t0) + lag * (v0 - c) * (1 - std::exp(-(t - t0) / lag)); }
  /// Where it has come to `place`, between two times on whose sides of it it is.
  double at(double place, double begin, double end) const {
    for (int i = 0; i < 200; ++i) {
      const double middle = (begin + end) / 2;
      ((x(middle) < place) == (x(begin) < place) ? begin : end) = middle;
    }
    return end;
  }
  Phase then(double t, double velocity) const { return {t, x(t), v(t), velocity}; }
};

TEST(Homing, MovesAsTheClosedFormDoes) {
  std::vector<Phase> phases{{0, 30e-3, 0, -40e-3}};
  phases.push_back(phases[0].then(phases[0].at(meets, 0, 2), 10e-3));
  const Phase& away = phases[1];
  const double turns = away.t0 + lag * std::log(1 - away.v0 / away.c);
  phases.push_back(away.then(std::max(away.at(leaves, turns, turns + 1), away.t0 + 0.15), -2e-3));
  const Phase& back = phases[2];  // still going away at first
  phases.push_back(back.then(back.at(meets, back.t0 + 0.1, back.t0 + 3), 0));
  ASSERT_LT(phases[3].t0, 3.5);

  const auto registry = all_blocks();
  const Diagram diagram = read_diagram(HYSTERON_SOURCE_DIR "/diagrams/motion/homing.json");
  const auto program = compile(diagram, registry);
  SimulateOptions options = simulate_options(*program);
  options.signals = {program->signal("axis"), program->signal("machine.state"), program->signal("position")};
  const Traces traces = simulate(*program, start(*program), options);
  ASSERT_GT(traces.t.size(), 390U);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double t = traces.t[k];
    std::size_t now = 0;
    while (now + 1 < phases.size() && t >= phases[now + 1].t0) ++now;
    const bool at_change = now > 0 && t - phases[now].t0 < 1e-5;
    const double x = phases[now].x(t);
    EXPECT_NEAR(traces.values[0][k], x, 3e-7) << t;  // ten times 1e-6 of the stroke
    if (at_change) continue;
    EXPECT_EQ(traces.values[1][k], static_cast<double>(now)) << t;
    EXPECT_NEAR(traces.values[2][k], now == 3 ? x - meets : x, 3e-7) << t;
  }
  // it runs on by the velocity times the lag
  EXPECT_NEAR(traces.values[2].back(), phases[3].v0 * lag, 3e-7);
}

}  // namespace
}  // namespace hysteron
