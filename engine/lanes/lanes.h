// Decides how many runs of one program that differ in parameter values are advanced together, lane by lane in the inner
// loop: fixed steps (Euler, Runge-Kutta), and static diagrams from row to row. Rows are handed on as they come, none
// are kept. What all lanes share (sources whose parameters are not varied, and what is made of them) is computed once.
// Which programs may: lanes_allowed.cpp. Does not choose parameter sets and does not judge runs: fit/.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/program/parameter_values.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"

namespace hysteron {

/// Can runs of this program that differ in anything but the times of their sources' corners be advanced together? "" or
/// the block that stands in the way, and why. Says nothing of the method.
std::string why_not_in_lanes(const Program& program);
/// The same for this run (its inputs bound), these options and these varied parameters (places in program.parameters),
/// with the cure.
std::string why_not_in_lanes(const Program& program, const Run& run, const SimulateOptions& options,
                             std::span<const int> parameters);

class Lanes {
 public:
  /// Enough that a loop's beginning is a small share of it; few enough that a law's numbers stay in the nearest cache.
  static constexpr int width = 128;

  /// `run`: parameters that are not varied, inputs bound. Signals and instants as in `options`, whose instants must lie
  /// on steps. Throws Error "not_in_lanes" where why_not_in_lanes() says so.
  Lanes(ProgramPointer program, const Run& run, const SimulateOptions& options, std::vector<int> parameters,
        RefusedValues refused = RefusedValues::end_the_run);
  ~Lanes();
  Lanes(Lanes&&) noexcept;
  Lanes& operator=(Lanes&&) noexcept;

  /// Row number, its time [s], and signals[s * width + lane] [SI]; lanes that are not used or were refused hold nothing
  /// that matters.
  using Sink = std::function<void(long row, double t, const double* signals)>;

  /// Runs values.size() / parameters of them, at most `width`: values[sample * parameters + parameter] [SI]. Returns
  /// per sample why there is no result, if there is none: values that a block refuses ("bad_value"), no equilibrium to
  /// start from, states that are not finite at the end ("diverged").
  std::vector<std::optional<Problem>> operator()(std::span<const double> values, const Sink& sink);

  long rows() const;

 private:
  class Advance;
  std::unique_ptr<Advance> advance_;
};

}  // namespace hysteron
