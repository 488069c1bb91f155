#include "engine/diagram/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace hysteron {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_a_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_'; }

/// "nand" and "inflate" begin like numbers that are words, and are others.
bool is_another_word(std::string_view text, std::size_t length) {
  return length < text.size() && is_of_a_word(text[length]) &&
         text.substr(0, length).find_first_of("0123456789") == std::string_view::npos;
}

/// Of a decimal number beyond what a double holds: whether it is too large (else too small). Its first digit that is
/// not zero stands `place` digits before (after: negative) the point, and the exponent moves that.
bool is_too_large(std::string_view number) {
  const auto exponent_at = std::min(number.find_first_of("eE"), number.size());
  const auto mantissa = number.substr(0, exponent_at);
  const auto point = std::min(mantissa.find('.'), mantissa.size());
  const auto first = std::min(mantissa.find_first_of("123456789"), mantissa.size());
  const auto place = static_cast<double>(point) - static_cast<double>(first);
  double exponent = 0;  // one of many digits, too
  const bool negative = exponent_at + 1 < number.size() && number[exponent_at + 1] == '-';
  for (const char c : number.substr(exponent_at))
    if (is_digit(c)) exponent = 10 * exponent + (c - '0');
  return place + (negative ? -exponent : exponent) > 0;
}

}  // namespace

std::size_t read_number(std::string_view text, double& value) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  const std::string_view number = text.substr(sign);
  if (sign == 1 && (number.empty() || (!is_digit(number.front()) && number.front() != '.' && number.front() != 'i')))
    return 0;  // "+-5"
  const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (status == std::errc::invalid_argument) return 0;
  const auto length = static_cast<std::size_t>(end - number.data());
  if (is_another_word(number, length)) return 0;
  if (status == std::errc::result_out_of_range) {
    const bool large = is_too_large(number.substr(0, length));
    value = std::copysign(large ? std::numeric_limits<double>::infinity() : 0.0, number.front() == '-' ? -1.0 : 1.0);
  }
  return sign + length;
}

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const std::size_t length = read_number(text, value);
  return length > 0 && length == text.size() ? std::optional(value) : std::nullopt;
}

int leading_whole_number(std::string_view text, int otherwise) {
  int value = 0;
  return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc{} ? value : otherwise;
}

double rounded_to_digits(double value, int digits) { return number_of(fmt::format("{:.{}g}", value, digits)).value(); }

}  // namespace hysteron
