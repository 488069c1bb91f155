// Decides where a structure repeats: over time or over a level. Internal to discover; structure.cpp lets the kinds of
// structure compete. Each fills `fall` with the fall of chi2 less what its own numbers cost.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "discover/structure/structure.h"

namespace hysteron {

class ResidualParts;

/// Interference: a line with one frequency, amplitude and phase of its own in every recording.
std::optional<Structure> line_in_time(const ResidualParts& parts);
/// The strongest lines of the residual in bands of frequency [Hz], strongest first, at most `most`: found from the
/// shortest recording to the longest, since each tells frequencies apart by one over its duration.
std::vector<double> strongest_lines(const ResidualParts& parts, const std::vector<std::pair<double, double>>& bands,
                                    std::size_t most);
/// Periods [SI] of the strongest ripples of the residual over a level, from `shortest` to `longest`, strongest first,
/// at most `most`: found on train recordings.
std::vector<double> strongest_ripples(const ResidualParts& parts, std::size_t level, double shortest, double longest,
                                      std::size_t most);
/// Fringes, gear teeth: a ripple over a level, one shape for all recordings, 3 to 130 periods over the range.
std::optional<Structure> line_in_level(const ResidualParts& parts, std::size_t level);

/// Cosine and sine of wave number k [rad per unit of x] along x.
std::vector<Rows> wave(const Rows& x, double origin, double k);

}  // namespace hysteron
