// Decides how the parts of a column's note stand in a data set file. What is wrong is noted at its place.
#pragma once

#include "engine/diagram/units.h"
#include "io/data/dataset.h"
#include "io/json/json_reader.h"

namespace hysteron {

/// "1 sample", "2 samples", "5 ms"; a plain number would leave open which of both is meant.
void read_delay(const JsonPlace& place, ColumnNote& note);
/// "2 nm" (white) or {"white": "2 nm", "resolution": "0.1 nm", "one_over_f": 0.3}; numbers are in the column's unit.
void read_noise(const JsonPlace& place, const Unit& unit, NoiseNote& noise);
/// [0, 10] or ["0 V", "10 V"]; "find" where rows pile up. Numbers are in the column's unit.
void read_limits(const JsonPlace& place, const Unit& unit, ColumnNote& note);

}  // namespace hysteron
