// Decides in which order values, rates and derivatives are computed. Internal to compile().
#pragma once

#include "engine/compile/graph.h"
#include "engine/compile/loop_wishes.h"

namespace hysteron {

/// Smoothness, needed rates, loops, steps.
void order_steps(const Graph& graph, const LoopWishes& wishes, Program& program);

}  // namespace hysteron
