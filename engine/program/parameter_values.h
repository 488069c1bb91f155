// Decides what becomes of parameter values that nobody has written down: drawn ones. Does not draw them.
#pragma once

#include <span>

#include "engine/program/program.h"

namespace hysteron {

/// Inside the declared range [SI]; not a number never is.
bool lies_in_range(const ParameterDeclaration& parameter, double si);
/// The first place from 1 on whose number is not above the one before; 0 if the list increases.
std::size_t first_that_does_not_increase(std::span<const double> list);

/// Has it one of these parameters (places in program.parameters)?
bool block_varies(const Program& program, const BlockInstance& block, std::span<const int> parameters);

/// What becomes of values that a block's own check refuses (Kernel::check): its law has no meaning there, or has been
/// given up. What lies outside the declared range, or outside the diagram's bounds, is refused in any case.
enum class RefusedValues { end_the_run, are_simulated };

/// Sets many parameters [SI] (places in program.parameters) and what depends on them, each block once. Throws Error
/// "bad_value" where a value is refused: outside its range or bounds, a list that does not increase, a block's check.
void set_parameters(const Program& program, Run& run, std::span<const int> parameters, std::span<const double> values,
                    RefusedValues refused);

}  // namespace hysteron
