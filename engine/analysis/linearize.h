// Decides what a program is near an operating point: a linear system from chosen signals to chosen signals, its poles
// and its frequency response. Does not decide the operating point (rest.h: settle_at_rest, or a simulation that was
// stopped there) nor how the response is read (margins.h), nor sampled systems (sampled_model.h).
#pragma once

#include <complex>
#include <span>
#include <string>
#include <vector>

#include "engine/analysis/poles.h"
#include "engine/program/program.h"

namespace hysteron {

/// x' = A x + B u + B_w w,  y = C x + D u + D_w w,  v = E x + F u + G w,  w_i(t) = factor_i v_i(t - delay_i)
/// in deviations from the operating point, SI. Matrices by rows. The last terms are the channels: dead times, exactly
/// (factor 1), and describing functions (delay 0; the factor counts at positive frequencies).
struct LinearModel {
  int states = 0, inputs = 0, outputs = 0;
  std::vector<double> a, b, c, d;
  std::vector<std::string> state_names;
  std::vector<double> delays;  ///< [s]
  std::vector<std::complex<double>> factors;
  std::vector<double> b_delayed, d_delayed, to_delays, to_delays_from_inputs, between_delays;

  /// Eigenvalues of A [rad/s], by falling real part; exactly 0 where rounding decides. With channels inside a loop
  /// these are not all there is.
  std::vector<std::complex<double>> poles() const;
  /// Of one input and one output: where the response is zero [rad/s], without channels, by falling real part.
  std::vector<std::complex<double>> zeros() const;
  /// y/u at the angular frequency w [rad/s], outputs by rows. The instant response D is included.
  std::vector<std::complex<double>> response(double w) const;

  /// Without the states and channels that no input moves or no output sees: what lies between inputs and outputs.
  LinearModel on_the_way() const;
  /// One input, one output: the same with the loop closed, u = -gain y. No inputs are left. Throws Error "not_linear"
  /// if gain times D is -1, where no closed loop exists.
  LinearModel closed(double gain = 1) const;
};

/// A block that stands for its describing function: the first harmonic of what it does to a sine of that amplitude.
struct AboutAmplitude {
  int block = -1;
  double amplitude = 0;  ///< [SI] of its input
};

/// One input, and no dynamics of its own: its answer to a sine is a number.
bool has_describing_function(const Program& program, int block);

struct LinearizeOptions {
  std::vector<int> from, to;  ///< signals
  /// Signals whose readers no longer see them move (a loop is opened there); one of `from` may be among them: its
  /// readers then see the injected signal instead.
  std::vector<int> open{};
  std::vector<AboutAmplitude> amplitudes{};
};

/// Slopes of the program at (run.t, run.x) with its memory and modes as committed. A signal in `from` is taken to move
/// by u in addition to what it does itself, with its rate. Throws Error "not_linear" where sampled blocks stand on the
/// way: sampled_model() describes those.
LinearModel linearize(const Program& program, const Run& run, const LinearizeOptions& options);

/// Does something sampled stand between `from` and `to`.
bool is_sampled(const Program& program, const Run& run, const LinearizeOptions& options);

/// Blocks on the way by the wires that pass nothing on at this operating point: a play inside its gap, a saturation at
/// its limit, a quantizer.
std::vector<int> blocks_that_cut(const Program& program, const Run& run, const LinearizeOptions& options);

}  // namespace hysteron
