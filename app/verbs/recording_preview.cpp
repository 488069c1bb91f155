#include "app/verbs/recording_preview.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/diagram/error.h"
#include "io/data/measured_file.h"
#include "io/data/recording_file.h"
#include "io/formats/file_format.h"

namespace hysteron {
namespace {

std::pair<std::string, std::string> unit_choice(const std::string& written) {
  const auto sign = written.rfind('=');
  if (sign == std::string::npos || sign == 0)
    fail("bad_command_line", "--unit", fmt::format("\"{}\" does not say which column has which unit", written),
         "write --unit force=N");
  return {written.substr(0, sign), written.substr(sign + 1)};
}

/// "t [s],u [V]" as a list.
std::vector<std::string> heading_list(const std::string& written) {
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin < written.size();) {
    const auto end = std::min(written.find(',', begin), written.size());
    list.push_back(written.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
}

/// What `action` finds wrong is a question to the user.
template <class Action>
void asking(std::vector<Problem>& questions, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    questions.insert(questions.end(), error.problems.begin(), error.problems.end());
  }
}

}  // namespace

ReadingChoices reading_choices(const Arguments& arguments) {
  ReadingChoices choices;
  choices.time = arguments.text("--time");
  if (arguments.has("--interval")) choices.interval = arguments.seconds("--interval", 0);
  for (const auto& written : arguments.list("--unit")) choices.units.insert(unit_choice(written));
  choices.without = arguments.list("--without");
  choices.names = heading_list(arguments.text("--names"));
  choices.sheet = arguments.text("--sheet");
  choices.group = arguments.text("--group");
  choices.decimal = arguments.text("--decimal");
  if (!choices.decimal.empty() && choices.decimal != "point" && choices.decimal != "comma")
    fail("bad_command_line", "--decimal", fmt::format("\"{}\" is no decimal sign", choices.decimal),
         "write --decimal point or --decimal comma");
  return choices;
}

StarterRoles given_roles(const Arguments& arguments, const CsvTable& table) {
  StarterRoles given;
  for (const auto& written : arguments.list("--input")) given.add(given.inputs, "--input", written, table);
  for (const auto& written : arguments.list("--output")) given.add(given.outputs, "--output", written, table);
  return given;
}

RecordingPreview preview_recording(const Arguments& arguments) {
  RecordingPreview preview;
  const ReadingChoices choices = reading_choices(arguments);
  const std::string file = arguments.list("--from").front();
  std::vector<Problem> unread;
  asking(unread, [&] { preview.raw = read_measured_table(file, choices); });
  asking(preview.questions, [&] {
    MeasuredFile read = read_measured_file(file, choices);
    check_sizes(read.table);
    check_times(read.table);
    preview.as_it_stands = read.as_it_stands;
    preview.assumed = std::move(read.assumed);
    preview.table = std::move(read.table);
  });
  if (preview.table.columns.empty()) return preview;
  asking(preview.questions, [&] {
    const StarterRoles roles = guess_roles(preview.table, given_roles(arguments, preview.table), preview.assumed);
    preview.inputs = roles.inputs;
    preview.outputs = roles.outputs;
  });
  return preview;
}

}  // namespace hysteron
