// What a block declares of its own linearity is true: the exact advance and the linear fits rest on it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "blocks/register_all.h"
#include "models/random.h"
#include "tests/blocks/samples.h"

namespace hysteron {
namespace {

using bench::any_parameter;
using bench::Bench;
using bench::Numbers;

std::vector<Numbers> input_sequence(int wires, std::uint64_t stream, std::size_t rows = 40) {
  std::vector<Numbers> u(rows, Numbers(static_cast<std::size_t>(wires)));
  for (std::size_t k = 0; k < u.size(); ++k)
    for (std::size_t i = 0; i < u[k].size(); ++i)  // moderate moves per row, so that Euler steps stay bounded
      u[k][i] = 2 * std::sin(0.3 * static_cast<double>(k) + 6 * random::uniform(5, stream, i));
  return u;
}
template <class F>
void combine(const Numbers& a, const Numbers& b, const Numbers& mixed, F between, const std::string& what) {
  ASSERT_EQ(a.size(), mixed.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double expected = between(a[i], b[i]);
    // additions and multiplications of numbers of size one, forty Euler steps: 1e-12 leaves room for their roundings
    ASSERT_NEAR(mixed[i], expected, 1e-12 * (1 + std::fabs(expected))) << what << " element " << i;
  }
}

class OneSample : public testing::TestWithParam<bench::Sample> {
 protected:
  Bench bench_of(const Bench::Values& values) const { return Bench(GetParam().type, values, GetParam().inputs); }
};

void expect_affine(const Bench& b) {
  EXPECT_EQ(b.sizes.memory, 0);
  EXPECT_FALSE(b.kernel.uses_time);
  const auto draw = [&](std::uint64_t stream, int n) {
    Numbers v;
    for (int i = 0; i < n; ++i) v.push_back(random::normal(3, stream, static_cast<std::uint64_t>(i)));
    return v;
  };
  const auto mix = [](double l, double r) { return 0.3 * l + 0.7 * r; };
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const Numbers u1 = draw(4 * trial, b.n_u), u2 = draw(4 * trial + 1, b.n_u);
    const Numbers x1 = draw(4 * trial + 2, b.states()), x2 = draw(4 * trial + 3, b.states());
    Numbers u, x;
    for (std::size_t i = 0; i < u1.size(); ++i) u.push_back(mix(u1[i], u2[i]));
    for (std::size_t i = 0; i < x1.size(); ++i) x.push_back(mix(x1[i], x2[i]));
    combine(b.output(0, u1, x1), b.output(0, u2, x2), b.output(0, u, x), mix, "output");
    if (b.sizes.states > 0) combine(b.derivative(u1, x1), b.derivative(u2, x2), b.derivative(u, x), mix, "derivative");
    if (b.sizes.sampled_states > 0) combine(b.update(u1, x1), b.update(u2, x2), b.update(u, x), mix, "update");
  }
}

class Linear : public OneSample {};
TEST_P(Linear, BlocksThatSaySoAreAffineInStatesAndInputs) { expect_affine(bench_of(GetParam().values)); }

class AffineInModes : public OneSample {};
TEST_P(AffineInModes, BlocksThatSaySoAreAffineInEachOfThem) {
  Bench b = bench_of(GetParam().values);
  ASSERT_TRUE(b.kernel.has_modes());
  for (b.mode = 0; b.mode < 3; ++b.mode) expect_affine(b);  // stuck, up, down; free, at either limit
}

class LinearParameters : public OneSample {};
TEST_P(LinearParameters, ResponseIsAffineInTheParametersThatAreDeclaredLinear) {
  auto first = GetParam().values, second = first, middle = first;
  const Bench plain = bench_of(first);
  for (const auto& p : plain.kernel.declaration.parameters) {
    if (!p.is_linear || p.kind == ParameterKind::text) continue;
    const int i = plain.kernel.declaration.parameter_index(p.name);
    Numbers own(plain.p.begin() + plain.p_at[static_cast<std::size_t>(i)],
                plain.p.begin() + plain.p_at[static_cast<std::size_t>(i) + 1]);
    first[p.name] = second[p.name] = middle[p.name] = own;
    for (std::size_t k = 0; k < own.size(); ++k) {
      second[p.name][k] = own[k] + 0.5 + static_cast<double>(k);
      middle[p.name][k] = 0.3 * own[k] + 0.7 * second[p.name][k];
    }
  }
  const auto u = input_sequence(plain.n_u, 1);
  combine(
      bench_of(first).response(u, 0.01), bench_of(second).response(u, 0.01), bench_of(middle).response(u, 0.01),
      [](double l, double r) { return 0.3 * l + 0.7 * r; }, "response");
}

class Offsets : public OneSample {};
TEST_P(Offsets, ChangeTheResponseByWhatNoInputChanges) {
  const Bench plain = bench_of(GetParam().values);
  for (const auto& p : plain.kernel.declaration.parameters) {
    if (!p.is_offset) continue;
    auto more = GetParam().values;
    const int i = plain.kernel.declaration.parameter_index(p.name);
    more[p.name] = Numbers(plain.p.begin() + plain.p_at[static_cast<std::size_t>(i)],
                           plain.p.begin() + plain.p_at[static_cast<std::size_t>(i) + 1]);
    for (double& x : more[p.name]) x += 0.8;
    const Bench shifted = bench_of(more);
    const auto one = input_sequence(plain.n_u, 1), two = input_sequence(plain.n_u, 2);
    const Numbers a0 = plain.response(one, 0.01), a1 = shifted.response(one, 0.01);
    const Numbers b0 = plain.response(two, 0.01), b1 = shifted.response(two, 0.01);
    for (std::size_t k = 0; k < a0.size(); ++k) EXPECT_NEAR(a1[k] - a0[k], b1[k] - b0[k], 1e-12) << p.name;
  }
}

class Rest : public OneSample {};
TEST_P(Rest, IsWhereNothingMoves) {
  const Bench b = bench_of(GetParam().values);
  const Numbers u(static_cast<std::size_t>(b.n_u), 1.7), x = b.rest(u);
  for (const double rate : b.derivative(u, x)) EXPECT_NEAR(rate, 0, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Blocks, Linear,
                         testing::ValuesIn(bench::samples_where([](const Bench& b) { return b.is_linear(); })),
                         bench::sample_name);
INSTANTIATE_TEST_SUITE_P(Blocks, AffineInModes,
                         testing::ValuesIn(bench::samples_where([](const Bench& b) { return b.is_affine_in_modes(); })),
                         bench::sample_name);
INSTANTIATE_TEST_SUITE_P(Blocks, LinearParameters, testing::ValuesIn(bench::samples_where([](const Bench& b) {
                           return any_parameter(b, &ParameterDeclaration::is_linear);
                         })),
                         bench::sample_name);
INSTANTIATE_TEST_SUITE_P(Blocks, Offsets, testing::ValuesIn(bench::samples_where([](const Bench& b) {
                           return any_parameter(b, &ParameterDeclaration::is_offset);
                         })),
                         bench::sample_name);
INSTANTIATE_TEST_SUITE_P(Blocks, Rest, testing::ValuesIn(bench::samples_where([](const Bench& b) {
                           return b.kernel.rest != nullptr;
                         })),
                         bench::sample_name);

TEST(LinearBlocks, AreThoseOfTheExactAdvance) {
  for (const auto& type : {"gain", "sum", "pass", "calibration", "integrator", "transfer_function", "pi_controller",
                           "lag", "creep", "logarithmic_creep"})
    EXPECT_TRUE(bench::kernel_of(type).declaration.is_linear) << type;
}

TEST(LinearBlocks, FrictionIsAffineInItsModesWithoutAnExcessWhateverItIs) {
  const auto says = [](const char* type, Bench::Values values) { return Bench(type, values).is_affine_in_modes(); };
  const double any = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says("integrator_with_friction", {{"level", {any}}}));
  EXPECT_TRUE(says("mass_with_friction", {{"mass", {any}}, {"coulomb", {any}}, {"stiffness", {any}}}));
  EXPECT_TRUE(says("inertia_with_friction", {{"inertia", {1}}, {"coulomb", {2}}, {"breakaway", {2}}}));
  EXPECT_FALSE(says("integrator_with_friction", {{"level", {1}}, {"excess", {any}}, {"stribeck_velocity", {1}}}));
  EXPECT_FALSE(
      says("mass_with_friction", {{"mass", {1}}, {"coulomb", {1}}, {"breakaway", {any}}, {"stribeck_velocity", {1}}}));
  EXPECT_FALSE(says("mass_with_friction", {{"mass", {1}}, {"coulomb", {1}}, {"drag", {0.1}}}));
}

TEST(LinearBlocks, ThoseThatAreAtSomeNumbersHaveSamplesOfBothKindsAndNoModes) {
  std::map<std::string, std::set<bool>> seen;
  for (const auto& type : all_blocks().types()) {
    const auto& kernel = bench::kernel_of(type);
    if (kernel.is_linear_at == nullptr) continue;
    EXPECT_FALSE(kernel.has_modes()) << type;
    EXPECT_FALSE(kernel.declaration.is_linear) << type;
    seen[type];
  }
  for (const auto& s : bench::samples())
    if (const auto one = seen.find(s.type); one != seen.end())
      one->second.insert(Bench(s.type, s.values, s.inputs).is_linear());
  EXPECT_GE(seen.size(), 5u);
  for (const auto& [type, kinds] : seen) EXPECT_EQ(kinds.size(), 2u) << type;
}

TEST(TransferFunctionBlock, FeedsThroughOnlyWithAsManyNumeratorAsDenominatorCoefficients) {
  EXPECT_FALSE(Bench("transfer_function", {{"num", {1}}, {"den", {1, 2}}}).sizes.feedthrough);
  EXPECT_TRUE(Bench("transfer_function", {{"num", {1, 3}}, {"den", {1, 2}}}).sizes.feedthrough);
  EXPECT_TRUE(Bench("transfer_function", {{"num", {0, 3}}, {"den", {1, 2}}}).sizes.feedthrough)
      << "structure never depends on a value";
}

TEST(TransferFunctionBlock, RestsAtItsDcGain) {
  const Bench plant("transfer_function",
                    {{"gain", {1e-6}}, {"num", {1.377e16}}, {"den", {1, 2.813e4, 5.403e8, 4.981e12, 1.822e16}}});
  EXPECT_NEAR(plant.output(0, {2}, plant.rest({2}))[0], 2e-6 * 1.377 / 1.822, 1e-20);
}

TEST(StateSpaceBlock, RestsWhereItsMatricesSay) {
  // x1' = x2, x2' = -8 x1 - 2 x2 + 8 u: at rest x1 = u and x2 = 0, though A has a zero in its corner.
  const Bench b(
      "state_space",
      {{"a", {0, 1, -8, -2}}, {"a columns", {2}}, {"b", {0, 8}}, {"b columns", {1}}, {"c", {1, 0}}, {"c columns", {2}}},
      1);
  const Numbers x = b.rest({1.5});
  EXPECT_DOUBLE_EQ(x[0], 1.5);
  EXPECT_DOUBLE_EQ(x[1], 0);
  const Bench integrating(
      "state_space",
      {{"a", {0, 1, 0, -2}}, {"a columns", {2}}, {"b", {0, 8}}, {"b columns", {1}}, {"c", {1, 0}}, {"c columns", {2}}},
      1);
  EXPECT_TRUE(std::isnan(integrating.rest({1})[0]));
}

TEST(TransferFunctionBlock, AnIntegratingOneHasNoRestUnderAConstantInput) {
  const Bench b("transfer_function", {{"num", {5}}, {"den", {1, 20, 0}}});
  EXPECT_TRUE(std::isnan(b.rest({1})[0]));
  EXPECT_EQ(b.rest({0})[0], 0);
}

TEST(PiControllerBlock, IsProportionPlusIntegral) {
  const Bench b("pi_controller", {{"kp", {2}}, {"ki", {30}}, {"initial", {0.5}}});
  EXPECT_EQ(b.initial_states()[0], 0.5);
  EXPECT_EQ(b.output(0, {3}, {0.5})[0], 6.5);
  EXPECT_EQ(b.derivative({3}, {0.5})[0], 90);
}

TEST(LagBlock, GoesThroughItsPolesOneAfterTheOther) {
  const Bench b("lag", {{"times", {0.5, 2}}});
  const Numbers dx = b.derivative({3}, {1, 0.4});
  EXPECT_DOUBLE_EQ(dx[0], (3 - 1) / 0.5);
  EXPECT_DOUBLE_EQ(dx[1], (1 - 0.4) / 2);
  EXPECT_EQ(b.output(0, {3}, {1, 0.4})[0], 0.4);
}

}  // namespace
}  // namespace hysteron
