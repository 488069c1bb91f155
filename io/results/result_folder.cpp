// Decides which files a result is made of, and which folder may take them: none that holds somebody else's.
// Does not decide what stands in the files (result.cpp) nor how they take the place of old ones (staged_results.h).
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <vector>

#include "engine/diagram/error.h"
#include "io/data/binary_table.h"
#include "io/data/table_file.h"
#include "io/diagram/diagram_file.h"
#include "io/files/atomic_file.h"
#include "io/results/result.h"
#include "io/results/result_manifest.h"
#include "io/results/schema.h"
#include "io/results/staged_results.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const std::string& folder, const std::string& why, const std::string& cure) {
  fail("cannot_write", folder, fmt::format("the results cannot be written: {}", why), cure);
}

void check_names(const Document& document, const std::string& folder) {
  std::set<std::string> taken{"result.json", "report.html", "result.schema.json"};
  const auto check = [&](const std::string& name, const std::string& path) {
    if (!stays_inside(name))
      fail("bad_name", folder, fmt::format("\"{}\" is not a name inside the folder of results", name),
           "use a relative name without \"..\", as trace_file_name gives it");
    if (!taken.insert(path).second)
      fail("duplicate_name", folder, fmt::format("two files of the results are called \"{}\"", path),
           "give each its own name");
  };
  for (const auto& trace : document.traces) check(trace.file, "traces/" + trace.file);
  for (const auto& file : document.files) check(file.first, file.first);
}

/// A curve that points nowhere would be an empty figure that nobody notices.
void check_curves(const Document& document, const std::vector<Figure>& figures, const std::string& folder) {
  for (const auto& figure : figures)
    for (const auto& curve : figure.curves) {
      if (curve.trace.empty()) continue;
      const auto trace = std::find_if(document.traces.begin(), document.traces.end(),
                                      [&](const CsvTable& table) { return table.file == curve.trace; });
      if (trace == document.traces.end() || !trace->find(curve.x_column) || !trace->find(curve.y_column))
        fail("unknown_trace", folder,
             fmt::format(
                 "curve \"{}\" of figure \"{}\" is drawn from columns {}, {} of trace \"{}\", which is not there",
                 curve.name, figure.title, curve.x_column, curve.y_column, curve.trace),
             "add that trace to the document, or give the curve its own numbers");
    }
}

void check_curves(const Document& document, const std::string& folder) {
  check_curves(document, document.answer, folder);
  for (const auto& section : document.sections) check_curves(document, section.figures, folder);
}

/// A folder is replaced by results of the same kind only. Throws Error "folder_in_use".
void check_replaceable(const fs::path& target, const std::string& folder, const std::string& verb) {
  if (fs::exists(target) && !fs::is_directory(target))
    throw Error(Fault::input, {{"cannot_write", folder, "this is a file, and the results go into a folder",
                                "name a folder with -o, or leave it out", "", 0}});
  if (!fs::exists(target) || is_free(target)) return;
  auto earlier = read_manifest(target);
  if (!earlier && has_results_to_place(target)) return;  // known when they are in place
  if (!earlier) earlier = read_manifest(target);         // where another process has put them there this instant
  if (!earlier)
    fail("folder_in_use", folder, "the folder holds other files and no result of hysteron, so it is not replaced",
         "choose another folder with -o, or empty this one");
  if (!earlier->verb.empty() && earlier->verb != verb)
    fail("folder_in_use", folder,
         fmt::format("the folder holds what \"hysteron {}\" found, so it is not replaced", earlier->verb),
         "choose another folder with -o, or remove this one");
}

/// Those of the document, result.json last.
std::vector<std::string> names_in(const Document& document, bool with_report) {
  std::vector<std::string> names;
  for (const auto& trace : document.traces) names.push_back("traces/" + trace.file);
  for (const auto& [name, content] : document.files) names.push_back(name);
  if (with_report) names.emplace_back("report.html");
  names.emplace_back("result.schema.json");  // "$schema" of result.json, wherever the folder is moved
  names.emplace_back(result_file);
  return names;
}

void write_files(StagedResults& staged, const Document& document, const std::string& report_html) {
  const auto names = names_in(document, !report_html.empty());
  std::vector<std::string> places;  // all of them before anything is written: a name that is taken is told at once
  for (const auto& name : names) places.push_back(staged.place(name));
  auto place = places.begin();
  for (const auto& trace : document.traces) write_table(*place++, trace);
  for (const auto& [name, content] : document.files) write_file(*place++, content);
  if (!report_html.empty()) write_file(*place++, report_html);
  write_file(*place++, result_schema());
  write_file(*place, result_text(document));
}

/// Runs `action`; what the disk refuses is told as a problem of the folder.
template <class Action>
void on_the_disk(const std::string& folder, const Action& action) {
  try {
    action();
  } catch (const fs::filesystem_error& e) {
    cannot_write(folder, fmt::format("{}: {}", e.path1().string(), e.code().message()),
                 "choose another folder with -o, or make room or permission there; nothing was changed");
  } catch (const Error& e) {
    const Problem& p = e.problems.front();
    if (p.code != "cannot_write" || p.path.find(unfinished_folder) == std::string::npos) throw;
    cannot_write(folder, p.what, p.cure);
  }
}

}  // namespace

std::vector<std::string> files_of_result(const Document& document) {
  std::vector<std::string> names = document.data, written = names_in(document, true);
  names.insert(names.end(), written.begin(), written.end());
  return names;
}

std::string trace_file_name(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    safe += std::isalnum(u) || u >= 0x80 || c == '.' || c == '-' || c == '_' ? c : '_';
  }
  while (!safe.empty() && safe.front() == '.') safe.erase(0, 1);
  if (safe.size() < 4 || safe.substr(safe.size() - 4) != ".csv") safe += ".csv";
  return safe;
}

void finish_result(StagedResults& staged, const std::string& folder, const Document& document,
                   const std::string& report_html) {
  check_names(document, folder);
  check_curves(document, folder);
  on_the_disk(folder, [&] {
    write_files(staged, document, report_html);
    staged.put_in_place();
  });
}

void write_result(const std::string& folder, const Document& document, const std::string& report_html,
                  const FolderLock::Waiting& waiting) {
  check_names(document, folder);
  check_curves(document, folder);
  on_the_disk(folder, [&] {
    const fs::path target = folder.empty() ? "." : folder;
    check_replaceable(target, folder, document.verb);  // before anything is made there
    const FolderLock lock(target, waiting);
    StagedResults staged(lock);
    check_replaceable(target, folder, document.verb);  // others may have been here meanwhile
    finish_result(staged, folder, document, report_html);
  });
}

std::string trace_file(const std::string& name, const std::vector<CsvTable>& taken, const std::string& type) {
  std::string stem = name;
  for (const char* other : {".csv", binary_table_type})
    if (const auto dot = stem.rfind(other); dot != std::string::npos) stem.erase(dot, 4);
  std::string clean;
  for (const char c : stem) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
    if (plain)
      clean += c;
    else if (!clean.empty() && clean.back() != '-')
      clean += '-';
  }
  while (!clean.empty() && (clean.back() == '-' || clean.back() == '.')) clean.pop_back();
  clean.erase(0, clean.find_first_not_of(".-"));
  if (clean.empty()) clean = "recording";
  const auto is_taken = [&](const std::string& file) {
    return std::any_of(taken.begin(), taken.end(), [&](const CsvTable& t) { return t.file == file; });
  };
  std::string file = clean + type;
  for (int i = 2; is_taken(file); ++i) file = fmt::format("{}-{}{}", clean, i, type);
  return file;
}

}  // namespace hysteron
