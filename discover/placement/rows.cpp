// Decides how signals of a program are simulated at given times. See rows.h.
#include "discover/placement/rows.h"

#include <optional>

#include "engine/diagram/error.h"
#include "engine/rowwise/advance.h"
#include "engine/simulate/simulate.h"
#include "fit/model/model.h"

namespace hysteron {

std::vector<std::vector<double>> simulate_rows(const ProgramPointer& program, const std::vector<SeriesPointer>& inputs,
                                               const std::vector<double>& t, const std::vector<int>& signals,
                                               bool at_rest) {
  Run run = start(*program);
  for (std::size_t i = 0; i < inputs.size(); ++i) bind_input(*program, run, program->input_names[i], inputs[i]);
  std::optional<Advance> advance;
  if (why_not_exact(*program).empty()) advance.emplace(program, signals);
  const auto in_steps = [&](int substeps) {
    std::vector<std::vector<double>> values;
    AdvanceOptions options;
    options.at_rest = at_rest;
    options.substeps = substeps;
    (*advance)(run, t, options, values);
    return values;
  };
  if (advance && !advance->integrates()) return in_steps(2);  // ranges, holds and differences need no last digit
  SimulateOptions options;
  options.begin = t.front();
  options.until = t.back();
  options.instants = t;
  options.signals = signals;
  options.at_rest = at_rest;
  try {
    return simulate(*program, run, options).values;  // states that are not linear need steps that suit them
  } catch (const Error& e) {
    // The integrator cannot go on: a slew limit that turns within a rounding error. Steps as fine as a fit takes at
    // most.
    if (!advance || e.fault != Fault::numerics) throw;
    return in_steps(DataModelOptions().max_substeps);
  }
}

}  // namespace hysteron
