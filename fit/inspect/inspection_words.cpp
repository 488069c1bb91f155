#include "fit/inspect/inspection_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/diagram/time_text.h"
#include "fit/signals/unit_words.h"

namespace hysteron {
namespace {

const InspectedColumn* column_of(const Inspection& seen, const std::string& name) {
  const auto found =
      std::find_if(seen.columns.begin(), seen.columns.end(), [&](const auto& c) { return c.name == name; });
  return found == seen.columns.end() ? nullptr : &*found;
}

/// Everything that one input does, in all recordings or in those of a role.
struct Moved {
  Unit unit;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;  ///< [SI]
  double band_low = lowest, band_high = 0;                                     ///< [Hz]
  std::size_t reversals = 0, swings = 0;
  Hold hold;
  std::string held_in;

  bool moves() const { return highest > lowest; }
  void add(const InspectedRecording& recording, const InspectedDrive& d) {
    unit = d.unit;
    lowest = std::min(lowest, d.lowest);
    highest = std::max(highest, d.highest);
    if (d.band.highest > 0) {
      band_low = std::min(band_low, d.band.lowest);
      band_high = std::max(band_high, d.band.highest);
    }
    reversals += d.reversals;
    swings = std::max(swings, d.swings);
    if (d.hold.length > hold.length) {
      hold = d.hold;
      held_in = recording.name;
    }
  }
};

template <class Counts>
Moved moved(const Inspection& seen, const std::string& input, const Counts& counts) {
  Moved all;
  for (const auto& r : seen.recordings)
    for (const auto& d : r.drives)
      if (d.input == input && counts(r)) all.add(r, d);
  return all;
}

std::string drive_sentence(const Inspection& seen, const std::string& name) {
  const Moved m = moved(seen, name, [](const InspectedRecording&) { return true; });
  if (!m.moves()) return column_of(seen, name) == nullptr ? "" : fmt::format("{} does not move.", name);
  std::string text = fmt::format("{} moves over {}", name, range_text(m.lowest, m.highest, m.unit));
  if (m.band_high > 0) text += fmt::format(", excites {:.3g} .. {:.4g} Hz", m.band_low, m.band_high);
  text += fmt::format(", turns {}", m.reversals == 1 ? "once" : fmt::format("{} times", m.reversals));
  if (m.swings > 0)
    text +=
        fmt::format(" with up to {} of swing in a recording", m.swings == 1 ? "one size" : count_of(m.swings, "size"));
  return text + (m.hold.length > 0 ? fmt::format("; longest hold {} ({}).", time_text(m.hold.length), m.held_in)
                                   : "; it is never held.");
}

std::string output_sentence(const Inspection& seen, const std::string& name) {
  const InspectedColumn* c = column_of(seen, name);
  if (c == nullptr) return "";
  std::string text = fmt::format("{} was measured over {}", name, range_text(c->lowest, c->highest, c->unit));
  if (c->finest > 0) text += fmt::format("; resolution {}", size_text(c->finest, c->unit));
  text += fmt::format("; scatter from sample to sample {} rms", size_text(c->roughness, c->unit));
  const auto repeat =
      std::find_if(seen.repeats.begin(), seen.repeats.end(), [&](const auto& r) { return r.output == name; });
  if (repeat != seen.repeats.end())
    text += fmt::format("; repeatability {} rms ({})", size_text(repeat->floor.rms, c->unit), repeat->what);
  return text + ".";
}

std::string sentence_of_rows(const Inspection& seen) {
  std::size_t rows = 0;
  double duration = 0, shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const auto& r : seen.recordings) {
    rows += r.rows;
    duration += r.duration;
    shortest = std::min(shortest, r.clock.step);
    longest = std::max(longest, r.clock.step);
  }
  const std::string steps =
      longest > 1.01 * shortest ? time_text(shortest) + " to " + time_text(longest) : time_text(longest);
  return fmt::format("{} with {}, {} between rows, {} in all.", count_of(seen.recordings.size(), "recording"),
                     count_of(rows, "row"), steps, time_text(duration));
}

}  // namespace

std::string count_of(std::size_t n, const std::string& noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}
std::string share_text(double share) { return fmt::format("{:.2g} %", 100 * share); }

std::string list_text(const std::vector<std::string>& names) {
  if (names.size() == 1) return names[0];
  if (names.size() == 2) return names[0] + " and " + names[1];
  return fmt::format("{}, {} and {} more", names[0], names[1], names.size() - 2);
}

std::string note_of_reach(const Inspection& seen, const std::string& input) {
  constexpr double far = 0.1;  // of the range that is fitted
  const Moved fitted = moved(seen, input, [](const InspectedRecording& r) { return r.role == Role::train; });
  if (!fitted.moves()) return "";
  std::vector<std::string> names;
  const Moved beyond = moved(seen, input, [&](const InspectedRecording& r) {
    if (r.role != Role::validate) return false;
    const auto reaches = [&](const InspectedDrive& d) {
      return d.input == input &&
             std::max(d.highest - fitted.highest, fitted.lowest - d.lowest) > far * (fitted.highest - fitted.lowest);
    };
    if (std::none_of(r.drives.begin(), r.drives.end(), reaches)) return false;
    names.push_back(r.name);
    return true;
  });
  if (names.empty()) return "";
  return fmt::format(
      "{} {} {} over {}, the train recordings only over {}: beyond that the model is extrapolated. If that range matters, give a recording of it the role \"train\".",
      list_text(names), names.size() == 1 ? "moves" : "move", input,
      range_text(beyond.lowest, beyond.highest, fitted.unit), range_text(fitted.lowest, fitted.highest, fitted.unit));
}

std::string cut_sentence(const InspectedCut& cut) {
  return fmt::format(
      "{} may be cut at {}: {} are flat there (in {}), though their flanks bend towards {} and would reach {}. Where "
      "an "
      "amplifier stops there, the column is right; where only the logger does, the device was driven further than it "
      "says.",
      cut.input, level_text(cut.level, cut.unit), count_of(cut.tops, cut.at_top ? "top" : "bottom"),
      list_text(cut.recordings), cut.at_top ? "a summit" : "a trough", level_text(cut.would_be, cut.unit));
}

std::vector<std::string> sentences_of(const Inspection& seen, const std::vector<std::string>& inputs,
                                      const std::vector<std::string>& outputs) {
  if (seen.recordings.empty()) return {};
  std::vector<std::string> say{sentence_of_rows(seen)};
  for (const auto& name : inputs) say.push_back(drive_sentence(seen, name));
  for (const auto& name : outputs) say.push_back(output_sentence(seen, name));
  std::erase(say, "");
  if (seen.repeats.empty())
    say.emplace_back(
        "Nothing was recorded twice, neither a period nor a recording: the repeatability is unknown, and the noise is "
        "estimated from the scatter from sample to sample.");
  return say;
}

}  // namespace hysteron
