#include "tests/export/c/random_diagram.h"

#include <fmt/format.h>

#include <iterator>
#include <random>
#include <vector>

namespace hysteron::in_c {
namespace {

/// A block of the random diagrams: `in` is wired to `wires` signals before it.
struct Part {
  const char* json;
  int wires;
  bool jumps =
      false;  ///< its law has a step, where the last bit of what comes in may decide about much of what goes out
};
constexpr Part parts[] = {
    {R"("type": "gain", "gain": 0.7)", 1},
    {R"("type": "pass")", 1},
    {R"("type": "calibration", "gain": 1.1, "offset": -0.3)", 1},
    {R"("type": "sum", "signs": "+-")", 2},
    {R"("type": "sum")", 3},
    {R"("type": "product")", 2},
    {R"("type": "abs")", 1},
    {R"("type": "sign")", 1, true},
    {R"("type": "saturation", "lower": -0.4, "upper": 0.6)", 1},
    {R"("type": "dead_zone", "lower": -0.1, "upper": 0.2)", 1},
    {R"("type": "wrap", "period": 0.7)", 1, true},
    {R"("type": "rectifier", "mix": 0.4)", 1},
    {R"("type": "rounding", "step": 0.13, "zero": 0.05)", 1, true},
    {R"("type": "min_max", "is": "min")", 3},
    {R"("type": "polynomial", "coefficients": [0.1, 0.9, -0.2, 0.05], "reference": 0.8, "lower": -0.6, "upper": 0.9)",
     1},
    {R"("type": "lookup", "at": [-0.5, 0, 0.2, 1], "values": [0.3, 0, 0.5, 0.4], "outside": "extrapolate")", 1},
    {R"("type": "soft_saturation", "limit": 0.8, "sharpness": 2.5)", 1},
    {R"("type": "switch", "level": 0.2)", 3, true},
    {R"("type": "play", "radius": 0.15)", 1},
    {R"("type": "play", "radius": 0.2, "sides": "one", "before": 0.4)", 1},
    {R"("type": "prandtl_ishlinskii", "thresholds": [0, 0.1, 0.3], "weights": [0.6, 0.2, 0.3], "sides": "two")", 1},
    {R"("type": "prandtl_ishlinskii_inverse", "thresholds": [0, 0.2, 0.5], "weights": [0.6, 0.2, -0.1], "before": 0.7)",
     1},
    {R"("type": "generalized_prandtl_ishlinskii", "thresholds": [0, 0.1, 0.3], "weights": [0.6, 0.2, 0.3], "lower": -1, "upper": 1, "slope_at_lower": 0.5, "slope_at_upper": 1.8)",
     1},
    {R"("type": "asymmetric_prandtl_ishlinskii", "thresholds": [0, 0.1, 0.3], "weights": [0.6, 0.2, 0.3], "saturation": 0.5, "bend": 0.8)",
     1},
    {R"("type": "preisach", "levels": [-1, -0.2, 0.1, 0.8], "weights": [0.1, 0.2, 0.1, 0.3, 0.05, 0.2], "gain": 0.5)",
     1, true},
    {R"("type": "sampled_asymmetric_inverse", "thresholds": [0, 0.1, 0.3], "weights": [0.6, 0.2, 0.3], "saturation": 0.5, "bend": 0.8, "period": "1 ms")",
     1},
    {R"("type": "sampled_bouc_wen_inverse", "alpha": 0.4, "beta": 0.9, "gamma": 0.1, "d_p": 1.2, "period": "1 ms")", 1},
    {R"("type": "sampled_bouc_wen_inverse", "alpha": 0.4, "beta": 0.9, "gamma": 0.1, "d_p": 1.2, "exponent": 1.5, "scale": 0.5, "period": "1 ms")",
     1},
    {R"("type": "sample_hold", "period": "3 ms", "offset": "1 ms")", 1},
    {R"("type": "quantizer", "bits": 8, "lower": -1, "upper": 1, "period": "1 ms")", 1, true},
    {R"("type": "delay_line", "samples": 3, "period": "2 ms")", 1},
    {R"("type": "fir", "coefficients": [0.3, 0.4, 0.2], "period": "1 ms")", 1},
    {R"("type": "moving_average", "samples": 4, "period": "1 ms")", 1},
    {R"("type": "discrete_transfer_function", "num": [0.2, 0.1], "den": [1, -0.6, 0.1], "gain": 1.5, "period": "1 ms")",
     1},
    {R"("type": "discrete_transfer_function", "num": [0.2, 0.1], "den": [1, -0.6], "direct": "no", "period": "2 ms")",
     1},
    {R"("type": "digital_filter", "order": 3, "corner": "80 Hz", "period": "1 ms")", 1},
    {R"("type": "discrete_state_space", "a": [[0.5, 0.1], [0, 0.8]], "b": [[0.2], [0.4]], "c": [[1, 0.5]], "d": [[0.1]], "period": "1 ms")",
     1},
    {R"("type": "sampled_pid", "kp": 0.8, "ki": "20 1/s", "lower": -0.5, "upper": 0.6, "anti_windup": "clamping", "period": "1 ms")",
     1, true},
    {R"("type": "sampled_pid", "kp": 0.8, "ki": "20 1/s", "kd": "1 ms", "filter": "3 ms", "rule": "trapezoidal", "lower": -0.5, "upper": 0.6, "anti_windup": "back_calculation", "period": "2 ms")",
     1},
    {R"("type": "discrete_pid", "kp": 0.8, "ki": "20 1/s", "kd": "1 ms", "lower": -0.5, "upper": 0.6, "rate": "50 1/s", "period": "1 ms")",
     2},
};

}  // namespace

unsigned random_kinds() { return static_cast<unsigned>(std::size(parts)); }

RandomDiagram random_diagram(unsigned seed) {
  std::mt19937 random(seed);
  const auto any = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::vector<std::string> signals{"u", "v"};
  std::string blocks;
  bool jumps = false;
  const std::size_t count = 3 + any(7);
  for (std::size_t k = 0; k < count; ++k) {
    // Each part is met: the first of every diagram goes through all of them.
    const Part& part = parts[k == 0 ? seed % std::size(parts) : any(std::size(parts))];
    jumps = jumps || part.jumps;
    std::string wires;
    for (int w = 0; w < part.wires; ++w)
      wires += fmt::format("{}\"{}\"", w == 0 ? "" : ", ", signals[any(signals.size())]);
    blocks += fmt::format("{}\n\"b{}\": {{{}, \"in\": [{}]}}", k == 0 ? "" : ",", k, part.json, wires);
    signals.push_back(fmt::format("b{}", k));
  }
  // Every block is an output, and both inputs are read.
  std::string outputs;
  for (std::size_t k = 0; k < count; ++k) outputs += fmt::format("\"y{0}\": \"b{0}\", ", k);
  return {fmt::format(R"({{"format": 1, "title": "random {}", "inputs": {{"u": {{}}, "v": {{}}}}, "blocks": {{{},
    "both": {{"type": "sum", "in": ["u", "v"]}}}}, "outputs": {{{}"both": "both"}}}})",
                      seed, blocks, outputs),
          jumps};
}

}  // namespace hysteron::in_c
