// Decides what a starter diagram and data set look like for the columns of recordings, and says what it assumed.
// Does not read or write files.
#include "app/verbs/starter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine/diagram/error.h"
#include "engine/diagram/name_list.h"
#include "engine/diagram/number_text.h"
#include "fit/numerics/linear.h"
#include "io/data/recording_file.h"
#include "io/json/value_text.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr double train_share = 0.6;  // of the time, as for a single recording

/// In which unit a difference of this column is written: a temperature step in K.
std::string difference_unit(const CsvColumn& column) { return column.unit.offset != 0 ? "K" : unit_text(column.unit); }
double in_difference_unit(const CsvColumn& column, double number) {
  return column.unit.offset != 0 ? column.unit.scale * number : number;
}

std::string quotient(const std::string& above, const std::string& below) {
  if (below.empty()) return above;
  const bool composed = below.find_first_of("/* ") != std::string::npos;
  return fmt::format("{}/{}", above.empty() ? "1" : above, composed ? "(" + below + ")" : below);
}

double rounded(double value) { return rounded_to_digits(value, 5); }

/// A signal that stays and jumps was held between samples; one that moves was sampled.
bool looks_held(const CsvColumn& column) {
  std::size_t changes = 0;
  for (std::size_t i = 1; i < column.values.size(); ++i) changes += column.values[i] != column.values[i - 1] ? 1U : 0U;
  return changes > 0 && changes * 20 < column.values.size();
}

/// Rows of a recording that train: of a single one the first 60 % of its time, of several all but those of the last.
std::size_t training_rows(const StarterRecordings& recordings, std::size_t index) {
  const auto& t = recordings[index].table->find("t")->values;
  if (recordings.size() > 1) return index + 1 < recordings.size() ? t.size() : 0;
  const double until = t.front() + train_share * (t.back() - t.front());
  return static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), until) - t.begin());
}

/// y = sum of slopes times inputs + offset, least squares over the rows that train. Numbers as written in the files.
std::vector<double> straight_line(const StarterRecordings& recordings, const StarterRoles& roles,
                                  const std::string& output) {
  const std::size_t n = roles.inputs.size() + 1;
  NormalForm problem(static_cast<int>(n));
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const CsvTable& table = *recordings[k].table;
    const std::size_t rows = training_rows(recordings, k);
    if (rows == 0) continue;
    std::vector<double> columns;
    for (const auto& input : roles.inputs) {
      const auto& u = table.find(input)->values;
      columns.insert(columns.end(), u.begin(), u.begin() + static_cast<std::ptrdiff_t>(rows));
    }
    columns.resize(n * rows, 1.0);  // the last column: the offset
    problem.add(columns, std::span(table.find(output)->values).first(rows));
  }
  const std::vector<double> lower(n, -std::numeric_limits<double>::infinity());
  const std::vector<double> upper(n, std::numeric_limits<double>::infinity());
  // Smallest solution: an input that does not move in these rows gets a gain only as far as the rows say.
  return solve_bounded(problem, lower, upper).x;
}

DiagramParameter free_parameter(double value, const std::string& unit) {
  DiagramParameter parameter;
  parameter.value = Value(unit.empty() ? Number{rounded(value), {}} : Number{rounded(value), unit});
  parameter.free = true;
  return parameter;
}

/// A block's name that no input of the diagram has.
std::string block_name(const Diagram& diagram, std::string name) {
  while (diagram.inputs.find(name) != nullptr) name += "_block";
  return name;
}

/// One output: a gain for each input, their sum, an offset.
void add_output(Diagram& diagram, const StarterRecordings& recordings, const StarterRoles& roles,
                const std::string& output) {
  const CsvTable& table = *recordings.front().table;
  const CsvColumn& y = *table.find(output);
  const bool alone = roles.outputs.size() == 1;
  const bool single = alone && roles.inputs.size() == 1;
  const std::string name = roles.name_of(output);
  const std::string of_output = alone ? "" : "_" + name;
  const auto line = straight_line(recordings, roles, output);
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < roles.inputs.size(); ++k) {
    const std::string input = roles.name_of(roles.inputs[k]);
    const std::string gain = single ? "gain" : "gain" + of_output + "_" + input;
    const std::string unit = quotient(difference_unit(y), difference_unit(*table.find(roles.inputs[k])));
    diagram.parameters[gain] = free_parameter(in_difference_unit(y, line[k]), unit);
    const std::string block = block_name(diagram, single ? "actuator" : "actuator" + of_output + "_" + input);
    Node& node = diagram.blocks[block];
    node.type = "gain";
    node.parameters["gain"] = Value(Reference{gain});
    node.in = {{"", input}};
    parts.push_back(block);
  }
  std::string moved = parts.front();
  if (parts.size() > 1) {
    moved = block_name(diagram, "sum" + of_output);
    Node& sum = diagram.blocks[moved];
    sum.type = "sum";
    for (const auto& part : parts) sum.in.push_back({"", part});
  }
  const std::string offset = "offset" + of_output;
  diagram.parameters[offset] = free_parameter(line.back(), unit_text(y.unit));
  Node sensor;
  if (y.unit.offset == 0) {
    sensor.type = "calibration";
    sensor.parameters["gain"] = Value(1.0);
    sensor.parameters["offset"] = Value(Reference{offset});
    sensor.in = {{"", moved}};
  } else {  // the offset of a calibration is a difference; a temperature needs a zero of its own
    const std::string zero_name = block_name(diagram, "zero" + of_output);
    Node& zero = diagram.blocks[zero_name];
    zero.type = "constant";
    zero.parameters["value"] = Value(Reference{offset});
    sensor.type = "sum";
    sensor.in = {{"", moved}, {"", zero_name}};
  }
  const std::string sensor_name = block_name(diagram, "sensor" + of_output);
  diagram.blocks[sensor_name] = std::move(sensor);
  diagram.outputs[name] = sensor_name;
}

/// The columns of a data set: how each is bound.
std::string column_entries(const StarterRecordings& recordings, const StarterRoles& roles,
                           std::vector<std::string>& assumed) {
  std::vector<std::string> columns;
  for (const auto& input : roles.inputs) {
    const bool held = looks_held(*recordings.front().table->find(input));
    columns.push_back(fmt::format("{}: {{\"to\": \"{}\", \"between_samples\": \"{}\"}}", json_quoted(input),
                                  roles.name_of(input), held ? "hold" : "linear"));
    assumed.push_back(held ? fmt::format("{} seldom changes: held between samples", input)
                           : fmt::format("{} moves along a straight line between samples", input));
  }
  for (const auto& output : roles.outputs)
    columns.push_back(fmt::format("{}: {{\"to\": \"{}\"}}", json_quoted(output), roles.name_of(output)));
  return fmt::format("{}", fmt::join(columns, ",\n              "));
}

/// Its recordings: a single one is cut in time, of several the last one validates.
std::string recording_entries(const StarterRecordings& recordings, std::vector<std::string>& assumed) {
  std::vector<std::string> entries;
  if (recordings.size() > 1) {
    for (const auto& recording : recordings)
      entries.push_back(fmt::format("{{\"file\": {}, \"role\": \"{}\"}}", json_quoted(recording.file),
                                    &recording == &recordings.back() ? "validate" : "train"));
    assumed.push_back(fmt::format("{} validates, the other recording{} train{}", recordings.back().file,
                                  recordings.size() > 2 ? "s" : "", recordings.size() > 2 ? "" : "s"));
  } else {
    const CsvColumn& time = *recordings.front().table->find("t");
    const auto& t = time.values;
    const double cut = t.front() + train_share * (t.back() - t.front());
    const auto first = std::upper_bound(t.begin(), t.end(), cut);
    const double edge =
        first == t.end() ? cut : 0.5 * (*(first - 1) + *first);  // between two rows: no row is in both parts
    const std::string unit = unit_text(time.unit);
    const std::string at =
        fmt::format("{:.9g} {}", edge - t.front(), unit.empty() ? "s" : unit);  // counted from the first row
    assumed.push_back(fmt::format("the first 60 % of the time ({}) train, the rest validates", at));
    const std::string file = json_quoted(recordings.front().file);
    entries.push_back(fmt::format("{{\"file\": {}, \"role\": \"train\", \"until\": \"{}\"}}", file, at));
    entries.push_back(fmt::format("{{\"file\": {}, \"role\": \"validate\", \"skip\": \"{}\"}}", file, at));
  }
  return fmt::format("{}", fmt::join(entries, ",\n    "));
}

std::string dataset_text(const StarterRecordings& recordings, const StarterRoles& roles,
                         std::vector<std::string>& assumed) {
  const std::string columns = column_entries(recordings, roles, assumed);
  return fmt::format(
      "{{\n  \"format\": 1,\n  \"title\": {},\n  \"columns\": {{{}}},\n  \"recordings\": [\n    {}\n  ]\n}}\n",
      json_quoted(recordings.front().file), columns, recording_entries(recordings, assumed));
}

/// Two columns that differ only by case or by signs would get one name in the diagram.
void check_names(const CsvTable& table, const StarterRoles& roles) {
  std::vector<std::string> names;
  for (const auto* list : {&roles.inputs, &roles.outputs})
    for (const auto& column : *list) {
      const std::string name = roles.name_of(column);
      if (std::find(names.begin(), names.end(), name) != names.end())
        fail("unclear_columns", table.file, fmt::format("two columns would both be called \"{}\" in the diagram", name),
             "rename one of them in the header line, or choose with --input NAME and --output NAME");
      names.push_back(name);
    }
}

/// Every recording has the columns of the first, in units that fit.
void check_alike(const StarterRecordings& recordings, const StarterRoles& roles) {
  const CsvTable& first = *recordings.front().table;
  std::vector<std::string> wanted{"t"};
  wanted.insert(wanted.end(), roles.inputs.begin(), roles.inputs.end());
  wanted.insert(wanted.end(), roles.outputs.begin(), roles.outputs.end());
  for (const auto& recording : recordings) {
    check_times(*recording.table);
    std::vector<std::string> known;
    for (const auto& column : recording.table->columns) known.push_back(column.name);
    for (const auto& name : wanted) {
      const CsvColumn* column = recording.table->find(name);
      if (column == nullptr)
        fail("missing_column", recording.table->file,
             fmt::format("{} has no column \"{}\", which {} has", recording.file, name, recordings.front().file),
             did_you_mean(name, known));
      const Unit &here = column->unit, &there = first.find(name)->unit;
      if (!(here.dimension == there.dimension))
        fail("wrong_unit", name,
             fmt::format("{} is in [{}] in {} and in [{}] in {}", name, unit_text(here), recording.file,
                         unit_text(there), recordings.front().file),
             fmt::format("say which it is: --unit {}={}", name, unit_text(there)));
      if (here.scale != there.scale || here.offset != there.offset)
        fail("wrong_unit", name,
             fmt::format("{} is in [{}] in {} and in [{}] in {}: a starter needs one unit", name, unit_text(here),
                         recording.file, unit_text(there), recordings.front().file),
             "make a starter from those of one unit, and list the others in its dataset.json");
    }
    if (recording.table->rows() < 3)
      fail("too_few_rows", recording.table->file,
           fmt::format("{} cannot show a straight line", count_text(static_cast<long>(recording.table->rows()), "row")),
           "record at least three rows");
  }
}

}  // namespace

Starter make_starter(const StarterRecordings& recordings, const StarterRoles& given) {
  Starter starter;
  const CsvTable& table = *recordings.front().table;
  const StarterRoles roles = guess_roles(table, given, starter.assumed);
  check_names(table, roles);
  check_alike(recordings, roles);
  Diagram& diagram = starter.diagram;
  diagram.title = "Starter: gain and offset";
  diagram.source = "a straight line through " + recordings.front().file;
  for (const auto& input : roles.inputs) diagram.inputs[roles.name_of(input)].unit = unit_text(table.find(input)->unit);
  for (const auto& output : roles.outputs) add_output(diagram, recordings, roles, output);
  for (const auto& [name, signal] : diagram.outputs) diagram.record.push_back(signal);
  for (const auto& input : roles.inputs) {
    const auto& u = table.find(input)->values;
    if (std::all_of(u.begin(), u.end(), [&](double value) { return value == u.front(); }))
      starter.assumed.push_back(fmt::format("{} never moves: its gain cannot be told from the offset", input));
  }
  starter.dataset_text = dataset_text(recordings, roles, starter.assumed);
  std::vector<std::string> side;
  for (const auto& column : table.columns)
    if (column.name != roles.time &&
        std::find(roles.inputs.begin(), roles.inputs.end(), column.name) == roles.inputs.end() &&
        std::find(roles.outputs.begin(), roles.outputs.end(), column.name) == roles.outputs.end())
      side.push_back(column.name);
  if (!side.empty()) starter.assumed.push_back(fmt::format("left as side channels: {}", name_list(side)));
  return starter;
}

}  // namespace hysteron
