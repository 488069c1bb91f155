// Decides how a free text names the units of the elements of a vector: one for all, or one each. Does not know units:
// the engine does.
#pragma once

#include <string>
#include <vector>

#include "engine/block/kernel.h"

namespace hysteron::blocks {

/// "V" for all elements, or "V, A, N" one each.
std::vector<std::string> units_of_elements(const std::string& text, int elements);

/// "" or what is wrong with these units.
std::string wrong_units(const std::vector<std::string>& units, int elements, const char* parameter);

/// Scale and offset to SI of every element, from the text parameter that names its unit. Returns what follows.
double* note_scales(const View<double>& v, int text_parameter, int elements, double* out);

}  // namespace hysteron::blocks
