#include "fit/compare/trace_tolerance.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr char option[] = "--tolerance";

[[noreturn]] void fail_text(const std::string& written, const std::string& what) {
  fail("bad_command_line", option, fmt::format("\"{}\" is no tolerance of a trace: {}", written, what),
       "write \"y: 2 nm + 0.1 %, 0.1 ms\": signal, absolute and relative part, time; each part may be left out");
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

/// The plus between two terms, not that of "1e+3".
std::size_t plus_of(const std::string& text) {
  for (std::size_t i = 1; i < text.size(); ++i) {
    const bool exponent = i >= 2 && (text[i - 1] == 'e' || text[i - 1] == 'E') &&
                          (std::isdigit(static_cast<unsigned char>(text[i - 2])) != 0 || text[i - 2] == '.');
    if (text[i] == '+' && !exponent) return i;
  }
  return std::string::npos;
}

double read_part(const std::string& written, const std::string& text, std::string& unit) {
  double value = 0;
  if (!split_quantity(text, value, unit) || !(value >= 0) || !std::isfinite(value))
    fail_text(written, fmt::format("\"{}\" is no limit", text));
  return value;
}

void read_term(WrittenTolerance& tolerance, const std::string& text) {
  std::string unit;
  const double value = read_part(tolerance.written, text, unit);
  auto& part = unit == "%" ? tolerance.relative : tolerance.absolute;
  if (part) fail_text(tolerance.written, unit == "%" ? "two relative parts" : "two absolute parts");
  part = unit == "%" ? value / 100 : value;
  if (unit != "%") tolerance.unit = parse_unit(unit, option);
}

}  // namespace

bool WrittenTolerance::fits(const Unit& signal_unit) const {
  return !absolute || *absolute == 0 || unit.dimension == signal_unit.dimension;
}

TraceTolerance WrittenTolerance::in_si(const Unit& axis, const std::string& axis_name) const {
  if (along && !(along_unit.dimension == axis.dimension))
    fail("wrong_unit", option,
         fmt::format("\"{}\": behind the comma stands a tolerance along {}, in {}", written, axis_name,
                     axis.text.empty() ? "1" : axis.text),
         fmt::format("write it in {}, or leave it out", axis.text.empty() ? "1" : axis.text));
  return {unit.difference_to_si(absolute.value_or(0)), relative.value_or(0),
          along ? along_unit.difference_to_si(*along) : 0};
}

WrittenTolerance read_trace_tolerance(const std::string& written) {
  WrittenTolerance tolerance;
  tolerance.written = written;
  std::string rest = written;
  if (const auto colon = rest.rfind(':'); colon != std::string::npos) {
    tolerance.signal = trimmed(rest.substr(0, colon));
    rest = rest.substr(colon + 1);
    if (tolerance.signal.empty()) fail_text(written, "no signal stands before the colon");
  }
  std::string terms = rest;
  if (const auto comma = rest.find(','); comma != std::string::npos) {
    std::string unit;
    if (rest.find(',', comma + 1) != std::string::npos) fail_text(written, "it holds two commas");
    terms = rest.substr(0, comma);
    tolerance.along = read_part(written, trimmed(rest.substr(comma + 1)), unit);
    tolerance.along_unit = parse_unit(unit, option);
  }
  terms = trimmed(terms);
  if (terms.empty() && !tolerance.along) fail_text(written, "it holds no limit");
  while (!terms.empty()) {
    const auto plus = plus_of(terms);
    read_term(tolerance, trimmed(terms.substr(0, plus)));
    if (plus == std::string::npos) break;
    terms = trimmed(terms.substr(plus + 1));
    if (terms.empty()) fail_text(written, "nothing stands behind the plus");
  }
  return tolerance;
}

}  // namespace hysteron
