#include "io/formats/cells.h"

#include <algorithm>
#include <cmath>

#include "engine/diagram/number_text.h"

namespace hysteron {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// "1.234.567,8" with groups by '.': each group behind the first has three digits.
bool grouped(std::string_view whole, char group) {
  std::size_t digits = 0;
  bool first = true;
  for (const char c : whole) {
    if (is_digit(c)) {
      ++digits;
      continue;
    }
    if (c != group || digits == 0 || digits > 3 || (!first && digits != 3)) return false;
    first = false;
    digits = 0;
  }
  return !first && digits == 3;
}

/// The text with a point for the decimal sign and without groups; "" where the signs stand in no order that numbers
/// have.
std::string with_point(std::string_view cell, char decimal) {
  const char other = decimal == ',' ? '.' : ',';
  std::string text(cell);
  if (text.find(other) != text.npos) {
    const std::size_t begin = text.find_first_of("0123456789");
    const std::size_t end = std::min(text.find(decimal), text.size());
    if (begin == text.npos || end < begin) return "";
    std::string whole = text.substr(begin, end - begin);
    if (text.find(other, end) != text.npos || !grouped(whole, other)) return "";
    std::erase(whole, other);
    text = text.substr(0, begin) + whole + text.substr(end);
  }
  if (decimal == ',') std::replace(text.begin(), text.end(), ',', '.');
  return text;
}

// ---- times ----------------------------------------------------------------------------------------------------------

/// Walks through the digits and signs of a date or a time of day.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}
  bool end() const { return at_ >= text_.size(); }
  char next() const { return end() ? '\0' : text_[at_]; }
  bool take(char c) { return next() == c && (++at_, true); }
  bool take_any(std::string_view signs) { return !end() && signs.find(next()) != signs.npos && (++at_, true); }
  std::string_view rest() const { return text_.substr(std::min(at_, text_.size())); }
  std::size_t at() const { return at_; }
  void go(std::size_t to) { at_ = to; }
  /// A whole number of at most `most` digits; -1 where there is none.
  int number(std::size_t most, std::size_t* digits = nullptr) {
    int value = 0;
    std::size_t n = 0;
    for (; n < most && is_digit(next()); ++n) value = 10 * value + (text_[at_++] - '0');
    if (digits != nullptr) *digits = n;
    return n == 0 || is_digit(next()) ? -1 : value;
  }
  /// Digits behind a decimal sign as nanoseconds.
  std::int64_t fraction() {
    std::int64_t value = 0, unit = 100'000'000;
    for (; is_digit(next()); ++at_, unit /= 10) value += unit * (text_[at_] - '0');
    return value;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// Days since 1970-01-01 of the Gregorian calendar; nothing for a day that is none.
std::optional<std::int64_t> days_of(int year, int month, int day) {
  constexpr int days_in[] = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (month < 1 || month > 12 || day < 1 || day > days_in[month - 1] || year < 1) return {};
  const std::int64_t y = month > 2 ? year : year - 1;  // years begin in March, so that the leap day is the last one
  const std::int64_t m = (month + 9) % 12;
  return 365 * y + y / 4 - y / 100 + y / 400 + (153 * m + 2) / 5 + day - 1 - 719468;
}

int month_named(std::string_view text) {
  const std::string word = lower_case_of(text.substr(0, 3));
  constexpr std::string_view names = "janfebmaraprmayjunjulaugsepoctnovdec";
  const auto at = word.size() == 3 ? names.find(word) : names.npos;
  return at == names.npos || at % 3 != 0 ? 0 : static_cast<int>(at / 3) + 1;
}

std::optional<std::int64_t> date(Scanner& scan, bool& unclear) {
  std::size_t digits = 0;
  const int first = scan.number(4, &digits);
  if (first < 0) return {};
  const char sign = scan.next();
  if (!scan.take_any("-/.")) return {};
  if (const int month = month_named(scan.rest()); month > 0) {  // 06-Dec-2012
    scan.go(scan.at() + 3);
    if (!scan.take(sign)) return {};
    return days_of(scan.number(4), month, first);
  }
  const int second = scan.number(2);
  if (second < 0 || !scan.take(sign)) return {};
  if (digits == 4) return days_of(first, second, scan.number(2));
  std::size_t year_digits = 0;
  const int third = scan.number(4, &year_digits);
  const int year = year_digits == 2 ? 2000 + third : third;
  if (sign == '.') return days_of(year, second, first);
  unclear = first <= 12 && second <= 12 && first != second;
  return first > 12 ? days_of(year, second, first) : days_of(year, first, second);
}

std::optional<std::int64_t> time_of_day(Scanner& scan) {
  const int hour = scan.number(2);
  if (hour < 0 || hour > 24 || !scan.take(':')) return {};
  const int minute = scan.number(2);
  if (minute < 0 || minute > 59 || !scan.take(':')) return {};
  const int second = scan.number(2);
  if (second < 0 || second > 60) return {};
  std::int64_t ns = ((hour * 60LL + minute) * 60 + second) * 1'000'000'000;
  if (scan.take_any(".,:")) ns += scan.fraction();
  while (scan.take(' ')) {
  }
  const std::string half = lower_case_of(scan.rest().substr(0, 2));
  if ((half == "am" || half == "pm") && hour >= 1 && hour <= 12) {
    scan.go(scan.at() + 2);
    constexpr std::int64_t hours_12 = 12LL * 3600 * 1'000'000'000;
    if (hour == 12) ns -= hours_12;
    if (half == "pm") ns += hours_12;
  }
  return ns;
}

/// "Z", "+02:00": how far the clock stands before the world's.
std::optional<std::int64_t> zone(Scanner& scan) {
  if (scan.take('Z') || scan.end()) return 0;
  const char sign = scan.next();
  if (!scan.take_any("+-")) return {};
  const int hours = scan.number(2);
  scan.take(':');
  const int minutes = scan.end() ? 0 : scan.number(2);
  if (hours < 0 || minutes < 0) return {};
  return (sign == '-' ? -60LL : 60LL) * (60 * hours + minutes) * 1'000'000'000;
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  while (!text.empty()) {
    if (text.front() == ' ' || text.front() == '\t')
      text.remove_prefix(1);
    else if (text.starts_with("\xC2\xA0"))
      text.remove_prefix(2);
    else
      break;
  }
  while (!text.empty()) {
    if (text.back() == ' ' || text.back() == '\t')
      text.remove_suffix(1);
    else if (text.ends_with("\xC2\xA0"))
      text.remove_suffix(2);
    else
      break;
  }
  return text;
}

std::string lower_case_of(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  const auto add = [&](std::string_view cell) {
    cell = without_blanks(cell);
    if (cell.size() > 1 && (cell.front() == '"' || cell.front() == '\'') && cell.back() == cell.front())
      cell = without_blanks(cell.substr(1, cell.size() - 2));
    cells.push_back(cell);
  };
  if (separator == ' ') line = without_blanks(line);
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') quoted = !quoted;
    if (quoted || (c != separator && !(separator == ' ' && c == '\t'))) continue;
    add(line.substr(begin, i - begin));
    if (separator == ' ')
      while (i + 1 < line.size() && (line[i + 1] == ' ' || line[i + 1] == '\t')) ++i;
    begin = i + 1;
  }
  if (!line.empty()) add(line.substr(begin));
}

std::optional<double> cell_number(std::string_view cell, char decimal) {
  if (cell.empty() || cell.find_first_of("0123456789") == cell.npos) return {};
  double value = 0;
  std::size_t length = 0;
  if (cell.find(',') == cell.npos && decimal == '.') {  // nearly all: no copy
    length = read_number(cell, value);
    return length == cell.size() && std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  const std::string text = with_point(cell, decimal);
  length = read_number(text, value);
  return length > 0 && length == text.size() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool says_no_value(std::string_view cell) {
  if (cell.empty()) return true;
  if (cell.size() > 8) return false;
  if (cell.find_first_not_of('-') == cell.npos) return true;
  const std::string word = lower_case_of(cell);
  return is_one_of(word, {"nan", "-nan", "na", "n/a", "#n/a", "null", "none", "nil", "missing", "-nan(ind)", "*", "?"});
}

bool says_overload(std::string_view cell) {
  if (cell.empty() || cell.size() > 12) return false;
  std::string word = lower_case_of(cell);
  if (word.front() == '-' || word.front() == '+') word.erase(0, 1);
  return is_one_of(word, {"ol", "o.l", "0l", "o.l.", "0.l", "ovl", "ovld", "ovf", "overload", "overflow", "over",
                          "overrange", "underrange", "ovrng", "clip", "clipped", "inf", "infinity", "\xE2\x88\x9E"});
}

bool is_overload(double value) { return std::abs(value) >= 9.8e37 && std::abs(value) <= 9.92e37; }

std::optional<ClockTime> clock_time(std::string_view cell) {
  if (cell.size() < 6 || cell.size() > 40 || !is_digit(cell.front())) return {};
  ClockTime time;
  Scanner scan(cell);
  constexpr std::int64_t day = 86'400LL * 1'000'000'000;
  if (const auto days = date(scan, time.order_unclear); days && *days > -100'000 && *days < 100'000) {
    time.has_date = true;
    time.nanoseconds = *days * day;
    if (scan.end()) return time;
    if (!scan.take_any("T ,;_")) return {};
    while (scan.take(' ')) {
    }
  } else {
    scan.go(0);
    time.order_unclear = false;
  }
  const auto clock = time_of_day(scan);
  if (!clock) return {};
  const auto before = zone(scan);
  if (!before || !scan.end()) return {};
  time.has_clock = true;
  time.nanoseconds += *clock - *before;
  return time;
}

}  // namespace hysteron
