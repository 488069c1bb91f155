// Decides how a number of an effect file is meant where it depends on the wire.
#include "discover/hypotheses/effect_quantity.h"

#include <fmt/format.h>

#include <algorithm>

#include "discover/hypotheses/effect_terms.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

/// A word, in the unit in which its number is written.
struct Measured {
  double value = 0;
  std::string unit;
};

/// A difference of the wire or of the side signal, in the unit that people wrote; of degC: K.
Measured difference(double si, const Unit& unit) {
  const Unit plain = unit.offset == 0 && !unit.text.empty() ? unit : si_unit(unit.dimension);
  return {plain.difference_from_si(si), plain.dimension.none() ? "" : effects::unit_text(plain)};
}

Measured time(double seconds) { return {seconds, "s"}; }

bool is_level(const std::string& word) {
  return word == "lowest" || word == "middle" || word == "highest" || word == "side_middle";
}

double level_si(const std::string& word, const Excitation& at) {
  if (word == "lowest") return at.lowest;
  if (word == "highest") return at.highest;
  if (word == "middle") return 0.5 * (at.lowest + at.highest);
  return 0.5 * (at.side_lowest + at.side_highest);
}

Measured measured(const std::string& word, const Excitation& at) {
  if (word == "range") return difference(at.range(), at.unit);
  if (word == "side_range") return difference(at.side_highest - at.side_lowest, at.side_unit);
  if (word == "row") return time(at.shortest_step);
  if (word == "recording") return time(at.longest_recording);
  return time(at.longest_hold);
}

}  // namespace

std::vector<std::string> EffectQuantity::words() {
  return {"range", "row", "recording", "hold", "side_range", "lowest", "middle", "highest", "side_middle"};
}

EffectQuantity::EffectQuantity(const std::string& text, const std::string& path) {
  std::string rest;
  if (!split_quantity(text, number_, rest))
    fail("bad_value", path, fmt::format("\"{}\" does not begin with a number", text),
         "write e.g. \"0.2 ms\", \"0.1 range\" or \"1 row\"");
  const auto known = words();
  const auto is_word = [&](const std::string& t) { return std::find(known.begin(), known.end(), t) != known.end(); };
  bool below = false;
  std::size_t i = 0;
  while (i < rest.size()) {
    const auto end = std::min(rest.find_first_of("*/ ", i), rest.size());
    const std::string token = rest.substr(i, end - i);
    if (!token.empty() && token != "1") {
      factors_.push_back({token, is_word(token), below});
      relative_ = relative_ || factors_.back().word;
    }
    if (end < rest.size()) below = rest[end] == '/' || (rest[end] == ' ' && token.empty() && below);
    i = end + 1;
  }
  if (!relative_) {  // an ordinary unit, with whatever udunits knows of exponents and brackets
    (void)parse_unit(rest, path);
    factors_.clear();
    if (!rest.empty()) factors_.push_back({rest, false, false});
    return;
  }
  for (const auto& f : factors_) {
    if (!f.word) (void)parse_unit(f.text, path);
    if (f.word && is_level(f.text) && (factors_.size() > 1 || f.below))
      fail("bad_value", path, fmt::format("\"{}\" is a level: it is no factor", f.text),
           "write it alone, or use \"range\" or \"side_range\"");
  }
}

Unit EffectQuantity::unit() const { return factors_.empty() ? Unit{} : parse_unit(factors_.front().text); }

Number EffectQuantity::number(const Excitation& at) const {
  if (!relative_) return factors_.empty() ? Number{number_, {}} : Number{number_, factors_.front().text};
  if (is_level(factors_.front().text)) {
    const bool side = factors_.front().text == "side_middle";
    Number n = effects::level(number_ * level_si(factors_.front().text, at), side ? at.side_unit : at.unit);
    if (n.unit == "1") n.unit.reset();
    return n;
  }
  double value = number_;
  std::string above, under;
  for (const auto& f : factors_) {
    const Measured m = f.word ? measured(f.text, at) : Measured{1, f.text};
    const double size = m.value > 0 ? m.value : 1;  // what stands still is refused elsewhere; here nothing divides by 0
    value = f.below ? value / size : value * size;
    if (m.unit.empty() || m.unit == "1") continue;
    const std::string bracketed = m.unit.find_first_of("/* ") == std::string::npos ? m.unit : "(" + m.unit + ")";
    if (f.below)
      under += "/" + bracketed;
    else
      above += (above.empty() ? "" : "*") + bracketed;
  }
  if (above.empty() && !under.empty()) above = "1";
  Number n{effects::rounded(value), {}};
  if (!above.empty()) n.unit = above + under;
  return n;
}

double EffectQuantity::si(const Excitation& at) const {
  const Number n = number(at);
  return n.unit ? parse_unit(*n.unit).to_si(n.value) : n.value;
}

}  // namespace hysteron
