// Decides in which words and facts the poles, the stability and the margins of small motions are told.
// Does not compute them (engine/analysis/small_motions.h).
#pragma once

#include <string>

#include "engine/analysis/small_motions.h"
#include "io/results/result.h"
#include "report/pages/facts.h"

namespace hysteron {

/// "12.51 Hz" of an angular frequency [rad/s].
std::string frequency_text(double w);

/// "unstable (2 poles in the right half plane)", or "" where nothing is unstable.
std::string instability_text(const PoleCount& count, bool sampled);

/// What the head line says of stability, with its colon or semicolon behind; "" where there is nothing to say.
std::string stability_head(const SmallMotions& motions);

/// Sentences and facts on poles, zeros and sampling; a table of all poles.
void tell_poles(Document& document, Facts& facts, const SmallMotions& motions);

/// Sentences and facts on the loop as closed with the sign -1.
void tell_margins(Document& document, Facts& facts, const SmallMotions& motions);

/// Warnings for blocks that pass nothing on.
void tell_cuts(Document& document, Facts& facts, const Program& program, const SmallMotions& motions);

}  // namespace hysteron
