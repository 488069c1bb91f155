#include "io/results/result_manifest.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/files/atomic_file.h"
#include "io/results/result.h"

namespace hysteron {

namespace fs = std::filesystem;

bool stays_inside(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && path.is_relative() && path.has_filename() &&
         std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".." || part == "."; });
}

std::optional<ResultManifest> read_manifest(const fs::path& folder) {
  const fs::path result = folder / result_file;
  if (!fs::is_regular_file(result)) return std::nullopt;
  const std::string text = read_file(result.string());
  if (!is_result(text)) return std::nullopt;
  const auto j = nlohmann::json::parse(text);
  const bool has_verb = j.contains("verb") && j["verb"].is_string();
  ResultManifest manifest{has_verb ? j["verb"].get<std::string>() : "",
                          {result_file, "report.html", "result.schema.json"}};
  const auto add = [&](const char* key, const std::string& below) {
    if (!j.contains(key) || !j[key].is_array()) return;
    for (const auto& name : j[key])
      if (name.is_string() && stays_inside(name.get<std::string>()))
        manifest.files.insert(below + name.get<std::string>());
  };
  add("traces", "traces/");
  add("files", "");
  add("data", "");
  return manifest;
}

}  // namespace hysteron
