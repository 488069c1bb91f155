// Decides what a verb of the command line is: its name, what its help teaches, its options, what it does and what its
// answer holds for programs. Does not parse (command_line.cpp) and does not compute (the rooms below).
#pragma once

#include <string>
#include <vector>

#include "app/cli/arguments.h"
#include "app/cli/options.h"

namespace hysteron {

struct Answer;  // answer.h
struct Watch;   // watch.h
namespace shape {
struct Member;  // shape.h
}

/// Exit codes of the program (docs/programs.md).
namespace exit_code {
inline constexpr int done = 0;       ///< whatever was found
inline constexpr int no = 1;         ///< a yes-or-no question was asked, and the answer is no
inline constexpr int bad_input = 2;  ///< the input is wrong
inline constexpr int numerics = 3;   ///< the computation failed
inline constexpr int interrupted = 130;
}  // namespace exit_code

struct Verb {
  std::string name;
  std::string summary;  ///< one line, in the list of verbs
  std::string help;     ///< what it answers, examples, what it writes
  std::vector<OptionSpec> options;
  Answer (*act)(const Arguments&, const Watch&) = nullptr;
  /// What --json says beside the members that every answer has; its schema is made of it (answer_json.h).
  std::vector<shape::Member> (*shape)() = nullptr;
};

/// The functions that make the verbs, in the order in which a user meets them. Each stands in a source of app/verbs as
/// `Verb name_verb() {`; the build writes this list (app/CMakeLists.txt).
std::vector<Verb (*)()> verb_functions();

}  // namespace hysteron
