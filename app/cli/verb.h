// Decides what a verb of the command line is: its name, what its help teaches, its options, what it does and what its
// answer holds for programs. Does not parse (command_line.cpp) and does not compute (the rooms below).
#pragma once

#include <map>
#include <string>
#include <vector>

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

/// One option ("--data") or one positional word ("diagram") of a verb.
struct OptionSpec {
  std::string name;         ///< with its dashes where it is an option
  std::string placeholder;  ///< what stands for its value in the help; empty = a flag
  std::string meaning;
  bool required = false;
  bool repeated = false;  ///< may be given several times
};

/// What the user wrote behind a verb.
class Arguments {
 public:
  bool has(const std::string& name) const { return given_.contains(name); }
  /// The value of an option, or `otherwise`.
  std::string text(const std::string& name, const std::string& otherwise = "") const;
  std::vector<std::string> list(const std::string& name) const;
  /// The value of an option as a plain number. Throws Error "bad_command_line".
  double number(const std::string& name, double otherwise) const;
  /// A whole number from 1 to `most`.
  int whole_number(const std::string& name, int otherwise, int most = 100'000) const;
  /// The value of an option as a time in s ("2 s", "5 ms", "3"). Throws Error "bad_command_line".
  double seconds(const std::string& name, double otherwise) const;
  int threads() const;  ///< of --threads; one per core if it is not given
  bool quiet() const { return has("--quiet"); }
  bool json() const { return has("--json"); }
  void set(const std::string& name, std::vector<std::string> values) { given_[name] = std::move(values); }

 private:
  std::map<std::string, std::vector<std::string>> given_;
};

struct Verb {
  std::string name;
  std::string summary;  ///< one line, in the list of verbs
  std::string help;     ///< what it answers, examples, what it writes
  std::vector<OptionSpec> options;
  Answer (*act)(const Arguments&, const Watch&) = nullptr;
  /// What --json says beside the members that every answer has; its schema is made of it (answer_json.h).
  std::vector<shape::Member> (*shape)() = nullptr;
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
OptionSpec threads(const std::string& things);  ///< so many of these at once
}  // namespace options

/// All verbs, in the order in which a user meets them.
std::vector<Verb> all_verbs();

}  // namespace hysteron
