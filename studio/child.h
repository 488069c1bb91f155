// Decides how a job runs: a process in a session of its own, which goes on when the studio ends and is found again when
// the studio is started anew. Does not decide what it computes.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace hysteron::studio {

/// A process, told from a later one of the same number by when it was started.
struct Child {
  pid_t pid = 0;
  unsigned long long started = 0;  ///< [clock ticks since the machine was started]; 0 = not known
};

/// Runs words[0] (a path) in `folder`, its streams into files, never through a shell. Throws Error "cannot_start".
Child start_child(const std::vector<std::string>& words, const std::string& folder, const std::string& out,
                  const std::string& err);

bool is_alive(const Child& child);

/// Sends a signal where that process is still there.
void signal_child(const Child& child, int signal);

/// The exit code of a child of this process that has ended (128 + signal where it was killed); nothing while it runs,
/// and of one that another process started.
std::optional<int> exit_code_of(const Child& child);

}  // namespace hysteron::studio
