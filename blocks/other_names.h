// Decides what a user is told who writes the name that a block has elsewhere: which type it is here, or how it is
// composed. Does not decide what is told of any other unknown name (engine/diagram/error.h: did_you_mean).
#pragma once

#include <string>
#include <vector>

namespace hysteron {

/// As it would be without "_", "-", blanks and capitals: "Dead Zone" and "dead_zone" are "deadzone".
std::string plain_name(const std::string& type);

/// What to write instead of a type that is known from elsewhere ("dead_zone", "Dead Zone"); "" if nobody knows it.
std::string instead_of_other_name(const std::string& type);

/// The words that it knows, without "_", "-" and blanks.
std::vector<std::string> other_names();

}  // namespace hysteron
