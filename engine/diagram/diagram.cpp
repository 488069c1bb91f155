#include "engine/diagram/diagram.h"

#include "engine/diagram/units.h"

namespace hysteron {

namespace {

/// "2*u": no number with its unit, but the beginning of an expression.
bool goes_on(const std::string& behind_number) {
  return !behind_number.empty() && std::string_view("*+-^<>=!").find(behind_number.front()) != std::string_view::npos;
}

}  // namespace

Value::Value(const std::string& text) {
  double number = 0;
  std::string unit;
  if (!text.empty() && text.front() == '$') {
    content = Reference{text.substr(1)};
  } else if (split_quantity(text, number, unit) && !goes_on(unit)) {
    content = unit.empty() ? Number{number, {}} : Number{number, unit};
  } else {
    content = text;
  }
}

bool was_set(const std::string& origin) { return origin.starts_with("--set "); }

}  // namespace hysteron
