// Decides how new results take the place of old ones in a folder that stays: all of them or none, and nothing else in
// the folder is touched. Does not know what stands in the files.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/files/folder_lock.h"
#include "io/results/result_manifest.h"

namespace hysteron {

/// New results are written into .hysteron/new of their folder; result.json, the last of them, makes them whole. Then
/// they are put in place, one rename after the other. Should the program be killed between, the next one to come goes
/// on: what is whole is put in place, the rest removed.
class StagedResults {
 public:
  /// Ends what a killed process began. `lock` outlives it. `own`: names that are ours in this folder beside those that
  /// its result.json lists. Throws Error "cannot_write".
  explicit StagedResults(const FolderLock& lock, std::set<std::string> own = {});
  /// Without put_in_place() nothing is left.
  ~StagedResults();
  StagedResults(const StagedResults&) = delete;
  StagedResults& operator=(const StagedResults&) = delete;

  /// Where the file is to be written that will be `name`, e.g. "traces/02.csv"; the folders above it are made. Throws
  /// Error "folder_in_use" where the user has something of that name, "cannot_write".
  std::string place(const std::string& name);

  /// The old results go, the new ones, of which result.json is one, take their place. Throws Error "cannot_write".
  void put_in_place();

 private:
  void check_name_is_free(const std::string& name) const;
  void go_on();

  const FolderLock& lock_;
  std::filesystem::path staged_;
  std::set<std::string> own_, placed_;
  bool whole_ = false;
};

/// True where a process was killed whose results were whole, but not all of them in place.
bool has_results_to_place(const std::filesystem::path& folder);

}  // namespace hysteron
