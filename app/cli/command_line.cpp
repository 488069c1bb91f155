// Decides how a command line is read, how failures are told, and which exit code the program ends with.
// Does not know what the verbs do.
#include "app/cli/command_line.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/cli/failure.h"
#include "app/cli/interrupt.h"
#include "app/cli/perform.h"
#include "app/cli/words.h"

namespace hysteron {
namespace {

/// Read before anything else, so that failures of the command line itself come in the form asked for: as --errors says,
/// else as the answer would have come.
bool wants_json_errors(const std::vector<std::string>& words) {
  bool json = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool apart = words[i] == "--errors" && i + 1 < words.size();
    if (apart || words[i].starts_with("--errors=")) return (apart ? words[i + 1] : words[i].substr(9)) == "json";
    json = json || words[i] == "--json";
  }
  return json;
}

int read_and_act(const std::vector<std::string>& words) {
  const AskedVerb reading = read_words(words);
  if (reading.verb) return perform(*reading.verb, reading.arguments);
  fmt::print("{}", reading.text);
  return reading.exit_code;
}

Problem output_not_written() {
  return {"cannot_write",
          "standard output",
          "not all of the output could be written",
          "free space on the device, or send the output elsewhere",
          "",
          0};
}

/// A write into a closed or full standard output is told as that.
void tell(Failure failure, bool as_json) {
  if (failure.code == exit_code::interrupted) {
    fmt::print(stderr, "{}\n", failure.interrupted);
    return;
  }
  if (failure.of_the_system && std::ferror(stdout) != 0) failure.problems = {output_not_written()};
  print_problems(failure.problems, failure.code, as_json);
}

}  // namespace

int run_command_line(const std::vector<std::string>& words) {
  const bool as_json = wants_json_errors(words);
  int code = exit_code::done;
  watch_interrupts();
  try {
    code = read_and_act(words);
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    code = failure.code;
    tell(failure, as_json);
  }
  if (std::fflush(stdout) != 0 && code == exit_code::done) {
    code = exit_code::bad_input;
    print_problems({output_not_written()}, code, as_json);
  }
  return code;
}

}  // namespace hysteron
