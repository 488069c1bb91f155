// Decides what a user is told who names a block type that is not there. Does not know the words (blocks/other_names.h).
#pragma once

#include <string>

namespace hysteron {

/// The cure: what has this name elsewhere, else the nearest types.
std::string instead_of_type(const std::string& type);

}  // namespace hysteron
