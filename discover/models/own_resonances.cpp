#include "discover/models/own_resonances.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "engine/analysis/linearize.h"
#include "engine/diagram/error.h"
#include "engine/events/rest.h"
#include "engine/simulate/simulate.h"

namespace hysteron {

std::vector<Resonance> own_resonances(const Program& program) {
  std::vector<Resonance> list;
  try {
    Run run = start(program);
    const auto zero = std::make_shared<const Series>(Series{{0.0}, {0.0}, Between::linear});
    for (const auto& input : program.input_names) bind_input(program, run, input, zero);
    settle_at_rest(program, run, 0);
    const LinearModel model = linearize(program, run, {program.input_signals, program.output_signals});
    for (const auto& pole : model.poles())
      if (pole.imag() > 0) list.push_back({std::abs(pole) / (2 * std::numbers::pi), -pole.real() / std::abs(pole)});
  } catch (const Error&) {
    return {};  // its resonances are not known, and nothing is refused for them
  }
  std::sort(list.begin(), list.end(), [](const Resonance& a, const Resonance& b) { return a.frequency < b.frequency; });
  return list;
}

}  // namespace hysteron
