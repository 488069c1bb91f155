// Decides how a number of a data set becomes SI: its own unit, else the declared one, checked against the dimension
// expected. Diagrams keep their numbers as written; the engine converts those.
#pragma once

#include <optional>
#include <string>

#include "engine/diagram/diagram.h"
#include "engine/diagram/units.h"
#include "io/json/json_reader.h"

namespace hysteron {

enum class QuantityKind { absolute, difference };  ///< 0.01 degC is 273.16 K, or (a noise) 0.01 K

/// `number` as SI; a plain number is in `declared`. Notes "bad_unit" and "wrong_unit" at `place`.
std::optional<double> to_si(const JsonPlace& place, const Number& number, const Unit& declared, QuantityKind kind);

/// Reads and converts in one go.
std::optional<double> read_si(const JsonPlace& place, const Unit& declared, QuantityKind kind = QuantityKind::absolute);

/// For a place whose unit nobody declares: a number must carry its own unit (0 need not).
std::optional<double> read_si_with_unit(const JsonPlace& place);

}  // namespace hysteron
