// Decides what discover and diagnose share: reading, searching with progress and Ctrl-C, and the folder of results.
// Does not decide what is claimed (discover/) nor how it is told (discover_page.h).
#pragma once

#include <string>
#include <vector>

#include "app/cli/verb.h"

namespace hysteron {

/// Runs the verb "discover" or "diagnose" and returns the exit code.
int look(const std::string& verb, const Arguments& arguments);

/// The options that both take.
std::vector<OptionSpec> look_options();

}  // namespace hysteron
