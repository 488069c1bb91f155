// Decides how results reach the disk: the one door through which a verb's folder and files are put in place, whole or
// not at all. Does not decide what was found.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/cli/answer.h"
#include "app/cli/watch.h"
#include "io/files/folder_lock.h"
#include "io/results/staged_results.h"

namespace hysteron {

/// A folder of results that a verb has for itself from its first file until its answer is in place.
struct HeldFolder {
  HeldFolder(const std::string& folder, const FolderLock::Waiting& waiting) : lock(folder, waiting) {}

  FolderLock lock;
  std::optional<StagedResults> staged;  ///< where some of the results are written before the answer
};

/// "out/report.html", also where the folder was named "out/".
std::string place_in(const Answer& answer, const std::string& name);

/// Waits for others who write there, and says so once (Watch::note). Throws as FolderLock does.
std::shared_ptr<HeldFolder> hold_folder(const std::string& folder, const Watch& watch);

/// The folder of an answer; `stop`: what ends it besides Ctrl-C, while it waits for others or writes. Throws
/// Interrupted, and then nothing was replaced.
void publish_folder(const Answer& answer, const Watch& watch, const std::function<bool()>& stop = {});

/// Its files, those that lie in no folder of results: all of them, or none that was not there before.
void publish_files(const Answer& answer);

}  // namespace hysteron
