// Decides what the studio asks of verbs that it carries out itself, because their answer is wanted at once and kept
// nowhere, or because they write the user's files. Knows none of them: they are handed in.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/diagram/error.h"
#include "io/data/csv.h"
#include "io/formats/measured_table.h"

namespace hysteron::studio {

/// What a verb found.
struct VerbAnswer {
  std::string json;  ///< what --json prints
  std::string headline;
  std::vector<CsvTable> traces{};  ///< file = name in traces/
};

/// A recording as far as it can be read, and what of it is open.
struct RecordingPreview {
  MeasuredTable raw{};  ///< as the file has it; no columns where it cannot be read at all
  CsvTable table{};     ///< a table of ours; no columns where a question is open
  bool as_it_stands = false;
  std::vector<std::string> assumed{};            ///< to read it and to guess the roles, in words
  std::vector<std::string> inputs{}, outputs{};  ///< columns, as they are guessed or were given
  std::vector<Problem> questions{};              ///< what the file leaves open, or what is wrong with it
};

struct OwnVerbs {
  using Stop = std::function<bool()>;
  /// Carries a command line out, without the program's name. Throws Error; "took_too_long" where `stop` ended it.
  std::function<VerbAnswer(const std::vector<std::string>& words, const Stop& stop)> carry_out{};
  /// How the verb new would read the recording of this command line. Throws nothing but for the command line itself.
  std::function<RecordingPreview(const std::vector<std::string>& words)> preview{};
};

}  // namespace hysteron::studio
