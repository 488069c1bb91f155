#include "engine/compile/enabled.h"

#include <fmt/format.h>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

/// The triggered diagram around it, if any.
const Enabling* trigger_around(const Graph& graph, int enabling) {
  for (int e = enabling; e >= 0; e = graph.enablings[at(e)].outer)
    if (graph.enablings[at(e)].triggered) return &graph.enablings[at(e)];
  return nullptr;
}

void check_block(const Graph& graph, const GraphBlock& b, Problems& problems) {
  const auto refuse = [&](const std::string& why, const std::string& cure) {
    problems.add("cannot_be_switched", b.origin, fmt::format("{} \"{}\" {}", b.kernel->declaration.type, b.path, why),
                 cure);
  };
  const std::string& diagram = graph.enablings[at(b.enabling)].path;
  if (b.sizes.history)
    refuse(
        fmt::format("delays its input, and \"{}\" does not always run: the past of the input is unknown then", diagram),
        "put it outside, before or behind the nested diagram; or take a delay_line, which is sampled");
  if (b.kernel->derivative_wants_rate || b.kernel->guard_wants_rate)
    refuse(fmt::format("is driven by the rate of its input, and \"{}\" does not always run: the way of its input "
                       "meanwhile would be lost",
                       diagram),
           "put it outside, before or behind the nested diagram");
  if (const Enabling* trigger = trigger_around(graph, b.enabling); trigger != nullptr && b.sizes.states > 0)
    refuse(fmt::format("has states that move with the time, and \"{}\" runs at the edges of its trigger only",
                       trigger->path),
           "take a sampled block (discrete_integrator, delay_line ...), or enable the nested diagram instead of "
           "triggering it");
}

}  // namespace

void check_enabled(const Graph& graph) {
  Problems problems;
  for (const auto& enabling : graph.enablings)
    if (const Enabling* trigger = trigger_around(graph, enabling.outer))
      problems.add("cannot_be_switched", graph.blocks[at(enabling.block)].origin,
                   fmt::format("\"{}\" is enabled or triggered by itself inside \"{}\", which is triggered",
                               enabling.path, trigger->path),
                   "take it out of the triggered diagram, or switch its signals there (\"switch\")");
  for (const auto& b : graph.blocks)
    if (b.enabling >= 0) check_block(graph, b, problems);
  problems.throw_if_any();
}

}  // namespace hysteron
