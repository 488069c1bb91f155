#include "studio/folder.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
#include "io/files/digest.h"
#include "io/json/json_reader.h"

namespace hysteron::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 5000;
constexpr int deepest = 8;
constexpr std::uintmax_t largest_json = std::uintmax_t{4} << 20;  // [bytes]; diagrams of a thousand blocks take 0.2 MB

/// What a JSON file is, by its keys; "" for one that is none of ours.
ListedFile described(const fs::path& file) {
  ListedFile listed;
  try {
    JsonFile json(file.string());
    const JsonPlace root = json.root();
    if (!root.is_object()) return listed;
    listed.kind = root.find("recordings")                   ? "dataset"
                  : root.find("blocks") && !root.find("do") ? "diagram"
                  : root.find("do")                         ? "job"
                                                            : "";
    listed.title = text_member(root, "title");
  } catch (const Error&) {  // one that is being written: shown, so that it can be cured here
    listed.kind = "diagram";
  }
  return listed;
}

}  // namespace

OpenFolder::OpenFolder(const std::string& folder) {
  std::error_code error;
  const fs::path path = fs::canonical(folder, error);
  if (error || !fs::is_directory(path))
    fail("no_folder", folder, "there is no folder \"" + folder + "\"",
         "name the folder in which your diagrams lie, or make it first");
  root_ = path.string();
}

std::string OpenFolder::file(const std::string& name) const {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::path(root_) / name, error);
  const fs::path inside = whole.lexically_relative(root_);
  if (error || name.empty() || name.find('\0') != std::string::npos || inside.empty() || *inside.begin() == "..")
    fail("outside_folder", name, "this file lies outside the folder that the studio was opened on",
         "start hysteron studio on a folder that holds it");
  return whole.string();
}

std::string OpenFolder::name_of(const std::string& file) const {
  return fs::path(file).lexically_relative(root_).generic_string();
}

std::vector<ListedFile> OpenFolder::list() const {
  std::vector<ListedFile> files;
  std::error_code error;
  fs::recursive_directory_iterator at(root_, fs::directory_options::skip_permission_denied, error), end;
  for (; at != end && !error && files.size() < most_files; at.increment(error)) {
    const fs::path& path = at->path();
    const bool hidden = path.filename().string().starts_with(".");
    if (at->is_directory(error)) {
      const bool is_result = fs::exists(path / "result.json", error);
      if (hidden || is_result || at.depth() >= deepest) at.disable_recursion_pending();
      continue;
    }
    const std::string type = path.extension().string();
    if (hidden || path.filename().string().ends_with(".layout.json")) continue;
    ListedFile listed;
    if (type == ".csv" || type == ".f64")
      listed.kind = "recording";
    else if (type == ".json" && at->file_size(error) <= largest_json)
      listed = described(path);
    listed.path = name_of(path.string());
    if (!listed.kind.empty()) files.push_back(std::move(listed));
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

namespace {

/// What tells that a file is still the one that was read.
struct Seen {
  fs::file_time_type changed{};
  std::uintmax_t size = 0;
  std::string digest{};
};

/// Files that nobody has touched for so long are not read again: within it, two changes may bear one time.
constexpr auto settled = std::chrono::seconds(2);
constexpr std::size_t most_seen = 4096;

}  // namespace

std::string digest_of(const std::string& file) {
  static std::mutex mutex;
  static std::map<std::string, Seen> seen;
  std::error_code error;
  const auto changed = fs::last_write_time(file, error);
  const std::uintmax_t size = error ? 0 : fs::file_size(file, error);
  if (error) return "";
  {
    const std::lock_guard lock(mutex);
    const auto known = seen.find(file);
    if (known != seen.end() && known->second.changed == changed && known->second.size == size)
      return known->second.digest;
  }
  try {
    Digest digest;
    digest.add(read_file(file));
    if (fs::file_time_type::clock::now() - changed > settled) {
      const std::lock_guard lock(mutex);
      if (seen.size() >= most_seen) seen.clear();
      seen[file] = {changed, size, digest.text()};
    }
    return digest.text();
  } catch (const Error&) {
    return "";
  }
}

}  // namespace hysteron::studio
