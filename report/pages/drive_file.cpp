#include "report/pages/drive_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "discover/hypotheses/effect_terms.h"
#include "io/data/csv.h"

namespace hysteron {
namespace {

CsvColumn column_of(const DrivenInput& input) {
  CsvColumn column{input.name, input.unit, {}};
  for (const double si : input.values) column.values.push_back(input.unit.from_si(si));
  return column;
}

std::vector<std::string> comments_of(const Experiment& e) {
  const DriveRows& rows = *e.drive;
  std::vector<std::string> moved, held;
  for (const auto& input : rows.inputs) (input.moves ? moved : held).push_back(input.name);
  std::vector<std::string> list{std::string(drive_file_head).substr(2) + ", to tell " + e.between + " apart",
                                e.word + ": " + e.text};
  if (!moved.empty())
    list.push_back(fmt::format("Moves: {}, along straight lines from row to row", fmt::join(moved, ", ")));
  if (!held.empty()) list.push_back(fmt::format("Held: {}", fmt::join(held, ", ")));
  if (!rows.besides.empty())
    list.push_back(
        fmt::format("Not in these columns, as said above, and to be recorded: {}", fmt::join(rows.besides, ", ")));
  for (const auto& word : faster_than_recorded(e)) list.push_back("Faster than recorded: " + word);
  list.push_back("Measure: " + what_to_measure(e));
  list.push_back(fmt::format("Expected: the models differ by {:.3g} times the noise (rms)", e.separation));
  return list;
}

}  // namespace

std::vector<std::string> faster_than_recorded(const Experiment& e) {
  std::vector<std::string> list;
  for (const auto& input : e.drive->inputs)
    if (input.fastest > (1 + 1e-6) * input.recorded)
      list.push_back(fmt::format("{} moves by up to {:.3g} {}/s, in the recordings by {:.3g}", input.name,
                                 input.unit.difference_from_si(input.fastest), input.unit.text,
                                 input.unit.difference_from_si(input.recorded)));
  return list;
}

std::string what_to_measure(const Experiment& e) {
  using effects::rounded, effects::time_text;
  const DriveRows& rows = *e.drive;
  const double duration = rows.t.empty() ? 0 : rows.t.back() - rows.t.front();
  return fmt::format("{}{}, for {}, in these rows or every {}", fmt::join(rows.outputs, ", "),
                     e.word == "reference_sensor" ? " and the same by a second, independent sensor" : "",
                     time_text(rounded(duration)), time_text(rounded(rows.shortest_step)));
}

std::string drive_file_text(const Experiment& e) {
  CsvTable table;
  table.columns.push_back({"t", parse_unit("s"), e.drive->t});
  for (const auto& input : e.drive->inputs) table.columns.push_back(column_of(input));
  return csv_text(table, comments_of(e));
}

}  // namespace hysteron
