// Decides which command line a job of the page is: words that the verb itself declares, and nothing of a shell.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "studio/folder.h"

namespace hysteron::studio {

/// A verb as far as jobs use it.
struct JobVerb {
  struct Option {
    std::string name;
    bool is_flag = false, is_repeated = false;
  };
  std::string name;
  std::vector<Option> options;  ///< with their dashes
};

/// How the words name files of the folder: for a process that works in it, or for this one.
enum class WordPaths { from_folder, absolute };

/// The words behind the program's name for {"verb", "diagram", "options": {"--data": "lab.csv", "--set": ["a=1"],
/// "--flag": true}}; files are names in the folder, "other" a second one where the verb takes two. Throws Error
/// "unknown_verb", "bad_command_line" for options that the verb does not have or that the studio gives itself,
/// "outside_folder".
std::vector<std::string> job_words(const nlohmann::json& asked, const std::vector<JobVerb>& verbs,
                                   const OpenFolder& folder, WordPaths paths = WordPaths::from_folder);

/// Those for {"--data": "lab.csv", ...} alone, of a verb. Throws as job_words().
std::vector<std::string> option_words(const nlohmann::json& options, const JobVerb& verb, const OpenFolder& folder,
                                      WordPaths paths);

}  // namespace hysteron::studio
