// Decides how a number with its unit, or any parameter value, stands in JSON: 5, "5 Hz", {"value": 5, "unit": "Hz"},
// lists, "$name". Does not know which unit is right: the engine checks that.
#pragma once

#include <optional>
#include <string>

#include "engine/diagram/diagram.h"
#include "io/json/json_reader.h"

namespace hysteron {

/// Reads 5, "5 Hz" or {"value": 5, "unit": "Hz"}; notes "wrong_type" and "bad_value" in the file.
std::optional<Number> read_number(const JsonPlace& place);

/// Reads any parameter value, with `origin` set. Objects may hold the further keys `also` (bounds, free ...), not
/// looked at here.
std::optional<Value> read_value(const JsonPlace& place, const std::string& origin,
                                const std::vector<std::string>& also = {});

/// [0, "10 V"] in a file; nothing, with notes, where an element is no number.
std::optional<NumberList> read_numbers(const JsonPlace& place);
std::string numbers_text(const NumberList& list);

/// Shortest text that reads back as the same double, as JSON wants it. Throws Error "not_finite".
std::string exact_number_text(double value);
/// How well a number is known: "2 %" in quotes, or the shortest number that reads back as the same.
std::string known_to_text(double known_to);
/// "1 row", "5 rows".
std::string rows_text(std::size_t count);
/// A text in quotes.
std::string json_quoted(const std::string& text);
std::string value_text(const Number& number);
/// Throws Error "not_writable" for recorded samples, which stand in a CSV and not in JSON.
std::string value_text(const Value& value);

}  // namespace hysteron
