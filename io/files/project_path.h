// Decides which files a file may name: those inside its project, or in a folder that the user allowed.
// Does not open anything.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hysteron {

class ProjectPaths {
 public:
  /// The project of `file`: the nearest folder upwards that holds a file `hysteron.project`, else the file's own
  /// folder. Files that it names and that name others are judged by the same project.
  /// Of `allowed`, what is a file and no folder is trusted, too.
  ProjectPaths(const std::string& file, const std::vector<std::string>& allowed);

  /// The path to open for `written` in `from_file` (relative to that file's folder); nothing if it lies outside.
  /// Symbolic links and ".." are followed before it is judged.
  std::optional<std::string> resolve(const std::string& from_file, const std::string& written) const;

  /// Has the user allowed this very file? Then native code in it may be run.
  bool trusts(const std::string& path) const;

  const std::string& project() const { return folders_.front(); }

 private:
  std::vector<std::string> folders_;  ///< canonical; the project first, and files that are allowed
  std::vector<std::string> trusted_;  ///< canonical
};

/// `target` (relative to the folder of `from_file`) as seen from the folder of `to_file`.
std::string moved_path(const std::string& target, const std::string& from_file, const std::string& to_file);

/// Text for errors.
std::string outside_cure(const std::string& written);

}  // namespace hysteron
