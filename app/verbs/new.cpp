// The verb new: a starter diagram and a data set from the columns of one recording.
// Does not decide what they hold (starter.h).
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "app/cli/answer.h"
#include "app/cli/rewrite.h"
#include "app/cli/shape.h"
#include "app/cli/shell_word.h"
#include "app/cli/target.h"
#include "app/cli/terminal.h"
#include "app/verbs/starter.h"
#include "engine/diagram/error.h"
#include "io/data/recording_file.h"
#include "io/data/table_file.h"
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

/// The project's files; the recording unless it lies there already.
std::vector<WrittenFile> files_of(const fs::path& folder, const Starter& starter, const fs::path& recording,
                                  bool recording_is_there) {
  const auto place = [&](const std::string& name) { return (folder / name).string(); };
  std::error_code code;
  std::vector<WrittenFile> files;
  if (!recording_is_there) files.push_back({place(recording.filename().string()), read_file(recording.string())});
  files.push_back({place("dataset.json"), starter.dataset_text});
  if (!fs::exists(folder / "hysteron.project", code))
    files.push_back(
        {place("hysteron.project"),
         "This file marks a hysteron project: paths in its JSON files may point anywhere below this folder.\n"});
  files.push_back(diagram_file(place("diagram.json"), starter.diagram));
  return files;
}

Answer make_new(const Arguments& arguments, const Watch&) {
  const fs::path from = arguments.text("--from");
  const fs::path folder = arguments.text("-o");
  const CsvTable table = read_table(from.string());
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
  make_folder(folder.string(), "name another with -o");
  Answer answer;
  answer.files = files_of(folder, starter, from, recording_is_there);

  const std::string diagram = (folder / "diagram.json").string(), dataset = (folder / "dataset.json").string();
  const std::string next = fmt::format("hysteron compare {} --data {}", shell_word(diagram), shell_word(dataset));
  answer.closing = fmt::format("wrote {}, {}\n", diagram, dataset);
  if (!arguments.quiet()) {
    answer.closing += "assumed:\n";
    for (const auto& line : starter.assumed) answer.closing += wrapped("- " + line, 2);
  }
  answer.closing += fmt::format("next: {}\n", next);
  answer.facts =
      Facts::object({{"diagram", diagram}, {"dataset", dataset}, {"assumed", starter.assumed}, {"next", next}});
  return answer;
}

std::vector<shape::Member> new_shape() {
  return {{"diagram", shape::text("the diagram file")},
          {"dataset", shape::text("the data set that binds the recording to it")},
          {"assumed", shape::texts("what was guessed of the columns")},
          {"next", shape::text("the command that compares both")}};
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
          make_new,
          new_shape};
}

}  // namespace hysteron
