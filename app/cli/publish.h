// Decides how a verb ends: its folder of results is written, and what matters is printed, the report's place last.
// Does not decide what was found.
#pragma once

#include <string>
#include <vector>

#include "app/cli/verb.h"
#include "io/results/result.h"

namespace hysteron {

/// The folder of results alone; nothing is printed.
void write_results(const std::string& folder, const Document& document);

/// Writes `folder` whole or not at all, then prints headline, sentences, warnings, what is said here only (times, which
/// no result may depend on) and, on the last line, the verdict and where report.html lies.
void publish(const Arguments& arguments, const std::string& folder, const Document& document,
             const std::vector<std::string>& said_here_only = {});

/// The same in a folder that holds other files of ours besides, and keeps them: each file whole or not at all.
void publish_into(const Arguments& arguments, const std::string& folder, const Document& document,
                  const std::vector<std::string>& said_here_only = {});

}  // namespace hysteron
