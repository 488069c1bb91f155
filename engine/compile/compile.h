// Decides how a checked graph becomes a program. Internal to compile(), which program.h declares.
#pragma once

#include "engine/compile/graph.h"

namespace hysteron {

/// The stages behind build_graph: from units to a program that can start.
ProgramPointer compile_graph(Graph graph, const Diagram& diagram);

}  // namespace hysteron
