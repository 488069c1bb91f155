// Decides the JSON Schemas of data sets and of result.json. Those of diagrams and effects: io/diagram/diagram_file.h.
#pragma once

#include <string>

namespace hysteron {

std::string dataset_schema();
std::string result_schema();

}  // namespace hysteron
