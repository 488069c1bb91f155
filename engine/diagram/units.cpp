#include "engine/diagram/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "engine/diagram/unit_table.h"

namespace hysteron {
namespace {

constexpr std::array<const char*, 9> base_symbols{"m", "kg", "s", "A", "K", "mol", "cd", "rad", "cycle"};
constexpr std::size_t radian = 7;
constexpr std::size_t cycle = 8;
constexpr char degree_definition[] = "(3.14159265358979323846264338327950288/180) rad";

struct UnitFree {
  void operator()(ut_unit* u) const { ut_free(u); }
};
using UnitPointer = std::unique_ptr<ut_unit, UnitFree>;

/// A unit that is known before the table is read: what the table says of it.
struct CommonUnit {
  const char* symbol;
  const char* definition;
};

// As in the table. Only symbols whose combinations with the prefixes below mean the same there (a test tries them all):
// no "h", since "ph" is a phot there.
constexpr CommonUnit common_units[] = {
    {"g", "1e-3 kg"}, {"N", "m.kg/s^2"}, {"Pa", "N/m^2"},        {"J", "N.m"},   {"W", "J/s"},    {"C", "s.A"},
    {"V", "W/A"},     {"F", "C/V"},      {"S", "A/V"},           {"Wb", "V.s"},  {"T", "Wb/m^2"}, {"H", "Wb/A"},
    {"min", "60 s"},  {"%", "0.01"},     {"degC", "K @ 273.15"}, {"ohm", "V/A"},
};
struct CommonPrefix {
  const char* symbol;
  double value;
};
constexpr CommonPrefix common_prefixes[] = {{"G", 1e9},  {"M", 1e6},  {"k", 1e3},  {"d", .1},   {"c", .01},
                                            {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}, {"p", 1e-12}};

/// A unit table with our additions, and every unit that was read from it. Used under a lock.
class Table {
 public:
  /// All of udunits2's units, which costs milliseconds of parsing XML; or those of a usual diagram, which cost next to
  /// nothing: the same parser with a short list.
  explicit Table(bool all) {
    ut_set_error_message_handler(ut_ignore);
    if (all)
      read_all();
    else
      list_common();
    const UnitPointer second(ut_get_unit_by_symbol(system_, "s"));
    const UnitPointer hertz(ut_divide(cycle_.get(), second.get()));
    ut_map_symbol_to_unit("Hz", UT_ASCII, hertz.get());
    ut_map_name_to_unit("hertz", UT_ASCII, hertz.get());
    if (const UnitPointer degree(ut_parse(system_, all ? "arc_degree" : degree_definition, UT_UTF8)); degree)
      ut_map_name_to_unit("deg", UT_ASCII, degree.get());
  }

  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  /// Not left to the end of the process: the library of an FMU may be unloaded before.
  ~Table() {
    cycle_.reset();
    ut_free_system(system_);
  }

  void learn(const Unit& unit) { cache_.emplace(unit.text, unit); }

  /// nullptr if the text is no unit of this table.
  const Unit* find(const std::string& text) {
    if (const auto found = cache_.find(text); found != cache_.end()) return &found->second;
    Unit unit;
    unit.text = text;
    if (!text.empty()) {
      const UnitPointer parsed(ut_parse(system_, text.c_str(), UT_UTF8));
      if (!parsed) return nullptr;
      collect(parsed.get(), unit);
    }
    return &cache_.emplace(text, unit).first->second;
  }

 private:
  void read_all() {
    system_ = ut_read_xml(nullptr);
    if (system_ == nullptr) throw std::runtime_error("udunits2's unit table cannot be read");
    cycle_.reset(ut_new_base_unit(system_));
    ut_unmap_symbol_to_unit(system_, "Hz", UT_ASCII);
    ut_unmap_name_to_unit(system_, "hertz", UT_ASCII);
  }

  void list_common() {
    system_ = ut_new_system();
    if (system_ == nullptr) throw std::runtime_error("udunits2 cannot make a unit system");
    for (std::size_t i = 0; i < radian; ++i) name_base(UnitPointer(ut_new_base_unit(system_)), base_symbols[i]);
    name_base(UnitPointer(ut_new_dimensionless_unit(system_)), base_symbols[radian]);
    cycle_.reset(ut_new_base_unit(system_));
    for (const auto& prefix : common_prefixes) ut_add_symbol_prefix(system_, prefix.symbol, prefix.value);
    for (const auto& unit : common_units) {
      const UnitPointer parsed(ut_parse(system_, unit.definition, UT_ASCII));
      ut_map_symbol_to_unit(unit.symbol, UT_ASCII, parsed.get());
    }
  }

  static void name_base(const UnitPointer& unit, const char* symbol) {
    ut_map_symbol_to_unit(symbol, UT_ASCII, unit.get());
    ut_map_unit_to_symbol(unit.get(), symbol, UT_ASCII);
  }

  void collect(const ut_unit* parsed, Unit& unit) {
    struct Found {
      Table* table;
      Unit* unit;
      const ut_unit* underlying;
    } found{this, &unit, nullptr};
    ut_visitor visitor{};
    visitor.visit_basic = [](const ut_unit* u, void* arg) {
      auto* f = static_cast<Found*>(arg);
      f->unit->dimension.power[f->table->base_index(u)] = 1;
      return UT_SUCCESS;
    };
    visitor.visit_product = [](const ut_unit*, int count, const ut_unit* const* units, const int* powers, void* arg) {
      auto* f = static_cast<Found*>(arg);
      for (int i = 0; i < count; ++i)
        f->unit->dimension.power[f->table->base_index(units[i])] = static_cast<std::int8_t>(powers[i]);
      return UT_SUCCESS;
    };
    visitor.visit_galilean = [](const ut_unit*, double, const ut_unit* underlying, double, void* arg) {
      static_cast<Found*>(arg)->underlying = underlying;
      return UT_SUCCESS;
    };
    visitor.visit_timestamp = [](const ut_unit*, const ut_unit*, double, void*) { return UT_BAD_ARG; };
    visitor.visit_logarithmic = [](const ut_unit*, double, const ut_unit*, void*) { return UT_BAD_ARG; };
    if (ut_accept_visitor(parsed, &visitor, &found) != UT_SUCCESS)
      fail("bad_unit", "unit", fmt::format("\"{}\" is a logarithmic or calendar unit", unit.text), "use a linear unit");
    if (found.underlying == nullptr) return;
    const std::unique_ptr<cv_converter, void (*)(cv_converter*)> converter(
        ut_get_converter(const_cast<ut_unit*>(parsed), const_cast<ut_unit*>(found.underlying)), cv_free);
    unit.offset = cv_convert_double(converter.get(), 0.0);
    unit.scale = cv_convert_double(converter.get(), 1.0) - unit.offset;
    if (unit.offset == 0.0) unit.scale = cv_convert_double(converter.get(), 1.0);
    Unit base;
    base.text = unit.text;
    collect(found.underlying, base);
    unit.dimension = base.dimension;
  }

  std::size_t base_index(const ut_unit* u) const {
    if (ut_compare(u, cycle_.get()) == 0) return cycle;
    const char* symbol = ut_get_symbol(u, UT_ASCII);
    for (std::size_t i = 0; symbol != nullptr && i < base_symbols.size(); ++i)
      if (std::string_view(base_symbols[i]) == symbol) return i;
    throw std::runtime_error("unknown base unit in udunits2's table");
  }

  ut_system* system_ = nullptr;
  UnitPointer cycle_;
  std::map<std::string, Unit> cache_;
};

/// Whether a unit says an origin of its own ("um @ 5", "s since 2000"): udunits2 shifts by it, and a change in such a
/// unit would have lost it. Temperatures have their names (degC).
bool has_written_origin(std::string_view text) {
  if (text.find('@') != text.npos) return true;
  std::string word;
  for (const char c : std::string(text) + " ") {
    if (c != ' ' && c != '\t') {
      word += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
      continue;
    }
    for (const char* origin : {"since", "after", "from", "ref"})
      if (word == origin) return true;
    word.clear();
  }
  return false;
}

}  // namespace

Dimension operator*(const Dimension& a, const Dimension& b) {
  Dimension r;
  for (std::size_t i = 0; i < r.power.size(); ++i) r.power[i] = static_cast<std::int8_t>(a.power[i] + b.power[i]);
  return r;
}

Dimension operator/(const Dimension& a, const Dimension& b) {
  Dimension r;
  for (std::size_t i = 0; i < r.power.size(); ++i) r.power[i] = static_cast<std::int8_t>(a.power[i] - b.power[i]);
  return r;
}

std::string to_text(const Dimension& d) {
  std::string text;
  for (std::size_t i = 0; i < d.power.size(); ++i) {
    if (d.power[i] == 0) continue;
    if (!text.empty()) text += ' ';
    text += d.power[i] == 1 ? base_symbols[i] : fmt::format("{}^{}", base_symbols[i], static_cast<int>(d.power[i]));
  }
  return text.empty() ? "1" : text;
}

namespace {

/// What parse_unit() knows.
struct KnownUnits {
  std::mutex mutex;
  Table common{false};
  std::unique_ptr<Table> all;
  std::vector<std::map<std::string, Unit>*> logs{};
};

KnownUnits& known_units() {
  static KnownUnits known;
  return known;
}

}  // namespace

Unit parse_unit(std::string_view text, const std::string& path) {
  auto& [mutex, common, all, logs] = known_units();
  const std::lock_guard lock(mutex);
  const auto first = text.find_first_not_of(' ');
  const auto last = text.find_last_not_of(' ');
  const std::string trimmed(first == std::string_view::npos ? "" : text.substr(first, last - first + 1));
  if (has_written_origin(trimmed))
    fail("bad_unit", path, fmt::format("\"{}\" counts from an origin of its own, which a number here cannot", trimmed),
         "write the unit alone and take the origin into the number; temperatures may be in degC or degF");
  if (const Unit* unit = common.find(trimmed)) return *unit;
  if (!all) all = std::make_unique<Table>(true);
  if (const Unit* unit = all->find(trimmed)) {
    for (auto* log : logs) log->emplace(trimmed, *unit);
    return *unit;
  }
  const bool decimal_comma = trimmed.size() > 1 && trimmed[0] == ',' && trimmed[1] >= '0' && trimmed[1] <= '9';
  fail("bad_unit", path, fmt::format("\"{}\" is not a unit", trimmed),
       decimal_comma
           ? "write decimals with a point, not with a comma: 0.8"
           : "write SI or derived units with prefixes, e.g. \"um\", \"V/um\", \"1/s\", \"Hz\", \"deg\", \"degC\"");
}

UnitLog::UnitLog() {
  const std::lock_guard lock(known_units().mutex);
  known_units().logs.push_back(&found_);
}

UnitLog::~UnitLog() {
  const std::lock_guard lock(known_units().mutex);
  std::erase(known_units().logs, &found_);
}

std::vector<Unit> UnitLog::units() const {
  const std::lock_guard lock(known_units().mutex);
  std::vector<Unit> list;
  for (const auto& [text, unit] : found_) list.push_back(unit);
  return list;
}

void learn_units(const std::vector<Unit>& units) {
  const std::lock_guard lock(known_units().mutex);
  for (const auto& unit : units) known_units().common.learn(unit);
}

Unit parse_unit_in_full_table(std::string_view text) {
  static std::mutex mutex;
  static Table all(true);
  const std::lock_guard lock(mutex);
  const Unit* unit = all.find(std::string(text));
  return unit == nullptr ? Unit{"", {}, 0, 0} : *unit;
}

std::vector<std::string> common_unit_symbols() {
  std::vector<std::string> list{"Hz", "deg"};
  for (std::size_t i = 0; i <= radian; ++i) list.emplace_back(base_symbols[i]);
  for (const auto& unit : common_units) list.emplace_back(unit.symbol);
  return list;
}

std::vector<std::string> common_unit_prefixes() {
  std::vector<std::string> list;
  for (const auto& prefix : common_prefixes) list.emplace_back(prefix.symbol);
  return list;
}

double dimension_factor(const Dimension& from, const Dimension& to) {
  if (from == to) return 1;
  Dimension a = from;
  Dimension b = to;
  // Angles: a cycle is 2 pi rad where the other side says rad; rad itself may be left out (SI), a cycle may not.
  const int cycles = a.power[cycle] - b.power[cycle];
  const int radians = b.power[radian] - a.power[radian];
  a.power[cycle] = b.power[cycle] = a.power[radian] = b.power[radian] = 0;
  if (!(a == b)) return 0;
  if (cycles == 0) return 1;
  if (cycles != radians) return 0;
  return std::pow(2 * std::numbers::pi, cycles);
}

bool split_quantity(std::string_view text, double& number, std::string& unit) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  const std::size_t length = read_number(text, number);
  if (length == 0) return false;
  auto rest = text.substr(length);
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  while (!rest.empty() && rest.back() == ' ') rest.remove_suffix(1);
  unit = std::string(rest);
  return true;
}

namespace {

/// What engineers call the units of what flows through their diagrams. A torque, and not an energy, is a signal.
const std::vector<Unit>& named_units() {
  static const std::vector<Unit> all = [] {
    std::vector<Unit> units;
    for (const char* text : {"Hz", "N", "V", "N m", "W", "Pa", "C", "ohm", "F", "H", "Wb", "T", "N/m", "N m/rad",
                             "N m s/rad", "N/V", "N/A", "V/m", "m/V"})
      units.push_back(parse_unit(text));
    // What curves, springs that stiffen and limits of a rate make of a signal.
    for (const std::string signal : {"V", "N", "Pa"}) {
      units.push_back(parse_unit(signal + "/s"));
      units.push_back(parse_unit("1/" + signal));
      for (const char* power : {"2", "3", "4"}) units.push_back(parse_unit("1/" + signal + "^" + power));
    }
    return units;
  }();
  return all;
}

}  // namespace

Unit si_unit(const Dimension& d) {
  Unit unit;
  unit.dimension = d;
  if (d.none()) return unit;
  // Products first, then quotients, in a form that udunits2 reads back: "kg m/s^2".
  std::string above;
  std::string below;
  for (std::size_t i = 0; i < d.power.size(); ++i) {
    const int n = d.power[i];
    if (n == 0) continue;
    std::string& side = n > 0 ? above : below;
    if (!side.empty()) side += ' ';
    side += std::abs(n) == 1 ? base_symbols[i] : fmt::format("{}^{}", base_symbols[i], std::abs(n));
  }
  unit.text = below.empty() ? above
                            : fmt::format("{}/{}", above.empty() ? "1" : above,
                                          below.find(' ') == std::string::npos ? below : "(" + below + ")");
  for (const auto& named : named_units())
    if (named.dimension == d) return named;
  return unit;
}

}  // namespace hysteron
