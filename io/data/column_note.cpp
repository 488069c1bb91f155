#include "io/data/column_note.h"

#include <cmath>

#include "io/json/json_reader.h"
#include "io/json/quantity.h"
#include "io/json/value_text.h"

namespace hysteron {

void read_delay(const JsonPlace& place, ColumnNote& note) {
  const char* cure = "write \"1 sample\", \"2 samples\" or a time such as \"5 ms\"";
  const auto number = read_number(place);
  if (!number) return;
  if (!(number->value >= 0))
    return place.add("bad_value", "a delay cannot be negative", "if this column is early, give the others a delay");
  if (!number->unit && number->value > 0) return place.add("missing_unit", "samples or seconds?", cure);
  if (!number->unit) return;
  if (*number->unit == "sample" || *number->unit == "samples") {
    if (number->value != std::floor(number->value) || number->value > 1e6)
      return place.add("bad_value", "samples are whole numbers", cure);
    note.delay_samples = static_cast<int>(number->value);
  } else if (const auto seconds = to_si(place, *number, parse_unit("s"), QuantityKind::difference)) {
    note.delay_seconds = *seconds;
  }
}

void read_noise(const JsonPlace& place, const Unit& unit, NoiseNote& noise) {
  const auto size = [&](const JsonPlace& at, const Unit& declared) {
    const auto value = read_si(at, declared, QuantityKind::difference);
    if (value && !(*value >= 0))
      at.add("bad_value", "a noise cannot be negative", "write its rms or step size, 0 or above");
    return value;
  };
  if (!place.is_object() || place.find("value")) {
    noise.white = size(place, unit);
    return;
  }
  place.only({"white", "resolution", "one_over_f"});
  if (const auto white = place.find("white")) noise.white = size(*white, unit);
  if (const auto resolution = place.find("resolution")) noise.resolution = size(*resolution, unit);
  if (const auto share = place.find("one_over_f")) noise.one_over_f = size(*share, Unit{});
}

void read_limits(const JsonPlace& place, const Unit& unit, ColumnNote& note) {
  if (place.is_text()) {
    note.find_limits = place.text() == "find";
    if (!note.find_limits)
      place.add("bad_value", "limits are two numbers", "write [0, 10], or \"find\" for where rows pile up");
    return;
  }
  if (!place.expect_array("[0, 10]")) return;
  const auto ends = place.elements();
  if (ends.size() != 2) return place.add("bad_value", "limits are two numbers", "write [0, 10]");
  const auto low = read_si(ends[0], unit), high = read_si(ends[1], unit);
  if (!low || !high) return;
  if (!(*low < *high)) return place.add("bad_value", "the lower limit comes first", "write [0, 10]");
  note.limits = std::pair(*low, *high);
}

}  // namespace hysteron
