// Decides which files the page may see and change: those below the folder that the studio was started on.
// Does not know what stands in them.
#pragma once

#include <string>
#include <vector>

namespace hysteron::studio {

/// A file that the page offers.
struct ListedFile {
  std::string path;   ///< from the folder on, with "/"
  std::string kind;   ///< "diagram", "dataset", "recording", "job"
  std::string title;  ///< what the file says of itself, or ""
};

class OpenFolder {
 public:
  /// Throws Error "no_folder".
  explicit OpenFolder(const std::string& folder);

  const std::string& path() const { return root_; }  ///< absolute, links followed
  /// The file of this name, absolute, whether it is there or not. Throws Error "outside_folder" where the name, or a
  /// link on the way, leads out of the folder.
  std::string file(const std::string& name) const;
  /// What `file()` was given.
  std::string name_of(const std::string& file) const;
  /// Files that can be opened here, by their names; results and what begins with a dot are left out.
  std::vector<ListedFile> list() const;

 private:
  std::string root_;
};

/// Digest of the content of a file, "" where it cannot be read.
std::string digest_of(const std::string& file);

}  // namespace hysteron::studio
