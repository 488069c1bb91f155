#include "blocks/sampled/observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blocks/sampled/kalman_gain.h"
#include "blocks/vectors/element_units.h"

namespace hysteron::blocks {
namespace {

std::vector<double> gain_of(const View<double>& v) {
  const int measured = static_cast<int>(v.list(KalmanFilter::c).size()) / v.n_x;
  return kalman_gain({v.n_x, measured, v.list(KalmanFilter::a), v.list(KalmanFilter::c),
                      v.list(KalmanFilter::process_noise), v.list(KalmanFilter::measurement_noise)});
}

/// "" or that a matrix is not so large.
std::string wrong_size(const Shape& shape, const char* name, int rows, int columns) {
  if (shape.rows_of(name) == rows && shape.columns_of(name) == columns) return "";
  return fmt::format("\"{}\" is {} x {}; make it {} x {}", name, shape.rows_of(name), shape.columns_of(name), rows,
                     columns);
}

}  // namespace

void PulledModel::describe_model(Declaration& spec) {
  spec.in_group("sampled").linear();
  spec.remark(
      "The matrices are those of \"discrete_state_space\": plain numbers for one sampling period, in "
      "\"input_unit\", \"output_unit\" and \"state_unit\"; several units, one per element, are separated "
      "by commas: \"um, um/s\".");
  spec.remark(
      "The output is the predicted estimate, without the present measurement, so a controller can use it "
      "at the same instant.");
  spec.input("u", "$u", "inputs of the plant, one per column of B").vector();
  spec.input("measured", "$y", "measured outputs of the plant, one per row of C").vector();
  spec.output("x", "$x", "estimate of the states").vector();
  spec.state("x", "", "estimate of the states, in the units of the matrices");
  spec.matrix("a", "", "A, one row and column per state");
  spec.matrix("b", "", "B, one row per state, one column per input");
  spec.matrix("c", "", "C, one row per measurement, one column per state");
  spec.matrix("d", "", "D, one row per measurement, one column per input").optional("");
  spec.list("initial", "", "initial estimate of the states, zero if left out").optional("");
  spec.text("input_unit", {}, "unit of the inputs that the matrices refer to").optional("");
  spec.text("output_unit", {}, "unit of the measurements that the matrices refer to").optional("");
  spec.text("state_unit", {}, "unit of the states that the matrices refer to").optional("");
}

Sizes PulledModel::sizes_of(const Shape& shape) {
  Sizes s;
  const int n = shape.rows_of("a"), m = shape.columns_of("b"), p = shape.rows_of("c");
  s.sampled_states = s.outputs = n;
  s.constants = n * p + 2 * (m + p + n);
  s.feedthrough = false;
  s.input_lengths = {m, p};
  s.output_lengths = {n};
  s.lengths_from = fmt::format("\"b\" has {} columns, \"c\" {} rows and \"a\" {}", m, p, n);
  s.error = wrong_size(shape, "a", n, n);
  if (s.error.empty()) s.error = wrong_size(shape, "b", n, m);
  if (s.error.empty()) s.error = wrong_size(shape, "c", p, n);
  if (s.error.empty() && shape.rows_of("d") > 0) s.error = wrong_size(shape, "d", p, m);
  if (const int k = shape.length("initial"); s.error.empty() && k != 0 && k != n)
    s.error = fmt::format("\"initial\" has {} numbers for {} states; write one per state", k, n);
  if (!s.error.empty()) return s;
  s.input_units = units_of_elements(shape.free_text("input_unit"), m);
  const auto measured = units_of_elements(shape.free_text("output_unit"), p);
  s.output_units = units_of_elements(shape.free_text("state_unit"), n);
  s.error = wrong_units(s.input_units, m, "input_unit");
  if (s.error.empty()) s.error = wrong_units(measured, p, "output_unit");
  if (s.error.empty()) s.error = wrong_units(s.output_units, n, "state_unit");
  s.input_units.insert(s.input_units.end(), measured.begin(), measured.end());
  return s;
}

void PulledModel::note_units(const View<double>& v, double* c) {
  const int inputs = static_cast<int>(v.list(b).size()) / v.n_x;
  c = note_scales(v, input_unit, inputs, c);
  c = note_scales(v, output_unit, v.n_u - inputs, c);
  note_scales(v, state_unit, v.n_x, c);
}

void PulledModel::initial_states(const View<double>& v) {
  const auto given = v.list(initial);
  for (int k = 0; k < v.n_x; ++k) v.out[k] = given.empty() ? 0.0 : given[static_cast<std::size_t>(k)];
}

void Observer::describe(Declaration& spec) {
  spec.name("observer", "Luenberger observer: estimates the states of a plant");
  spec.law("x_(k+1) = A x_k + B u_k + gain (measured_k - C x_k - D u_k), x_0 = initial")
      .from("Luenberger, IEEE Trans. Automatic Control 16 (1971) 596-602");
  describe_model(spec);
  spec.remark("The estimation error decays with the eigenvalues of A - gain C.");
  spec.matrix("gain", "", "observer gain L, one row per state, one column per measurement");
  spec.sampled();
}

Sizes Observer::sizes(const Shape& shape) {
  Sizes s = sizes_of(shape);
  if (s.error.empty()) s.error = wrong_size(shape, "gain", shape.rows_of("a"), shape.rows_of("c"));
  return s;
}

void Observer::prepare(const View<double>& v) {
  const auto own = v.list(gain);
  note_units(v, std::copy(own.begin(), own.end(), v.out));
}

void KalmanFilter::describe(Declaration& spec) {
  spec.name("kalman_filter", "stationary Kalman filter: estimates the states of a plant");
  spec.law(
          "x_(k+1) = A x_k + B u_k + L (measured_k - C x_k - D u_k), L = A P C' (C P C' + R)^-1, P = A P A' - L C P A' + Q; Q = "
          "process_noise, R = measurement_noise")
      .from("Anderson, Moore, Optimal Filtering (1979), chapter 4");
  describe_model(spec);
  spec.remark(
      "Only the ratio of Q to R matters: a larger Q gives the measurements more weight. To give the gain "
      "directly use \"observer\".");
  spec.matrix("process_noise", "", "covariance Q of the process noise per period, one row and column per state");
  spec.matrix("measurement_noise", "", "covariance R of the measurement noise, one row and column per measurement");
  spec.sampled();
}

Sizes KalmanFilter::sizes(const Shape& shape) {
  Sizes s = sizes_of(shape);
  const int n = shape.rows_of("a"), p = shape.rows_of("c");
  if (s.error.empty()) s.error = wrong_size(shape, "process_noise", n, n);
  if (s.error.empty()) s.error = wrong_size(shape, "measurement_noise", p, p);
  return s;
}

void KalmanFilter::prepare(const View<double>& v) {
  const auto gain = gain_of(v);
  note_units(v, std::copy(gain.begin(), gain.end(), v.out));
}

std::string KalmanFilter::check(const View<double>& v) {
  const auto gain = gain_of(v);
  if (std::all_of(gain.begin(), gain.end(), [](double x) { return std::isfinite(x); })) return "";
  return "the estimation error does not converge: an unstable or undamped state is not observable from the "
         "measurements, or \"measurement_noise\" is not positive; add measurements, or give a positive "
         "\"measurement_noise\"";
}

Kernel observer_block() { return kernel<Observer>(); }
Kernel kalman_filter_block() { return kernel<KalmanFilter>(); }

}  // namespace hysteron::blocks
