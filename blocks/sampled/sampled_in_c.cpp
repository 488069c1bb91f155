// Decides what the blocks of this room are in C: the operations of their models, one by one. Does not write files
// (export/).
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "blocks/sampled/delay_line_in_c.h"
#include "blocks/sampled/discrete_pid.h"
#include "blocks/sampled/sampled_pid_in_c.h"
#include "engine/block/c_law.h"
#include "models/sampled/discrete_filter.h"

namespace hysteron::blocks {

CLaw sample_hold_c() {
  return {"sample_hold", [](const CBlock&) {
            CCode c;
            c.output = "$out.y = $in.u;";
            return c;
          }};
}

CLaw quantizer_c() {
  return {"quantizer", [](const CBlock& b) {
            CCode c;
            c.functions = {c_functions::larger, c_functions::smaller};
            const double levels = std::exp2(b.number("bits"));
            c.tables = {{"step", "one step", {(b.number("upper") - b.number("lower")) / levels}},
                        {"last_code", "number of the highest level", {levels - 1}}};
            c.output =
                "$out.y = $p.lower + $t.step[0] * larger(0.0, smaller($t.last_code[0], floor(($in.u - $p.lower) / "
                "$t.step[0] + 0.5)));";
            return c;
          }};
}

CLaw delay_line_c() {
  return {"delay_line", [](const CBlock& b) {
            CCode c;
            const int n = b.view.n_x;
            if (n == 0) {
              c.output = "$out.0 = $in.0;";
              return c;
            }
            c.functions = {delay_line_push_in_c};
            c.output = "$out.0 = $x[0];";
            c.update = "push_sample($x, " + std::to_string(n) + ", $in.0);";
            return c;
          }};
}

CLaw fir_c() {
  return {"fir", [](const CBlock& b) {
            CCode c;
            const std::string n = std::to_string(b.view.n_x);
            if (b.view.n_x == 0) {
              c.output = "$out.0 = $p.coefficients[0] * $in.0;";
              return c;
            }
            c.functions = {delay_line_push_in_c,
                           R"(static double fir(const double *coefficients, const double *line, int n, double u)
{
    double y = coefficients[0] * u;
    int i;
    for (i = 0; i < n; ++i)
        y += coefficients[n - i] * line[i];
    return y;
}
)"};
            c.output = "$out.0 = fir($p.coefficients, $x, " + n + ", $in.0);\npush_sample($x, " + n + ", $in.0);";
            return c;
          }};
}
CLaw moving_average_c() {
  return {"moving_average", [](const CBlock& b) {
            CCode c;
            const std::string n = std::to_string(b.view.n_x);
            if (b.view.n_x == 0) {
              c.output = "$out.0 = $in.0 / 1.0;";
              return c;
            }
            c.functions = {delay_line_push_in_c, R"(static double mean_of_samples(const double *line, int n, double u)
{
    double sum = u;
    int i;
    for (i = 0; i < n; ++i)
        sum += line[i];
    return sum / (n + 1);
}
)"};
            c.output = "$out.0 = mean_of_samples($x, " + n + ", $in.0);\npush_sample($x, " + n + ", $in.0);";
            return c;
          }};
}

CLaw discrete_integrator_c() {
  return {"discrete_integrator", [](const CBlock& b) {
            CCode c;
            const int rule = b.choice("rule");  // forward, backward, trapezoidal
            c.output = rule == 0   ? "$out.0 = $x[0] + 0.0;"
                       : rule == 1 ? "$out.0 = $x[0] + $p.period * $in.0;"
                                   : "$out.0 = $x[0] + 0.5 * ($p.period * $in.0);";
            c.update = "$x[0] = $x[0] + $p.period * $in.0;";
            return c;
          }};
}

CLaw discrete_transfer_function_c() {
  return {"discrete_transfer_function", [](const CBlock& b) {
            CCode c;
            const discrete_filter::Coefficients<double> f{b.list("num"), b.list("den"),
                                                          b.choice("direct") == 0 ? std::size_t{0} : std::size_t{1}};
            const auto n = static_cast<std::size_t>(b.view.n_x);
            std::vector<double> over, under;
            for (std::size_t i = 0; i <= n; ++i) {
              over.push_back(f.b(i));
              under.push_back(f.a(i));
            }
            c.tables = {{"over", "coefficients of the numerator, over the first of the denominator", over},
                        {"under", "coefficients of the denominator, over its first", under}};
            const std::string direct = b.choice("direct") == 0 ? "$t.over[0] * $in.0" : "0.0";
            if (n == 0) {
              c.tables.pop_back();
              c.output = "$out.0 = $p.gain * ($t.over[0] * $in.0);";
              return c;
            }
            c.functions = {R"(/* States of a filter in direct form II transposed, behind the instant. */
static void filter_states(double *w, int n, const double *over, const double *under, double u)
{
    const double y = w[0] + over[0] * u;
    int i;
    for (i = 0; i < n; ++i) {
        w[i] = over[i + 1] * u - under[i + 1] * y;
        if (i + 1 < n)
            w[i] += w[i + 1];
    }
}
)"};
            c.output = "$out.0 = $p.gain * ($x[0] + " + direct + ");";
            c.update = "filter_states($x, " + std::to_string(n) + ", $t.over, $t.under, $in.0);";
            return c;
          }};
}

CLaw digital_filter_c() {
  return {"digital_filter", [](const CBlock& b) {
            CCode c;
            const int sections = b.view.n_x / 2;
            if (sections == 0) {
              c.output = "$out.0 = $in.0;";
              return c;
            }
            c.tables = {{"sections", "b0, b1, b2, a1, a2 of each section", {b.view.c, b.view.c + 5 * sections}}};
            c.functions = {R"(/* Second-order sections in direct form II transposed, one behind the other. */
static double filter_sections(double *w, const double *sections, int n, double u)
{
    int k;
    for (k = 0; k < n; ++k) {
        const double *s = &sections[5 * k];
        double *x = &w[2 * k];
        const double y = s[0] * u + x[0];
        x[0] = s[1] * u - s[3] * y + x[1];
        x[1] = s[2] * u - s[4] * y;
        u = y;
    }
    return u;
}
)"};
            c.output = "$out.0 = filter_sections($x, $t.sections, " + std::to_string(sections) + ", $in.0);";
            return c;
          }};
}

CLaw discrete_state_space_c() {
  return {"discrete_state_space", [](const CBlock& b) {
            CCode c;
            const int states = b.view.n_x, inputs = b.view.n_u, outputs = b.view.n_y;
            const auto number_of = [&](int k, bool input) {  // the constants: scale and offset to SI of every port
              const int at = 2 * (input ? k : inputs + k);
              const double scale = b.view.c[at], offset = b.view.c[at + 1];
              return std::pair(scale, offset);
            };
            const auto read = [&](int k) {
              const auto [scale, offset] = number_of(k, true);
              if (scale == 1 && offset == 0) return fmt::format("$in.{}", k);
              return fmt::format("($in.{} - $t.ports[{}]) / $t.ports[{}]", k, 2 * k + 1, 2 * k);
            };
            bool scaled = false;
            for (int k = 0; k < inputs; ++k) scaled = scaled || number_of(k, true) != std::pair(1.0, 0.0);
            for (int k = 0; k < outputs; ++k) scaled = scaled || number_of(k, false) != std::pair(1.0, 0.0);
            if (scaled)
              c.tables = {{"ports",
                           "scale and offset to SI of every input, then of every output",
                           {b.view.c, b.view.c + 2 * (inputs + outputs)}}};
            std::string y;
            for (int r = 0; r < outputs; ++r) {
              std::string sum = "0.0";
              for (int k = 0; k < states; ++k) sum += fmt::format(" + $p.c[{}] * $x[{}]", r * states + k, k);
              if (!b.list("d").empty())
                for (int k = 0; k < inputs; ++k) sum += fmt::format(" + $p.d[{}] * ({})", r * inputs + k, read(k));
              const auto own = number_of(r, false);
              const int at = 2 * (inputs + r);
              y += fmt::format("{}$out.{} = {};", r == 0 ? "" : "\n", r,
                               own == std::pair(1.0, 0.0)
                                   ? sum
                                   : fmt::format("$t.ports[{}] * ({}) + $t.ports[{}]", at, sum, at + 1));
            }
            c.output = y;
            if (states == 0) return c;
            c.functions = {R"(/* x becomes A x + B u, row by row. */
static void next_states(double *x, double *after, const double *a, int n, const double *b, int inputs, const double *u)
{
    int r, k;
    for (r = 0; r < n; ++r) {
        double sum = 0.0;
        for (k = 0; k < n; ++k)
            sum += a[r * n + k] * x[k];
        for (k = 0; k < inputs; ++k)
            sum += b[r * inputs + k] * u[k];
        after[r] = sum;
    }
    for (r = 0; r < n; ++r)
        x[r] = after[r];
}
)"};
            c.update = fmt::format("double after[{}], u[{}];\n", states, inputs);
            for (int k = 0; k < inputs; ++k) c.update += fmt::format("u[{}] = {};\n", k, read(k));
            c.update += fmt::format("next_states($x, after, $p.a, {}, $p.b, {}, u);", states, inputs);
            return c;
          }};
}

CLaw sampled_pid_c() {
  return {"sampled_pid", [](const CBlock& b) {
            CCode c;
            const auto rule = sampled_pid::Rule(b.choice("rule"));
            const auto windup = sampled_pid::AntiWindup(b.choice("anti_windup"));
            const double kp = b.number("kp"), ki = b.number("ki"), period = b.number("period");
            double tracking = b.number("tracking_time");
            if (tracking == 0) tracking = ki != 0 && kp / ki > period ? kp / ki : period;
            c.tables = {{"ki", "integral gain", {ki}}, {"tracking_time", "of the anti-windup", {tracking}}};
            c.functions = {c_functions::larger, c_functions::smaller};
            const bool derivative = b.number("kd") != 0, before = rule == sampled_pid::Rule::trapezoidal;
            if (derivative)
              c.output = "const double rate = ($p.filter * $s.rate + ($in.u - $s.error)) / ($p.filter + $p.period);\n";
            if (before) c.output += "const double before = $s.error;\n";
            c.output += sampled_pid_in_c::command(rule, windup, ki != 0, "$in.u", "$p.kp * $in.u",
                                                  derivative ? " + $p.kd * rate" : "", "raw", "$out.y");
            if (derivative) c.output += "$s.rate = rate;\n";
            if (derivative || before) c.output += "$s.error = $in.u;\n";
            return c;
          }};
}

namespace {

template <bool tracks>
CCode discrete_pid_code(const CBlock& b) {
  using Block = DiscretePid<tracks>;
  CCode c;
  const auto p = block_detail::load<double>(typename Block::template Params<double>{}, b.view.p);
  const auto law = Block::law(p);
  constexpr sampled_pid::AntiWindup rules[] = {sampled_pid::AntiWindup::back_calculation,
                                               sampled_pid::AntiWindup::clamping, sampled_pid::AntiWindup::none};
  c.tables = {{"kp", "proportional gain", {law.gains.kp}},
              {"ki", "integral gain", {law.gains.ki}},
              {"kd", "derivative gain", {law.gains.kd}},
              {"lead", "lead of the series form", {law.gains.lead}},
              {"filter", "time constant of the derivative's filter", {law.filter}},
              {"step", "largest change of the command", {law.step}},
              {"tracking_time", "of the anti-windup", {law.tracking_time}}};
  c.functions = {c_functions::larger, c_functions::smaller};
  const auto rule = sampled_pid::Rule(static_cast<int>(p.rule));
  const bool trapezoidal = rule == sampled_pid::Rule::trapezoidal, stepped = std::isfinite(law.step);
  if (p.derivative_on != 0 || trapezoidal) c.output = "const double difference = $in.reference - $in.measured;\n";
  c.output += p.derivative_on == 0 ? "const double differentiated = -$in.measured;\n"
                                   : "const double differentiated = difference;\n";
  c.output += "const double last = $s.begun != 0.0 ? $s.differentiated : differentiated;\n";
  if (trapezoidal) c.output += "const double before = $s.begun != 0.0 ? $s.error : difference;\n";
  c.output +=
      "const double rate = ($t.filter[0] * $s.rate + (differentiated - last)) / ($t.filter[0] + $p.period);\n"
      "const double error = $in.reference - $in.measured + $t.lead[0] * rate;\n";
  c.output += sampled_pid_in_c::command(
      rule, rules[static_cast<int>(p.anti_windup)], law.gains.ki != 0, "error",
      "$t.kp[0] * ($p.setpoint_weight * $in.reference - $in.measured + $t.lead[0] * rate)", " + $t.kd[0] * rate",
      stepped ? "$s.begun != 0.0 ? larger($s.command - $t.step[0], smaller($s.command + $t.step[0], raw)) : raw"
              : "raw",
      tracks ? "$in.tracked" : "$out.y");
  c.output += "$s.rate = rate;\n$s.differentiated = differentiated;\n$s.begun = 1.0;\n";
  if (trapezoidal) c.output += "$s.error = error;\n";
  if (stepped) c.output += "$s.command = $out.y;\n";
  return c;
}

}  // namespace

CLaw discrete_pid_c() { return {"discrete_pid", discrete_pid_code<false>}; }
CLaw discrete_pid_tracking_c() { return {"discrete_pid_tracking", discrete_pid_code<true>}; }

}  // namespace hysteron::blocks
