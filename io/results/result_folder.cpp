// Decides how a folder of results appears on the disk: whole or not at all, and never over somebody else's files.
// Does not decide what stands in the files.
#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>

#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"
#include "io/files/atomic_file.h"
#include "io/results/result.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const std::string& folder, const std::string& why) {
  fail("cannot_write", folder, fmt::format("the results cannot be written: {}", why),
       "choose another folder with -o, or make room or permission there; nothing was changed");
}

/// A name in the folder must stay in the folder.
bool stays_inside(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && path.is_relative() && path.has_filename() &&
         std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".." || part == "."; });
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
void check_curves(const Document& document, const std::string& folder) {
  for (const auto& section : document.sections)
    for (const auto& figure : section.figures)
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

/// What an earlier run wrote.
struct Earlier {
  std::string verb;
  std::set<std::string> files;  ///< relative to the folder
};

/// nullopt where no result of hysteron lies there.
std::optional<Earlier> earlier_result(const fs::path& folder) {
  const fs::path result = folder / "result.json";
  if (!fs::is_regular_file(result)) return std::nullopt;
  const std::string text = read_file(result.string());
  if (!is_result(text)) return std::nullopt;
  const auto j = nlohmann::json::parse(text);
  const auto names = [&](const char* key) {
    std::vector<std::string> list;
    if (j.contains(key) && j[key].is_array())
      for (const auto& name : j[key])
        if (name.is_string()) list.push_back(name.get<std::string>());
    return list;
  };
  const bool has_verb = j.contains("verb") && j["verb"].is_string();
  Earlier earlier{has_verb ? j["verb"].get<std::string>() : "", {"result.json", "report.html", "result.schema.json"}};
  for (const auto& trace : names("traces")) earlier.files.insert("traces/" + trace);
  for (const auto& file : names("files")) earlier.files.insert(file);
  return earlier;
}

/// Files in the folder that no run wrote: notes, or a diagram that was worked on.
std::vector<fs::path> files_of_others(const fs::path& folder, const Earlier& earlier) {
  std::vector<fs::path> list;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (const auto name = entry.path().lexically_relative(folder);
        !fs::is_directory(entry.symlink_status()) && !earlier.files.contains(name.generic_string()))
      list.push_back(name);
  return list;
}

/// A folder is replaced by results of the same kind only, and what others put there stays: what an earlier run wrote.
/// Throws Error "folder_in_use".
Earlier replaceable(const fs::path& target, const std::string& folder, const std::string& verb) {
  if (!fs::exists(target) || fs::is_empty(target)) return {};
  auto earlier = earlier_result(target);
  if (!earlier)
    fail("folder_in_use", folder, "the folder holds other files and no result of hysteron, so it is not replaced",
         "choose another folder with -o, or empty this one");
  if (!earlier->verb.empty() && earlier->verb != verb)
    fail("folder_in_use", folder,
         fmt::format("the folder holds what \"hysteron {}\" found, so it is not replaced", earlier->verb),
         "choose another folder with -o, or remove this one");
  return std::move(*earlier);
}

/// Puts what others left in the folder into the one that takes its place; a name that is taken there is not theirs.
void keep_files_of_others(const fs::path& target, const Earlier& earlier, const fs::path& partial,
                          const std::string& folder) {
  if (!fs::exists(target)) return;
  for (const auto& name : files_of_others(target, earlier)) {
    if (fs::exists(partial / name))
      fail("folder_in_use", folder, fmt::format("\"{}\" would be replaced, which no run has written", name.string()),
           "choose another folder with -o, or call that file something else");
    fs::create_directories((partial / name).parent_path());
    fs::copy(target / name, partial / name, fs::copy_options::copy_symlinks);
  }
}

void write_files(const fs::path& folder, const Document& document, const std::string& report_html) {
  const auto place = [&](const fs::path& relative) {
    fs::create_directories((folder / relative).parent_path());
    return (folder / relative).string();
  };
  for (const auto& trace : document.traces) write_csv(place(fs::path("traces") / trace.file), trace);
  for (const auto& [name, content] : document.files) write_file(place(name), content);
  if (!report_html.empty()) write_file(place("report.html"), report_html);
  write_file(place("result.schema.json"), result_schema());  // "$schema" of result.json, wherever the folder is moved
  write_file(place("result.json"), result_text(document));
}

/// Puts `partial` in the place of `target`. Where the file system can exchange two names at once, there is no instant
/// at which the place is empty; elsewhere the old folder steps aside first and comes back if the new one cannot follow.
void put_in_place(const fs::path& partial, const fs::path& target) {
  if (!fs::exists(target)) return fs::rename(partial, target);
  if (renameat2(AT_FDCWD, partial.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) {
    std::error_code ignored;
    fs::remove_all(partial, ignored);
    return;
  }
  const fs::path aside = fmt::format("{}.old-{}", target.string(), getpid());
  fs::rename(target, aside);
  std::error_code failed;
  fs::rename(partial, target, failed);
  if (failed) {
    fs::rename(aside, target);
    throw fs::filesystem_error("rename", partial, target, failed);
  }
  fs::remove_all(aside, failed);
}

/// Removes what was built if anything goes wrong on the way.
struct Partial {
  fs::path path;
  ~Partial() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

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

std::string trace_file(const std::string& name, const std::vector<CsvTable>& taken) {
  std::string stem = name;
  if (const auto dot = stem.rfind(".csv"); dot != std::string::npos) stem.erase(dot, 4);
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
  std::string file = clean + ".csv";
  for (int i = 2; is_taken(file); ++i) file = fmt::format("{}-{}.csv", clean, i);
  return file;
}

void add_result(const std::string& folder, const Document& document, const std::string& report_html) {
  check_names(document, folder);
  check_curves(document, folder);
  try {
    write_files(folder, document, report_html);
  } catch (const fs::filesystem_error& e) {
    cannot_write(folder, e.code().message());
  }
}

void write_result(const std::string& folder, const Document& document, const std::string& report_html) {
  check_names(document, folder);
  check_curves(document, folder);
  try {
    fs::path target = fs::weakly_canonical(fs::absolute(folder));
    if (!target.has_filename()) target = target.parent_path();  // "out/"
    if (fs::exists(target) && !fs::is_directory(target))
      throw Error(Fault::input, {{"cannot_write", folder, "this is a file, and the results go into a folder",
                                  "name a folder with -o, or leave it out", "", 0}});
    const Earlier earlier = replaceable(target, folder, document.verb);
    fs::create_directories(target.parent_path());
    const Partial partial{fmt::format("{}.partial-{}", target.string(), getpid())};
    fs::remove_all(partial.path);
    fs::create_directory(partial.path);
    write_files(partial.path, document, report_html);
    keep_files_of_others(target, earlier, partial.path, folder);
    put_in_place(partial.path, target);
  } catch (const fs::filesystem_error& e) {
    cannot_write(folder, e.code().message());
  } catch (Error& e) {
    if (e.problems.empty() || e.problems.front().code != "cannot_write" || e.problems.front().path == folder) throw;
    cannot_write(folder, e.problems.front().what);
  }
}

}  // namespace hysteron
