#include "engine/diagram/diagram.h"

#include "engine/diagram/units.h"

namespace hysteron {

Value::Value(const std::string& text) {
  double number = 0;
  std::string unit;
  if (!text.empty() && text.front() == '$') {
    content = Reference{text.substr(1)};
  } else if (split_quantity(text, number, unit)) {
    content = unit.empty() ? Number{number, {}} : Number{number, unit};
  } else {
    content = text;
  }
}

bool was_set(const std::string& origin) { return origin.starts_with("--set "); }

}  // namespace hysteron
