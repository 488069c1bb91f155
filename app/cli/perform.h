// Decides how a verb is carried out: watched while it works, its answer put in place, then told to people or, with
// --json, to programs. The only place that prints what a verb found. Does not know what the verbs do.
#pragma once

#include "app/cli/verb.h"

namespace hysteron {

/// Returns the exit code. Throws what the verb throws, behind the text that it had for people.
int perform(const Verb& verb, const Arguments& arguments);

}  // namespace hysteron
