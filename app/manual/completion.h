// Decides what a shell offers behind "hysteron": verbs, their options, the words and the kinds of files that these
// take. Does not know what the verbs do (verb.h).
#pragma once

#include <string>
#include <vector>

#include "app/cli/verb.h"

namespace hysteron {

/// Names that a verb takes and that no file holds.
struct KnownNames {
  std::vector<std::string> blocks, effects;
};

/// What bash reads ("source FILE"); needs no other package.
std::string bash_completion(const std::vector<Verb>& verbs, const KnownNames& names);

/// The same for zsh, with what each verb and option means: a file "_hysteron" in a folder of $fpath.
std::string zsh_completion(const std::vector<Verb>& verbs, const KnownNames& names);

}  // namespace hysteron
