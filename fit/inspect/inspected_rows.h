// Decides what rows of a data set an inspection looks at: those of each recording that is fitted or judged, in one
// piece where a single recording was cut in two.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fit/model/model.h"

namespace hysteron {

/// Rows [first, last) of a recording of the data set. A single recording that was cut in two is one again here.
struct InspectedPart {
  int recording = 0;
  std::size_t first = 0, last = 0;
  std::string name;
};

std::vector<InspectedPart> parts_of(const DataSet& data);

/// [SI] Empty where the recording has no such column.
std::span<const double> rows_of(const DataSet& data, const InspectedPart& part, const std::string& column);
inline std::span<const double> rows_of(const DataModel& model, const InspectedPart& part, const std::string& column) {
  return rows_of(model.data(), part, column);
}
/// The data set leaves this row of the part out ("exclude", "limits"): it is simulated, and nothing is judged by it.
bool is_left_out(const DataSet& data, const InspectedPart& part, std::size_t row);
/// What stands in the rows that are judged.
std::vector<double> judged_of(const DataSet& data, const InspectedPart& part, const std::string& column);
/// [s]
std::span<const double> times_of(const DataModel& model, const InspectedPart& part);

/// Largest less smallest; 0 of no rows.
double range_of(std::span<const double> v);

/// Inputs of the diagram that move in this part, with their rows.
std::vector<std::pair<std::string, std::span<const double>>> drives_of(const DataModel& model,
                                                                       const InspectedPart& part);

}  // namespace hysteron
