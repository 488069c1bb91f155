// Decides how a structure that no effect describes is told: when, how regularly, on what; and what to record to learn
// more of it. Does not find it (structure.h).
#include <fmt/format.h>

#include <algorithm>

#include "discover/narrate/words.h"

namespace hysteron {
namespace {

constexpr std::size_t few = 5;  // gaps, below which nothing is said of their rhythm

std::string in_unit(double number, const Unit& unit) {
  return unit.text.empty() ? fmt::format("{:.4g}", number) : fmt::format("{:.4g} {}", number, unit.text);
}
std::string difference_text(double si, const Unit& unit) { return in_unit(unit.difference_from_si(si), unit); }
std::string level_text(const Structure& s) {
  return fmt::format("{} = {}", s.variable, in_unit(s.unit.from_si(s.threshold), s.unit));
}

std::string where_most_are(const Structure& s) {
  const auto most = std::max_element(s.intervals.begin(), s.intervals.end(),
                                     [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  std::size_t all = 0;
  for (const auto& [recording, list] : s.intervals) all += list.size();
  const auto& [recording, list] = *most;
  if (all == 1) return fmt::format("There is one, in {}, at {:.4g} s.", recording, list.front().first);
  const std::string when = list.size() == 1 ? fmt::format("at {:.4g} s", list.front().first)
                                            : fmt::format("the first at {:.4g} s, the last at {:.4g} s",
                                                          list.front().first, list.back().first);
  if (s.intervals.size() == 1) return fmt::format("All {} {} are in {}, {}.", all, s.kind, recording, when);
  return fmt::format("Of {} {} most are in {}: {}, {}.", all, s.kind, recording, list.size(), when);
}

/// How long after each other they begin, within a recording; "" where they are too few.
std::string rhythm(const Structure& s) {
  std::vector<double> gaps;
  for (const auto& [recording, list] : s.intervals)
    for (std::size_t i = 1; i < list.size(); ++i) gaps.push_back(list[i].first - list[i - 1].first);
  if (gaps.size() < few) return "";
  std::sort(gaps.begin(), gaps.end());
  const double quarter = gaps[gaps.size() / 4], middle = gaps[gaps.size() / 2], rest = gaps[gaps.size() * 3 / 4];
  // Chance spreads the middle half over ln 3/ln 2 = 1.6 times the median; a tenth of that one is a rhythm.
  if (rest - quarter <= 0.1 * middle)
    return fmt::format("The {} are periodic: half of the intervals between them are {:.4g} .. {:.4g} s.", s.kind,
                       quarter, rest);
  return fmt::format(
      "The {} are not periodic: the intervals between them are {:.4g} .. {:.4g} s, with a median of {:.4g} s.", s.kind,
      gaps.front(), gaps.back(), middle);
}

std::string lasting(const Structure& s) {
  double least = 1e300, most = 0;
  for (const auto& [recording, list] : s.intervals)
    for (const auto& [from, to] : list) {
      least = std::min(least, to - from);
      most = std::max(most, to - from);
    }
  return fmt::format("A burst lasts {:.3g} .. {:.3g} s.", least, most);
}

std::string follows(const Structure& s) {
  if (s.harmonic > 0)
    return "It is a harmonic of the drive: it comes from the motion (a nonlinear characteristic, hysteresis, friction or a limit), not from outside.";
  if (s.kind == "line_in_time")
    return fmt::format(
        "It repeats every {} in all recordings, whatever the inputs do; amplitude and phase were fitted in each.",
        difference_text(s.period, s.unit));
  if (s.kind == "line_in_level")
    return fmt::format(
        "It repeats every {} of {}: fitted on the train recordings, it lies at the same levels in the others.",
        difference_text(s.period, s.unit), s.variable);
  if (s.kind == "kink_at_level" && s.passed_once_at > 0)
    return fmt::format(
        "{} is passed only once in each recording, about {:.3g} s after its start, so these recordings cannot tell a cause at that level from one at that time.",
        level_text(s), s.passed_once_at);
  if (s.kind == "kink_at_level")
    return fmt::format(
        "The step and the change of slope at {} were fitted on the train recordings and hold in the others: they belong to that level, not to a time.",
        level_text(s));
  return s.has_threshold ? fmt::format("They happen at {}, whenever it is passed.", level_text(s)) : "";
}

}  // namespace

std::vector<std::string> structure_sentences(const Structure& s) {
  std::vector<std::string> list;
  const auto say = [&](std::string sentence) {
    if (!sentence.empty()) list.push_back(std::move(sentence));
  };
  say(follows(s));
  if (s.intervals.empty()) return list;
  say(where_most_are(s));
  say(rhythm(s));
  if (s.kind == "bursts") say(lasting(s));
  return list;
}

std::string what_to_record(const Structure* left) {
  if (left == nullptr)
    return "Record longer, with each input moved by itself (slowly and fast, by small and large strokes, and held), and add columns for what else may act (temperature, load, supply voltage): then the residual can be seen to follow one of them.";
  if (left->harmonic > 0)
    return "Record the same drive at a half and at a quarter of its amplitude, and at another frequency: harmonics of a nonlinear characteristic grow faster than the drive, those of friction and hysteresis do not.";
  if (left->kind == "line_in_time")
    return fmt::format(
        "Record once with every input held, for many periods of {}: a spectral line that stays comes from outside or from the sensor, one that vanishes comes from the motion.",
        difference_text(left->period, left->unit));
  if (left->kind == "line_in_level" || left->has_threshold) {
    const std::string across =
        left->has_threshold ? "across " + level_text(*left) : fmt::format("over the range of {}", left->variable);
    return fmt::format(
        "Record slow and fast runs {}, in both directions and several times each: what belongs to the level stays there at every speed, and if it differs between the directions it has memory (hysteresis).",
        across);
  }
  return fmt::format(
      "Record once with every input held, as long as the longest recording: {} that go on do not come from the inputs. Add columns for what may act at such times (temperature, load, supply voltage, a change of range): columns that the diagram does not use are examined, too.",
      left->kind);
}

}  // namespace hysteron
