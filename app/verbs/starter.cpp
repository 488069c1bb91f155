// Decides what a starter diagram and data set look like for the columns of one recording, and says what it assumed.
// Does not read or write files.
#include "app/verbs/starter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <span>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "fit/numerics/linear.h"
#include "io/data/recording_file.h"
#include "io/json/value_text.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr double train_share = 0.6;  // of the time, as for a single recording

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool is_one_of(const std::string& name, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return name == word; });
}

/// "u", "u1", "u_x" for the letter u.
bool letter_with_index(const std::string& name, char letter) {
  return !name.empty() && name[0] == letter &&
         (name.size() == 1 || std::isdigit(static_cast<unsigned char>(name[1])) != 0 || name[1] == '_');
}

enum class Guess { none, input, output, maybe_output };

Guess guess_of(const CsvColumn& column) {
  const std::string name = lower_case(column.name);
  if (letter_with_index(name, 'u') || is_one_of(name, {"input", "drive", "command", "voltage", "heater"}))
    return Guess::input;
  if (letter_with_index(name, 'y') || is_one_of(name, {"output", "displacement", "position", "measured", "sensor"}))
    return Guess::output;
  // A temperature or a position beside a y is a side channel; without one it is what was measured.
  if (letter_with_index(name, 'x') || letter_with_index(name, 't') || is_one_of(name, {"temperature"}))
    return Guess::maybe_output;
  return Guess::none;
}

std::vector<std::string> columns_of(const CsvTable& table) {
  std::vector<std::string> names;
  for (const auto& column : table.columns) names.push_back(column.name);
  return names;
}

std::string names_of(const CsvTable& table) { return fmt::format("{}", fmt::join(columns_of(table), ", ")); }

void check_columns(const CsvTable& table, const std::vector<std::string>& wanted, const std::string& option) {
  const auto known = columns_of(table);
  for (const auto& name : wanted)
    if (table.find(name) == nullptr)
      fail("missing_column", table.file, fmt::format("{} names a column \"{}\" that is not there", option, name),
           did_you_mean(name, known) + bracket_hint(name, known));
}

/// The time neither drives nor was measured, whatever the options say.
void refuse_time(const StarterRoles& roles) {
  const auto is_time = [&](const std::string& column) { return column == roles.time; };
  for (const auto& [option, columns] : {std::pair("--input", &roles.inputs), {"--output", &roles.outputs}})
    if (std::any_of(columns->begin(), columns->end(), is_time))
      fail("bad_command_line", option, fmt::format("column \"{}\" is the time", roles.time),
           fmt::format("name a column that {}", option == std::string("--input") ? "drives" : "was measured"));
}

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

/// y = sum of slopes times inputs + offset, least squares over the first 60 % of the time. Numbers as written in the
/// file.
std::vector<double> straight_line(const CsvTable& table, const StarterRoles& roles, const CsvColumn& y) {
  const auto& t = table.find(roles.time)->values;
  const double until = t.front() + train_share * (t.back() - t.front());
  const auto rows = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), until) - t.begin());
  const std::size_t n = roles.inputs.size() + 1;
  std::vector<double> columns;
  for (const auto& input : roles.inputs) {
    const auto& u = table.find(input)->values;
    columns.insert(columns.end(), u.begin(), u.begin() + static_cast<std::ptrdiff_t>(rows));
  }
  columns.resize(n * rows, 1.0);  // the last column: the offset
  NormalForm problem(static_cast<int>(n));
  problem.add(columns, std::span(y.values).first(rows));
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
void add_output(Diagram& diagram, const CsvTable& table, const StarterRoles& roles, const std::string& output) {
  const CsvColumn& y = *table.find(output);
  const bool alone = roles.outputs.size() == 1;
  const bool single = alone && roles.inputs.size() == 1;
  const std::string name = diagram_name(output);
  const std::string of_output = alone ? "" : "_" + name;
  const auto line = straight_line(table, roles, y);
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < roles.inputs.size(); ++k) {
    const std::string input = diagram_name(roles.inputs[k]);
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

std::string dataset_text(const CsvTable& table, const StarterRoles& roles, const std::string& csv_name,
                         std::vector<std::string>& assumed) {
  std::vector<std::string> columns;
  for (const auto& input : roles.inputs) {
    const bool held = looks_held(*table.find(input));
    columns.push_back(fmt::format("{}: {{\"to\": \"{}\", \"between_samples\": \"{}\"}}", json_quoted(input),
                                  diagram_name(input), held ? "hold" : "linear"));
    assumed.push_back(held ? fmt::format("{} seldom changes: held between samples", input)
                           : fmt::format("{} moves along a straight line between samples", input));
  }
  for (const auto& output : roles.outputs)
    columns.push_back(fmt::format("{}: {{\"to\": \"{}\"}}", json_quoted(output), diagram_name(output)));
  const auto& t = table.find(roles.time)->values;
  const double cut = t.front() + train_share * (t.back() - t.front());
  const auto first = std::upper_bound(t.begin(), t.end(), cut);
  const double edge =
      first == t.end() ? cut : 0.5 * (*(first - 1) + *first);  // between two rows: no row is in both parts
  const std::string unit = unit_text(table.find(roles.time)->unit);
  const std::string at =
      fmt::format("{:.9g} {}", edge - t.front(), unit.empty() ? "s" : unit);  // counted from the first row
  assumed.push_back(fmt::format("the first 60 % of the time ({}) train, the rest validates", at));
  return fmt::format(
      "{{\n  \"format\": 1,\n  \"title\": {0},\n  \"columns\": {{{1}}},\n  \"recordings\": [\n"
      "    {{\"file\": {0}, \"role\": \"train\", \"until\": \"{2}\"}},\n"
      "    {{\"file\": {0}, \"role\": \"validate\", \"skip\": \"{2}\"}}\n  ]\n}}\n",
      json_quoted(csv_name), fmt::join(columns, ",\n              "), at);
}

}  // namespace

std::string diagram_name(const std::string& column) {
  std::string name;
  for (const char c : lower_case(column)) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  if (name.empty() || !(name.front() >= 'a' && name.front() <= 'z')) name = "column_" + name;
  return name;
}

StarterRoles guess_roles(const CsvTable& table, StarterRoles given, std::vector<std::string>& assumed) {
  check_columns(table, given.inputs, "--input");
  check_columns(table, given.outputs, "--output");
  const Dimension second = parse_unit("s").dimension;
  const CsvColumn* time = table.find("t");
  if (time == nullptr || !(time->unit.dimension == second))
    fail("missing_column", table.file, "no column is the time",
         "name one \"t [s]\" in the header line; the columns are " + names_of(table) + "." +
             bracket_hint("t", columns_of(table)));
  given.time = "t";
  refuse_time(given);

  std::vector<std::string> inputs, outputs, maybe;
  for (const auto& column : table.columns) {
    if (column.name == given.time) continue;
    const Guess guess = guess_of(column);
    if (guess == Guess::input) inputs.push_back(column.name);
    if (guess == Guess::output) outputs.push_back(column.name);
    if (guess == Guess::maybe_output) maybe.push_back(column.name);
  }
  if (outputs.empty()) outputs = maybe;
  if (given.inputs.empty() && !inputs.empty())
    assumed.push_back(fmt::format("inputs, by their names: {}", fmt::join(inputs, ", ")));
  if (given.outputs.empty() && !outputs.empty())
    assumed.push_back(fmt::format("measured outputs, by their names: {}", fmt::join(outputs, ", ")));
  if (given.inputs.empty()) given.inputs = inputs;
  if (given.outputs.empty()) given.outputs = outputs;
  if (given.inputs.empty() || given.outputs.empty())
    fail("unclear_columns", table.file,
         fmt::format("nothing tells which column is the {}", given.inputs.empty() ? "input" : "measured output"),
         fmt::format("say so with --input NAME and --output NAME; the columns are {}", names_of(table)));
  for (const auto& name : given.inputs)
    if (std::find(given.outputs.begin(), given.outputs.end(), name) != given.outputs.end())
      fail("bad_command_line", "--output", fmt::format("column \"{}\" cannot be input and output", name),
           "give each column one role");
  return given;
}

namespace {

/// Two columns that differ only by case or by signs would get one name in the diagram.
void check_names(const CsvTable& table, const StarterRoles& roles) {
  std::vector<std::string> names;
  for (const auto* list : {&roles.inputs, &roles.outputs})
    for (const auto& column : *list) {
      const std::string name = diagram_name(column);
      if (std::find(names.begin(), names.end(), name) != names.end())
        fail("unclear_columns", table.file, fmt::format("two columns would both be called \"{}\" in the diagram", name),
             "rename one of them in the header line, or choose with --input NAME and --output NAME");
      names.push_back(name);
    }
}

}  // namespace

Starter make_starter(const CsvTable& table, const StarterRoles& given, const std::string& csv_name) {
  Starter starter;
  const StarterRoles roles = guess_roles(table, given, starter.assumed);
  check_names(table, roles);
  if (table.rows() < 3)
    fail("too_few_rows", table.file,
         fmt::format("{} cannot show a straight line", count_text(static_cast<long>(table.rows()), "row")),
         "record at least three rows");
  Diagram& diagram = starter.diagram;
  diagram.title = "Starter: gain and offset";
  diagram.source = "a straight line through " + csv_name;
  for (const auto& input : roles.inputs) diagram.inputs[diagram_name(input)].unit = unit_text(table.find(input)->unit);
  for (const auto& output : roles.outputs) add_output(diagram, table, roles, output);
  for (const auto& [name, signal] : diagram.outputs) diagram.record.push_back(signal);
  for (const auto& input : roles.inputs) {
    const auto& u = table.find(input)->values;
    if (std::all_of(u.begin(), u.end(), [&](double value) { return value == u.front(); }))
      starter.assumed.push_back(fmt::format("{} never moves: its gain cannot be told from the offset", input));
  }
  starter.dataset_text = dataset_text(table, roles, csv_name, starter.assumed);
  std::vector<std::string> side;
  for (const auto& column : table.columns)
    if (column.name != roles.time &&
        std::find(roles.inputs.begin(), roles.inputs.end(), column.name) == roles.inputs.end() &&
        std::find(roles.outputs.begin(), roles.outputs.end(), column.name) == roles.outputs.end())
      side.push_back(column.name);
  if (!side.empty()) starter.assumed.push_back(fmt::format("left as side channels: {}", fmt::join(side, ", ")));
  return starter;
}

}  // namespace hysteron
