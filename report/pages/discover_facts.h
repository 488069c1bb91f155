// Decides how a discovery stands in result.json: every decision with its numbers, for programs.
// Does not decide how people see it (discover_page.h).
#pragma once

#include <string>

#include "discover/selection/check.h"
#include "report/pages/facts.h"

namespace hysteron {

/// Every error in the unit of its output.
Facts discovery_facts(const Discovery& found, const std::string& diagram_file, const std::string& data_file);
/// The answer to --check.
Facts check_facts(const Check& answer);

}  // namespace hysteron
