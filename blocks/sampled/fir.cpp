#include "blocks/sampled/fir.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron::blocks {
namespace {

constexpr int most_samples = 100000;

void describe_past(Declaration& d) {
  d.state("line", "$a", "the last samples, oldest first");
  d.parameter("before", "$a", "value of the input before the first instant").optional("0");
  d.sampled();
}

}  // namespace

void Fir::describe(Declaration& d) {
  d.name("fir", "FIR filter: weighted sum of the last samples").in_group("sampled").elementwise().linear();
  d.law("y_k = coefficients[1] u_k + coefficients[2] u_(k-1) + ...")
      .from("Oppenheim, Schafer, Discrete-Time Signal Processing, 3rd ed. (2010), section 6.5");
  d.remark("The coefficients are the impulse response of the filter and carry its unit.");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "the response");
  d.list("coefficients", "$b/$a", "filter coefficients, that of the present sample first").linear();
  describe_past(d);
}

Sizes Fir::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("coefficients");
  if (n < 1) s.error = "no coefficients; write at least one, e.g. \"coefficients\": [1]";
  s.sampled_states = std::max(n - 1, 0);
  return s;
}

void Fir::initial_states(const View<double>& v) { std::fill(v.out, v.out + v.n_x, v.parameter(before)); }

void MovingAverage::describe(Declaration& d) {
  d.name("moving_average", "moving average of the last samples").in_group("sampled").elementwise().linear();
  d.law("y_k = (u_k + u_(k-1) + ... + u_(k-samples+1))/samples").from("definition");
  d.remark(
      "It removes every frequency with a whole number of periods in samples x period: 50 Hz with 20 "
      "samples of 1 ms. It delays the signal by (samples - 1)/2 periods.");
  d.input("u", "$a", "the input");
  d.output("y", "$a", "the mean");
  d.parameter("samples", "", "number of samples, including the present one").structural().positive();
  describe_past(d);
}

Sizes MovingAverage::sizes(const Shape& shape) {
  Sizes s;
  const auto n = shape.whole_numbers("samples");
  const int samples = n.empty() ? 0 : n[0];
  if (samples < 1 || samples > most_samples)
    s.error = fmt::format("\"samples\" is {}; give a whole number from 1 to {}", samples, most_samples);
  s.sampled_states = std::max(samples - 1, 0);
  return s;
}

void MovingAverage::initial_states(const View<double>& v) { std::fill(v.out, v.out + v.n_x, v.parameter(before)); }

Kernel fir_block() { return kernel<Fir>(); }
Kernel moving_average_block() { return kernel<MovingAverage>(); }

}  // namespace hysteron::blocks
