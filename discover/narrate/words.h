// Decides which words a discovery and its page share: names of what was found, sizes of an error, what is known of a
// structure that is left (structure_words.cpp), what to record next. Does not decide what is claimed.
#pragma once

#include <string>
#include <vector>

#include "discover/search/discovery.h"

namespace hysteron {

/// "hysteresis or backlash": what explains a step; a name that stands at several places once, with these:
/// "asymmetry (at u or at sensor)". With its place where another step has the same name.
std::string names_of(const std::vector<FoundStep>& steps, std::size_t step);

/// Of all outputs, over the recordings of a role, each in its own unit: "0.42 um", "y 0.42 um, s 0.03 mm/s"; "" where
/// there are more than can be read in a sentence.
std::string sizes_text(const ModelError& error, Role role);

/// Of recordings that were kept for the end; there must be some.
std::string test_sentence(const ModelError& error);

/// What is known of a structure besides its sentence: when it is there, how regularly, what it follows.
std::vector<std::string> structure_sentences(const Structure& structure);

/// A recording that would say more of what no effect explains: of this structure, or, if it is null, of anything.
std::string what_to_record(const Structure* left);

}  // namespace hysteron
