// Decides which of the many vectors of a file (MAT, HDF5, TDMS) are the columns of one recording: those of one group
// that are as long as its time. What that leaves open is asked.
#pragma once

#include <string>
#include <vector>

#include "io/formats/measured_table.h"

namespace hysteron {

/// What a compressed file can hold at most, for each of its bytes: deflate makes no more than 1032 bytes of one (zlib,
/// "Technical Details"), and a number has one at least.
inline constexpr std::size_t most_numbers_per_byte = 1100;

/// Vectors by their full names ("run1/force"), of any lengths; a name without "/" lies in no group. Keeps the order.
/// `table` has its file, clock and what was assumed already. Throws Error "no_table", "ambiguous_group" (the choices,
/// and --group), "missing_column" where --group names none.
MeasuredTable table_of_vectors(MeasuredTable table, std::vector<MeasuredColumn> vectors, const ReadingChoices& choices);

}  // namespace hysteron
