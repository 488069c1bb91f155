#include "engine/compile/loop_wishes.h"

#include <fmt/format.h>

#include "engine/program/names.h"

namespace hysteron {

std::vector<int> LoopWishes::guessed_signals() const {
  std::vector<int> signals;
  for (const auto& [signal, value] : guesses) signals.push_back(signal);
  return signals;
}

LoopWishes loop_wishes(const SimulateSettings& settings, const Program& program) {
  LoopWishes wishes;
  Problems problems;
  if (settings.loops && *settings.loops != "solve" && *settings.loops != "error")
    problems.add("bad_value", "/simulate/loops", fmt::format("loops cannot be \"{}\"", *settings.loops),
                 did_you_mean(*settings.loops, {"solve", "error"}));
  wishes.forbidden = settings.loops && *settings.loops == "error";
  for (const auto& [path, number] : settings.guess) {
    const std::string place = place_of_guess(path);
    const int signal = find_named_signal(program, path);
    if (signal < 0) {
      problems.add("unknown_signal", place, fmt::format("there is no signal \"{}\"", path),
                   did_you_mean(path, signal_names(program)));
      continue;
    }
    const Dimension& dimension = program.signals[static_cast<std::size_t>(signal)].dimension;
    const Unit unit = number.unit ? parse_unit(*number.unit, place) : Unit{};
    if (number.value != 0 && dimension_factor(unit.dimension, dimension) == 0)
      problems.add(
          "wrong_unit", place,
          fmt::format("{} {} is no value of \"{}\", which is in {}", number.value, unit.text, path, to_text(dimension)),
          "write the unit of the signal behind the number");
    wishes.guesses.emplace_back(signal, number.unit ? unit.to_si(number.value) : number.value);
  }
  problems.throw_if_any();
  return wishes;
}

std::string place_of_guess(const std::string& signal) {
  std::string place = "/simulate/guess/";
  for (const char c : signal) place += c == '/' ? "~1" : std::string(1, c);
  return place;
}

}  // namespace hysteron
