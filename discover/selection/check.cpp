// Decides whether a model still explains a recording. See check.h.
#include "discover/selection/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "discover/selection/discover.h"
#include "fit/model/free_parameter.h"

namespace hysteron {
namespace {

/// The model with all its parameters held, those of diagrams inside it too.
Diagram held(Diagram diagram) {
  for (auto& [name, parameter] : diagram.parameters)
    if (parameter.free.value_or(false)) parameter.free = false;
  const auto hold = [](auto&& self, Node& node) -> void {
    if (node.nested) node.nested = std::make_shared<const Diagram>(held(*node.nested));
    for (auto& [name, candidate] : node.from) self(self, candidate);
  };
  for (auto& [name, node] : diagram.blocks) hold(hold, node);
  return diagram;
}

std::vector<std::string> names_of(const Discovery& d) {
  std::vector<std::string> names;
  for (const auto& step : d.steps) {
    names.push_back(step.winner.effect);
    for (const auto& tie : step.ties) names.push_back(tie.effect);
  }
  return names;
}

/// "gain 1.05 um/V (was 1 um/V)", of the free parameters.
std::string moved_values(const Discovery& now) {
  std::vector<std::string> parts;
  for (const auto& p : now.base_parameters) {
    const auto& e = p.estimate;
    const auto shown = [&](double si) { return e.difference ? e.unit.difference_from_si(si) : e.unit.from_si(si); };
    parts.push_back(fmt::format("{} {:.4g} (was {:.4g}) {}", e.path, shown(e.used), shown(e.start), e.unit.text));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

DataSet with_both_roles(DataSet data) {
  const auto any = [&](Role role) {
    return std::any_of(data.recordings.begin(), data.recordings.end(),
                       [&](const Recording& r) { return r.role == role; });
  };
  if (any(Role::train) == any(Role::validate)) return data;  // both, or none: that is told by the discovery
  const std::size_t n = data.recordings.size();
  for (std::size_t r = 0; r < n; ++r)
    if (data.recordings[r].role != Role::test) cut_in_time(data, r);
  return data;
}

Check check(const Diagram& diagram, const DataSet& given, const Registry& registry, const Effects& effects,
            const DiscoverOptions& options) {
  const DataSet data = with_both_roles(given);
  DiscoverOptions nothing_free = options;
  nothing_free.free_paths.clear();
  nothing_free.numbers_are_exact = true;
  Check c;
  c.discovery = discover(held(diagram), data, registry, effects, nothing_free);
  c.explained = c.discovery.verdict == Verdict::adequate;
  if (c.explained) {
    c.discovery.base_diagram = c.discovery.final_diagram = diagram;  // as it was given: nothing was found
    c.sentence = "Explained. " + c.discovery.headline;
    return c;
  }
  if (!free_parameters(*compile(diagram, registry), options.free_paths).empty()) {
    DiscoverOptions free = options;
    free.numbers_are_exact = true;  // what is not free has not moved, or is told as what it looks like
    c.discovery = discover(diagram, data, registry, effects, free);
    c.moved = c.discovery.verdict == Verdict::adequate;
  }
  c.named = c.moved ? std::vector<std::string>{"parameters"} : names_of(c.discovery);
  c.sentence = c.moved ? "No longer explained: parameters. With other values it is: " + moved_values(c.discovery)
                       : "No longer explained. " + c.discovery.headline;
  return c;
}

}  // namespace hysteron
