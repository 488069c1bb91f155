#include "io/formats/heading.h"

#include <algorithm>
#include <array>

#include "io/formats/cells.h"
#include "io/formats/instrument_unit.h"

namespace hysteron {
namespace {

bool is_unit(std::string_view text) {
  const auto answer = instrument_unit(text).answer;
  return !without_blanks(text).empty() && answer != UnitAnswer::unknown;
}

/// "tilt[1]" is an element of a vector.
bool is_index(std::string_view text, std::size_t open) {
  return open > 0 && text[open - 1] != ' ' && text[open] == '[' && open + 2 < text.size() &&
         text.find_first_not_of("0123456789", open + 1) == text.size() - 1;
}

Heading with_unit(std::string_view name, std::string_view unit) {
  return {std::string(without_blanks(name)), std::string(without_blanks(unit)), true};
}

/// The letters and digits of a name, in small letters, words apart by one blank.
std::string plain(std::string_view name) {
  std::string text;
  for (const char c : lower_case_of(name)) {
    const bool sign = (c >= ' ' && c < '0') || (c > '9' && c < 'a') || c > 'z';
    if (!sign)
      text += c;
    else if (!text.empty() && text.back() != ' ')
      text += ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

template <std::size_t n>
bool is_one_of(const std::string& word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

Heading heading_of(std::string_view text) {
  text = without_blanks(text);
  for (const auto& [opening, closing] : {std::pair('[', ']'), {'(', ')'}}) {
    const auto open = text.rfind(opening);
    if (open == text.npos || text.back() != closing || is_index(text, open)) continue;
    const auto inside = text.substr(open + 1, text.size() - open - 2);
    if (opening == '[' || is_unit(inside)) return with_unit(text.substr(0, open), inside);
  }
  if (text.starts_with("in ") && is_unit(text.substr(3))) return with_unit("", text.substr(3));
  if (const auto in = text.rfind(" in "); in != text.npos && is_unit(text.substr(in + 4)))
    return with_unit(text.substr(0, in), text.substr(in + 4));
  if (const auto slash = text.find('/'); slash != text.npos && slash > 0) {
    const auto before = without_blanks(text.substr(0, slash)), behind = text.substr(slash + 1);
    const bool apart = text[slash - 1] == ' ';
    if (is_unit(behind) && (apart || before.size() == 1 || !is_unit(text))) return with_unit(before, behind);
  }
  return {std::string(text), "", false};
}

bool is_time_name(std::string_view name) {
  static constexpr std::array<std::string_view, 33> names{
      "t",         "time",      "zeit",          "temps",      "tiempo",
      "tempo",     "tid",       "timestamp",     "time stamp", "zeitstempel",
      "uhrzeit",   "date time", "datetime",      "elapsed",    "elapsed time",
      "x value",   "trace x",   "seconds",       "second",     "sekunden",
      "sec",       "rel time",  "relative time", "time rel",   "zeit relativ",
      "zeitachse", "time axis", "timebase",      "messzeit",   "time s",
      "time ms",   "t s",       "t ms"};
  return name != "T" && is_one_of(plain(name), names);  // which is a temperature
}

bool is_counter_name(std::string_view name) {
  static constexpr std::array<std::string_view, 14> names{"x",      "sequence", "sample", "samples",      "index",
                                                          "no",     "nr",       "row",    "point",        "points",
                                                          "number", "count",    "scan",   "sample number"};
  return name == "#" || is_one_of(plain(name), names);
}

}  // namespace hysteron
