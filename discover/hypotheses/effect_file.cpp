#include "discover/hypotheses/effect_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "discover/hypotheses/effect_reader.h"
#include "discover/wiring/wiring.h"
#include "engine/diagram/error.h"
#include "engine/program/program.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

/// The effect between an input and an output, as it would stand on a wire in the unit that it states.
ProgramPointer alone(const Effect& effect, Diagram diagram, const Registry& registry) {
  Excitation at;
  at.unit = parse_unit(diagram.inputs.find("in")->unit);
  if (effect.side != Side::none) at.side_unit = parse_unit((diagram.inputs.end() - 1)->second.unit);
  const Node block = effect.laws(at).front().block;
  for (const auto& [name, value] : block.parameters) diagram.parameters[name].value = value;
  auto program = compile(diagram, registry);
  const auto& out = program->signals[static_cast<std::size_t>(program->output_signals.front())].unit;
  if (dimension_factor(out.dimension, at.unit.dimension) == 0)
    fail("wrong_unit", "/outputs/out",
         fmt::format("the effect hands on a signal in {}, what came in was in {}", to_text(out.dimension),
                     to_text(at.unit.dimension)),
         "an effect keeps the unit of its wire; where its numbers have units, state that of the wire: \"inputs\": "
         "{\"in\": {\"unit\": \"V\"}}");
  return program;
}

/// Finds the free numbers in the compiled effect; what the engine says of it is told with the lines of the file.
void find_in_program(const Effect& effect, EffectContent& content, const Registry& registry) {
  try {
    const ProgramPointer program = alone(effect, *content.diagram, registry);
    for (auto& f : content.free) {
      f.program_path = f.path;
      if (program->find_parameter(f.path) == nullptr) f.program_path = element(f.path, 0);
      if (program->find_parameter(f.program_path) == nullptr)
        fail("unknown_parameter", "/effect/free/" + f.path, fmt::format("no block reads \"{}\"", f.path),
             fmt::format("write \"${}\" where a block needs it, or leave it out", f.path));
    }
  } catch (Error& e) {
    locate_problems(e, content.file);
    throw Error(e.fault, e.problems);
  }
}

}  // namespace

Effect read_effect(const std::string& file, const Registry& registry, const std::vector<std::string>& allowed) {
  auto diagram = std::make_shared<const Diagram>(read_diagram(file, allowed));
  EffectAsWritten written = read_effect_member(file, diagram);
  Effect e = std::move(written.effect);
  e.way = Way::insert;
  e.block_type = "diagram";
  e.file = file;
  const auto content = std::make_shared<EffectContent>(std::move(written.content));
  e.laws = [content](const Excitation& at) { return std::vector<Law>{law_of(*content, at)}; };
  e.unseen = [content](const Excitation& at) { return why_unseen(*content, at); };
  if (!content->says.empty())
    e.summary = [content](const Law& law, const std::vector<double>& values, const Excitation& at) {
      return summary_of(*content, law, values, at);
    };
  find_in_program(e, *content, registry);
  const Wiring w(*diagram, registry);
  bool linear = e.side == Side::none;
  for (const auto& [name, node] : diagram->blocks) {
    e.is_memory = e.is_memory || w.has_memory(name);
    linear = linear && w.is_linear(name);
  }
  if (linear) e.commutes = Commutes::linear;
  return e;
}

Effects with_own_effects(const Effects& library, const std::vector<std::string>& files, const Registry& registry,
                         const std::vector<std::string>& allowed) {
  namespace fs = std::filesystem;
  std::vector<std::string> all;
  for (const auto& given : files) {
    std::error_code code;
    if (!fs::is_directory(given, code)) {
      all.push_back(given);
      continue;
    }
    std::vector<std::string> inside;
    for (const auto& entry : fs::directory_iterator(given, code))
      if (entry.path().extension() == ".json") inside.push_back(entry.path().string());
    if (inside.empty())
      fail("no_file", given, "the folder holds no effect file", "name a folder with *.json, or one file");
    std::sort(inside.begin(), inside.end());
    all.insert(all.end(), inside.begin(), inside.end());
  }
  std::vector<Effect> list = library.list();
  for (const auto& file : all) {
    Effect e = read_effect(file, registry, allowed);
    for (const auto& other : list)
      if (other.id == e.id)
        fail("effect_twice", file,
             fmt::format("there is an effect \"{}\" already{}", e.id, other.file.empty() ? "" : ", in " + other.file),
             "give it another id");
    list.push_back(std::move(e));
  }
  Effects effects(std::move(list));
  for (const auto& e : effects.list())
    for (const auto& l : e.look_alikes)
      if (!e.file.empty() && effects.find(l.effect) == nullptr)
        fail("unknown_effect", e.file,
             fmt::format("\"{}\" names the look-alike \"{}\", and there is no such effect", e.id, l.effect),
             did_you_mean(l.effect, effects.ids()));
  return effects;
}

}  // namespace hysteron
