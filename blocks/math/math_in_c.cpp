// Decides what the blocks of this room are in C: the operations of their models, one by one. Does not write files
// (export/).
#include <fmt/format.h>

#include <algorithm>

#include "engine/block/c_law.h"

namespace hysteron::blocks {

CLaw gain_c() {
  return {"gain", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $p.gain * $in.u;";
            return c;
          }};
}
CLaw pass_c() {
  return {"pass", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $in.u;";
            return c;
          }};
}
CLaw calibration_c() {
  return {"calibration", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $p.gain * $in.u + $p.offset;";
            return c;
          }};
}

CLaw sum_c() {
  return {"sum", [](const CBlock& b) {
            CCode c;
            c.output = "$out.y = 0.0";  // as the sum begins: -0 becomes 0
            const auto signs = b.list("signs");
            for (int i = 0; i < b.view.n_u; ++i)
              c.output +=
                  fmt::format(" {} $in.{}", !signs.empty() && signs[static_cast<std::size_t>(i)] == '-' ? '-' : '+', i);
            c.output += ";";
            return c;
          }};
}

CLaw product_c() {
  return {"product", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $in.a * $in.b;";
            return c;
          }};
}

CLaw divide_c() {
  return {"divide", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $in.a / $in.b;";
            return c;
          }};
}

CLaw abs_c() {
  return {"abs", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = fabs($in.u);";
            return c;
          }};
}
CLaw sign_c() {
  return {"sign", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $in.u > 0.0 ? 1.0 : $in.u < 0.0 ? -1.0 : 0.0;";
            c.is_monotone = true;
            return c;
          }};
}

CLaw saturation_c() {
  return {"saturation", [](const CBlock&) {
            CCode c;
            c.functions = {c_functions::larger, c_functions::smaller};
            c.output = "$out.y = larger($p.lower, smaller($p.upper, $in.u));";
            c.is_monotone = true;
            return c;
          }};
}

CLaw dead_zone_c() {
  return {"dead_zone", [](const CBlock&) {
            CCode c;
            c.functions = {c_functions::larger, c_functions::smaller};
            c.output = "$out.y = $in.u - larger($p.lower, smaller($p.upper, $in.u));";
            c.is_monotone = true;
            return c;
          }};
}
CLaw wrap_c() {
  return {"wrap", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $in.u - floor(($in.u - $p.lower) / $p.period) * $p.period;";
            return c;
          }};
}

CLaw rectifier_c() {
  return {"rectifier", [](const CBlock& b) {
            CCode c;
            c.is_monotone = b.number("mix") <= 0.5;  // its slope below zero is 1 - 2 mix
            c.output = "$out.y = $in.u + $p.mix * (fabs($in.u) - $in.u);";
            return c;
          }};
}

CLaw rounding_c() {
  return {"rounding", [](const CBlock& b) {
            CCode c;
            c.output = b.number("step") > 0 ? "$out.y = round(($in.u - $p.zero) / $p.step) * $p.step + $p.zero;"
                                            : "$out.y = $in.u;";
            c.is_monotone = true;
            return c;
          }};
}

CLaw min_max_c() {
  return {"min_max", [](const CBlock& b) {
            CCode c;
            c.output = "$out.y = $in.0;";
            const char* const better = b.choice("is") == 0 ? ">" : "<";
            for (int i = 1; i < b.view.n_u; ++i)
              c.output += fmt::format("\nif ($in.{0} {1} $out.y)\n    $out.y = $in.{0};", i, better);
            return c;
          }};
}

CLaw polynomial_c() {
  return {"polynomial", [](const CBlock&) {
            CCode c;
            c.functions = {
                c_functions::larger, c_functions::smaller,
                R"(/* Polynomial of (u - about)/reference by Horner's rule, its tangents beyond the limits. */
static double polynomial(const double *coefficients, int n, double about, double reference, double lower, double upper,
                         double u)
{
    const double inside = larger(smaller(u, upper), lower), x = (inside - about) / reference;
    double value = 0.0, slope = 0.0;
    int k;
    for (k = n - 1; k >= 0; --k) {
        slope = slope * x + value;
        value = value * x + coefficients[k];
    }
    return value + slope * ((u - inside) / reference);
}
)"};
            c.output =
                "$out.y = polynomial($p.coefficients, $n.coefficients, $p.about, $p.reference, $p.lower, $p.upper, "
                "$in.u);";
            return c;
          }};
}

CLaw lookup_c() {
  return {"lookup", [](const CBlock& b) {
            CCode c;
            if (b.view.n_u != 1 || b.choice("between") != 0) {
              c.refusal =
                  "only tables along one axis with straight lines between their knots are written; give more "
                  "knots and \"between\": \"linear\"";
              return c;
            }
            c.functions = {c_functions::larger, c_functions::smaller,
                           R"(/* Straight between the knots, and on beyond them. */
static double table_value(const double *knots, const double *values, int n, double u)
{
    int i = 0;
    while (i + 2 < n && u >= knots[i + 1])
        ++i;
    return values[i] + (u - knots[i]) * ((values[i + 1] - values[i]) / (knots[i + 1] - knots[i]));
}
)"};
            const bool clips = b.choice("outside") == 0;
            std::string u = "$in.0";
            if (clips)
              u = "larger(smaller($in.0, $p.at[$n.at - 1]), $p.at[0])";
            else
              c.functions.erase(c.functions.begin(), c.functions.begin() + 2);
            c.output = "$out.y = table_value($p.at, $p.values, $n.at, " + u + ");";
            if (b.choice("outside") == 2)
              c.output += "\nif ($in.0 < $p.at[0] || $in.0 > $p.at[$n.at - 1])\n    $out.y = NAN;";
            const auto values = b.list("values");
            c.is_monotone =
                std::is_sorted(values.begin(), values.end()) || std::is_sorted(values.rbegin(), values.rend());
            return c;
          }};
}

CLaw soft_saturation_c() {
  return {"soft_saturation", [](const CBlock&) {
            CCode c;
            c.functions = {R"(/* u/(1 + |u/size|^n)^(1/n) without overflow. */
static double with_knee(double size, double n, double u)
{
    const double share = fabs(u / size);
    double power;
    if (!(share > 0.0))
        return u;
    power = n * log(share);
    if (power > 0.0)
        return (u / share) * exp(-log(1.0 + exp(-power)) / n);
    return u * exp(-log(1.0 + exp(power)) / n);
}
)"};
            c.output = "$out.y = with_knee($p.limit, $p.sharpness, $in.u);";
            c.is_monotone = true;
            return c;
          }};
}

}  // namespace hysteron::blocks
