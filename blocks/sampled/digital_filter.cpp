#include "blocks/sampled/digital_filter.h"

#include <fmt/format.h>

namespace hysteron::blocks {
namespace {

bool is_band(filter_design::Pass pass) {
  return pass == filter_design::Pass::band || pass == filter_design::Pass::stop;
}
filter_design::Wanted wanted(const View<double>& v) {
  using P = DigitalFilter;
  return {filter_design::Family(v.choice(P::family)),
          filter_design::Pass(v.choice(P::pass)),
          v.choice(P::order),
          v.parameter(P::corner),
          v.parameter(P::upper),
          v.parameter(P::ripple),
          v.parameter(P::period)};
}

}  // namespace

void DigitalFilter::describe(Declaration& d) {
  d.name("digital_filter", "digital Butterworth or Chebyshev filter").in_group("sampled").elementwise().linear();
  d.law(
       "poles of the analog prototype, transformed to the corner frequencies and discretised by z = (1 + s "
       "T/2)/(1 - s T/2) (Tustin) with prewarping: every corner f at s = 2/T tan(pi f T)")
      .from("Oppenheim, Schafer, Discrete-Time Signal Processing, 3rd ed. (2010), section 7.3 and appendix B");
  d.remark(
      "At a corner the gain is 1/sqrt(2) (-3.01 dB) for Butterworth and -\"ripple\" dB for Chebyshev, "
      "exactly and for every period. \"band\" and \"stop\" have 2 x order poles.");
  d.remark("It is implemented as second-order sections; the output is held between the sampling instants.");
  d.input("u", "$a", "the input");
  d.output("y", "$a", "the response");
  d.state("w", "$a", "states, two per section");
  d.text("family", {"butterworth", "chebyshev"},
         "butterworth: flat pass band; chebyshev: steeper, with ripple in the pass band");
  d.text("pass", {"low", "high", "band", "stop"}, "type: low-pass, high-pass, band-pass or band-stop");
  d.parameter("order", "", "order of the prototype, 1 to 20").optional("2").structural().positive();
  d.parameter("corner", "Hz", "corner frequency; for \"band\" and \"stop\" the lower one").positive();
  d.parameter("upper", "Hz", "\"band\" and \"stop\": upper corner frequency").optional("0 Hz").not_negative();
  d.parameter("ripple", "", "\"chebyshev\": ripple of the pass band, in dB").optional("1").positive();
  d.parameter("before", "$a", "constant input before the first instant, for the initial states").optional("0");
  d.sampled();
}

Sizes DigitalFilter::sizes(const Shape& shape) {
  Sizes s;
  const auto n = shape.whole_numbers("order");
  const int order = n.empty() ? 0 : n[0];
  if (order < 1 || order > 20) {
    s.error = fmt::format("the order is {}; give a whole number from 1 to 20", order);
    return s;
  }
  const std::string& pass = shape.text("pass");
  const int sections = pass == "band" || pass == "stop" ? order : (order + 1) / 2;
  s.sampled_states = 2 * sections;
  s.constants = 5 * sections;
  return s;
}

std::string DigitalFilter::check(const View<double>& v) {
  const auto w = wanted(v);
  const double half = 0.5 / w.period;
  if (w.corner >= half || (is_band(w.pass) && w.upper >= half))
    return fmt::format(
        "a corner at {:.4g} Hz with a sampling frequency of {:.4g} Hz; give corners below half the sampling "
        "frequency",
        std::max(w.corner, w.upper), 2 * half);
  if (is_band(w.pass) && !(w.upper > w.corner))
    return fmt::format("\"upper\" ({:.4g} Hz) is not above \"corner\" ({:.4g} Hz); give the upper corner of the band",
                       w.upper, w.corner);
  return "";
}

void DigitalFilter::prepare(const View<double>& v) {
  double* c = v.out;
  for (const auto& s : filter_design::design(wanted(v)))
    for (const double number : {s.b0, s.b1, s.b2, s.a1, s.a2}) *c++ = number;
}

void DigitalFilter::initial_states(const View<double>& v) {
  double u = v.parameter(before);
  for (int k = 0; 2 * k < v.n_x; ++k) u = sections::rest(section(v.c, k), u, v.out + 2 * k);
}

Kernel digital_filter_block() { return kernel<DigitalFilter>(); }

}  // namespace hysteron::blocks
