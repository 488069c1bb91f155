// Decides how the words of a command line are read: which verb they name, with what. Does not carry it out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/verb.h"

namespace hysteron {

struct AskedVerb {
  std::optional<Verb> verb{};  ///< to be carried out; none: `text` is the answer (--help, --version, no words at all)
  Arguments arguments{};
  std::string text{};
  int exit_code = exit_code::done;  ///< where no verb is to be carried out
};

/// What every verb takes besides its own options. `values`: the only words that the option may have; empty: any.
struct CommonOption {
  OptionSpec spec;
  std::vector<std::string> values{};
};
const std::vector<CommonOption>& common_options();

/// What stands above and below the list of verbs in "hysteron --help".
const char* overview_of_program();
const char* first_steps();
const char* version_of_program();  ///< "0.1.0"

/// Throws Error "bad_command_line", "unknown_verb".
AskedVerb read_words(const std::vector<std::string>& words);

}  // namespace hysteron
