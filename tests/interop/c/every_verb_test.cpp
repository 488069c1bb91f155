// Every verb does its work through the library, and says of it what the program says with --json.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "interop/c/hysteron.h"
#include "tests/app/cli/verb_lines.h"

namespace hysteron {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Free {
  void operator()(void* handle) const { hy_free(handle); }
};

/// What the library says, or its error.
Json carried_out(const std::string& verb, const verb_lines::Words& words) {
  std::vector<const char*> pointers;
  for (const auto& word : words) pointers.push_back(word.c_str());
  hy_error* error = nullptr;
  const std::unique_ptr<hy_result, Free> result(
      hy_verb(verb.c_str(), static_cast<int>(words.size()), pointers.data(), nullptr, nullptr, &error));
  const std::unique_ptr<hy_error, Free> told(error);
  return Json::parse(error == nullptr ? hy_result_json(result.get()) : hy_error_json(error));
}

/// Members that hold however long the work took, and wherever its folder is: times of the clock, and where there is a
/// folder of results, which the library writes only where the words name it.
Json what_counts(const Json& told) {
  if (told.is_array()) {
    Json list = Json::array();
    for (const auto& element : told) list.push_back(what_counts(element));
    return list;
  }
  if (!told.is_object()) return told;
  Json object = Json::object();
  for (const auto& [name, value] : told.items())
    if (name != "files" && name != "folder" && name != "result" && name.find("seconds") == std::string::npos)
      object[name] = what_counts(value);
  return object;
}

TEST(Interop, EveryVerbDoesWhatTheProgramDoes) {
  const process::Folder of_program, of_library;
  verb_lines::furnish(of_program);
  verb_lines::furnish(of_library);
  const fs::path before = fs::current_path();
  fs::current_path(of_library.path());
  for (const auto& [verb, lines] : verb_lines::all())
    for (const auto& line : lines) {
      verb_lines::Words words{verb};
      words.insert(words.end(), line.begin(), line.end());
      words.emplace_back("--json");
      SCOPED_TRACE(verb + (line.empty() ? "" : " " + line.front()));
      const Json here = carried_out(verb, line);
      if (std::find(line.begin(), line.end(), "--slurm-dry-run") != line.end()) {
        EXPECT_EQ(here["exit_code"], HY_BAD_INPUT) << "it starts the program";
        continue;
      }
      const Json there = Json::parse(process::hysteron(of_program.path(), words).out);
      const Json said = what_counts(here), expected = what_counts(there);
      for (const auto& [name, value] : expected.items()) EXPECT_EQ(said.value(name, Json()), value) << name;
    }
  fs::current_path(before);
}

}  // namespace
}  // namespace hysteron
