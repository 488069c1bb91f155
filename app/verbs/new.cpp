// The verb new: a starter diagram and a data set from the columns of recordings.
// Does not decide what they hold (starter.h), nor how files of instruments are read (io/data/measured_file.h).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "app/cli/answer.h"
#include "app/cli/rewrite.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "app/cli/terminal.h"
#include "app/verbs/recording_preview.h"
#include "app/verbs/starter.h"
#include "engine/diagram/error.h"
#include "io/data/measured_file.h"
#include "io/data/recording_file.h"
#include "io/files/atomic_file.h"
#include "io/files/shell_word.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr char new_help[] =
    "Answers: how do I begin. Reads recordings as instruments, spreadsheets and MATLAB write them\n"
    "(docs/recordings.md), says what it assumed, and writes the simplest model of them: gain and offset, both free\n"
    "for a fit.\n\n"
    "Examples:\n"
    "  hysteron new --from lab.csv -o stage/\n"
    "  hysteron new --from scope.csv --input u=CH1 --output y=CH2 -o stage/\n"
    "  hysteron new --from monday.csv tuesday.csv --time Zeit --unit Weg=mm -o stage/\n"
    "  hysteron new --from export.txt --names \"u [V],y [um]\" --interval \"0.4 ms\" -o stage/\n\n"
    "Writes into the folder: diagram.json, dataset.json, the recordings (as CSV, unless they lie there as\n"
    "t [s],u [V],... already), and hysteron.project, which marks the folder as a project. Of several recordings the\n"
    "last one validates. Inputs and outputs are guessed from the names (u*, y*, x*, T*) and from what the columns\n"
    "measure, and said; what is open is asked. Nothing that is there is overwritten.\n"
    "Exit codes: 0 done, 2 a recording or the folder is wrong.";

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

/// One of the files that the user named, and the file that stands for it in the project.
struct NamedRecording {
  fs::path from;
  MeasuredFile read;
  std::string file;       ///< beside the data set
  bool is_there = false;  ///< it lies there already
};

std::vector<NamedRecording> read_all(const Arguments& arguments, const fs::path& folder) {
  const ReadingChoices choices = reading_choices(arguments);
  std::vector<NamedRecording> all;
  for (const auto& name : arguments.list("--from")) {
    NamedRecording recording{name, read_measured_file(name, choices), "", false};
    check_sizes(recording.read.table);
    check_times(recording.read.table);
    std::error_code code;
    recording.file = recording.from.filename().string();
    if (recording.read.as_it_stands) {
      recording.is_there = fs::equivalent(recording.from, folder / recording.file, code);
    } else {  // never under the name of the file itself, where that lies there
      const std::string stem = recording.from.stem().string();
      recording.file = stem + ".csv";
      if (fs::equivalent(recording.from, folder / recording.file, code)) recording.file = stem + ".clean.csv";
    }
    const auto taken = [&](const std::string& file) {
      return std::any_of(all.begin(), all.end(), [&](const NamedRecording& r) { return r.file == file; });
    };
    const fs::path plain = recording.file;
    for (int k = 2; taken(recording.file) && !recording.is_there; ++k)
      recording.file = fmt::format("{}_{}{}", plain.stem().string(), k, plain.extension().string());
    all.push_back(std::move(recording));
  }
  return all;
}

/// How each file was read, behind its name where there are several.
std::vector<std::string> reading_assumed(const std::vector<NamedRecording>& recordings) {
  std::vector<std::string> list;
  for (const auto& recording : recordings)
    for (const auto& fact : recording.read.assumed)
      list.push_back(recordings.size() > 1 ? fmt::format("{}: {}", recording.from.filename().string(), fact) : fact);
  return list;
}

std::string recording_text(const NamedRecording& recording) {
  if (recording.read.as_it_stands) return read_file(recording.from.string());
  std::vector<std::string> comments{"from " + recording.from.filename().string()};
  for (std::string fact : recording.read.assumed) {
    std::replace_if(
        fact.begin(), fact.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    comments.push_back(std::move(fact));
  }
  return csv_text(recording.read.table, comments);
}

/// The project's files; a recording unless it lies there already.
std::vector<WrittenFile> files_of(const fs::path& folder, const Starter& starter,
                                  const std::vector<NamedRecording>& recordings) {
  const auto place = [&](const std::string& name) { return (folder / name).string(); };
  std::error_code code;
  std::vector<WrittenFile> files;
  for (const auto& recording : recordings)
    if (!recording.is_there) files.push_back({place(recording.file), recording_text(recording)});
  files.push_back({place("dataset.json"), starter.dataset_text});
  if (!fs::exists(folder / "hysteron.project", code))
    files.push_back(
        {place("hysteron.project"),
         "This file marks a hysteron project: paths in its JSON files may point anywhere below this folder.\n"});
  files.push_back(diagram_file(place("diagram.json"), starter.diagram));
  return files;
}

/// An error in choosing columns says how the file was read so far.
Starter starter_of(const std::vector<NamedRecording>& recordings, const Arguments& arguments) {
  const StarterRoles given = given_roles(arguments, recordings.front().read.table);
  StarterRecordings list;
  for (const auto& recording : recordings) list.push_back({&recording.read.table, recording.file});
  return make_starter(list, given);
}

Answer make_new(const Arguments& arguments, const Watch&) {
  const fs::path folder = arguments.text("-o");
  const auto recordings = read_all(arguments, folder);
  const Starter starter = starter_of(recordings, arguments);

  std::vector<std::string> written{"diagram.json", "dataset.json"};
  for (const auto& recording : recordings)
    if (!recording.is_there) written.push_back(recording.file);
  refuse_overwriting(folder, written);
  make_folder(folder.string(), "name another with -o");
  Answer answer;
  answer.files = files_of(folder, starter, recordings);

  const std::string diagram = (folder / "diagram.json").string(), dataset = (folder / "dataset.json").string();
  const std::string next = fmt::format("hysteron compare {} --data {}", shell_word(diagram), shell_word(dataset));
  std::vector<std::string> assumed = reading_assumed(recordings);
  assumed.insert(assumed.end(), starter.assumed.begin(), starter.assumed.end());
  answer.closing = fmt::format("wrote {}, {}\n", diagram, dataset);
  if (!arguments.quiet()) {
    answer.closing += "assumed:\n";
    for (const auto& line : assumed) answer.closing += wrapped("- " + line, 2);
  }
  answer.closing += fmt::format("next: {}\n", next);
  answer.facts = Facts::object({{"diagram", diagram}, {"dataset", dataset}, {"assumed", assumed}, {"next", next}});
  return answer;
}

std::vector<shape::Member> new_shape() {
  return {{"diagram", shape::text("the diagram file")},
          {"dataset", shape::text("the data set that binds the recordings to it")},
          {"assumed", shape::texts("what was assumed to read the recordings, and guessed of their columns")},
          {"next", shape::text("the command that compares both")}};
}

}  // namespace

Verb new_verb() {
  return {"new",
          "a starter diagram and a data file from recordings",
          new_help,
          {{"--from", "FILE...", "recordings: CSV, LVM, XLSX, MAT, HDF5, TDMS", true, true, true},
           {"-o", "FOLDER", "the folder to write into; made if it is not there", true, false},
           {"--input", "[NAME=]COLUMN", "this column drives (else guessed), as NAME in the diagram", false, true},
           {"--output", "[NAME=]COLUMN", "this column was measured (else guessed)", false, true},
           {"--time", "COLUMN", "this column holds the times", false, false},
           {"--interval", "TIME", "the rows are so far apart, whatever the file says", false, false},
           {"--unit", "COLUMN=UNIT", "the unit of a column, whatever the file says", false, true},
           {"--without", "COLUMN", "leave this column out", false, true},
           {"--names", "LIST", "headings for a file that has none: \"t [s],u [V]\"", false, false},
           {"--decimal", "SIGN", "point or comma, where the file leaves it open", false, false},
           {"--sheet", "NAME", "of a workbook (else its first)", false, false},
           {"--group", "NAME", "of a file that holds several tables", false, false}},
          make_new,
          new_shape};
}

}  // namespace hysteron
