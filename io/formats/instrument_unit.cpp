#include "io/formats/instrument_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "engine/diagram/error.h"
#include "engine/diagram/units.h"
#include "io/formats/cells.h"

namespace hysteron {
namespace {

struct Spelling {
  std::string_view written, read;
  std::string_view note = "";
};

// What the unit table reads otherwise ("Grad" is a thousand million rad there) or not at all.
constexpr Spelling spellings[] = {
    {"rev/min", "rpm"},
    {"r/min", "rpm"},
    {"U/min", "rpm"},
    {"Umdr/min", "rpm"},
    {"1/min", "1/min"},
    {"min-1", "1/min"},
    {"min^-1", "1/min"},
    {"rev", "cycle"},
    {"revs", "cycle"},
    {"turns", "cycle"},
    {"rev/s", "rps"},
    {"Grad", "deg"},
    {"grd", "deg"},
    {"Grad/s", "deg/s"},
    {"degree", "deg"},
    {"degrees", "deg"},
    {"dps", "deg/s"},
    {"gon", "0.9 deg"},
    {"\xC2\xB0", "deg"},
    {"\xC2\xB0/s", "deg/s"},
    {"\xC2\xB0"
     "C",
     "degC"},
    {"\xC2\xBA"
     "C",
     "degC"},
    {"deg C", "degC"},
    {"deg. C", "degC"},
    {"Celsius", "degC"},
    {"\xC2\xB0"
     "F",
     "degF"},
    {"deg F", "degF"},
    {"\xC2\xB0"
     "K",
     "K"},
    {"Sek", "s"},
    {"Sek.", "s"},
    {"Sekunde", "s"},
    {"Sekunden", "s"},
    {"Std", "h"},
    {"S/s", "1/s"},
    {"ticks", ""},
    {"tick", ""},
    {"tick/s", "1/s"},
    {"ticks/s", "1/s"},
    {"cnt", ""},
    {"cnts", ""},
    {"cts", ""},
    {"count", ""},
    {"counts", ""},
    {"cnt/s", "1/s"},
    {"counts/s", "1/s"},
    {"inc", ""},
    {"incs", ""},
    {"inc/s", "1/s"},
    {"pulses", ""},
    {"pulses/s", "1/s"},
    {"steps", ""},
    {"steps/s", "1/s"},
    {"digit", ""},
    {"digits", ""},
    {"LSB", ""},
    {"bits", ""},
    {"-", ""},
    {"--", ""},
    {"1", ""},
    {"none", ""},
    {"n/a", ""},
    {"a.u.", ""},
    {"A.U.", ""},
    {"au", ""},
    {"arb", ""},
    {"arb.", ""},
    {"arb. units", ""},
    {"unitless", ""},
    {"dimensionless", ""},
    {"VDC", "V"},
    {"Vdc", "V"},
    {"V DC", "V"},
    {"ADC", "A"},
    {"Vpk", "V"},
    {"Vp", "V"},
    {"VAC", "V", "an alternating voltage is taken as written"},
    {"Vrms", "V", "a root mean square is taken as written"},
    {"VRMS", "V", "a root mean square is taken as written"},
    {"Arms", "A", "a root mean square is taken as written"},
    {"strain", ""},
    {"m/m", ""},
    {"mm/mm", ""},
    {"ustrain", "1e-6"},
    {"\xC2\xB5\xCE\xB5", "1e-6"},
    {"\xCE\xBC\xCE\xB5", "1e-6"},
    {"gn", "gravity"},
    {"g0", "gravity"},
    {"mg0", "0.001 gravity"},
    {"Ncm", "N.cm"},
    {"Nmm", "N.mm"},
    {"Gs", "gauss"},
    {"in-lb", "inch.lbf"},
    {"ft-lb", "foot.lbf"},
    {"lb-ft", "foot.lbf"},
    {"hPa", "hPa"},
    {"sec.", "s"},
};

// Whatever their capitals.
constexpr Spelling unit_words[] = {
    {"volt", "V"},   {"volts", "V"},     {"ampere", "A"},     {"amperes", "A"},   {"amp", "A"},     {"amps", "A"},
    {"second", "s"}, {"seconds", "s"},   {"sec", "s"},        {"secs", "s"},      {"watt", "W"},    {"watts", "W"},
    {"newton", "N"}, {"newtons", "N"},   {"celsius", "degC"}, {"kelvin", "K"},    {"ohms", "ohm"},  {"meter", "m"},
    {"metre", "m"},  {"degrees", "deg"}, {"radian", "rad"},   {"radians", "rad"}, {"percent", "%"}, {"hertz", "Hz"}};

constexpr std::string_view metric_prefixes[] = {"", "m", "u", "n", "k", "M", "c"};

std::optional<Spelling> spelling_of(std::string_view text) {
  for (const auto& s : spellings)
    if (s.written == text) return s;
  const std::string lower = lower_case_of(text);
  for (const auto& s : unit_words)
    if (s.written == lower) return s;
  return {};
}

bool is_parsed(std::string_view text) {
  try {
    parse_unit(text);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// "mNm" is a thousandth of a newton metre.
std::string torque(std::string_view text) {
  if (!text.ends_with("Nm")) return "";
  const auto prefix = text.substr(0, text.size() - 2);
  if (std::find(std::begin(metric_prefixes), std::end(metric_prefixes), prefix) == std::end(metric_prefixes)) return "";
  return fmt::format("{}N.m", prefix);
}

bool holds_any(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* w) { return text.find(w) != text.npos; });
}

/// Micro, degree and power signs as ASCII, so that what is written is read everywhere.
std::string in_ascii(std::string_view text) {
  std::string ascii;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto rest = text.substr(i);
    const auto is = [&](std::string_view sign) { return rest.starts_with(sign); };
    if (is("\xC2\xB5") || is("\xCE\xBC"))
      ascii += 'u', ++i;
    else if (is("\xC2\xB2"))
      ascii += "^2", ++i;
    else if (is("\xC2\xB3"))
      ascii += "^3", ++i;
    else if (is("\xC2\xB7"))
      ascii += '.', ++i;
    else if (is("\xCE\xA9"))
      ascii += "ohm", ++i;
    else if (is("\xE2\x84\xA6"))
      ascii += "ohm", i += 2;
    else
      ascii += text[i];
  }
  return ascii;
}

/// A letter that is one unit on a balance and another on an accelerometer, or "C" on a thermometer.
std::optional<InstrumentUnit> of_two_meanings(const std::string& text, std::string_view column) {
  const std::string name = lower_case_of(column);
  const bool kilo = text == "mg" || text == "kg";
  if (text == "g" || text == "mg") {
    const bool accelerates = holds_any(name, {"acc", "besch", "vib", "imu"}) || name == "a" || name.starts_with("a_");
    const bool weighs = holds_any(name, {"mass", "weight", "masse", "gewicht", "load", "balance", "waage"});
    const std::string gravity = kilo ? "0.001 gravity" : "gravity";
    if (accelerates && !weighs)
      return InstrumentUnit{UnitAnswer::known, gravity, fmt::format("[{}] is the acceleration of free fall", text), ""};
    if (weighs && !accelerates) return InstrumentUnit{UnitAnswer::known, text, "", ""};
    return InstrumentUnit{UnitAnswer::ambiguous, "",
                          fmt::format("[{}] may be grams or the acceleration of free fall", text),
                          fmt::format("gram, or gravity")};
  }
  if (text == "C" && holds_any(name, {"temp", "therm", "heiz"}))
    return InstrumentUnit{UnitAnswer::known, "degC", "[C] is degC", ""};
  return {};
}

}  // namespace

InstrumentUnit instrument_unit(std::string_view text, std::string_view column, bool is_time) {
  text = without_blanks(text);
  if (text.size() > 1 && (text.front() == '(' || text.front() == '[') && (text.back() == ')' || text.back() == ']'))
    text = without_blanks(text.substr(1, text.size() - 2));
  if (text.empty()) return {UnitAnswer::known, "", "", ""};
  const std::string ascii = in_ascii(text);
  if (is_time)  // instruments write S, mS, uS, NS for seconds
    for (const char* second : {"s", "ms", "us", "ns", "ps"})
      if (lower_case_of(ascii) == second)
        return {UnitAnswer::known, second, ascii == second ? "" : fmt::format("[{}] is [{}]", text, second), ""};
  const std::string lower = lower_case_of(ascii);
  if (lower == "db" || lower.starts_with("dbm") || lower.starts_with("dbv") || lower.starts_with("dbu") ||
      lower.starts_with("db(") || lower == "dbfs" || lower == "neper")
    return {UnitAnswer::refused, "", fmt::format("[{}] is a logarithm of a ratio, and a signal here is none", text),
            "convert the column, such as 10^(dB/20)"};
  if (auto two = of_two_meanings(ascii, column)) return *two;
  if (const auto spelling = spelling_of(text))
    return {UnitAnswer::known, std::string(spelling->read), std::string(spelling->note), ""};
  if (const std::string moment = torque(ascii); !moment.empty()) return {UnitAnswer::known, moment, "", ""};
  if (is_parsed(ascii)) return {UnitAnswer::known, ascii, "", ""};
  return {};
}

bool looks_like_unit(std::string_view text) {
  text = without_blanks(text);
  if (text.size() > 2 && ((text.front() == '(' && text.back() == ')') || (text.front() == '[' && text.back() == ']')))
    return true;
  static constexpr std::array<std::string_view, 40> alone{
      "s",   "ms",       "us",  "ns", "min", "V",  "mV",  "uV", "kV", "A",  "mA",  "uA",  "N", "kN",
      "mN",  "m",        "mm",  "um", "nm",  "cm", "rad", "%",  "Pa", "Hz", "kHz", "bar", "W", "degC",
      "deg", "\xC2\xB0", "rpm", "K",  "S",   "mS", "uS",  "C",  "g",  "kg", "-",   "1"};
  if (std::find(alone.begin(), alone.end(), text) != alone.end()) return true;
  return spelling_of(text).has_value() || !torque(text).empty() ||
         (text.size() > 2 && text.find('/') != text.npos && instrument_unit(text).answer == UnitAnswer::known) ||
         text.starts_with("\xC2\xB5") || text.starts_with("\xCE\xBC");
}

}  // namespace hysteron
