// Decides which generic structure stands out in a residual: a line in time, a line in level, a kink at a level, jumps,
// bursts.
// Names no physical effect: a structure is what `unexplained` shows to people.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "discover/models/evidence.h"
#include "fit/numerics/threads.h"

namespace hysteron {

namespace rules {
constexpr double structure_share = 0.3;  ///< a structure must remove more of the excess to be told
}  // namespace rules

/// Train recordings and validation recordings, each taken together.
struct ByRole {
  double train = 0, validate = 0;
  double& of(bool is_train) { return is_train ? train : validate; }
  double all() const { return train + validate; }
};

/// A structure in the residual that no known effect describes.
struct Structure {
  std::string kind;      ///< "line_in_time", "line_in_level", "kink_at_level", "jumps", "bursts"
  std::string variable;  ///< "t", an input or an output: what it lives on
  std::string output;    ///< in whose residual
  double period = 0;     ///< in units of the variable [SI]; 0 = none
  int harmonic = 0;      ///< of a line: so many times the frequency of the drive, in every recording; 0 = it is none
  double threshold = 0;  ///< [SI]
  bool has_threshold = false;
  /// The threshold is passed once in each recording, at about the same time [s] after its start: nobody can tell
  /// whether it is that level or that time. 0 = no such thing.
  double passed_once_at = 0;
  Unit unit;                                                                              ///< of the variable
  std::vector<std::pair<std::string, std::vector<std::pair<double, double>>>> intervals;  ///< per recording [s]
  /// Of chi2, beyond a free gain and offset.
  ByRole fall{};
  /// chi2 with the best gain and offset: what the fall is counted from.
  ByRole beyond_calibration{};
  double share_removed = 0;  ///< of the excess over the noise, where it was looked for
  std::string sentence;
  /// Bursts only say when: they do not compete with effects.
  bool explains() const { return kind != "bursts"; }
};

enum class Where { validation, all_recordings };
inline double over(const ByRole& value, Where where) {
  return where == Where::validation ? value.validate : value.all();
}

/// Structures that competed, in the order in which they were looked for.
struct StructureSearch {
  std::vector<Structure> list;
  int best = -1;  ///< of them, the one that removes most of chi2; -1 = none removes any
  const Structure* winner() const { return best < 0 ? nullptr : &list[static_cast<std::size_t>(best)]; }
};
/// All that can be fitted to what this model leaves on these recordings.
StructureSearch find_structures(const Evidence& evidence, const Prediction& prediction, const Threads& threads = 1,
                                Where where = Where::validation);

}  // namespace hysteron
