// Prints measured errors as multiples of the requested relative tolerance, 1e-4 ... 1e-10: each memory model in front
// of the plant, in open and closed loop, continuous and sampled, by each adaptive method. The error is the largest
// difference over the largest value of the reference, at 2001 instants, of the model's output or the plant's, whichever
// is larger.
//
// The reference is the same diagram by explicit Runge-Kutta at 1e-12. How far it can be trusted show the golden traces
// of tests/engine/simulate/simulate_golden_test.cpp and the errors of the workload "closed loop", against a program by
// hand.
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "benchmarks/diagrams.h"
#include "engine/diagram/error.h"

namespace {

using namespace hysteron;
using namespace hysteron::benchmarks;

constexpr double until = 0.4;  // [s] two periods
constexpr double tolerances[] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};

struct Model {
  const char* name;
  Node node;  // its input is still open
};

std::vector<Model> models() {
  return {
      {"play", node("play", {{"radius", "0.6 V"}})},
      {"Prandtl-Ishlinskii",
       node("prandtl_ishlinskii",
            {{"thresholds", numbers({0, .6, 1.2, 1.8, 2.4, 3.0, 3.6, 4.2, 4.8, 5.4}, "V")},
             {"weights", numbers({.7521, .1381, .0775, .0651, .0658, .0522, .0506, .0523, .0520, .1169}, "um/V")}})},
      {"Bouc-Wen",
       node("bouc_wen",
            {{"alpha", "0.6187 um/V"}, {"beta", "0.2418 1/V"}, {"gamma", "0.0237 1/V"}, {"d_p", "1.6126 um/V"}})},
      {"Jiles-Atherton",
       node("jiles_atherton",
            {{"p_s", "55.9973 um"}, {"a", "48.5843 V"}, {"alpha", "0.2512 V/um"}, {"k", "3.8892 V"}, {"c", .6929}})}};
}

Diagram diagram(const Model& model, bool closed, bool sampled) {
  Diagram d;
  d.blocks["reference"] = thesis_sine(closed ? "um" : "V");
  std::string drive = "reference";
  if (closed) {
    d.blocks["error"] = node("sum", {{"signs", "+-"}}, {"reference", "stage"});
    drive = "controller";
    // Sampled: the slower controller of the thesis, whose loop stays stable with the delay of the hold.
    d.blocks["controller"] = sampled ? node("sampled_pid",
                                            {{"kp", "0.5265 V/um"},
                                             {"ki", "1521 V/um/s"},
                                             {"lower", "-inf V"},
                                             {"upper", "inf V"},
                                             {"rule", "forward"},
                                             {"anti_windup", "none"},
                                             {"period", "0.1 ms"}},
                                            {"error"})
                                     : node("pi_controller", {{"kp", "1.207 V/um"}, {"ki", "7009 V/um/s"}}, {"error"});
  } else if (sampled) {
    drive = "hold";
    d.blocks["hold"] = node("sample_hold", {{"period", "0.1 ms"}}, {"reference"});
  }
  d.blocks["model"] = model.node;
  d.blocks["model"].in.push_back({"", drive});
  const bool volts = model.node.type == "play";
  d.blocks["stage"] = volts ? thesis_plant("model", "1 um/V") : thesis_plant("model");
  d.record = {"model", "stage"};
  return d;
}

std::vector<std::vector<double>> traces_of(const Program& program, Method method, double tolerance) {
  const SimulateOptions options{
      .until = until, .every = until / 2000, .method = method, .relative_tolerance = tolerance};
  return simulate(program, start(program), options).values;
}

double relative_error(const std::vector<std::vector<double>>& traces,
                      const std::vector<std::vector<double>>& reference) {
  double worst = 0;
  for (std::size_t s = 0; s < reference.size(); ++s) {
    double size = 0;
    for (const double v : reference[s]) size = std::max(size, std::abs(v));
    worst = std::max(worst, largest_error(traces[s], reference[s]) / size);
  }
  return worst;
}

}  // namespace

int main() {
  fmt::print("{:<54}", "error / relative tolerance");
  for (const double tolerance : tolerances) fmt::print("{:>8.0e}", tolerance);
  fmt::print("\n");
  double worst = 0;
  int count = 0, beyond = 0;
  for (const bool sampled : {false, true})
    for (const bool closed : {false, true})
      for (const auto& model : models()) {
        const auto program = compiled(diagram(model, closed, sampled));
        const auto reference = traces_of(*program, Method::runge_kutta, 1e-12);
        for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta}) {
          fmt::print("{:<20}{:<8}{:<12}{:<14}", model.name, closed ? "closed" : "open",
                     sampled ? "sampled" : "continuous", method_name(method));
          for (const double tolerance : tolerances) {
            try {
              const double ratio = relative_error(traces_of(*program, method, tolerance), reference) / tolerance;
              worst = std::max(worst, ratio);
              ++count;
              beyond += ratio > 10 ? 1 : 0;
              fmt::print("{:>8.2g}", ratio);
            } catch (const Error&) {
              fmt::print("{:>8}", "failed");
            }
          }
          fmt::print("\n");
          std::fflush(stdout);
        }
      }
  fmt::print("\nlargest {:.3g}; {} of {} beyond 10\n", worst, beyond, count);
  return 0;
}
