// Decides how tests run the built program: as a user would, in a folder of its own, with exit code and both streams
// kept. Does not know what the program should say.
#pragma once

#include <string>
#include <vector>

namespace hysteron::process {

struct Outcome {
  int code = -1;  ///< exit code; 128 + signal where it was killed, as a shell says it
  std::string out, err;
};

/// Runs the program with these words in `folder`. `out_device`: where standard output goes ("" = it is kept).
/// `interrupt_after_ms` > 0: SIGINT is sent so long after the start.
Outcome hysteron(const std::string& folder, const std::vector<std::string>& words, const std::string& out_device = "",
                 int interrupt_after_ms = 0);

/// The same with SIGTERM, as a batch system ends a job.
Outcome hysteron_terminated(const std::string& folder, const std::vector<std::string>& words, int after_ms);

/// The same with SIGKILL: code 137 where it came in time.
Outcome hysteron_killed(const std::string& folder, const std::vector<std::string>& words, int after_ms);

/// The same with SIGTERM, of a program that has so much to do that it comes in time: on a slow machine, or under a
/// sanitizer, it may not have begun to listen, and is started anew.
Outcome hysteron_terminated(const std::string& folder, const std::vector<std::string>& words);

/// Runs a command line of a shell in `folder`, with the built program first in PATH.
Outcome shell(const std::string& folder, const std::string& command);

/// A folder that goes away with this value.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return path_; }
  std::string write(const std::string& name, const std::string& content) const;  ///< returns the name
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const;
  /// Everything that lies in it, sorted, folders with a trailing slash.
  std::vector<std::string> entries() const;

 private:
  std::string path_;
};

}  // namespace hysteron::process
