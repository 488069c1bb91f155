// The effect quantization: the reading knows only multiples of a step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {

Effect quantization() {
  Effect e;
  e.id = e.family = "quantization";
  e.title = "Quantization";
  e.cause = "The converter of the sensor has so many bits, its display so many digits.";
  e.equation = "y = zero + step*round((u - zero)/step)";
  e.source = "Widrow, Kollar, Quantization Noise (2008), chapter 1";
  e.residual = "Within half a step, white for busy signals; a saw tooth where the signal is slow.";
  e.needs = "Noise before the converter of less than half a step; else the rounding is part of the noise.";
  e.way = Way::insert;
  e.block_type = "rounding";
  e.places = {"measured"};
  e.parameters = {
      {"step", "unit of the output", "read off the levels of the column", "range/2^bits: 0.1 nm for 20 bit on 100 um"}};
  e.look_alikes = {{"backlash", "triangle", "rounding has no memory: both ways it steps at the same levels"},
                   {"friction", "triangle", "a stick is not always at the same levels"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("levels every {}", size_text(values[0], at.unit));
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "levels of the column";
    law.block.type = "rounding";
    const double levels = at.resolution > 0 ? std::max(at.range() / at.resolution, 1.0) : 1000;
    LawParameter step;
    step.path = "step";
    step.start = at.resolution > 0 ? at.resolution : at.range() / levels;
    // The column says it: what is left to find is less than half a step at the end of the range.
    step.lower = step.start * (1 - 0.25 / levels);
    step.upper = step.start * (1 + 0.25 / levels);
    step.read_off_column = true;
    give(law.block, "step", with_unit(step.start, at.unit));
    // Zero of a converter in volts is a level; that of a thermometer in degC is none in K, nor is that of a counter
    // with an offset.
    constexpr double on_a_level = 0.02;  // of a step: levels are counted from zero by a step that is known so well
    const double steps = at.resolution > 0 ? at.level / at.resolution : 0;
    if (std::abs(steps - std::round(steps)) > on_a_level) give(law.block, "zero", value_in_unit(at.level, at.unit));
    law.free = {step};
    return std::vector<Law>{law};
  };
  e.unsure = [](const Excitation& at) -> std::string {
    if (!at.from_data || at.resolution >= 2 * at.roughness) return "";
    return fmt::format("its resolution is {:.2g} times the noise; detectable from 2 times",
                       at.resolution / at.roughness);
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    if (at.resolution <= 0) return "the values of the column are no multiples of one step";
    // What is finer than a simulation is not predicted: the digits of a text file.
    if (at.resolution < 1e-5 * at.range())
      return fmt::format("the steps of the column are {:.1g} of its range: digits of the file",
                         at.resolution / at.range());
    return "";
  };
  return e;
}

}  // namespace hysteron::effects
