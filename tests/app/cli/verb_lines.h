// Decides a command line for every verb, and the folder in which it is carried out: by the program and by the library.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/app/hysteron_process.h"

namespace hysteron::verb_lines {

using Words = std::vector<std::string>;

/// At least one command line of every verb; those of one verb in their order, in one folder.
const std::map<std::string, std::vector<Words>>& all();

/// What they read.
void furnish(const process::Folder& folder);

}  // namespace hysteron::verb_lines
