#include "blocks/continuous/input_shaper.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void InputShaper::describe(Declaration& d) {
  d.name("input_shaper", "zero-vibration (ZV) input shaper for one mode").in_group("continuous").elementwise();
  d.law(
       "y(t) = (u(t) + K u(t - delay))/(1 + K), K = exp(-pi damping/sqrt(1 - damping^2)), delay = 1/(2 "
       "frequency sqrt(1 - damping^2)); before the start the input is taken as constant")
      .from("Singer, Seering, J. Dyn. Syst. Meas. Control 112 (1990) 76-82 (ZV)");
  d.remark(
      "A mode of this frequency and damping is at rest half a damped period after the end of any command. "
      "Two equal shapers in series are a ZVD shaper, which tolerates a larger frequency error. For several "
      "modes connect one shaper per mode in series.");
  d.input("u", "$a", "the command");
  d.output("y", "$a", "the shaped command, which excites no residual vibration of the mode");
  d.parameter("frequency", "Hz", "undamped natural frequency of the mode").positive();
  d.parameter("damping", "", "damping ratio of the mode, below 1").optional("0").not_negative();
}

Sizes InputShaper::sizes(const Shape&) {
  Sizes s;
  s.history = true;
  return s;
}

std::string InputShaper::check(const View<double>& v) {
  if (v.parameter(damping) < 1) return "";
  return fmt::format("a mode of damping {:.4g} does not oscillate; give its damping below 1, or leave the shaper out",
                     v.parameter(damping));
}

Kernel input_shaper_block() { return kernel<InputShaper>(); }

}  // namespace hysteron::blocks
