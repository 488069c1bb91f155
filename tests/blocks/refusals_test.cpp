// Values and shapes that do not go together are refused, each with a cure behind the semicolon.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/blocks/bench.h"

namespace hysteron {
namespace {

using bench::Bench;

constexpr double inf = std::numeric_limits<double>::infinity();

struct Refusal {
  std::string name, type;
  Bench::Values values;
  int inputs;
  bool by_shape;     ///< refused by sizes(), else by check()
  std::string what;  ///< part of the text
};

class Refused : public testing::TestWithParam<Refusal> {};
TEST_P(Refused, NamesWhatIsWrongAndTheCure) {
  const auto& r = GetParam();
  const Bench b(r.type, r.values, r.inputs);
  const std::string text = r.by_shape ? b.sizes.error : b.check();
  EXPECT_NE(text.find(r.what), std::string::npos) << text;
  const auto cure = text.find("; ");
  ASSERT_NE(cure, std::string::npos) << text;
  EXPECT_GT(text.size(), cure + 5) << "the cure is empty: " << text;
}
INSTANTIATE_TEST_SUITE_P(
    Table, Refused,
    testing::Values(
        Refusal{"more_signs_than_wires", "sum", {{"signs", {'+', '-', '+'}}}, 2, true, "3 signs for 2 wires"},
        Refusal{"sign_that_is_none", "sum", {{"signs", {'+', 'x'}}}, 2, false, "'x'"},
        Refusal{"derivative_in_disguise",
                "transfer_function",
                {{"num", {1, 2, 3}}, {"den", {1, 2}}},
                1,
                true,
                "differentiates"},
        Refusal{"empty_denominator", "transfer_function", {{"num", {1}}, {"den", {}}}, 1, true, "at least one"},
        Refusal{"leading_zero", "transfer_function", {{"num", {1}}, {"den", {0, 1, 2}}}, 1, false, "first coefficient"},
        Refusal{"no_pole", "lag", {{"times", {}}}, 1, true, "empty"},
        Refusal{"unequal_creep_lists", "creep", {{"amounts", {1, 2}}, {"times", {1}}}, 1, true, "one length"},
        Refusal{"unequal_play_lists",
                "prandtl_ishlinskii",
                {{"thresholds", {0, 1}}, {"weights", {1}}},
                1,
                true,
                "one length"},
        Refusal{"no_levels", "staircase", {{"levels", {}}, {"duration", {1}}}, 0, true, "empty"},
        Refusal{"limits_exchanged", "saturation", {{"lower", {2}}, {"upper", {1}}}, 1, false, "not below"},
        Refusal{"no_limit_at_all", "saturation", {{"lower", {-inf}}, {"upper", {inf}}}, 1, false, "neither"},
        Refusal{"band_upside_down",
                "multisine",
                {{"rms", {1}}, {"lowest", {5}}, {"highest", {1}}, {"spacing", {1}}},
                0,
                false,
                "below lowest"},
        Refusal{"too_many_sines",
                "multisine",
                {{"rms", {1}}, {"lowest", {1}}, {"highest", {1e6}}, {"spacing", {1}}},
                0,
                false,
                "too many"},
        Refusal{"broken_seed",
                "multisine",
                {{"rms", {1}}, {"lowest", {1}}, {"highest", {5}}, {"spacing", {1}}, {"seed", {1.5}}},
                0,
                false,
                "whole number"},
        Refusal{
            "negative_seed", "sensor_noise", {{"rms", {1}}, {"period", {1}}, {"seed", {-1}}}, 1, false, "whole number"},
        Refusal{"exponent_without_scale",
                "bouc_wen",
                {{"alpha", {1}}, {"beta", {1}}, {"gamma", {1}}, {"d_p", {1}}, {"exponent", {2}}},
                1,
                false,
                "scale"}),
    [](const auto& made) { return made.param.name; });

TEST(Samples, AreNotRefused) {
  for (const auto& s : bench::samples()) {
    const Bench b(s.type, s.values, s.inputs);
    EXPECT_EQ(b.sizes.error, "") << s.type;
    EXPECT_EQ(b.check(), "") << s.type;
  }
}

}  // namespace
}  // namespace hysteron
