#include "app/cli/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "engine/diagram/units.h"

namespace hysteron {

std::string Arguments::text(const std::string& name, const std::string& otherwise) const {
  const auto found = given_.find(name);
  return found == given_.end() || found->second.empty() ? otherwise : found->second.back();
}

std::vector<std::string> Arguments::list(const std::string& name) const {
  const auto found = given_.find(name);
  return found == given_.end() ? std::vector<std::string>{} : found->second;
}

double Arguments::number(const std::string& name, double otherwise) const {
  if (!has(name)) return otherwise;
  const std::string written = text(name);
  const auto value = number_of(written);
  if (!value || !std::isfinite(*value))
    fail("bad_command_line", name, "\"" + written + "\" is no number", "write it as in " + name + "=4");
  return *value;
}

int Arguments::whole_number(const std::string& name, int otherwise, int most) const {
  const double value = number(name, otherwise);
  if (value < 1 || value > most || value != static_cast<int>(value))
    fail("bad_command_line", name, fmt::format("\"{}\" is no whole number from 1 to {}", text(name), most),
         fmt::format("write it as in {}=4", name));
  return static_cast<int>(value);
}

int Arguments::threads() const {
  return whole_number("--threads", std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

double Arguments::seconds(const std::string& name, double otherwise) const {
  if (!has(name)) return otherwise;
  const std::string written = text(name);
  double value = 0;
  std::string unit;
  const std::string cure = fmt::format("write a time such as {0}=\"5 ms\" or {0}=\"2 min\"", name);
  if (!split_quantity(written, value, unit) || !std::isfinite(value))
    fail("bad_command_line", name, "\"" + written + "\" is no time", cure);
  if (unit.empty()) return value;
  const Unit read = parse_unit(unit, name);
  if (!(read.dimension == parse_unit("s").dimension))
    fail("bad_command_line", name, "\"" + written + "\" is no time", cure);
  return read.to_si(value);
}

}  // namespace hysteron
