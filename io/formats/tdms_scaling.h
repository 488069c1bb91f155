// Decides how the counts of a TDMS channel become values: by the chain of scales that its properties describe.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hysteron {

using TdmsProperties = std::map<std::string, std::variant<std::string, double>>;

std::string text_property(const TdmsProperties& properties, const std::string& name);
std::optional<double> number_property(const TdmsProperties& properties, const std::string& name);

/// Linear scales, polynomials, sums and differences, each of the counts or of another scale. Values that were scaled
/// before they were written stay as they are. Throws Error "unknown_scaling" for any other kind, by its name, and
/// "damaged_file" for a scale that rests on itself.
std::vector<double> scaled(std::vector<double> counts, const TdmsProperties& properties, const std::string& channel,
                           const std::string& file);

}  // namespace hysteron
