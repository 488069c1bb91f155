// Decides which process may change a folder of results: one at a time, told by a lock that ends with its process,
// however that ends. Does not know what stands in the folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hysteron {

/// In a folder of results: what is not finished. Gone when nobody writes.
inline constexpr char unfinished_folder[] = ".hysteron";

class FolderLock {
 public:
  /// Told every now and then while another process has the folder: who that is.
  using Waiting = std::function<void(const std::string& holder)>;

  /// Makes `folder` with those above it, and waits until nobody else has it. Where the file system has no locks, it is
  /// not waited for others. Throws Error "cannot_write"; Stopped (engine/diagram/stop.h) while it waits.
  explicit FolderLock(std::filesystem::path folder, const Waiting& waiting = {});
  /// What was made for the lock goes; so do the folders that were made for it and stayed empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path unfinished() const { return folder_ / unfinished_folder; }

 private:
  bool make_folders();
  bool take(std::string& holder);
  void try_again_or_fail(const std::filesystem::path& what);
  void remove_made();

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_;
  int descriptor_ = -1;
  int vanished_ = 0;  ///< so often, on end, something went away that had just been there
};

/// True if a folder holds nothing, but for what an unfinished writing left and what a file system keeps in its root.
bool is_free(const std::filesystem::path& folder);

}  // namespace hysteron
