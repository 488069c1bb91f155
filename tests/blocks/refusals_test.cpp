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
                "scale"},
        Refusal{"runaway_polarisation",
                "jiles_atherton",
                {{"p_s", {1}}, {"a", {1}}, {"alpha", {4}}, {"k", {1}}, {"c", {0.5}}},
                1,
                false,
                "run away"},
        Refusal{"nothing_pinned",
                "jiles_atherton_inverse",
                {{"p_s", {1}}, {"a", {1}}, {"alpha", {0}}, {"k", {1}}, {"c", {1}}},
                1,
                false,
                "nothing to pin"},
        Refusal{"no_slope_to_invert",
                "bouc_wen_inverse",
                {{"alpha", {2}}, {"beta", {1}}, {"gamma", {0}}, {"d_p", {1}}},
                1,
                false,
                "no inverse"},
        Refusal{"sampled_exponent_without_scale",
                "sampled_bouc_wen_inverse",
                {{"alpha", {1}}, {"beta", {1}}, {"gamma", {1}}, {"d_p", {2}}, {"exponent", {2}}, {"period", {1}}},
                1,
                false,
                "scale"},
        Refusal{"no_linear_part",
                "prandtl_ishlinskii_inverse",
                {{"thresholds", {0.1, 1}}, {"weights", {1, 1}}},
                1,
                false,
                "first threshold"},
        Refusal{"slope_that_ends",
                "prandtl_ishlinskii_inverse",
                {{"thresholds", {0, 1, 2}}, {"weights", {1, -0.5, -0.6}}},
                1,
                false,
                "up to number 3"},
        Refusal{"relay_without_hysteresis",
                "relay",
                {{"on_at", {1}}, {"off_at", {1}}, {"on_value", {1}}, {"off_value", {0}}},
                1,
                false,
                "chatters"},
        Refusal{"breakaway_below_coulomb",
                "mass_with_friction",
                {{"mass", {1}}, {"coulomb", {2}}, {"breakaway", {1}}},
                1,
                false,
                "below coulomb"},
        Refusal{"stops_exchanged",
                "mass_with_stops",
                {{"mass", {1}}, {"lower", {1}}, {"upper", {-1}}},
                1,
                false,
                "exchange"},
        Refusal{"start_behind_a_stop",
                "mass_with_stops",
                {{"mass", {1}}, {"lower", {-1}}, {"upper", {1}}, {"initial_position", {2}}},
                1,
                false,
                "between the stops"},
        Refusal{"tank_too_full",
                "tank",
                {{"area", {1}}, {"reference", {1}}, {"brim", {1}}, {"initial", {2}}},
                1,
                false,
                "above the brim"},
        Refusal{"pairs_missing",
                "thermal_network",
                {{"capacities", {1, 1, 1}}, {"to_ambient", {1, 1, 1}}, {"between", {1}}, {"initial", {1, 1, 1}}},
                4,
                true,
                "3 pairs"},
        Refusal{"no_body",
                "thermal_network",
                {{"capacities", {}}, {"to_ambient", {}}, {"initial", {}}},
                1,
                true,
                "one per body"},
        Refusal{"half_a_bit",
                "quantizer",
                {{"bits", {7.5}}, {"lower", {0}}, {"upper", {1}}, {"period", {1}}},
                1,
                false,
                "whole number"},
        Refusal{"endless_range",
                "quantizer",
                {{"bits", {8}}, {"lower", {0}}, {"upper", {inf}}, {"period", {1}}},
                1,
                false,
                "finite"},
        Refusal{"negative_sampled_seed",
                "sampled_noise",
                {{"rms", {1}}, {"seed", {-1}}, {"period", {1}}},
                1,
                false,
                "whole number"},
        Refusal{"command_limits_exchanged",
                "sampled_pid",
                {{"kp", {1}}, {"lower", {1}}, {"upper", {-1}}, {"period", {1}}},
                1,
                false,
                "exchange"},
        Refusal{"discrete_without_coefficients",
                "discrete_transfer_function",
                {{"num", {}}, {"den", {1}}, {"period", {1}}},
                1,
                true,
                "at least one"},
        Refusal{"discrete_leading_zero",
                "discrete_transfer_function",
                {{"num", {1}}, {"den", {0, 1}}, {"period", {1}}},
                1,
                false,
                "first coefficient"},
        Refusal{"delay_of_ages", "delay_line", {{"samples", {1e6}}, {"period", {1}}}, 1, true, "100000 samples"}),
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
