// Decides how a command line is read, how failures are told, and which exit code the program ends with.
// Does not know what the verbs do.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

/// Runs one command line (without the program's name) and returns the exit code. No exception leaves it.
int run_command_line(const std::vector<std::string>& words);

}  // namespace hysteron
