#include "blocks/vectors/element_units.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/diagram/error.h"
#include "engine/diagram/units.h"

namespace hysteron::blocks {

std::vector<std::string> units_of_elements(const std::string& text, int elements) {
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(',', begin), text.size());
    std::string unit = text.substr(begin, end - begin);
    unit.erase(0, unit.find_first_not_of(' '));
    unit.erase(unit.find_last_not_of(' ') + 1);
    list.push_back(std::move(unit));
    begin = end + 1;
  }
  if (list.size() == 1) list.resize(static_cast<std::size_t>(elements), list.front());
  return list;
}

std::string wrong_units(const std::vector<std::string>& units, int elements, const char* parameter) {
  if (static_cast<int>(units.size()) != elements)
    return fmt::format("\"{}\" names {} units for {} elements; name one for all, or one for each", parameter,
                       units.size(), elements);
  for (const auto& unit : units) try {
      parse_unit(unit);
    } catch (const Error& error) {
      return fmt::format("\"{}\": {}", parameter, error.problems.front().what);
    }
  return "";
}

double* note_scales(const View<double>& v, int text_parameter, int elements, double* out) {
  std::string text;
  for (const double code : v.list(text_parameter)) text += static_cast<char>(code);
  for (const auto& name : units_of_elements(text, elements)) {
    const Unit unit = parse_unit(name);
    *out++ = unit.scale;
    *out++ = unit.offset;
  }
  return out;
}

}  // namespace hysteron::blocks
