#include "blocks/continuous/logarithmic_creep.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void LogarithmicCreep::describe(Declaration& d) {
  d.name("logarithmic_creep", "creep that grows with the logarithm of time")
      .in_group("continuous")
      .elementwise()
      .linear()
      .at("core");
  d.law(
       "after a step of 1: y = 1 + per_decade*log10(1 + t/first_time); y = u + sum c_k x_k, times[k] dx_k/dt = u - "
       "x_k, c_k = per_decade*d_k*exp(-first_time/times[k]), d_k: the decades for which times[k] stands")
      .from(
          "Jung, Gweon, Rev. Sci. Instrum. 71 (2000) 1896 (logarithm); Croft, Shed, Devasia, J. Dyn. Sys. Meas. "
          "Control 123 (2001) 35-43 (chain)");
  d.remark("Typical for piezoceramics: per_decade 0.01 to 0.02.");
  d.remark(
      "With two time constants per decade, the first at first_time/3, the error is 0.1 % of per_decade up "
      "to 1/100 of the largest time constant, and 2.5 % up to 1/10 of it.");
  d.input("u", "$a", "the signal without creep");
  d.output("y", "$a", "the signal with creep");
  d.state("x", "$a", "relaxed signal of each element");
  d.parameter("per_decade", "", "creep per decade of time, relative to the step").linear().not_negative();
  d.parameter("first_time", "s", "time after a step at which creep begins").positive();
  d.list("times", "s",
         "time constants of the elements, increasing: two per decade, from below first_time to ten times the "
         "longest run time")
      .positive();
}

Sizes LogarithmicCreep::sizes(const Shape& shape) {
  Sizes s;
  s.states = shape.length("times");
  if (s.states < 2) s.error = "\"times\" needs two time constants or more; take two per decade";
  return s;
}

std::string LogarithmicCreep::check(const View<double>& v) {
  const auto tau = v.list(times);
  for (std::size_t k = 1; k < tau.size(); ++k)
    if (!(tau[k] > tau[k - 1]))
      return fmt::format("\"times\" must increase, but {:.6g} s follows {:.6g} s; sort them", tau[k], tau[k - 1]);
  return "";
}

Kernel logarithmic_creep_block() { return kernel<LogarithmicCreep>(); }

}  // namespace hysteron::blocks
