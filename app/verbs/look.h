// Decides what discover and diagnose share: reading, searching with progress and Ctrl-C, and the folder of results.
// Does not decide what is claimed (discover/) nor how it is told (discover_page.h).
#pragma once

#include <string>
#include <vector>

#include "app/cli/answer.h"
#include "app/cli/shape.h"
#include "app/cli/watch.h"

namespace hysteron {

/// Runs the verb "discover" or "diagnose".
Answer look(const std::string& verb, const Arguments& arguments, const Watch& watch);

/// What both say with --json.
std::vector<shape::Member> look_shape();

/// The options that both take.
std::vector<OptionSpec> look_options();

}  // namespace hysteron
