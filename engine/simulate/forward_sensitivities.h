// Decides how the slopes of a run with respect to parameters are carried along (forward sensitivities).
//
// Each parameter p has two twins of the run, with p + h and p - h. They own everything that a run commits: memory, held
// samples, modes, pasts of dead times. Their states are x + h S and x - h S with S = dx/dp, which the integrator
// carries:
//   dS/dt = (f(x + h S, p + h) - f(x - h S, p - h)) / (2 h) = J S + df/dp,
// one difference along one direction, exact but for h^2 (Hindmarsh, Serban, CVODES user guide, section 2.7). What a run
// accepts, its twins accept; a jump is walked by all three. So memory carries its own slopes, without which those of a
// hysteretic actuator have the wrong sign. ForwardSensitivities never see an event of their own: they
// change modes when the run does, with the correction for the shift of its time,
//   tau = dt/dp = -(dg/dp) / (dg/dt),  S+ = R_x (S + f- tau) + R_p - f+ tau,
// for a guard g and a reset R (Rozenvasser, Autom. Remote Control 28 (1967) 394-400).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/events/events.h"
#include "engine/program/program.h"

namespace hysteron {

class ForwardSensitivities {
 public:
  /// parameters: places in program.parameters. Throws Error "no_slope" for a parameter that shifts instants (a period,
  /// the time of a step): its slopes are not finite there.
  ForwardSensitivities(const Program& program, const Run& run, std::vector<int> parameters);

  int count() const { return static_cast<int>(sensitivities_of_.size()); }
  std::vector<double> parameter_sizes() const;  ///< usual sizes [SI]

  /// Runs with p + h and p - h, started as declared for them: for ways of simulating that carry no slopes themselves.
  struct Pair {
    Run up, down;
    double h = 0;
  };
  std::vector<Pair> pairs(const Run& run);

  /// dx/dp at the start, by columns: what the declared start says, or `settle` (an equilibrium, say) makes of it.
  std::vector<double> start(const Run& run, const std::function<void(Run&)>& settle);
  /// dS/dt for all columns; false where one is not finite.
  bool derivative(const Run& run, double t, const double* x, const double* const* s, double* const* ds);
  /// At an accepted point.
  void accept(const Run& run, double t, std::span<const double> x, std::span<const double> s);
  /// d(signal)/dp: out[parameter][signal].
  void outputs(const Run& run, double t, std::span<const double> x, std::span<const double> s,
               std::span<const int> signals, std::vector<std::vector<double>>& out);
  /// Breakpoints and samples that are due (Events::take was called); changes s.
  void cross(Events& events, const Run& run, double t, std::span<const double> x, std::span<double> s);
  /// The modes of the run change so; x: before the change; `step`: a time in which the guards are smooth [s].
  void change_modes(Events& events, const Run& run, double t, std::span<const double> x, std::span<double> s,
                    std::span<const ModeChange> changes, double step);

 private:
  struct Side {
    Run run;
    std::unique_ptr<Work> work;
    std::vector<double> x;
  };
  struct PerturbedRun {
    int parameter;
    double h;
    Side up, down;
  };
  void follow(const Run& run, Side& side);
  void place(PerturbedRun& twin, std::span<const double> x, std::span<const double> s);

  const Program& program_;
  std::vector<PerturbedRun> sensitivities_of_;
};

}  // namespace hysteron
