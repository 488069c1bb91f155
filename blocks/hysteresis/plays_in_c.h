// Decides the C functions of play operators and of the laws that sum them: models/hysteresis/play.h,
// prandtl_ishlinskii.h and tapi.h, operation by operation. Does not decide which block calls them.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "engine/block/c_law.h"

namespace hysteron::blocks::plays_in_c {

inline constexpr char two_sided[] =
    R"(/* Play operator with a gap of twice the radius: its output after the input has moved to u. */
static double play(double radius, double before, double u)
{
    return larger(u - radius, smaller(u + radius, before));
}
)";

inline constexpr char one_sided[] =
    R"(/* One-sided play operator: follows a falling input at once, a rising one behind the threshold. */
static double one_sided_play(double threshold, double before, double u)
{
    return larger(u - threshold, smaller(u, before));
}
)";

inline constexpr char move_two_sided[] =
    R"(static void move_plays(double *operators, const double *thresholds, int n, double u)
{
    int i;
    for (i = 0; i < n; ++i)
        operators[i] = play(thresholds[i], operators[i], u);
}
)";

inline constexpr char move_one_sided[] =
    R"(static void move_one_sided_plays(double *operators, const double *thresholds, int n, double u)
{
    int i;
    for (i = 0; i < n; ++i)
        operators[i] = one_sided_play(thresholds[i], operators[i], u);
}
)";

inline constexpr char weighted_sum[] =
    R"(static double weighted_sum(const double *weights, const double *operators, int n)
{
    double y = 0.0;
    int i;
    for (i = 0; i < n; ++i)
        y += weights[i] * operators[i];
    return y;
}
)";

/// Operators of one kind that move, and the sum over them.
inline std::vector<std::string> functions(bool one) {
  using c_functions::larger, c_functions::smaller;
  if (one) return {larger, smaller, one_sided, move_one_sided, weighted_sum};
  return {larger, smaller, two_sided, move_two_sided, weighted_sum};
}
/// Does the sum over operators rise wherever they rise? Weights below zero may turn it.
inline bool rise(std::span<const double> weights) {
  return std::all_of(weights.begin(), weights.end(), [](double weight) { return weight >= 0; });
}
/// The function that moves them.
inline std::string move(bool one) { return one ? "move_one_sided_plays" : "move_plays"; }

inline constexpr char tapi_law[] = R"(/* Bent curve of the temperature-dependent model; temperatures are absolute. */
struct bent_curve {
    double p_s, t_c, beta, a;
};

static double saturation_at(const struct bent_curve *c, double temperature)
{
    const double left = 1.0 - temperature / c->t_c;
    if (!(left > 0.0))
        return 0.0;
    return c->p_s * exp(c->beta * log(left));
}

static double polarisation_at(const struct bent_curve *c, double u, double temperature)
{
    return saturation_at(c, temperature) * tanh(u / (c->a * temperature));
}
)";

inline constexpr char tapi_input[] = R"(/* Displacement that an input u would give, from the operators before it. */
static double output_at(const struct bent_curve *c, const double *thresholds, const double *weights, const double *before,
                        int n, double u, double temperature)
{
    double y = weights[0] * polarisation_at(c, u, temperature);
    int i;
    for (i = 0; i < n; ++i)
        y += weights[i] * one_sided_play(thresholds[i], before[i], u);
    return y;
}

static double slope_at(const struct bent_curve *c, const double *thresholds, const double *weights, const double *before,
                       int n, double u, double temperature)
{
    const double bend = c->a * temperature, h = tanh(u / bend);
    double slope = weights[0] * saturation_at(c, temperature) / bend * (1.0 - h * h);
    int i;
    for (i = 0; i < n; ++i)
        if (u - thresholds[i] >= before[i] || u <= before[i])
            slope += weights[i];
    return slope;
}

/* The input whose displacement is y: Newton's method between bounds that hold the answer. At most 1100 evaluations to
   find the bounds and 200 inside them; in practice a handful. */
static double input_for(const struct bent_curve *c, const double *thresholds, const double *weights, const double *before,
                        int n, double y, double temperature)
{
    const double rounding = 2.0 * ${DBL_EPSILON|FLT_EPSILON};
    double u = before[0], f = output_at(c, thresholds, weights, before, n, u, temperature) - y;
    double low = u, high = u, way;
    int i;
    if (f == 0.0)
        return u;
    way = fabs(f) / weights[0];
    for (i = 0; i < 1100 && isfinite(way); ++i, way *= 2.0) {
        double bound;
        if (f > 0.0)
            low = u - way;
        else
            high = u + way;
        bound = f > 0.0 ? low : high;
        if ((output_at(c, thresholds, weights, before, n, bound, temperature) - y > 0.0) != (f > 0.0))
            break;
    }
    for (i = 0; i < 200; ++i) {
        double next = u - f / slope_at(c, thresholds, weights, before, n, u, temperature), moved;
        if (!(next > low && next < high))
            next = (low + high) / 2.0;
        moved = fabs(next - u);
        u = next;
        f = output_at(c, thresholds, weights, before, n, u, temperature) - y;
        if (f > 0.0)
            high = u;
        else
            low = u;
        if (f == 0.0 || moved <= rounding * fabs(u) || high - low <= rounding * fabs(u))
            return u;
    }
    return u;
}
)";

inline constexpr char tapi_iterated[] = R"(/* So many steps u <- P^-1[y - P_c(u)] of the thesis, the operators held. */
static double iterated_input(const struct bent_curve *c, const double *thresholds, const double *weights,
                             const double *before, int n, double y, double temperature, int steps)
{
    const struct bent_curve classical = {0.0, c->t_c, c->beta, c->a};
    double u = before[0];
    int i;
    for (i = 0; i < steps; ++i) {
        const double rest = y - weights[0] * polarisation_at(c, u, temperature);
        const double next = input_for(&classical, thresholds, weights, before, n, rest, temperature);
        const double moved = fabs(next - u);
        u = next;
        if (moved <= 0.0)
            steps = i + 1;
    }
    return u;
}
)";

/// y of operators beside a bent curve; `curve` and `temperature` in C. Reads $in.u, `sum of operators` in $x.
inline CCode with_bent_curve(const std::string& curve, const std::string& temperature) {
  CCode c;
  c.functions = functions(true);
  c.functions.emplace_back(tapi_law);
  c.output = "const struct bent_curve curve = " + curve + ";\n" +
             "move_one_sided_plays($x, $p.thresholds, $n.thresholds, $in.u);\n"
             "$out.y = $p.weights[0] * polarisation_at(&curve, $in.u, " +
             temperature + ") + weighted_sum($p.weights, $x, $n.thresholds);";
  return c;
}
/// The input that gives $in.y, and the operators behind it.
inline CCode inverse_with_bent_curve(const std::string& curve, const std::string& temperature, int iterations) {
  CCode c;
  c.functions = functions(true);
  c.functions.pop_back();
  c.functions.insert(c.functions.end(), {tapi_law, tapi_input});
  if (iterations > 0) c.functions.emplace_back(tapi_iterated);
  const std::string steps = iterations > 0 ? ", " + std::to_string(iterations) : "";
  c.output = "const struct bent_curve curve = " + curve + ";\n" +
             "$out.u = " + (iterations > 0 ? "iterated_input" : "input_for") +
             "(&curve, $p.thresholds, $p.weights, $x, $n.thresholds, $in.y, " + temperature + steps +
             ");\nmove_one_sided_plays($x, $p.thresholds, $n.thresholds, $out.u);";
  return c;
}

}  // namespace hysteron::blocks::plays_in_c
