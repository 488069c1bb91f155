// Decides how a verb, and the program, look as pages of man(1). Does not know what the verbs say (verb.h).
#pragma once

#include <string>

#include "app/cli/verb.h"

namespace hysteron {

/// "hysteron-compare.1" as a text for man: synopsis, description, options, examples, exit codes; UTF-8.
std::string manual_page(const Verb& verb);

/// "hysteron.1": what the program is for, its verbs, what all of them take.
std::string manual_page_of_program();

}  // namespace hysteron
