// Structures that no effect describes, beside effects that imitate them, by formulas of their own.
#include "discover/selection/structure_term.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discover/selection/discover.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

constexpr double noise_of_gain = 2e-3;  // [m], of signals of 1

class StructureTerms : public Discoveries {
 protected:
  using Hidden = std::function<double(double t, double u, int recording)>;

  /// Two recordings to fit and one to judge of a gain of 1 m/V, with something hidden at its sensor.
  static DataSet recorded(const Hidden& hidden) {
    std::vector<Recording> list;
    for (int r = 0; r < 3; ++r) {
      const auto t = rows(1000, 0.01);
      const auto u = several_sines(t, 1, {0.13 + 0.02 * r, 0.31, 0.07});
      auto y = noise(t.size(), noise_of_gain, 0, 70 + static_cast<std::uint64_t>(r));
      for (std::size_t k = 0; k < t.size(); ++k) y[k] += u[k] + hidden(t[k], u[k], r);
      list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, std::move(y)));
    }
    return data_set(std::move(list), noise_of_gain, 0);
  }
  Discovery selected(const Hidden& hidden) {
    DiscoverOptions options;
    options.only = {"calibration", "hysteresis",    "creep",          "asymmetry",
                    "saturation",  "amplifier_lag", "rate_dependence"};
    return discover(plain_gain(), recorded(hidden), registry, effects, options);
  }
};

TEST_F(StructureTerms, JumpsAtNoLevelAreNoEffect) {
  const std::vector<std::vector<double>> at{{1.03, 2.5, 4.4, 7.1}, {0.8, 3.3, 5.9}, {2.2, 4.1, 6.6, 8.3, 9.2}};
  const Discovery d = selected([&](double t, double, int r) {
    const auto& list = at[static_cast<std::size_t>(r)];
    return (std::upper_bound(list.begin(), list.end(), t) - list.begin()) % 2 == 1 ? 0.1 : 0.0;
  });
  EXPECT_EQ(d.verdict, Verdict::unexplained) << tried(d);
  ASSERT_TRUE(d.structure.has_value());
  EXPECT_EQ(d.structure->kind, "jumps");
  std::size_t found = 0;
  for (const auto& [name, list] : d.structure->intervals) found += list.size();
  EXPECT_EQ(found, 12u);
}

TEST_F(StructureTerms, AStepAtALevelIsNoEffect) {
  const Discovery d = selected([](double, double u, int) { return u > 0.6 ? 0.05 : 0.0; });
  EXPECT_EQ(d.verdict, Verdict::unexplained) << tried(d);
  ASSERT_TRUE(d.structure.has_value());
  EXPECT_EQ(d.structure->kind, "kink_at_level");
  EXPECT_NEAR(d.structure->threshold, 0.6, 0.01);  // u moves by less than that from row to row
}

// A clamp is a kink at a level, too, and says it by fewer numbers.
TEST_F(StructureTerms, ASaturationIsAnEffect) {
  const Discovery d = selected([](double, double u, int) { return std::min(u, 0.7) - u; });
  EXPECT_EQ(d.verdict, Verdict::missing_effect) << tried(d);
  EXPECT_EQ(winner(d), "saturation") << tried(d);
  EXPECT_FALSE(d.structure.has_value());
}

TEST_F(StructureTerms, NothingIsAheadWhereOnlyNoiseIsLeft) {
  const Discovery d = selected([](double, double, int) { return 0.0; });
  EXPECT_EQ(d.verdict, Verdict::adequate) << tried(d);
  EXPECT_FALSE(d.structure.has_value());
}

}  // namespace
}  // namespace hysteron
