// Decides whether a search may look at the first part of long recordings alone, and which part that is. Internal to
// discover.
#pragma once

#include <cstddef>
#include <optional>

#include "io/data/dataset.h"

namespace hysteron {

/// Ten thousand witnesses show by a score of 10 what takes a thousandth of the squares away that are left (ln(1 +
/// 0.001) of each half a unit), an effect of a twentieth of the noise: twice as many rows, as noise is seldom white.
inline constexpr std::size_t rows_that_tell = 20000;

/// The data set with the first rows of its recordings, `rows` that are judged of each or, doubled, so many more that
/// every column goes through three quarters of its range in them (noise of 10^6 rows spreads a fifth wider than of
/// 20 000). nullopt: some recording would not get shorter by three quarters. A recording that is cut in time is cut
/// anew, by the same shares. Test recordings, which nobody searches in, stay as they are.
std::optional<DataSet> first_part(const DataSet& data, std::size_t rows = rows_that_tell);

}  // namespace hysteron
