// Decides the small things that runs and values of a job share: rows inside a window, columns by name, spectra. Does
// not run anything (job_runs.h).
#pragma once

#include <span>
#include <string>
#include <utility>

#include "app/jobs/job_runs.h"
#include "engine/program/names.h"
#include "engine/program/program.h"
#include "fit/signals/features.h"
#include "fit/study/unit_algebra.h"

namespace hysteron {

/// Rows [first, last) whose base lies inside the window, both ends included up to a millionth of a row's distance.
/// Throws Error "empty_window" at its place.
std::pair<std::size_t, std::size_t> window_rows(std::span<const double> base, const Window& window);

/// Lines of a spectrum of these rows. Throws Error "uneven_rows" at `pointer` where they do not stand evenly in time.
features::Spectrum spectrum_of(const JobRunner::Rows& rows, const std::string& pointer);

/// Throws Error "unknown_signal" with the nearest name.
const RunColumn& column_of(const RunResult& result, const WrittenText& signal);

/// "6.616718 um", as wide as it is worth reading.
std::string quantity_text(const Quantity& q, int digits = 7);

}  // namespace hysteron
