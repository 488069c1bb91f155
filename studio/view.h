// Decides what the page is told of a diagram: what is drawn where, what is wrong, and where in the file that stands.
// Does not decide where anything is drawn (draw/) nor what is wrong (engine/compile/draft.h).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/block/kernel.h"

namespace hysteron::studio {

struct ViewOptions {
  std::vector<std::string> allowed{};  ///< folders of which nested diagrams and recordings may come besides
  int depth = 0;                       ///< levels of nested diagrams that are opened
};

/// {"lines", "hash", "problems", "warnings", "sheet", "places"} of a diagram file; "lines": its text, which "\n" joins
/// again; "sheet" is null where the file cannot be read as a diagram, which "problems" tells; "places": where blocks
/// were moved to by hand (layout_file.h). Throws Error where there is no such file.
nlohmann::ordered_json view_of(const std::string& file, const Registry& registry, const ViewOptions& options);

/// For each input port of the diagram whether a wire from `signal` may end there: [{"item", "in", "why"}], "why" empty
/// where it may, else what check says of it.
nlohmann::ordered_json fits_of(const std::string& file, const std::string& signal, const Registry& registry,
                               const ViewOptions& options);

/// The pictograms by their names: {"axes", "time", "curves", "arrows"}.
nlohmann::ordered_json pictograms();

}  // namespace hysteron::studio
