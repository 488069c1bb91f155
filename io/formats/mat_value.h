// Decides what a variable of MATLAB is, whichever kind of file it comes from, and which of them make a recording.
// Does not read files. Internal to io.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/formats/measured_table.h"

namespace hysteron {

struct MatValue {
  enum class Kind { other, numbers, text, structure, object };
  struct Field {
    std::string name;
    std::vector<MatValue> of_element;  ///< one for each element of an array of structures
  };

  Kind kind = Kind::other;
  std::vector<std::size_t> sizes{};  ///< of numbers: rows, columns ...
  std::vector<double> values{};      ///< column after column
  std::string text{};
  std::vector<Field> fields{};
  std::size_t elements = 0;  ///< of a structure
};

using MatVariables = std::vector<std::pair<std::string, MatValue>>;

inline constexpr int deepest_of_mat = 8;                   // structures within structures
inline constexpr std::size_t most_elements_of_mat = 1000;  // of an array of structures

/// Vectors and matrices by their names; structures of Simulink (time, signals), of dSPACE (X, Y) and of one's own by
/// their fields. Throws Error "unknown_file_type" where there are objects of MATLAB alone, "damaged_file" where there
/// is nothing, and what table_of_vectors() throws.
MeasuredTable recording_of_mat(const std::string& file, const MatVariables& variables, const ReadingChoices& choices);

/// The variables of a file of level 7.3, which is HDF5 (mat73.cpp). Throws Error "damaged_file".
MatVariables variables_of_mat73(const std::string& file);

}  // namespace hysteron
