// Decides which columns of a recording drive and which were measured: as the user says, else by their names, else by
// what they measure. What that leaves open is asked. Does not decide what a starter looks like (starter.h).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/data/csv.h"

namespace hysteron {

/// Columns by name; empty lists = guess from names and units.
struct StarterRoles {
  std::string time{};
  std::vector<std::string> inputs{}, outputs{};
  std::map<std::string, std::string> called{};  ///< name in the diagram by column, where the user gives one

  /// Takes "Force" or "u=Force" from the command line. Throws Error "bad_name".
  void add(std::vector<std::string>& list, const std::string& option, const std::string& written,
           const CsvTable& table);
  /// The name of a column in the diagram.
  std::string name_of(const std::string& column) const;
};

/// A column's name as a diagram may write it: [a-z][a-z0-9_]*.
std::string diagram_name(const std::string& column);

/// Which columns are time, inputs and outputs. Throws Error "unclear_columns" where nothing tells, "missing_column".
StarterRoles guess_roles(const CsvTable& table, StarterRoles given, std::vector<std::string>& assumed);

}  // namespace hysteron
