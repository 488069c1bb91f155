#include "fit/inspect/row_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/diagram/time_text.h"
#include "fit/inspect/inspection_words.h"
#include "fit/signals/row_checks.h"
#include "fit/signals/unit_words.h"

namespace hysteron {
namespace {

class RowFaults {
 public:
  RowFaults(const DataModel& model, const std::vector<InspectedPart>& parts, Inspection& seen)
      : model_(model), parts_(parts), seen_(seen) {}

  void find() {
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      clock_faults(seen_.recordings[k]);
      lost_and_repeated(parts_[k]);
      for (const auto& output : model_.outputs()) {
        apart(parts_[k], output);
        ends(parts_[k], output);
      }
    }
  }

 private:
  const InspectedColumn& column(const std::string& name) const {
    return *std::find_if(seen_.columns.begin(), seen_.columns.end(),
                         [&](const InspectedColumn& c) { return c.name == name; });
  }

  /// Those that the data set does not leave out: who left them out knows of them.
  std::vector<std::size_t> judged_rows(const InspectedPart& part, std::vector<std::size_t> rows) const {
    std::erase_if(rows, [&](std::size_t row) { return is_left_out(model_.data(), part, row); });
    return rows;
  }

  /// Per row: a drive moves there by more than 0.5 % of its range within two rows on each side.
  std::vector<bool> moving(const InspectedPart& part) const {
    std::vector<bool> rows(part.last - part.first, false);
    for (const auto& [name, u] : drives_of(model_, part)) {
      const double least = 0.005 * range_of(u);
      for (std::size_t i = 0; i < u.size(); ++i) {
        const std::size_t a = i > 1 ? i - 2 : 0, b = std::min(i + 2, u.size() - 1);
        rows[i] = rows[i] || range_of(u.subspan(a, b - a + 1)) > least;
      }
    }
    return rows;
  }

  void clock_faults(const InspectedRecording& r) {
    const Clock& c = r.clock;
    if (!c.gaps.empty())
      seen_.faults.push_back(fmt::format("{}: {} missing, in {} of its clock; the first at {} (after the first row).",
                                         r.name, count_of(static_cast<std::size_t>(c.missing()), "row"),
                                         count_of(c.gaps.size(), "gap"),
                                         time_text(c.gaps.front().time - begin_of(r.name))));
    if (!c.regular)
      seen_.notes.push_back(fmt::format("{}: time is not uniform, {} to {} between rows; no spectrum is read from it.",
                                        r.name, time_text(c.shortest), time_text(c.longest)));
    else if (!c.uniform)
      seen_.notes.push_back(fmt::format("{}: the clock jitters by up to {} of its step of {}.", r.name,
                                        share_text(c.jitter), time_text(c.step)));
  }
  double begin_of(const std::string& name) const {
    for (const auto& part : parts_)
      if (part.name == name) return model_.recording(part.recording).t.front();
    return 0;
  }

  void lost_and_repeated(const InspectedPart& part) {
    std::map<std::size_t, std::size_t> repeated;  // row: columns that repeat there
    std::size_t judged = 0;
    for (const auto& c : seen_.columns) {
      if (c.role == "auxiliary") continue;
      const auto rows = rows_of(model_, part, c.name);
      if (range_of(rows) <= 0) continue;
      ++judged;
      const auto stuck = judged_rows(part, repeats_in_motion(rows, c.finest));
      for (const auto row : stuck) ++repeated[row];
      if (const auto leaps = judged_rows(part, leaps_in_motion(rows, c.finest)); c.role == "input" && !leaps.empty())
        seen_.faults.push_back(fmt::format(
            "{}: {} jumps at {} by at least twice its usual change, the first at {}: rows before them may be lost although the clock does not show it.",
            part.name, c.name, count_of(leaps.size(), "row"), when(part, leaps.front())));
      if (c.role == "output")
        if (const long more = unexplained_repeats(judged_of(model_.data(), part, c.name), c.finest); more > 0)
          seen_.faults.push_back(fmt::format(
              "{}: at about {} ({}) {} repeats the value before exactly, more often than its noise explains: those readings were not updated.",
              part.name, count_of(static_cast<std::size_t>(more), "row"),
              share_text(static_cast<double>(more) / static_cast<double>(rows.size())), c.name));
    }
    std::vector<std::size_t> whole;
    for (const auto& [row, columns] : repeated)
      if (everything_repeats(part, row)) whole.push_back(row);
    if (!whole.empty())
      seen_.faults.push_back(fmt::format("{}: {} whole, though the signals move; the first at {}.", part.name,
                                         whole.size() == 1 ? "one row repeats the one before"
                                                           : fmt::format("{} rows repeat the one before", whole.size()),
                                         when(part, whole.front())));
    else if (!repeated.empty() && judged > 0)
      seen_.faults.push_back(fmt::format("{}: a column repeats its value in motion at {}, the first at {}.", part.name,
                                         count_of(repeated.size(), "row"), when(part, repeated.begin()->first)));
  }
  bool everything_repeats(const InspectedPart& part, std::size_t row) const {
    return std::all_of(seen_.columns.begin(), seen_.columns.end(), [&](const InspectedColumn& c) {
      const auto rows = rows_of(model_, part, c.name);
      return row >= rows.size() || rows[row] == rows[row - 1];
    });
  }
  std::string when(const InspectedPart& part, std::size_t row) const {
    return time_text(times_of(model_, part)[row] - model_.recording(part.recording).t.front());
  }

  void apart(const InspectedPart& part, const std::string& output) {
    const auto rows = rows_of(model_, part, output);
    const auto lone = judged_rows(part, rows_apart(rows));
    if (lone.empty()) return;
    const std::size_t i = lone.front();
    seen_.spoiling.push_back(fmt::format(
        "{}: {} of {} far from all others, the first at {} with {}, between {} and {}: a transmission error that dominates every fit and verdict there. Remove {} from the file.",
        part.name, count_of(lone.size(), "row"), output + (lone.size() == 1 ? " lies" : " lie"), when(part, i),
        level_text(rows[i], column(output).unit), level_text(rows[i > 0 ? i - 1 : i + 1], column(output).unit),
        level_text(rows[i + 1 < rows.size() ? i + 1 : i - 1], column(output).unit), lone.size() == 1 ? "it" : "them"));
    seen_.faults.push_back(seen_.spoiling.back());
  }

  void ends(const InspectedPart& part, const std::string& output) {
    const auto rows = rows_of(model_, part, output);
    if (rows.empty()) return;
    auto moves = moving(part);
    for (std::size_t i = 0; i < moves.size(); ++i) moves[i] = moves[i] && !is_left_out(model_.data(), part, i);
    const auto say = [&](const Plateau& p, const char* which) {
      if (p.found)
        seen_.faults.push_back(fmt::format(
            "{}: {} stays at its {} value {} in {} while the drive moves on: the sensor or the converter clips, or the "
            "device has come to a stop.",
            part.name, output, which, level_text(p.level, column(output).unit), count_of(p.rows, "row")));
    };
    const double finest = column(output).finest;
    say(plateau_at_top(rows, finest, moves), "highest");
    say(plateau_at_bottom(rows, finest, moves), "lowest");
  }

  const DataModel& model_;
  const std::vector<InspectedPart>& parts_;
  Inspection& seen_;
};

}  // namespace

void find_row_faults(const DataModel& model, const std::vector<InspectedPart>& parts, Inspection& seen) {
  RowFaults(model, parts, seen).find();
}

}  // namespace hysteron
