#include "app/verbs/column_roles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>

#include "engine/diagram/error.h"
#include "engine/diagram/name_list.h"
#include "io/data/recording_file.h"
#include "io/json/value_text.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool is_one_of(const std::string& name, std::span<const char* const> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return name == word; });
}
bool is_one_of(const std::string& name, std::initializer_list<const char*> words) {
  return is_one_of(name, std::span(words.begin(), words.size()));
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

// ---- by what they measure -------------------------------------------------------------------------------------------

/// How far along the way from the command to the motion a quantity stands: a voltage drives a current, a current a
/// force, a force a motion.
enum Stage { unknown_stage = -1, command, voltage, current, effort, motion };

constexpr const char* command_words[] = {"input",  "drive",   "command",    "cmd",       "setpoint", "reference",
                                         "ref",    "soll",    "sollwert",   "stellwert", "duty",     "pwm",
                                         "heater", "control", "excitation", "anregung",  "stimulus", "demand"};
constexpr const char* voltage_words[] = {"voltage", "volt", "volts", "spannung"};
constexpr const char* current_words[] = {"current", "strom"};
constexpr const char* effort_words[] = {"force", "kraft",    "torque", "moment",   "drehmoment",
                                        "druck", "pressure", "power",  "leistung", "load"};
constexpr const char* motion_words[] = {"position",
                                        "pos",
                                        "displacement",
                                        "disp",
                                        "weg",
                                        "angle",
                                        "winkel",
                                        "speed",
                                        "velocity",
                                        "drehzahl",
                                        "rpm",
                                        "acceleration",
                                        "temperature",
                                        "temp",
                                        "temperatur",
                                        "carriage",
                                        "encoder",
                                        "sensor",
                                        "measured",
                                        "ist",
                                        "istwert",
                                        "output",
                                        "response",
                                        "feedback",
                                        "geschwindigkeit",
                                        "beschleunigung",
                                        "auslenkung",
                                        "hub",
                                        "stroke",
                                        "deflection",
                                        "strain",
                                        "level"};
/// What stands on the driving side of a machine, of two columns of one kind.
constexpr const char* driving_words[] = {"motor", "actuator", "drive",  "driver", "antrieb", "aktor", "commanded",
                                         "in",    "input",    "source", "set",    "soll",    "master"};

/// The words of a name: "motor angle", "Voltage_0", "motorAngle".
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  bool small = false;
  for (const char c : name) {
    const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80;
    const bool capital = c >= 'A' && c <= 'Z';
    if ((!letter || (capital && small)) && !words.back().empty()) words.emplace_back();
    if (letter) words.back() += static_cast<char>(capital ? c - 'A' + 'a' : c);
    small = letter && !capital;
  }
  return words;
}

bool has_word(const CsvColumn& column, std::span<const char* const> known) {
  const auto words = words_of(column.name);
  return std::any_of(words.begin(), words.end(), [&](const std::string& w) { return is_one_of(w, known); });
}

bool is_in(const CsvColumn& column, std::initializer_list<const char*> units) {
  return std::any_of(units.begin(), units.end(),
                     [&](const char* u) { return column.unit.dimension == parse_unit(u).dimension; });
}

Stage stage_of(const CsvColumn& column) {
  if (has_word(column, command_words)) return command;
  if (has_word(column, voltage_words)) return voltage;
  if (has_word(column, current_words)) return current;
  if (has_word(column, effort_words)) return effort;
  if (has_word(column, motion_words)) return motion;
  if (is_in(column, {"V"})) return voltage;
  if (is_in(column, {"A"})) return current;
  if (is_in(column, {"N", "N m", "Pa", "W"})) return effort;
  if (is_in(column, {"m", "rad", "m/s", "rad/s", "m/s2", "rad/s2", "K"})) return motion;
  return unknown_stage;
}

/// The first and the last columns on the way from the command to the motion. Nothing where all stand at one place.
void guess_by_stage(const std::vector<const CsvColumn*>& columns, std::vector<std::string>& inputs,
                    std::vector<std::string>& outputs) {
  inputs.clear();
  outputs.clear();
  int first = motion, last = command;
  for (const auto* column : columns) {
    const int stage = stage_of(*column);
    if (stage == unknown_stage) continue;
    first = std::min(first, stage);
    last = std::max(last, stage);
  }
  for (const auto* column : columns) {
    const int stage = stage_of(*column);
    if (stage == unknown_stage) continue;
    if (first < last) {
      if (stage == first) inputs.push_back(column->name);
      if (stage == last) outputs.push_back(column->name);
    } else {
      (has_word(*column, driving_words) ? inputs : outputs).push_back(column->name);
    }
  }
}

std::vector<std::string> columns_of(const CsvTable& table) {
  std::vector<std::string> names;
  for (const auto& column : table.columns) names.push_back(column.name);
  return names;
}

/// "t [s], CH1 [V]": names that a user chooses from.
std::string names_of(const CsvTable& table) {
  std::vector<std::string> names;
  for (const auto& column : table.columns)
    names.push_back(column.unit.text.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit.text));
  return name_list(names);
}

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

bool holds(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// Names first: u is an input whatever it measures. Then what they measure.
void guess_the_rest(const CsvTable& table, StarterRoles& roles, std::vector<std::string>& assumed) {
  std::vector<std::string> inputs, outputs, maybe;
  std::vector<const CsvColumn*> open;
  for (const auto& column : table.columns) {
    if (column.name == roles.time || holds(roles.inputs, column.name) || holds(roles.outputs, column.name)) continue;
    open.push_back(&column);
    const Guess guess = guess_of(column);
    if (guess == Guess::input) inputs.push_back(column.name);
    if (guess == Guess::output) outputs.push_back(column.name);
    if (guess == Guess::maybe_output) maybe.push_back(column.name);
  }
  if (outputs.empty()) outputs = maybe;
  const char* how = "by their names";
  if ((inputs.empty() && roles.inputs.empty()) || (outputs.empty() && roles.outputs.empty())) {
    std::vector<std::string> driving, measured;
    guess_by_stage(open, driving, measured);
    how = "by what they measure";
    // What one side is named by stays: a y beside a force was measured.
    if (roles.inputs.empty() && inputs.empty()) {
      inputs = driving;
      std::erase_if(inputs, [&](const std::string& name) { return holds(outputs, name) && outputs != maybe; });
      if (outputs.empty() || outputs == maybe) outputs = measured;
    } else if (outputs.empty()) {
      outputs = measured;
    }
    std::erase_if(outputs, [&](const std::string& name) { return holds(inputs, name); });
  }
  if (roles.inputs.empty() && !inputs.empty()) {
    assumed.push_back(fmt::format("inputs, {}: {}", how, fmt::join(inputs, ", ")));
    roles.inputs = inputs;
  }
  if (roles.outputs.empty() && !outputs.empty()) {
    assumed.push_back(fmt::format("measured outputs, {}: {}", how, fmt::join(outputs, ", ")));
    roles.outputs = outputs;
  }
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

void StarterRoles::add(std::vector<std::string>& list, const std::string& option, const std::string& written,
                       const CsvTable& table) {
  const auto sign = written.find('=');
  if (sign == std::string::npos || table.find(written) != nullptr) return list.push_back(written);
  const std::string name = written.substr(0, sign), column = written.substr(sign + 1);
  if (name.empty() || diagram_name(name) != lower_case(name))
    fail("bad_name", option, fmt::format("\"{}\" is no name of an {} of a diagram", name, option.substr(2)),
         fmt::format("write letters, digits and _, such as {} u={}", option, column));
  list.push_back(column);
  called[column] = name;
}

std::string StarterRoles::name_of(const std::string& column) const {
  const auto found = called.find(column);
  return found == called.end() ? diagram_name(column) : found->second;
}

StarterRoles guess_roles(const CsvTable& table, StarterRoles given, std::vector<std::string>& assumed) {
  check_columns(table, given.inputs, "--input");
  check_columns(table, given.outputs, "--output");
  check_times(table);
  given.time = "t";
  refuse_time(given);
  if (given.inputs.empty() || given.outputs.empty()) guess_the_rest(table, given, assumed);
  if (given.inputs.empty() || given.outputs.empty())
    fail("unclear_columns", table.file,
         fmt::format("nothing tells which column is the {}", given.inputs.empty() ? "input" : "measured output"),
         fmt::format("say so with --input NAME and --output NAME; the columns are {}", names_of(table)));
  for (const auto& name : given.inputs)
    if (holds(given.outputs, name))
      fail("bad_command_line", "--output", fmt::format("column \"{}\" cannot be input and output", name),
           "give each column one role");
  return given;
}

}  // namespace hysteron
