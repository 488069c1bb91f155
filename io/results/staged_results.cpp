#include "io/results/staged_results.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

fs::path staged_in(const fs::path& folder) { return folder / unfinished_folder / "new"; }

/// Renames and removals, in their order.
struct Exchange {
  std::vector<std::string> new_folders;                    ///< the outer ones first
  std::vector<std::pair<std::string, std::string>> moves;  ///< from, to
  std::vector<std::string> old_files, old_folders;         ///< the inner ones first
  std::pair<std::string, std::string> last;

  /// Calls of the system alone. Returns errno or 0. What is done already is passed over.
  int carry_out() const noexcept {
    const auto move = [](const auto& m) {
      return ::rename(m.first.c_str(), m.second.c_str()) == 0 || errno == ENOENT ? 0 : errno;
    };
    for (const auto& folder : new_folders)
      if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) return errno;
    for (const auto& m : moves)
      if (const int error = move(m); error != 0) return error;
    for (const auto& file : old_files) ::unlink(file.c_str());
    for (const auto& folder : old_folders) ::rmdir(folder.c_str());
    return move(last);
  }
};

/// The exchange is the work of a process of its own, which goes on where this one is killed. It holds the lock of the
/// folder as long as it lives.
int carry_out_even_if_killed(const Exchange& exchange) {
  const pid_t child = ::fork();
  if (child < 0) return exchange.carry_out();
  if (child == 0) {
    ::setpgid(0, 0);
    ::_exit(exchange.carry_out());
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 0;  // nobody wants to know how children end: the files tell
  return WIFEXITED(status) ? WEXITSTATUS(status) : EINTR;
}

/// The folders in which files lie, the outer ones first.
std::vector<std::string> folders_of(const std::set<std::string>& files, const fs::path& below) {
  std::set<fs::path> folders;
  for (const auto& file : files)
    for (fs::path folder = fs::path(file).parent_path(); !folder.empty(); folder = folder.parent_path())
      folders.insert(folder);
  std::vector<std::string> list;
  for (const auto& folder : folders) list.push_back((below / folder).string());
  return list;
}

bool is_plain_file(const fs::path& file) {
  struct stat status {};
  return ::lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

/// Every folder between `folder` and the file is a folder, and no link to one elsewhere.
bool lies_inside(const fs::path& folder, const std::string& name) {
  fs::path path = folder;
  for (const auto& part : fs::path(name).parent_path())
    if (!fs::is_directory(fs::symlink_status(path /= part))) return false;
  return true;
}

[[noreturn]] void not_in_place(const FolderLock& lock, const Exchange& exchange, int error) {
  std::string first = exchange.last.second;
  std::error_code ignored;
  for (auto m = exchange.moves.rbegin(); m != exchange.moves.rend(); ++m)
    if (fs::exists(m->first, ignored)) first = m->second;
  fail("cannot_write", lock.folder().string(),
       fmt::format("the new results are whole, but {} cannot be put in place: {}", first, std::strerror(error)),
       "make the folder and what is in it writable, then give the command again: it begins with what is left to do");
}

}  // namespace

bool has_results_to_place(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(staged_in(folder) / result_file, ignored);
}

StagedResults::StagedResults(const FolderLock& lock, std::set<std::string> own)
    : lock_(lock), staged_(staged_in(lock.folder())), own_(std::move(own)) {
  if (has_results_to_place(lock.folder())) go_on();
  fs::remove_all(staged_);
  if (const auto earlier = read_manifest(lock.folder())) own_.insert(earlier->files.begin(), earlier->files.end());
}

StagedResults::~StagedResults() {
  std::error_code ignored;
  if (!whole_) fs::remove_all(staged_, ignored);
}

void StagedResults::check_name_is_free(const std::string& name) const {
  const auto taken = [&](const fs::path& path, const std::string& why) {
    fail("folder_in_use", lock_.folder().string(), fmt::format("\"{}\" would be replaced, {}", path.string(), why),
         "choose another folder with -o, or call that one something else");
  };
  struct stat root {
  }, status{};
  if (::stat(lock_.folder().c_str(), &root) != 0) return;
  fs::path path = lock_.folder();
  for (const auto& part : fs::path(name).parent_path()) {
    if (::lstat((path /= part).c_str(), &status) != 0) return;  // to be made
    if (!S_ISDIR(status.st_mode)) taken(path, "and is no folder");
    if (status.st_dev != root.st_dev) taken(path, "and lies on a file system of its own");
    if (::access(path.c_str(), W_OK | X_OK) != 0)
      fail("cannot_write", path.string(), fmt::format("nothing can be written into {}", path.string()),
           "make it writable, or choose another folder with -o");
  }
  path = lock_.folder() / name;
  if (::lstat(path.c_str(), &status) != 0) return;
  if (!S_ISREG(status.st_mode)) taken(path, "and is no file that a run has written");
  if (!own_.contains(name)) taken(path, "which no run has written");
}

std::string StagedResults::place(const std::string& name) {
  check_name_is_free(name);
  const fs::path path = staged_ / name;
  fs::create_directories(path.parent_path());
  placed_.insert(name);
  return path.string();
}

void StagedResults::put_in_place() {
  for (const auto& name : placed_) {  // what replaces a file hands on its permissions
    struct stat status {};
    if (::lstat((lock_.folder() / name).c_str(), &status) == 0)
      ::chmod((staged_ / name).c_str(), status.st_mode & 07777);
  }
  go_on();
}

/// From whole new results to results in place, wherever it was left.
void StagedResults::go_on() {
  whole_ = true;
  const fs::path& folder = lock_.folder();
  std::set<std::string> old = own_;
  if (const auto earlier = read_manifest(folder)) old.insert(earlier->files.begin(), earlier->files.end());
  const auto manifest = read_manifest(staged_);
  const std::set<std::string> files = manifest ? manifest->files : std::set<std::string>{};
  Exchange exchange;
  exchange.new_folders = folders_of(files, folder);
  for (const auto& name : files) {
    old.erase(name);
    if (name != result_file && fs::exists(staged_ / name))
      exchange.moves.emplace_back((staged_ / name).string(), (folder / name).string());
  }
  std::erase_if(old,
                [&](const std::string& name) { return !lies_inside(folder, name) || !is_plain_file(folder / name); });
  for (const auto& name : old) exchange.old_files.push_back((folder / name).string());
  exchange.old_folders = folders_of(old, folder);  // those that hold anything else will stay
  std::reverse(exchange.old_folders.begin(), exchange.old_folders.end());
  exchange.last = {(staged_ / result_file).string(), (folder / result_file).string()};
  const int error = carry_out_even_if_killed(exchange);
  if (has_results_to_place(folder)) not_in_place(lock_, exchange, error);
  whole_ = false;  // what is left of the staged ones are empty folders
}

}  // namespace hysteron
