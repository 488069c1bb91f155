// Decides what a program is near an operating point: a linear system from chosen signals to chosen signals, its poles
// and its frequency response. Does not decide the operating point (rest.h: settle_at_rest, or a simulation that was
// stopped there) nor how the response is read (margins.h).
#pragma once

#include <complex>
#include <span>
#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// x' = A x + B u + B_w w,  y = C x + D u + D_w w,  v = E x + F u + G w,  w_i(t) = v_i(t - delay_i)
/// in deviations from the operating point, SI. Matrices by rows. The last terms are the dead times, exactly.
struct LinearModel {
  int states = 0, inputs = 0, outputs = 0;
  std::vector<double> a, b, c, d;
  std::vector<std::string> state_names;
  std::vector<double> delays;  ///< [s]
  std::vector<double> b_delayed, d_delayed, to_delays, to_delays_from_inputs, between_delays;

  /// Eigenvalues of A [rad/s], by falling real part; exactly 0 where rounding decides. With dead
  /// times inside a loop these are not all there is.
  std::vector<std::complex<double>> poles() const;
  /// y/u at the angular frequency w [rad/s], outputs by rows. The instant response D is included.
  std::vector<std::complex<double>> response(double w) const;
};

struct LinearizeOptions {
  std::vector<int> from, to;  ///< signals
  /// Signals whose readers no longer see them move (a loop is opened there); one of `from` may be among them: its
  /// readers then see the injected signal instead.
  std::vector<int> open{};
};

/// Slopes of the program at (run.t, run.x) with its memory and modes as committed. A signal in `from` is taken to move
/// by u in addition to what it does itself, with its rate. Throws Error "not_linear" for sampled blocks on the way
/// (their instants have no place in such a system) with the cure.
LinearModel linearize(const Program& program, const Run& run, const LinearizeOptions& options);

}  // namespace hysteron
