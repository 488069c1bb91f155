// Decides what a starter diagram and data set look like for the columns of one recording, and says what it assumed.
// Does not read or write files.
#pragma once

#include <string>
#include <vector>

#include "engine/diagram/diagram.h"
#include "io/data/csv.h"

namespace hysteron {

/// Columns by name; empty lists = guess from names and units.
struct StarterRoles {
  std::string time;
  std::vector<std::string> inputs, outputs;
};

struct Starter {
  Diagram diagram;                   ///< gain and offset per output, from a straight line through the rows
  std::string dataset_text;          ///< dataset.json
  std::vector<std::string> assumed;  ///< everything that was guessed, for the user
};

/// A column's name as a diagram may write it: [a-z][a-z0-9_]*.
std::string diagram_name(const std::string& column);

/// Which columns are time, inputs and outputs. Throws Error "unclear_columns" where nothing tells, "missing_column".
StarterRoles guess_roles(const CsvTable& table, StarterRoles given, std::vector<std::string>& assumed);

/// The starter for `table`, whose file will lie beside the data set under `csv_name`.
Starter make_starter(const CsvTable& table, const StarterRoles& given, const std::string& csv_name);

}  // namespace hysteron
