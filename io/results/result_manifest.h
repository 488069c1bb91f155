// Decides which files of a folder are those of a result: what its result.json lists, and what every result has.
// All others are the user's. Does not read what the result says (result.h).
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hysteron {

struct Document;

inline constexpr char result_file[] = "result.json";  ///< the last to be written: with it a result is whole

struct ResultManifest {
  std::string verb;
  std::set<std::string> files;  ///< relative to the folder, none outside of it
};

/// nullopt where no result of hysteron lies there.
std::optional<ResultManifest> read_manifest(const std::filesystem::path& folder);

/// Those that a document becomes, with its report.html, relative to the folder; result.json last.
std::vector<std::string> files_of_result(const Document& document);

/// Is this the name of a file inside a folder: relative, and without ".."?
bool stays_inside(const std::string& name);

}  // namespace hysteron
