#include "app/jobs/job_measured.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "app/jobs/job_values.h"

namespace hysteron {
namespace {

constexpr int digits = 5;  // of a table that is read, not compared

/// "max_abs of deviation - reference", "line_above 200 Hz of deviation".
std::string what_of(const ValueWish& wish) {
  std::string text = wish.take.text;
  if (text == "parameter" || !wish.figure.text.empty())
    text = text == "parameter" ? wish.figure.text : fmt::format("{} {}", text, wish.figure.text);
  if (wish.constant) return "a number";
  if (wish.above) text += fmt::format(" {} {}", wish.above->number.value, wish.above->number.unit.value_or(""));
  if (wish.of.signal.text.empty()) return text;
  text += " of " + wish.of.signal.text;
  if (wish.of.minus) text += " - " + wish.of.minus->text;
  if (wish.over) text += " over " + wish.over->text;
  return text;
}

std::string title_of(const RunsJob& job, const std::string& run) {
  const auto found = std::find_if(job.runs.begin(), job.runs.end(), [&](const RunWish& r) { return r.name == run; });
  return found == job.runs.end() ? run : found->title;
}

std::string text_of(JobRunner& runner, const ValueWish& wish) {
  return quantity_text(runner.value({wish.name, wish.pointer}), digits);
}

Table by_run(JobRunner& runner) {
  Table table;
  table.title = "Measured";
  table.columns = {"run"};
  std::vector<std::string> runs;
  std::map<std::pair<std::string, std::string>, std::string> found;  // run and what -> text
  for (const auto& wish : runner.job().values) {
    if (wish.run.text.empty()) continue;
    const std::string what = what_of(wish);
    if (std::find(runs.begin(), runs.end(), wish.run.text) == runs.end()) runs.push_back(wish.run.text);
    if (std::find(table.columns.begin(), table.columns.end(), what) == table.columns.end())
      table.columns.push_back(what);
    auto& text = found[{wish.run.text, what}];
    text += (text.empty() ? "" : "; ") + text_of(runner, wish);
  }
  for (const auto& run : runs) {
    std::vector<std::string> row{title_of(runner.job(), run)};
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
      const auto at = found.find({run, table.columns[c]});
      row.push_back(at == found.end() ? "" : at->second);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table combined(JobRunner& runner) {
  Table table;
  table.title = "From these";
  table.columns = {"value", "is", "came out"};
  for (const auto& wish : runner.job().values) {
    if (!wish.run.text.empty()) continue;
    std::vector<std::string> names;
    for (const auto& name : wish.over_values) names.push_back(name.text);
    const std::string is =
        names.empty() ? what_of(wish) : fmt::format("{} of {}", wish.take.text, fmt::join(names, ", "));
    table.rows.push_back({wish.name, is, text_of(runner, wish)});
  }
  return table;
}

}  // namespace

std::vector<Table> measured_tables(JobRunner& runner) {
  std::vector<Table> tables;
  for (auto& table : {by_run(runner), combined(runner)})
    if (!table.rows.empty()) tables.push_back(table);
  return tables;
}

}  // namespace hysteron
