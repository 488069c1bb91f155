// Loops that hysteresis closes, against independent integrations and against enumeration of the pieces: a ferroelectric
// in its own depolarizing field (a loop among rates), and play operators that feed each other (several tears).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "models/hysteresis/jiles_atherton.h"
#include "models/hysteresis/play.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;

// --- Jiles-Atherton in its own field

const jiles_atherton::Params<double> table{.p_s = 55.9973, .a = 48.5843, .alpha = 0.2512, .k = 3.8892, .c = 0.6929};

Diagram in_its_own_field(double depolarizing) {
  return diagram(
      {{"applied", thesis_wave("sine", "3 V")},
       {"field", block("sum", {{"signs", "+-"}}, {"applied", "own"})},
       {"polarisation",
        block("jiles_atherton",
              {{"p_s", "55.9973 V"}, {"a", "48.5843 V"}, {"alpha", 0.2512}, {"k", "3.8892 V"}, {"c", 0.6929}},
              {"field"})},
       {"own", block("gain", {{"gain", depolarizing}}, {"polarisation"})}},
      {"polarisation", "field"});
}

/// P at each t, for E = E_ext - N P: P' = F/(1 + N F) E_ext' as long as 1 + N F > 0, so that E moves as E_ext does.
/// The reversals of 3 (1 - cos(2 pi 5 t)) V lie on multiples of 0.1 s, which t has.
std::vector<double> polarisation_by_hand(double depolarizing, const std::vector<double>& t) {
  return integrated_by_hand(t, 20, [&](double time, double p, std::size_t i) {
    const int direction = std::sin(2 * pi * 5 * (t[i] + t[i - 1]) / 2) > 0 ? 1 : -1;
    const double applied = 3 - 3 * std::cos(2 * pi * 5 * time);
    const double f = jiles_atherton::slope(table, applied - depolarizing * p, p, direction);
    return f / (1 + depolarizing * f) * 3 * 2 * pi * 5 * std::sin(2 * pi * 5 * time);
  });
}

class OwnField : public testing::TestWithParam<double> {};
TEST_P(OwnField, OfAJilesAthertonLawIsALoopOfRatesWithTheSolutionByHand) {
  const auto program = compiled(in_its_own_field(GetParam()));
  EXPECT_TRUE(program->has_rate_loops());
  for (const Method method : {Method::bdf, Method::runge_kutta}) {
    const auto traces =
        simulate(*program, start(*program), {.until = 0.4, .method = method, .relative_tolerance = 1e-9});
    const auto expected = polarisation_by_hand(GetParam(), traces.t);
    // The kinks at the reversals leave some ten times the tolerance; by hand the step of 20 us is exact to 1e-11.
    EXPECT_LT(distance(trace(traces), expected), 1e-7 * largest(expected)) << method_name(method);
    std::vector<double> field;
    for (std::size_t i = 0; i < expected.size(); ++i)
      field.push_back(3 - 3 * std::cos(2 * pi * 5 * traces.t[i]) - GetParam() * expected[i]);
    EXPECT_LT(distance(trace(traces, 1), field), 1e-6) << method_name(method);
  }
}
// The law's slope is between 0.69 and 1.6: from no field of its own to one that takes away most of what is applied.
INSTANTIATE_TEST_SUITE_P(Factors, OwnField, testing::Values(0.0, 0.3, 5.0));

TEST(OwnFieldOfAJump, IsThatOfTheFastRamp) {
  auto d = in_its_own_field(0.5);
  d.blocks["applied"] = block("step", {{"after", "6 V"}, {"time", "0.1 s"}});
  const auto program = compiled(d);
  const auto jumped =
      simulate(*program, start(*program), {.until = 0.2, .method = Method::bdf, .relative_tolerance = 1e-9});
  const double p = polarisation_by_hand(0.5, grid(0, 0.1, 200)).back();  // half a period: from 0 to 6 V
  EXPECT_NEAR(trace(jumped).back(), p, 1e-7 * p);
}

// --- play operators that feed each other

/// v = c u - K w, w_i = play(r_i, v_i): 2 x 2, with the pieces of both operators tried one by one.
struct Coupled {
  std::array<double, 2> c{1, 0.5}, r{0.4, 0.7}, w{0, 0};
  double k[2][2] = {{0.7, 0.3}, {0.4, 0.9}};

  /// The memory after u has come to this value on a monotone way; v is that, too (the matrices of all pieces have
  /// positive responses to u). Returns how many of the nine combinations of pieces agree with themselves.
  int move_to(double u, std::array<double, 2>& v) {
    int found = 0;
    std::array<double, 2> next = w;
    for (int first = -1; first <= 1; ++first)
      for (int second = -1; second <= 1; ++second) {
        // w_i = v_i - r_i (rising, 1), v_i + r_i (falling, -1) or as before (0): (I + K D) v = c u - K e.
        const std::array<int, 2> piece{first, second};
        double e[2], d[2];
        for (int i = 0; i < 2; ++i) {
          d[i] = piece[i] == 0 ? 0 : 1;
          e[i] = piece[i] == 0 ? w[i] : -piece[i] * r[i];
        }
        const double a = 1 + k[0][0] * d[0], b = k[0][1] * d[1], f = k[1][0] * d[0], g = 1 + k[1][1] * d[1];
        const double p = c[0] * u - k[0][0] * e[0] - k[0][1] * e[1], q = c[1] * u - k[1][0] * e[0] - k[1][1] * e[1];
        const std::array<double, 2> trial{(p * g - b * q) / (a * g - b * f), (a * q - f * p) / (a * g - b * f)};
        bool agrees = true;
        std::array<double, 2> after{};
        for (int i = 0; i < 2; ++i) {
          after[i] = play::follow(r[i], w[i], trial[i]);
          agrees = agrees && std::abs(after[i] - (d[i] * trial[i] + e[i])) < 1e-12;
        }
        if (!agrees) continue;
        ++found;
        next = after;
        v = trial;
      }
    w = next;
    return found;
  }
};

TEST(CoupledPlayOperators, AreSolvedTogetherOnEveryPiece) {
  const auto program = compiled(diagram({{"half", block("gain", {{"gain", 0.5}}, {"u"})},
                                         {"a", block("sum", {{"signs", "+--"}}, {"u", "aa", "ab"})},
                                         {"b", block("sum", {{"signs", "+--"}}, {"half", "ba", "bb"})},
                                         {"play_a", block("play", {{"radius", "0.4 V"}}, {"a"})},
                                         {"play_b", block("play", {{"radius", "0.7 V"}}, {"b"})},
                                         {"aa", block("gain", {{"gain", 0.7}}, {"play_a"})},
                                         {"ab", block("gain", {{"gain", 0.3}}, {"play_b"})},
                                         {"ba", block("gain", {{"gain", 0.4}}, {"play_a"})},
                                         {"bb", block("gain", {{"gain", 0.9}}, {"play_b"})}},
                                        {"a", "b", "play_a", "play_b"}, {{"u", "V"}}));
  ASSERT_EQ(program->loops.size(), 2U);  // of the values, and of the rates that show reversals
  for (const auto& loop : program->loops) EXPECT_EQ(loop.tears.size(), 2U);

  // Up, down, up with ever smaller turns: every piece of each operator, together and alone.
  std::vector<double> t{0}, u{0};
  for (double turn = 6; turn > 0.3; turn *= 0.8)
    for (const double to : {turn, -turn})
      for (int i = 1, n = 13; i <= n; ++i) {
        const double from = u[u.size() - static_cast<std::size_t>(i)];
        t.push_back(t.back() + 0.01);
        u.push_back(from + (to - from) * i / n);
      }
  auto run = start(*program);
  bind_input(*program, run, "u", series(t, u));
  Coupled by_hand;
  std::vector<std::vector<double>> expected(4);
  for (const double value : u) {
    std::array<double, 2> v{};
    ASSERT_GE(by_hand.move_to(value, v), 1) << value;
    expected[0].push_back(v[0]);
    expected[1].push_back(v[1]);
    expected[2].push_back(by_hand.w[0]);
    expected[3].push_back(by_hand.w[1]);
  }
  const auto traces = simulate(*program, run, {.instants = t, .method = Method::bdf});
  // Piecewise linear: Newton ends on the solution of the piece, but for rounding.
  for (std::size_t s = 0; s < 4; ++s) EXPECT_LT(distance(trace(traces, s), expected[s]), 1e-13) << s;
  for (const auto& loop : traces.statistics.loops) EXPECT_EQ(loop.failed, 0) << loop.path;
}

}  // namespace
}  // namespace hysteron
