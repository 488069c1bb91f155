// Decides how the table of models that a discovery has fitted is written, for scores that are worked out elsewhere.
// Does not choose what stands in it (discover/selection/kept_table.h).
#pragma once

#include <string>

#include "discover/search/discovery.h"

namespace hysteron {

/// With which its text begins.
inline constexpr char model_table_head[] = "{\n \"models\": [";

/// JSON: "models", each with what it adds and what it leaves of each column of each recording. All in SI.
std::string model_table_text(const Discovery& found);

}  // namespace hysteron
