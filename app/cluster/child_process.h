// Decides how another program is run: by its words, never through a shell, with its folder, and both streams kept.
// Does not decide which program, nor what its answer means.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

struct ChildOutcome {
  bool found = true;  ///< false: there is no such program on PATH
  int code = 0;       ///< exit code; 128 + signal where it was killed
  std::string out, err;
};

/// Runs words[0], found on PATH, in `folder` ("" = here) and waits for its end. Throws Error "cannot_start" where the
/// system refuses.
ChildOutcome run_child(const std::vector<std::string>& words, const std::string& folder = "");

}  // namespace hysteron
