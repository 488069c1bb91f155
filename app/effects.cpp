// The verb effects: the physical effects that hysteron knows, from their own declarations.
// Does not look at data.
#include <fmt/format.h>

#include "app/load.h"
#include "app/terminal.h"
#include "app/verb.h"
#include "discover/effect.h"

namespace hysteron {
namespace {

constexpr char help[] =
    "Answers: which effects can be named as missing, what is their law, which data show them, what looks alike.\n\n"
    "Examples:\n"
    "  hysteron effects           all of them\n"
    "  hysteron effects creep     one in full\n"
    "  hysteron effects --effects own/              with those of your own: a file each, or a folder\n\n"
    "Prints to the terminal, writes no files.\n"
    "Exit codes: 0 done, 2 there is no such effect.";

void print_all(const Effects& effects) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& effect : effects.list())
    rows.push_back({effect.id, fmt::format("{}", fmt::join(effect.places, ", ")), effect.title});
  fmt::print("{}", table_text({"effect", "enters at", "what it is"}, rows));
  fmt::print("\n\"hysteron effects ID\" shows one in full, \"hysteron add ID DIAGRAM.json\" puts it into a diagram.\n");
}

void print_part(const std::string& title, const std::string& text) {
  if (!text.empty()) fmt::print("\n{}\n{}", title, wrapped(text, 2));
}

std::string way_text(const Effect& effect) {
  const std::string places =
      effect.places.empty() ? "" : fmt::format(" Kinds of place: {}.", fmt::join(effect.places, ", "));
  if (!effect.file.empty()) return fmt::format("The diagram {} is put on a wire.{}", effect.file, places);
  if (effect.way == Way::insert)
    return fmt::format("A block of type {} is put on a wire.{}", effect.block_type, places);
  if (effect.way == Way::vary)
    return fmt::format("A block of the diagram gets the parameter \"{}\".{}", effect.parameter, places);
  return fmt::format("A value of the recording: {}.{}", effect.parameter, places);
}

void print_one(const Effect& effect) {
  fmt::print("{}", wrapped(fmt::format("{}: {}", effect.id, effect.title)));
  print_part("cause", effect.cause);
  print_part("law", effect.equation);
  print_part("how it enters", way_text(effect));
  if (!effect.parameters.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& p : effect.parameters)
      rows.push_back(
          {p.name, p.unit.empty() ? "1" : p.unit, p.range.empty() ? p.meaning : p.meaning + "; usual: " + p.range});
    fmt::print("\nparameters\n{}", table_text({}, rows));
  }
  print_part("what it leaves in the residual", effect.residual);
  print_part("data that show it", effect.needs);
  if (!effect.look_alikes.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& other : effect.look_alikes) rows.push_back({other.effect, other.experiment, other.deciding});
    fmt::print("\ntaken for it easily\n{}", table_text({"effect", "experiment", "what decides"}, rows));
  }
  print_part("source", effect.source);
}

int effects(const Arguments& arguments) {
  const Effects library = load_effects(arguments);
  if (!arguments.has("effect"))
    print_all(library);
  else
    print_one(library.get(arguments.text("effect")));
  return exit_code::done;
}

}  // namespace

Verb effects_verb() {
  return {"effects",
          "which effects can be missing, and how they are told apart",
          help,
          {{"effect", "ID", "the effect to show in full", false, false}, options::effects(), options::allow()},
          effects};
}

}  // namespace hysteron
