// Decides how a failure is told: a list of problems, each with a code, a place, what is wrong and the cure.
// Does not decide how it is printed (app) nor in which line of a file the place stands (io).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace hysteron {

/// Whose fault a failure is. The command line turns it into an exit code: input 2, numerics 3.
enum class Fault { input, numerics };

/// One thing that is wrong.
struct Problem {
  std::string code;  ///< stable identifier, e.g. "unknown_parameter"; tests and programs rely on it
  std::string path;  ///< where: JSON pointer ("/blocks/stage/gain"), or block path ("stage/play"), or file
  std::string what;  ///< what was found and what was expected, in the words of the user's file
  std::string cure;  ///< what to do about it; never empty
  std::string file;  ///< filled in by io where a file is known
  int line = 0;      ///< filled in by io, 1-based; 0 = unknown
};

/// An error that carries all problems of the stage that failed.
class Error : public std::runtime_error {
 public:
  Error(Fault fault, std::vector<Problem> problems);

  Fault fault;
  std::vector<Problem> problems;
};

/// Throws an input error with a single problem.
[[noreturn]] void fail(std::string code, std::string path, std::string what, std::string cure);

/// Throws a numerics error with a single problem.
[[noreturn]] void fail_numerics(std::string code, std::string path, std::string what, std::string cure);

/// Collects the problems of one stage, so that they are reported together (the first 20 in full).
class Problems {
 public:
  /// The same words about the same place are kept once.
  void add(std::string code, std::string path, std::string what, std::string cure);
  bool empty() const { return problems_.empty(); }
  const std::vector<Problem>& list() const { return problems_; }
  void throw_if_any() const;  ///< throws Error(Fault::input) if a problem was added

 private:
  std::vector<Problem> problems_;
  std::unordered_set<std::string> told_;
};

/// "choose one of a, b, c. Did you mean "b"?" for a name that is not among the known ones.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// The known name nearest to `name` (edit distance at most a third of its length), or "".
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// Text of all problems, one paragraph each: "file:line: path", what, cure.
std::string to_text(const std::vector<Problem>& problems);

}  // namespace hysteron
