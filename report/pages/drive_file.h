// Decides how an experiment that a discovery asks for is written as a file that a generator or a controller can play.
// Does not choose it (discover/experiment).
#pragma once

#include <string>
#include <vector>

#include "discover/experiment/experiment.h"

namespace hysteron {

/// How such a file begins: what begins otherwise is another file.
inline constexpr char drive_file_head[] = "# An experiment that hysteron asks for";

/// A CSV as read_csv() reads it: what to do and what to measure as comments, t, and a column for each input of the
/// diagram in its unit, exactly the rows in which the experiment was simulated.
std::string drive_file_text(const Experiment& experiment);

/// Inputs that must move faster than they did in the recordings, since nothing slower tells: "u moves by up to 20 V/s,
/// in the recordings by 4".
std::vector<std::string> faster_than_recorded(const Experiment& experiment);

/// What to measure, how long and in which rows: "y, for 1.8 s, in these rows or every 1 ms".
std::string what_to_measure(const Experiment& experiment);

}  // namespace hysteron
