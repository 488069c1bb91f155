#include "engine/simulate/step_tolerances.h"

#include <algorithm>

namespace hysteron {
namespace {

// The integrators hold the error of each step, and errors of many steps add up. Measured by benchmarks/accuracy.cpp on
// four memory models: up to 17 times the tolerance with half of it, up to 7 times with a quarter, the largest of the
// shares tried that stayed within ten (docs/performance.md; no bound). Doubles carry no more than the last of these.
constexpr double share_of_tolerance = 0.25;
// Behind each restart the first steps are of a low order, and every one of them errs by what it may.
constexpr double share_with_restarts = 0.1;
constexpr double tightest_tolerance = 1e-13;
constexpr double least_tolerance = 1e-290;  // [SI] absolute; one over it is a number

/// Something in it switches, turns, bends, is sampled or comes late: the integrator starts again and again.
bool restarts(const Program& program) {
  return program.n_m > 0 || !program.modal_blocks.empty() || !program.kinked_blocks.empty() || program.n_histories > 0;
}

}  // namespace

SimulateOptions held_tolerance(const Program& program, SimulateOptions options) {
  const double asked = options.relative_tolerance;
  const double share = restarts(program) ? share_with_restarts : share_of_tolerance;
  options.relative_tolerance = std::max(share * asked, std::min(asked, tightest_tolerance));
  return options;
}

std::vector<double> absolute_tolerances(const NominalSizes& sizes, const SimulateOptions& options) {
  std::vector<double> absolute(std::max<std::size_t>(1, sizes.states.size()), 1.0);
  for (std::size_t i = 0; i < sizes.states.size(); ++i)
    absolute[i] = std::max(options.absolute_tolerance * options.relative_tolerance * sizes.states[i], least_tolerance);
  return absolute;
}

}  // namespace hysteron
