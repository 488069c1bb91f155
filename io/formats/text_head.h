// Decides what stands above a table of numbers: names, units, labels, and the settings of the instrument that say how
// far apart its samples are.
#pragma once

#include <string>
#include <vector>

#include "io/formats/heading.h"
#include "io/formats/measured_table.h"
#include "io/formats/text_layout.h"

namespace hysteron {

struct TextHead {
  std::vector<Heading> headings;     ///< one per column of the table, the skipped ones not counted
  std::optional<SampleClock> clock;  ///< where the settings say it
  std::vector<std::string> assumed;
};

/// `names`: headings that the user gives instead. Throws Error "no_header" where nothing names the columns.
TextHead head_of(const std::string& file, const std::vector<std::string_view>& lines, const TextLayout& layout,
                 const std::vector<std::string>& names);

}  // namespace hysteron
