#include "io/json/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr const char* number_forms =
    "a number, a number with its unit such as \"5 Hz\", or {\"value\": 5, \"unit\": \"Hz\"}";

std::vector<std::string> object_keys(const std::vector<std::string>& also) {
  std::vector<std::string> keys{"value", "unit", "known_to"};
  keys.insert(keys.end(), also.begin(), also.end());
  return keys;
}

std::optional<std::string> read_unit(const JsonPlace& object) {
  const auto unit = object.find("unit");
  return unit ? unit->text() : std::nullopt;
}

/// "5 Hz" to a number; nothing (and no note) for other texts.
std::optional<Number> number_from(const std::string& text) {
  const Value value(text);
  const auto* number = std::get_if<Number>(&value.content);
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<NumberList> read_list(const JsonPlace& place, const std::optional<std::string>& unit) {
  NumberList list;
  const auto elements = place.elements();
  for (const auto& element : elements) {
    if (unit && !element.is_number()) {
      element.add_wrong_type("a number (the unit stands beside the list)");
      continue;
    }
    auto number = read_number(element);
    if (!number) continue;
    if (unit) number->unit = unit;
    list.push_back(std::move(*number));
  }
  return list.size() == elements.size() ? std::optional(list) : std::nullopt;
}

/// [[1, 2], [3, 4]].
std::optional<NumberMatrix> read_matrix(const JsonPlace& place, const std::optional<std::string>& unit) {
  NumberMatrix matrix;
  for (const auto& row : place.elements()) {
    if (!row.is_array()) {
      row.add_wrong_type("a row such as [1, 2], as the first one is");
      return {};
    }
    auto list = read_list(row, unit);
    if (!list) return {};
    matrix.rows.push_back(std::move(*list));
  }
  return matrix;
}

/// "2 %", "0.02" or 0.02.
std::optional<double> read_known_to(const JsonPlace& object, const Value& value) {
  const auto place = object.find("known_to");
  if (!place) return {};
  const auto refuse = [&](const std::string& what, const std::string& cure) {
    place->add("bad_value", what, cure);
    return std::optional<double>();
  };
  if (std::holds_alternative<Reference>(value.content) || std::holds_alternative<std::string>(value.content))
    return refuse("\"known_to\" says how well a number is known, and the value beside it is none",
                  "write it at the number itself; that of \"$name\" stands in \"parameters\"");
  std::optional<Number> part;
  if (place->is_number()) part = Number{*place->number(), {}};
  if (place->is_text()) part = number_from(*place->text());
  const bool in_percent = part && part->unit && *part->unit == "%";
  if (!part || (part->unit && !in_percent) || !std::isfinite(part->value))
    return refuse("\"known_to\" is one standard deviation as a part of the value",
                  "write \"2 %\" or 0.02; 0 of a number that is exact");
  const double known_to = in_percent ? part->value / 100 : part->value;
  if (known_to < 0 || known_to > 1)
    return refuse(fmt::format("known to {} %, which is not from 0 to 100 %", exact_number_text(100 * known_to)),
                  "write \"2 %\" or 0.02; for a number of which nothing is known \"free\": true in \"parameters\"");
  return known_to;
}

/// [1, 2] or [[1, 2], [3, 4]].
std::optional<Value> read_array(const JsonPlace& place, const std::optional<std::string>& unit) {
  const auto elements = place.elements();
  if (!elements.empty() && elements.front().is_array()) {
    auto matrix = read_matrix(place, unit);
    return matrix ? std::optional(Value(std::move(*matrix))) : std::nullopt;
  }
  auto list = read_list(place, unit);
  return list ? std::optional(Value(std::move(*list))) : std::nullopt;
}

}  // namespace

std::optional<Number> read_number(const JsonPlace& place) {
  if (place.is_number()) return Number{*place.number(), {}};
  if (place.is_text()) {
    const auto text = *place.text();
    auto number = number_from(text);
    if (!number && text.starts_with('$'))
      place.add(
          "bad_value",
          fmt::format("{} cannot stand for one number: a $name stands for the whole value of a "
                      "parameter of a block",
                      json_quoted(text)),
          fmt::format("write {} in place of the whole list, and the list at that name in \"parameters\"; or write "
                      "the number here",
                      json_quoted(text)));
    else if (!number)
      place.add("bad_value", fmt::format("{} does not begin with a number", json_quoted(text)),
                fmt::format("write {}", number_forms));
    return number;
  }
  if (!place.is_object()) {
    place.add_wrong_type(number_forms);
    return {};
  }
  place.only({"value", "unit"});
  const auto value = place.need("value", "write {\"value\": 5, \"unit\": \"Hz\"}");
  const auto number = value ? value->number() : std::nullopt;
  const auto unit = read_unit(place);
  return number ? std::optional(Number{*number, unit}) : std::nullopt;
}

std::optional<Value> read_value(const JsonPlace& place, const std::string& origin,
                                const std::vector<std::string>& also) {
  std::optional<Value> value;
  if (place.is_number()) {
    value = Value(*place.number());
  } else if (place.is_text()) {
    value = Value(*place.text());
  } else if (place.is_array()) {
    value = read_array(place, {});
  } else if (place.is_object()) {
    place.only(object_keys(also));
    const auto unit = read_unit(place);
    if (const auto inner = place.need("value", "write {\"value\": 5, \"unit\": \"Hz\"}")) {
      if (inner->is_array()) {
        value = read_array(*inner, unit);
      } else if (!unit && inner->is_text()) {
        value = Value(*inner->text());
      } else if (const auto number = inner->number()) {
        value = Value(Number{*number, unit});
      }
    }
  } else {
    place.add_wrong_type("a number, a text, a list, or {\"value\": 5, \"unit\": \"Hz\"}");
  }
  if (value) value->origin = origin;
  if (value && place.is_object()) value->known_to = read_known_to(place, *value);
  return value;
}

std::string exact_number_text(double value) {
  if (!std::isfinite(value))
    fail("not_finite", "", fmt::format("{} cannot be written as JSON", value), "give a finite number");
  std::string text = fmt::format("{}", value);  // shortest round trip
  if (const auto e = text.find('e'); e != text.npos) {
    // 1e-05 and 1e+20 become 1e-5 and 1e20.
    std::string exponent = text.substr(e + 1);
    const bool negative = exponent.front() == '-';
    exponent.erase(0, exponent.find_first_not_of("+-0"));
    text = text.substr(0, e + 1) + (negative ? "-" : "") + exponent;
  }
  return text;
}

std::string known_to_text(double known_to) {
  const std::string percent = exact_number_text(100 * known_to);
  const auto back = number_from(percent + " %");
  return back && back->value / 100 == known_to ? json_quoted(percent + " %") : exact_number_text(known_to);
}

std::string rows_text(std::size_t count) { return count == 1 ? "1 row" : fmt::format("{} rows", count); }

std::string json_quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string value_text(const Number& number) {
  if (!number.unit) return exact_number_text(number.value);
  const std::string text = exact_number_text(number.value) + " " + *number.unit;
  // The short form only where it reads back as the same number and unit ("5 " would not).
  if (number_from(text) == number) return json_quoted(text);
  return fmt::format("{{\"value\": {}, \"unit\": {}}}", exact_number_text(number.value), json_quoted(*number.unit));
}

namespace {

/// Short lists carry the unit at each number, long ones once.
std::string list_text(const NumberList& list) {
  constexpr std::size_t units_at_each = 4;
  const bool same_unit =
      std::all_of(list.begin(), list.end(), [&](const Number& n) { return n.unit == list.front().unit; });
  const bool unit_once = list.size() > units_at_each && same_unit && list.front().unit.has_value();
  std::vector<std::string> elements;
  for (const auto& n : list) elements.push_back(unit_once ? exact_number_text(n.value) : value_text(n));
  const std::string text = fmt::format("[{}]", fmt::join(elements, ", "));
  return unit_once ? fmt::format("{{\"value\": {}, \"unit\": {}}}", text, json_quoted(*list.front().unit)) : text;
}

/// Rows as lists; the unit once if all elements share one.
std::string matrix_text(const NumberMatrix& matrix) {
  const auto unit = matrix.rows.empty() || matrix.rows[0].empty() ? std::nullopt : matrix.rows[0][0].unit;
  bool unit_once = unit.has_value();
  for (const auto& row : matrix.rows)
    for (const auto& n : row) unit_once = unit_once && n.unit == unit;
  std::vector<std::string> rows;
  for (const auto& row : matrix.rows) {
    std::vector<std::string> elements;
    for (const auto& n : row) elements.push_back(unit_once ? exact_number_text(n.value) : value_text(n));
    rows.push_back(fmt::format("[{}]", fmt::join(elements, ", ")));
  }
  const std::string text = fmt::format("[{}]", fmt::join(rows, ", "));
  return unit_once ? fmt::format("{{\"value\": {}, \"unit\": {}}}", text, json_quoted(*unit)) : text;
}

}  // namespace

std::string value_text(const Value& value) {
  if (value.known_to) {
    Value plain = value;
    plain.known_to.reset();
    std::vector<std::string> members;
    if (const auto* number = std::get_if<Number>(&value.content); number != nullptr && number->unit) {
      members = {"\"value\": " + exact_number_text(number->value), "\"unit\": " + json_quoted(*number->unit)};
    } else if (const std::string text = value_text(plain); text.starts_with('{')) {
      members = {text.substr(1, text.size() - 2)};  // of a list with its unit
    } else {
      members = {"\"value\": " + text};
    }
    members.push_back("\"known_to\": " + known_to_text(*value.known_to));
    return fmt::format("{{{}}}", fmt::join(members, ", "));
  }
  if (const auto* number = std::get_if<Number>(&value.content)) return value_text(*number);
  if (const auto* list = std::get_if<NumberList>(&value.content)) return list_text(*list);
  if (const auto* matrix = std::get_if<NumberMatrix>(&value.content)) return matrix_text(*matrix);
  if (const auto* text = std::get_if<std::string>(&value.content)) return json_quoted(*text);
  if (const auto* reference = std::get_if<Reference>(&value.content)) return json_quoted("$" + reference->name);
  fail("not_writable", value.origin, "recorded samples cannot stand in a diagram file",
       "write them to a CSV and name it: \"file\", \"column\"");
}

std::optional<NumberList> read_numbers(const JsonPlace& place) {
  if (!place.is_array()) {
    place.add_wrong_type("a list such as [\"0 V\", \"10 V\"]");
    return std::nullopt;
  }
  return read_list(place, std::nullopt);
}
std::string numbers_text(const NumberList& list) { return list_text(list); }

}  // namespace hysteron
