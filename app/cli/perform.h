// Decides how a verb is carried out: watched while it works, its answer put in place, then told to people or, with
// --json, to programs. The only place that prints what a verb found. Does not know what the verbs do.
#pragma once

#include <string>
#include <vector>

#include "app/cli/answer.h"
#include "app/cli/verb.h"
#include "app/cli/watch.h"

namespace hysteron {

/// Returns the exit code. Throws what the verb throws, behind the text that it had for people.
int perform(const Verb& verb, const Arguments& arguments);

struct Performed {
  Answer answer;
  std::vector<std::string> notes;  ///< what was said while the verb worked
};

/// The same for a program that called: `watch` is told how far it is and asked, nothing is printed, and a folder of
/// results is written only where the arguments name it, or where parts of it were written already.
Performed perform_silently(const Verb& verb, const Arguments& arguments, Watch watch);

}  // namespace hysteron
