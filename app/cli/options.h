// Decides what an option of a verb is, and what those mean that several verbs take. Does not read them (arguments.h).
#pragma once

#include <string>

namespace hysteron {

/// One option ("--data") or one positional word ("diagram") of a verb.
struct OptionSpec {
  std::string name;         ///< with its dashes where it is an option
  std::string placeholder;  ///< what stands for its value in the help; empty = a flag
  std::string meaning;
  bool required = false;
  bool repeated = false;  ///< may be given several times
  bool several = false;   ///< ... and takes all words up to the next option
};

/// Options that several verbs take, said once.
namespace options {
OptionSpec diagram();
OptionSpec data(bool required);
OptionSpec output_folder();
OptionSpec output_file();
OptionSpec set();
OptionSpec choose();
OptionSpec allow();
OptionSpec effects();
OptionSpec traces();
OptionSpec threads(const std::string& things);  ///< so many of these at once
}  // namespace options

}  // namespace hysteron
