// The verb new: writes a starter diagram and a data set from the columns of one recording.
// Does not decide what they hold (starter.h).
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "app/cli/shell_word.h"
#include "app/cli/terminal.h"
#include "app/cli/verb.h"
#include "app/verbs/starter.h"
#include "engine/diagram/error.h"
#include "io/data/recording_file.h"
#include "io/diagram/diagram_file.h"
#include "io/files/atomic_file.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr char new_help[] =
    "Answers: how do I begin. Reads one recording (CSV with a header line such as t [s],u [V],y [um])\n"
    "and writes the simplest model of it: gain and offset, both free for a fit.\n\n"
    "Examples:\n"
    "  hysteron new --from lab.csv -o stage/\n"
    "  hysteron new --from lab.csv --input volts --output \"disp\" -o stage/\n\n"
    "Writes into the folder: diagram.json, dataset.json, a copy of the recording, and hysteron.project, which\n"
    "marks the folder as a project. Inputs and outputs are guessed from the names (u*, y*, x*, T*) and said.\n"
    "Nothing that is there is overwritten.\n"
    "Exit codes: 0 done, 2 the recording or the folder is wrong.";

/// Files that `new` would write and that are there already.
void refuse_overwriting(const fs::path& folder, const std::vector<std::string>& names) {
  std::error_code code;
  if (fs::exists(folder, code) && !fs::is_directory(folder, code))
    fail("folder_in_use", folder.string(), "this is a file, not a folder", "name another place with -o FOLDER");
  for (const auto& name : names)
    if (fs::exists(folder / name, code))
      fail("folder_in_use", (folder / name).string(), "this file is there already",
           "name another place with -o FOLDER");
}

/// All files or none: what was written before a failure is taken away again.
void write_all(const fs::path& folder, const Starter& starter, const std::string& csv_name,
               const std::string& csv_text) {
  std::vector<fs::path> written;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file((folder / name).string(), text);
    written.push_back(folder / name);
  };
  std::error_code code;
  try {
    if (!csv_name.empty()) write(csv_name, csv_text);
    write("dataset.json", starter.dataset_text);
    if (!fs::exists(folder / "hysteron.project", code))
      write("hysteron.project",
            "This file marks a hysteron project: paths in its JSON files may point anywhere below this folder.\n");
    write_diagram((folder / "diagram.json").string(), starter.diagram);
  } catch (...) {
    for (const auto& file : written) fs::remove(file, code);
    throw;
  }
}

int make_new(const Arguments& arguments) {
  const fs::path from = arguments.text("--from");
  const fs::path folder = arguments.text("-o");
  const CsvTable table = read_csv(from.string());
  check_sizes(table);
  StarterRoles given;
  given.inputs = arguments.list("--input");
  given.outputs = arguments.list("--output");
  const std::string csv_name = from.filename().string();
  const Starter starter = make_starter(table, given, csv_name);

  std::error_code code;
  const bool recording_is_there = fs::equivalent(from, folder / csv_name, code);
  std::vector<std::string> written{"diagram.json", "dataset.json"};
  if (!recording_is_there) written.push_back(csv_name);
  refuse_overwriting(folder, written);
  fs::create_directories(folder, code);
  if (code)
    fail("cannot_write", folder.string(), "the folder cannot be made: " + code.message(), "name another with -o");
  write_all(folder, starter, recording_is_there ? "" : csv_name, read_file(from.string()));

  fmt::print("wrote {}, {}\n", (folder / "diagram.json").string(), (folder / "dataset.json").string());
  if (!arguments.quiet()) {
    fmt::print("assumed:\n");
    for (const auto& line : starter.assumed) fmt::print("{}", wrapped("- " + line, 2));
  }
  fmt::print("next: hysteron compare {} --data {}\n", shell_word((folder / "diagram.json").string()),
             shell_word((folder / "dataset.json").string()));
  return exit_code::done;
}

}  // namespace

Verb new_verb() {
  return {"new",
          "a starter diagram and a data file from a recording",
          new_help,
          {{"--from", "FILE.csv", "the recording", true, false},
           {"-o", "FOLDER", "the folder to write into; made if it is not there", true, false},
           {"--input", "COLUMN", "this column drives (else guessed from the names)", false, true},
           {"--output", "COLUMN", "this column was measured (else guessed from the names)", false, true}},
          make_new};
}

}  // namespace hysteron
