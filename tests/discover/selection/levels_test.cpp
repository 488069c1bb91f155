// A column that a converter rounds, of a model whose numbers are off: levels are told, numbers are told, and nothing
// that happens to move what is rounded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discover/selection/discover.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double gain = 2, time_constant = 0.5;  // [m/V], [s]
constexpr double level = 0.1;                    // [m], of signals of 2 m
constexpr double before_rounding = 0.004;        // [m], noise

/// A lag between held samples, exactly: x' = (K u - x)/T.
std::vector<double> lagged(const std::vector<double>& t, const std::vector<double>& u) {
  std::vector<double> y{0};
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double to = gain * u[k - 1];
    y.push_back(to + (y.back() - to) * std::exp(-(t[k] - t[k - 1]) / time_constant));
  }
  return y;
}

/// `zero` [m]: one of the levels.
DataSet rounded(std::uint64_t seed, double zero = 0) {
  std::vector<Recording> list;
  for (int r = 0; r < 4; ++r) {
    const auto t = rows(800, 0.02);
    const auto u =
        r % 2 == 0 ? levels(t, {0.4, 1, 0.2 + 0.1 * r, 0.7, 0.1}) : several_sines(t, 1, {0.11 + 0.03 * r, 0.47});
    auto y = lagged(t, u);
    const auto n = noise(t.size(), before_rounding, 0, seed + static_cast<std::uint64_t>(r));
    for (std::size_t k = 0; k < y.size(); ++k) y[k] = zero + level * std::floor((y[k] + n[k] - zero) / level + 0.5);
    list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, std::move(y)));
    list.back().start_is_stated = true;
  }
  DataSet data = data_set(std::move(list), before_rounding, 0);
  data.notes["u"].between = Between::hold;
  return data;
}

Diagram lag_that_is_off() {
  Diagram d = plain_gain();
  d.blocks["stage"].parameters["gain"] = Value("2.2 m/V");
  Node& lag = d.blocks["lag"];
  lag.type = "lag";
  lag.parameters["times"] = Value("0.45 s");
  lag.in = {{"", "stage"}};
  d.outputs["y"] = "lag";
  return d;
}

class Levels : public Discoveries {};

TEST_F(Levels, NothingIsClaimedForMovingWhatTheyRound) {
  for (const std::uint64_t seed : {11, 21}) {
    const Discovery d = discovered(lag_that_is_off(), rounded(seed), {});
    ASSERT_EQ(d.steps.size(), 1u) << tried(d);
    EXPECT_EQ(winner(d), "quantization") << tried(d);
    EXPECT_NEAR(value(d, "step"), level, 1e-3 * level);
    // A level that is held has one error of rounding, 0.1/sqrt(12) = 0.03 m of a metre; some twenty of them, and what
    // moves between, know the gain to less than 1 % and the time constant to some times that.
    ASSERT_EQ(d.other_numbers.size(), 2u) << tried(d);
    for (const auto& n : d.other_numbers) {
      const bool is_gain = n.path == "stage.gain";
      EXPECT_NEAR(n.found, is_gain ? gain : time_constant, is_gain ? 0.02 * gain : 0.06 * time_constant) << n.path;
    }
  }
}

TEST_F(Levels, LieWhereTheColumnHasThem) {
  // A counter with an offset; a thermometer in degC is no other: none of its levels is 0 K.
  constexpr double zero = 0.037;
  const Discovery d =
      discovered(lag_that_is_off(), rounded(41, zero), {"quantization", "amplifier_lag", "calibration"});
  ASSERT_EQ(d.steps.size(), 1u) << tried(d);
  ASSERT_EQ(winner(d), "quantization") << tried(d);
  const auto program = compile(d.final_diagram, registry);
  double written = -1;
  for (const auto& p : program->parameters)
    if (p.path.ends_with(".zero")) written = p.value;
  const double steps = (written - zero) / value(d, "step");
  EXPECT_NEAR(steps, std::round(steps), 1e-3) << written;
  // Without rounding 0.1/sqrt(12) m are left, on levels that lie elsewhere 0.037 m at least.
  EXPECT_LT(d.final_error.rms_validate, 0.1 / std::sqrt(12.0)) << tried(d);
}

}  // namespace
}  // namespace hysteron
