// Decides in which file and line a problem of a diagram stands. Does not change what is wrong with it.
#include <map>
#include <memory>

#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"
#include "io/json/json_reader.h"

namespace hysteron {
namespace {

/// "stage/play.radius" as a JSON pointer: blocks of nested diagrams stand in other files, so the outermost name it is;
/// "" if the file has no such name.
std::string pointer_of_path(const JsonFile& json, const std::string& path) {
  const auto name = path.substr(0, path.find_first_of("/."));
  for (const char* section : {"/blocks", "/parameters", "/inputs", "/outputs"})
    if (const auto pointer = pointer_to(section, name); json.has(pointer)) return pointer;
  return "";
}

class Locator {
 public:
  explicit Locator(std::string file) : file_(std::move(file)) {}

  void locate(Problem& problem) {
    if (problem.line > 0 || problem.path.empty() || problem.path.front() == '-')
      return;  // "--set ...": the command line
    std::string file = file_, pointer = problem.path;
    if (const auto hash = problem.path.find("#/"); hash != std::string::npos) {
      file = problem.path.substr(0, hash);
      pointer = problem.path.substr(hash + 1);
    }
    const JsonFile* json = open(file);
    if (json == nullptr) return;
    if (pointer.front() != '/') pointer = pointer_of_path(*json, pointer);
    if (pointer.empty()) return;
    problem.file = file;
    problem.line = json->line(pointer);
    if (problem.path.find("#/") != std::string::npos) problem.path = pointer;
  }

 private:
  const JsonFile* open(const std::string& file) {
    auto& json = files_[file];
    if (!json) {
      try {
        json = std::make_unique<JsonFile>(file);
      } catch (const Error&) {
        return nullptr;  // it was readable when the diagram was read; without a line the problem still stands
      }
    }
    return json.get();
  }

  std::string file_;
  std::map<std::string, std::unique_ptr<JsonFile>> files_;
};

}  // namespace

void locate_problems(Error& error, const std::string& file) {
  Locator locator(file);
  auto problems = error.problems;
  for (auto& problem : problems) locator.locate(problem);
  error = Error(error.fault, std::move(problems));  // so that what() tells the lines too
}

}  // namespace hysteron
