#include "export/c/c_rows.h"

#include <cmath>
#include <memory>
#include <numbers>

#include "engine/events/clocks.h"
#include "engine/simulate/simulate.h"

namespace hysteron {
namespace {

SignalRows outputs(const Program& program, const std::vector<double>& times, const SignalRows& inputs,
                   SimulateOptions options) {
  Run run = start(program);
  for (std::size_t i = 0; i < program.input_names.size(); ++i) {
    auto series = std::make_shared<Series>(Series{times, inputs[i], Between::linear});
    bind_input(program, run, program.input_names[i], std::move(series));
  }
  options.begin = times.front();
  options.until = times.back();
  options.instants = times;
  options.signals = program.output_signals;
  return simulate(program, std::move(run), options).values;
}

}  // namespace

std::vector<double> step_times(double period, std::size_t count) {
  const Fraction exact = nearest_fraction(period);
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k)
    times.push_back(exact.d == 0
                        ? static_cast<double>(k) * period
                        : static_cast<double>(k) * static_cast<double>(exact.n) / static_cast<double>(exact.d));
  return times;
}

SignalRows stepped_outputs(const Program& program, const std::vector<double>& times, const SignalRows& inputs) {
  SimulateOptions options;
  options.method = Method::euler;
  // Steps end where an input turns and where something is sampled; nothing moves between.
  options.step = times.back() - times.front();
  return outputs(program, times, inputs, options);
}

SignalRows continuous_outputs(const Program& program, const std::vector<double>& times, const SignalRows& inputs) {
  SimulateOptions options;
  options.relative_tolerance = 1e-9;
  return outputs(program, times, inputs, options);
}

std::vector<double> tried_input(double size, std::size_t which, std::size_t count) {
  using std::numbers::pi;
  std::vector<double> u;
  const double phase = 0.7 * static_cast<double>(which);
  for (std::size_t k = 0; k < count; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(count);
    const double envelope = 0.75 + 0.25 * std::cos(2 * pi * s), turn = std::sin(2 * pi * (5 * s - 0.25) + phase);
    u.push_back(size * (0.5 + 0.45 * envelope * turn + 0.05 * std::sin(2 * pi * 43 * s + phase)));
  }
  return u;
}

}  // namespace hysteron
