// Decides the small things that runs and values of a job share: rows inside a window, columns by name, units of areas
// and ratios. Does not run anything (job_runs.h).
#pragma once

#include <span>
#include <string>
#include <utility>

#include "app/job_runs.h"
#include "engine/program.h"
#include "fit/features.h"

namespace hysteron {

Unit without_offset(Unit unit);               ///< for a difference or a size: 1 degC of it is 1 K
Unit product(const Unit& a, const Unit& b);   ///< "um V"
Unit quotient(const Unit& a, const Unit& b);  ///< "um/V", "um/(V/um)"
Unit squared(const Unit& a);

/// Rows [first, last) whose base lies inside the window, both ends included up to a millionth of a row's distance.
/// Throws Error "empty_window" at its place.
std::pair<std::size_t, std::size_t> window_rows(std::span<const double> base, const Window& window);

/// Lines of a spectrum of these rows. Throws Error "uneven_rows" at `pointer` where they do not stand evenly in time.
features::Spectrum spectrum_of(const JobRunner::Rows& rows, const std::string& pointer);

/// Throws Error "unknown_signal" with the nearest name.
const RunColumn& column_of(const RunResult& result, const WrittenText& signal);

/// A signal by its path, or an output of the diagram by its name; -1 if there is none.
int find_named(const Program& program, const std::string& name);
/// The same; throws Error "unknown_signal" with the nearest name.
int named_signal(const Program& program, const std::string& name);

/// "6.616718 um", as wide as it is worth reading.
std::string quantity_text(const Quantity& q, int digits = 7);

}  // namespace hysteron
