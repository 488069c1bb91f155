// Decides what a starter diagram and data set look like for the columns of recordings, and says what it assumed.
// Does not read or write files.
#pragma once

#include <string>
#include <vector>

#include "app/verbs/column_roles.h"
#include "engine/diagram/diagram.h"
#include "io/data/csv.h"

namespace hysteron {

/// A recording and the name under which its file will lie beside the data set.
struct StarterRecording {
  const CsvTable* table = nullptr;
  std::string file;
};
using StarterRecordings = std::vector<StarterRecording>;

struct Starter {
  Diagram diagram;                   ///< gain and offset per output, from a straight line through the rows
  std::string dataset_text;          ///< dataset.json
  std::vector<std::string> assumed;  ///< everything that was guessed, for the user
};

/// The starter for recordings with the same columns, their roles guessed in the first one.
Starter make_starter(const StarterRecordings& recordings, const StarterRoles& given);

}  // namespace hysteron
