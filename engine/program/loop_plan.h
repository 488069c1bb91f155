// Decides what one loop of a program consists of: its tears, its steps in order, what it reads from outside.
// Does not solve it: loops.h.
#pragma once

#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// `members`: the nodes of one strongly connected component, in any order; `needs[i]`: which of them member i needs.
/// The result does not depend on their order. Signals in `wanted_tears` are torn if they stand in the loop.
Loop plan_loop(const Program& program, const std::vector<Step>& members, const std::vector<std::vector<int>>& needs,
               const std::vector<int>& wanted_tears);

/// Nodes that need each other, once around in the direction of the signals, beginning at `first`: "a -> b -> a", with
/// "(rate)" and "(derivative)" where it is not the value.
std::vector<Step> path_around(const std::vector<Step>& members, const std::vector<std::vector<int>>& needs, int first);
std::string to_text(const Program& program, const std::vector<Step>& path);

}  // namespace hysteron
