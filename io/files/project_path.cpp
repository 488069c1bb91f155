#include "io/files/project_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

/// Canonical as far as it exists; what does not exist is only tidied, so that "../" cannot hide behind a missing
/// folder.
fs::path real_path(const fs::path& path) {
  std::error_code error;
  const auto whole = fs::absolute(path.empty() ? "." : path);  // "" is no path to absolute(): the folder that it is in
  auto result = fs::weakly_canonical(whole, error);
  return error ? whole.lexically_normal() : result;
}

fs::path project_of(const fs::path& folder) {
  std::error_code error;
  for (auto at = folder;; at = at.parent_path()) {
    if (fs::is_regular_file(at / "hysteron.project", error)) return at;
    if (at == at.parent_path()) return folder;
  }
}

bool is_inside(const fs::path& path, const fs::path& folder) {
  const auto [rest, ignored] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return rest == folder.end() ||
         (rest->empty() && std::next(rest) == folder.end());  // a trailing slash is an empty last part
}

}  // namespace

ProjectPaths::ProjectPaths(const std::string& file, const std::vector<std::string>& allowed) {
  folders_.push_back(project_of(real_path(file).parent_path()).string());
  for (const auto& folder : allowed) {
    const bool is_file = fs::is_regular_file(folder);
    if (is_file) trusted_.push_back(real_path(folder).string());
    if (!is_file && !fs::is_directory(folder))
      fail("bad_command_line", "--allow", fmt::format("there is no folder or file \"{}\"", folder),
           "name a folder that exists, or an FMU that you trust");
    folders_.push_back(real_path(folder).string());
  }
}

std::optional<std::string> ProjectPaths::resolve(const std::string& from_file, const std::string& written) const {
  const fs::path path = (fs::path(from_file).parent_path() / written).lexically_normal();
  // Judged on the path before tidying: the system follows a link before it takes "..".
  const auto real = real_path(fs::path(from_file).parent_path() / written);
  for (const auto& folder : folders_)
    if (is_inside(real, folder)) return real == real_path(path) ? path.string() : real.string();
  return {};
}

bool ProjectPaths::trusts(const std::string& path) const {
  return std::find(trusted_.begin(), trusted_.end(), real_path(path).string()) != trusted_.end();
}

std::string moved_path(const std::string& target, const std::string& from_file, const std::string& to_file) {
  if (target.empty() || fs::path(target).is_absolute() || from_file.empty()) return target;
  const auto from = real_path(from_file).parent_path(), to = real_path(to_file).parent_path();
  if (from == to) return target;
  return (from / target).lexically_normal().lexically_relative(to).generic_string();
}

std::string outside_cure(const std::string& written) {
  auto folder = fs::path(written).parent_path().generic_string();
  if (folder.empty()) folder += ".";  // += : g++ 12 warns wrongly at =
  return fmt::format(
      "move the file into the project, put an empty file hysteron.project into the folder that holds both, or allow "
      "its folder: --allow {}",
      folder);
}

}  // namespace hysteron
