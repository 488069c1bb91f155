// Decides what comes out with an effect and without it where it stands on one bench under one standard signal, and at
// which values it can be seen there. Internal to discover (demonstration.h, neutral.h).
#pragma once

#include <string>
#include <vector>

#include "discover/demonstration/demo_rig.h"
#include "discover/hypotheses/effect.h"
#include "engine/program/program.h"

namespace hysteron {

/// One effect on one bench under one signal; both outlive it. Numbers in SI.
class DemoRun {
 public:
  DemoRun(const Effect& effect, const DemoRig& demo_rig, const Stimulus& stimulus, const Registry& registry);

  const Excitation& excitation() const { return at_; }
  const Law& law() const { return law_; }
  const std::vector<double>& values() const { return values_; }  ///< as Law::free
  const std::vector<double>& rows() const { return rows_; }      ///< times of a recording
  const std::vector<double>& plain() const { return plain_; }    ///< without the effect, at the rows
  std::vector<double> with(const std::vector<double>& t) const { return response(*on_, t, values_); }
  std::vector<double> without(const std::vector<double>& t) const { return response(*off_, t, {}); }
  Unit out_unit() const { return off_->signals[static_cast<std::size_t>(off_->output_signals.front())].unit; }

  /// Sets values at which the effect can be seen: those at which it starts, else others of its scan, else an amplitude
  /// of a tenth of the signal and a factor that is unusual. False if it shows at none of them.
  bool find_values();
  /// Largest difference that the effect makes with these values over the span of the signal; not a number where it
  /// cannot be simulated with them.
  double share_with(const std::vector<double>& values) const;

 private:
  std::vector<double> response(const Program& program, const std::vector<double>& t,
                               const std::vector<double>& values) const;
  void refuse_impossible(const std::vector<double>& values) const;
  bool shows(const std::vector<double>& values) const;
  bool find_amplitudes();

  const DemoRig& demo_rig_;
  const Stimulus& stimulus_;
  Excitation at_;
  Law law_;
  std::vector<std::string> paths_;
  ProgramPointer on_, off_;
  std::vector<double> rows_, plain_, values_;
};

/// Largest less smallest, 0 of none.
double span_of(const std::vector<double>& v);
std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b);
/// Largest size.
double largest(const std::vector<double>& v);

}  // namespace hysteron
