// Decides how a verb ends: its folder of results is written, and what matters is printed, the report's place last.
// Does not decide what was found.
#pragma once

#include <string>
#include <vector>

#include "app/cli/verb.h"
#include "io/files/folder_lock.h"
#include "io/results/result.h"
#include "io/results/staged_results.h"

namespace hysteron {

/// The folder of results alone; nothing is printed. Throws Interrupted, and then nothing was replaced.
void write_results(const std::string& folder, const Document& document);

/// Writes `folder` whole or not at all, then prints headline, sentences, warnings, what is said here only (times, which
/// no result may depend on) and, on the last line, the verdict and where report.html lies.
void publish(const Arguments& arguments, const std::string& folder, const Document& document,
             const std::vector<std::string>& said_here_only = {});

/// The same where the folder is locked and some of its files were written before.
void publish_staged(const Arguments& arguments, StagedResults& staged, const std::string& folder,
                    const Document& document, const std::vector<std::string>& said_here_only = {});

/// Says once, on the error stream, for whom this program waits.
FolderLock::Waiting say_who_writes(const std::string& folder);

}  // namespace hysteron
