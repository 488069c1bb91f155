// Decides what the blocks of this room are in C: the operations of their models, one by one. Does not write files
// (export/).
#include <fmt/format.h>

#include <string>

#include "blocks/hysteresis/path_in_c.h"
#include "blocks/hysteresis/plays_in_c.h"
#include "engine/block/c_law.h"
#include "models/hysteresis/coupled_tapi.h"

namespace hysteron::blocks {

CLaw bouc_wen_c() { return {"bouc_wen", nullptr, "", "sampled_bouc_wen_inverse"}; }
CLaw jiles_atherton_c() { return {"jiles_atherton", nullptr, "", "sampled_jiles_atherton_inverse"}; }

CLaw play_c() {
  return {
      "play", [](const CBlock& b) {
        CCode c;
        const bool one = b.choice("sides") != 0;
        c.functions = {c_functions::larger, c_functions::smaller, one ? plays_in_c::one_sided : plays_in_c::two_sided};
        c.output =
            std::string("$s.w = ") + (one ? "one_sided_play" : "play") + "($p.radius, $s.w, $in.u);\n$out.y = $s.w;";
        c.is_monotone = true;
        return c;
      }};
}

CLaw prandtl_ishlinskii_c() {
  return {"prandtl_ishlinskii",
          [](const CBlock& b) {
            CCode c;
            const bool one = b.choice("sides") == 0;
            c.functions = plays_in_c::functions(one);
            c.output = plays_in_c::move(one) +
                       "($x, $p.thresholds, $n.thresholds, $in.u);\n"
                       "$out.y = weighted_sum($p.weights, $x, $n.thresholds);";
            c.is_monotone = plays_in_c::rise(b.list("weights"));
            return c;
          },
          "", "prandtl_ishlinskii_inverse"};
}

CLaw generalized_prandtl_ishlinskii_c() {
  return {"generalized_prandtl_ishlinskii", [](const CBlock& b) {
            CCode c;
            const bool one = b.choice("sides") == 0;
            c.functions = plays_in_c::functions(one);
            c.functions.emplace_back(R"(/* Hermite's cubic from lower to upper, straight on beyond. */
static double bent_at(double lower, double range, double slope_at_lower, double slope_at_upper, double value)
{
    const double x = (value - lower) / range, rest = 1.0 - x;
    if (x < 0.0)
        return slope_at_lower * x;
    if (x > 1.0)
        return 1.0 + slope_at_upper * (x - 1.0);
    return x * (rest * rest * slope_at_lower + x * (3.0 - 2.0 * x - rest * slope_at_upper));
}

/* The drive as the operators see it: zero where it is zero. */
static double bent_drive(double lower, double upper, double slope_at_lower, double slope_at_upper, double u)
{
    const double range = upper - lower;
    return range * (bent_at(lower, range, slope_at_lower, slope_at_upper, u) -
                    bent_at(lower, range, slope_at_lower, slope_at_upper, 0.0));
}
)");
            const std::string bent = "bent_drive($p.lower, $p.upper, $p.slope_at_lower, $p.slope_at_upper, $in.u)";
            if (b.list("thresholds")[0] == 0)
              c.output = "$x[0] = $in.u;\n" + plays_in_c::move(one) +
                         "(&$x[1], &$p.thresholds[1], $n.thresholds - 1, " + bent + ");\n";
            else
              c.output = plays_in_c::move(one) + "($x, $p.thresholds, $n.thresholds, " + bent + ");\n";
            c.output += "$out.y = weighted_sum($p.weights, $x, $n.thresholds);";
            return c;
          }};
}

CLaw preisach_c() {
  return {"preisach", [](const CBlock& b) {
            CCode c;
            if (b.list("levels").size() < 2) {
              c.refusal = "it has no cell; give two levels at least";
              return c;
            }
            c.functions = {c_functions::larger, c_functions::smaller,
                           R"(/* Part of a cell that a rising drive u has passed, 0 to 1. */
static double passed_part(double lower, double upper, double u)
{
    return larger(0.0, smaller(1.0, (u - lower) / (upper - lower)));
}

/* Relays of a density that is even within cells: up to which level those of each cell are up. The parts of the cells that
   the drive has passed stand in `part`. */
static double relays(double *state, double *part, const double *levels, const double *weights, int cells, double u)
{
    double y = 0.0;
    int i, j, k = 0;
    for (i = 0; i < cells; ++i)
        part[i] = passed_part(levels[i], levels[i + 1], u);
    for (i = 0; i < cells; ++i)
        for (j = 0; j <= i; ++j, ++k) {
            const double lower = levels[i], width = levels[i + 1] - lower;
            state[k] = larger(lower + width * part[i], smaller(lower + width * part[j], state[k]));
            y += weights[k] * ((state[k] - lower) / (levels[i + 1] - lower));
        }
    return y;
}
)"};
            const std::string cells = std::to_string(b.list("levels").size() - 1);
            c.output = "double part[" + cells +
                       "];\n$out.y = $p.gain * $in.u + relays($x, part, $p.levels, $p.weights, " + cells + ", $in.u);";
            c.is_monotone = b.number("gain") >= 0 && plays_in_c::rise(b.list("weights"));
            return c;
          }};
}

namespace {
/// At any temperature below t_c: nothing of the law changes with it.
constexpr char curve_at_one_temperature[] = "{$p.saturation, 2.0, 0.0, $p.bend}";
}  // namespace

CLaw asymmetric_prandtl_ishlinskii_c() {
  return {"asymmetric_prandtl_ishlinskii",
          [](const CBlock& b) {
            CCode c = plays_in_c::with_bent_curve(curve_at_one_temperature, "1.0");
            c.is_monotone = plays_in_c::rise(b.list("weights")) && b.number("saturation") >= 0;
            return c;
          },
          "", "sampled_asymmetric_inverse"};
}
CLaw sampled_asymmetric_inverse_c() {
  return {"sampled_asymmetric_inverse", [](const CBlock& b) {
            return plays_in_c::inverse_with_bent_curve(curve_at_one_temperature, "1.0", b.choice("iterations"));
          }};
}

namespace {
constexpr char curve_in_c[] = "{$p.p_s, $p.t_c, $p.beta, $p.a}";
}  // namespace

CLaw tapi_c() {
  return {"tapi", [](const CBlock&) { return plays_in_c::with_bent_curve(curve_in_c, "$in.temperature"); }, "",
          "sampled_tapi_inverse"};
}
CLaw sampled_tapi_inverse_c() {
  return {"sampled_tapi_inverse", [](const CBlock& b) {
            return plays_in_c::inverse_with_bent_curve(curve_in_c, "$in.temperature", b.choice("iterations"));
          }};
}

CLaw jiles_atherton_inverse_c() { return {"jiles_atherton_inverse", nullptr, "sampled_jiles_atherton_inverse"}; }
namespace {

constexpr char langevin_in_c[] =
    R"(/* Langevin's function and its slope. */
static void anhysteretic_curve(double x, double *value, double *slope)
{
    static const double above_of[8] = {22230464256000.0, 93405312000.0, 518918400.0, 3991680.0,
                                       45360.0,          840.0,         30.0,        3.0};
    static const double below_of[9] = {355687428096000.0, 1307674368000.0, 6227020800.0, 39916800.0, 362880.0,
                                       5040.0,            120.0,           6.0,          1.0};
    if (fabs(x) < 1.0) {
        const double y = x * x;
        double above = 1.0 / 6758061133824000.0, below = 1.0 / 121645100408832000.0, over_x;
        int i;
        for (i = 0; i < 8; ++i)
            above = 1.0 / above_of[i] + y * above;
        for (i = 0; i < 9; ++i)
            below = 1.0 / below_of[i] + y * below;
        over_x = above / below;
        *value = x * over_x;
        *slope = 1.0 - *value * *value - 2.0 * over_x;
    } else {
        const double h = tanh(x), part = 1.0 / x;
        *value = 1.0 / h - part;
        *slope = part * part - (1.0 - h * h) / (h * h);
    }
}
)";

constexpr char tanh_in_c[] =
    R"(static void anhysteretic_curve(double x, double *value, double *slope)
{
    const double h = tanh(x);
    *value = h;
    *slope = 1.0 - h * h;
}
)";

constexpr char jiles_atherton_in_c[] =
    R"(struct jiles_atherton_way {
    double p_s, a, alpha, k, c, steepest, from, move;
};

/* Slope of the field along a straight move of the wanted polarisation; not a number where the field does not rise. */
static double jiles_atherton_slope(const void *way, double s, double field)
{
    const struct jiles_atherton_way *p = way;
    const double polarisation = p->from + s * p->move, direction = p->move < 0.0 ? -1.0 : 1.0;
    double value, slope, q, steep, held, g, left, over, under;
    int refused, holds;
    anhysteretic_curve((field + p->alpha * polarisation) / p->a, &value, &slope);
    q = p->p_s * value - polarisation;
    steep = p->c * p->p_s * slope;
    held = 1.0 - p->c;
    g = direction * held * p->k - p->alpha * q;
    left = p->a - p->alpha * steep;
    refused = !(p->a > p->alpha * p->c * p->p_s * p->steepest);
    holds = refused || g * direction > 0.0;
    over = held * p->a * q + steep * g;
    under = g * left;
    return p->move * (holds && over * under > 0.0 ? under / over : NAN);
}
)";

}  // namespace

CLaw sampled_jiles_atherton_inverse_c() {
  return {"sampled_jiles_atherton_inverse", [](const CBlock& b) {
            CCode c;
            const bool langevin = b.choice("anhysteretic") != 0;
            c.functions = {c_functions::larger, c_functions::smaller, path_in_c::follow};
            if (langevin)
              c.functions.emplace_back(langevin_in_c);
            else
              c.functions.emplace_back(tanh_in_c);
            c.functions.emplace_back(jiles_atherton_in_c);
            const double scale = b.number("scale");
            c.tables = {{"scaled",
                         "saturation and alpha of the law whose output is scaled",
                         {scale * b.number("p_s"), b.number("alpha") / scale}},
                        {"steepest", "slope of the curve at zero", {langevin ? 1.0 / 3 : 1.0}}};
            c.output =
                "const double from = $s.y + $p.origin, to = $in.y + $p.origin;\n"
                "const struct jiles_atherton_way way = {$t.scaled[0], $p.a, $t.scaled[1], $p.k, $p.c, $t.steepest[0], "
                "from, to - from};\n"
                "$s.u = follow_path(jiles_atherton_slope, &way, $s.u);\n$s.y = $in.y;\n$out.u = $s.u;";
            return c;
          }};
}

namespace {

constexpr char coupled_law_in_c[] =
    R"(/* n axes, m operators per input; the branch from input i to output j stands at j n + i. */
struct coupled_axes {
    const double *thresholds, *weights, *p_s, *beta, *a;
    double t_c;
    int axes, operators;
};

/* What input i alone adds to output j. */
static double branch_at(const struct coupled_axes *p, int j, int i, const double *before, double u, double temperature)
{
    const int at = j * p->axes + i;
    const struct bent_curve curve = {p->p_s[at], p->t_c, p->beta[at], p->a[at]};
    const double *weights = &p->weights[at * p->operators];
    double y = polarisation_at(&curve, u, temperature);
    int k;
    for (k = 0; k < p->operators; ++k)
        y += weights[k] * one_sided_play(p->thresholds[k], before[k], u);
    return y;
}
)";

constexpr char coupled_outputs_in_c[] =
    R"(static void coupled_outputs(const struct coupled_axes *p, const double *operators, const double *u, double temperature,
                            double *y)
{
    int i, j;
    for (j = 0; j < p->axes; ++j) {
        y[j] = 0.0;
        for (i = 0; i < p->axes; ++i)
            y[j] += branch_at(p, j, i, &operators[i * p->operators], u[i], temperature);
    }
}
)";

constexpr char coupled_inputs_in_c[] =
    R"(/* The inputs whose outputs are y: axis after axis with the newest of the others until nothing moves any more. */
static void coupled_inputs(const struct coupled_axes *p, const double *operators, const double *y, double temperature,
                           int coupled, double *u)
{
    int sweep, j, k;
    for (j = 0; j < p->axes; ++j)
        u[j] = operators[j * p->operators];
    for (sweep = 0; sweep < 400; ++sweep) {
        double moved = 0.0, size = 0.0;
        for (j = 0; j < p->axes; ++j) {
            const int at = j * p->axes + j;
            const double *weights = &p->weights[at * p->operators];
            const struct bent_curve curve = {p->p_s[at] / weights[0], p->t_c, p->beta[at], p->a[at]};
            double own = y[j], next;
            for (k = 0; k < p->axes && coupled; ++k)
                if (k != j)
                    own -= branch_at(p, j, k, &operators[k * p->operators], u[k], temperature);
            next = input_for(&curve, p->thresholds, weights, &operators[j * p->operators], p->operators, own, temperature);
            moved = larger(moved, fabs(next - u[j]));
            size = larger(size, fabs(next));
            u[j] = next;
        }
        if (moved <= 4.0 * ${DBL_EPSILON|FLT_EPSILON} * size || !coupled)
            return;
    }
    for (j = 0; j < p->axes; ++j)
        u[j] = NAN;
}
)";

/// The axes as a table of C: "$in.0, $in.1".
std::string each(const char* what, int n) {
  std::string list;
  for (int k = 0; k < n; ++k) list += fmt::format("{}{}{}", k == 0 ? "" : ", ", what, k);
  return list;
}
/// What model and inverse have in common.
CCode coupled_code(const CBlock& b, const char* ports) {
  CCode c;
  c.functions = plays_in_c::functions(true);
  c.functions.pop_back();
  c.functions.insert(c.functions.end(), {plays_in_c::tapi_law, coupled_law_in_c});
  const int n = b.view.n_y;
  c.output = fmt::format(
      "const struct coupled_axes law = {{$p.thresholds, $p.weights, $p.p_s, $p.beta, $p.a, $p.t_c, {0}, "
      "$n.thresholds}};\n"
      "const double {2}[{0}] = {{{1}}};\n",
      n, each("$in.", n), ports);
  return c;
}
std::string moved_in_c(int n, const char* u) {
  std::string text;
  for (int k = 0; k < n; ++k)
    text +=
        fmt::format("move_one_sided_plays(&$x[{0} * $n.thresholds], $p.thresholds, $n.thresholds, {1}[{0}]);\n", k, u);
  return text;
}
std::string outputs_in_c(int n, const char* y) {
  std::string text;
  for (int k = 0; k < n; ++k) text += fmt::format("$out.{0} = {1}[{0}];\n", k, y);
  return text;
}

}  // namespace

CLaw coupled_tapi_c() {
  return {"coupled_tapi", [](const CBlock& b) {
            const int n = b.view.n_y;
            CCode c = coupled_code(b, "u");
            c.functions.emplace_back(coupled_outputs_in_c);
            c.output += fmt::format("double y[{}];\n", n) + moved_in_c(n, "u") +
                        fmt::format("coupled_outputs(&law, $x, u, $in.{}, y);\n", n) + outputs_in_c(n, "y");
            return c;
          }};
}
CLaw sampled_coupled_tapi_inverse_c() {
  return {"sampled_coupled_tapi_inverse", [](const CBlock& b) {
            const int n = b.view.n_y;
            CCode c = coupled_code(b, "y");
            c.functions.insert(c.functions.end(), {plays_in_c::tapi_input, coupled_inputs_in_c});
            const bool coupled = coupled_tapi::Axes(b.choice("axes")) == coupled_tapi::Axes::coupled;
            c.output += fmt::format("double u[{}];\n", n) +
                        fmt::format("coupled_inputs(&law, $x, y, $in.{}, {}, u);\n", n, coupled ? 1 : 0) +
                        moved_in_c(n, "u") + outputs_in_c(n, "u");
            return c;
          }};
}

}  // namespace hysteron::blocks
