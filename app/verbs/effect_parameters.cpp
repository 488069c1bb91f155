// Decides which numbers a fit may change where a diagram has effects in it: those that the effect's law leaves free.
#include "app/verbs/effect_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "discover/placement/add.h"
#include "engine/diagram/number_text.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// The effect's laws on a wire and, where a block may be replaced instead, those of its richer type.
std::vector<Law> every_law(const Effect& effect, Excitation at) {
  auto laws = effect.laws(at);
  if (effect.way != Way::insert || effect.variation.empty()) return laws;
  at.by = effect.variation;
  for (auto& law : effect.laws(at)) laws.push_back(std::move(law));
  return laws;
}

/// Parameters that some law of the effect frees, each with its first free element ("weights" from 1 where the first
/// weight is the wire's own gain).
std::map<std::string, int> freed_by(const Effect& effect, const Excitation& at) {
  std::map<std::string, int> first;
  for (const auto& law : every_law(effect, at))
    for (const auto& parameter : law.free) {
      const auto bracket = parameter.path.find('[');
      const std::string name = parameter.path.substr(0, bracket);
      const int index = bracket == std::string::npos ? 0 : leading_whole_number(parameter.path.substr(bracket + 1), 0);
      const auto [known, is_new] = first.emplace(name, index);
      if (!is_new) known->second = std::min(known->second, index);
    }
  return first;
}

}  // namespace

std::vector<std::string> effect_parameters(const Diagram& diagram, const Program& program, const Effects& effects) {
  Excitation at;
  // Beside a free gain of the user's own, a gain of the effect would not be determined.
  at.gain_is_free =
      std::any_of(program.parameters.begin(), program.parameters.end(), [](const auto& p) { return p.free; });
  std::vector<std::string> paths;
  for (const auto& [block, id] : effects_in(diagram)) {
    const Effect* effect = effects.find(id);
    if (effect == nullptr) continue;  // put there by a newer hysteron, or by hand
    for (const auto& [name, first] : freed_by(*effect, at)) {
      for (const char* joint : {".", "/"}) {  // of a user's own effect they are parameters of its diagram
        const std::string path = block + joint + name;
        if (program.find_parameter(path) != nullptr) paths.push_back(path);
        for (int k = first; program.find_parameter(element(path, k)) != nullptr; ++k) paths.push_back(element(path, k));
      }
    }
  }
  return paths;
}

std::vector<std::string> unusual_values(const Diagram& diagram, const FitResult& result, const Effects& effects) {
  std::vector<std::string> sentences;
  for (const auto& [block, id] : effects_in(diagram)) {
    const Effect* effect = effects.find(id);
    if (effect == nullptr) continue;
    for (const auto& e : result.estimates)
      for (const auto& law : every_law(*effect, {})) {
        const auto p = std::find_if(law.free.begin(), law.free.end(), [&, name = block](const auto& l) {
          return e.path == parameter_path(name, law, l);
        });
        if (p == law.free.end() || !e.value) continue;
        const bool high = *e.value > p->plausible_upper, low = *e.value < p->plausible_lower;
        if (high || low)
          sentences.push_back(fmt::format("{} = {} is {} than {}, the usual limit of {}.", e.path,
                                          difference_text(*e.value, e.unit), high ? "more" : "less",
                                          difference_text(high ? p->plausible_upper : p->plausible_lower, e.unit),
                                          effect->title));
        break;
      }
  }
  return sentences;
}

}  // namespace hysteron
