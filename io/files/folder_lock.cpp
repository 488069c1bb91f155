#include "io/files/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds look_again{50};
constexpr int most_coincidences = 8;  // on end; others who write there take away what they made, but not that often

[[noreturn]] void cannot_write(const fs::path& folder, const fs::path& what, int error) {
  fail("cannot_write", folder.string(), fmt::format("{} cannot be made: {}", what.string(), std::strerror(error)),
       error == ENOSPC || error == EDQUOT ? "free space there, or choose another folder with -o; nothing was changed"
                                          : "choose another folder with -o, or make that one writable");
}

std::string this_process() {
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  return fmt::format("process {} on {}", ::getpid(), host);
}

std::string content_of(int fd) {
  char text[512];
  const auto count = ::pread(fd, text, sizeof text, 0);
  return {text, count > 0 ? static_cast<std::size_t>(count) : 0};
}

}  // namespace

FolderLock::FolderLock(fs::path folder, const Waiting& waiting) : folder_(std::move(folder)) {
  std::string holder;
  try {
    while (!take(holder)) {
      look_up();
      if (waiting) waiting(holder.empty() ? "another process" : holder);
      std::this_thread::sleep_for(look_again);
    }
  } catch (...) {
    remove_made();
    throw;
  }
}

FolderLock::~FolderLock() {
  // Removed while it is held: who waits for it sees that it is gone, and makes another.
  if (descriptor_ >= 0) ::unlink((unfinished() / "lock").c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
  remove_made();
}

/// Another process took `what` away this instant, or it is one of the places (/proc) where nothing can be made and the
/// system says that it is not there.
void FolderLock::try_again_or_fail(const fs::path& what) {
  if (++vanished_ >= most_coincidences) cannot_write(folder_, what, ENOENT);
}

/// False where another process took one of them away this instant.
bool FolderLock::make_folders() {
  fs::path path;
  for (const auto& part : unfinished()) {
    path /= part;
    if (::mkdir(path.c_str(), 0777) == 0) {
      if (path != unfinished()) made_.push_back(path);
      continue;
    }
    const int error = errno;
    std::error_code code;
    if (error != ENOENT && fs::is_directory(path, code)) continue;
    // The one around it, which was there, is gone, or it is itself.
    if (error == ENOENT || (error == EEXIST && fs::symlink_status(path, code).type() == fs::file_type::not_found)) {
      try_again_or_fail(path);
      return false;
    }
    cannot_write(folder_, path, error == EEXIST ? ENOTDIR : error);
  }
  return true;
}

void FolderLock::remove_made() {
  ::rmdir(unfinished().c_str());
  for (; !made_.empty(); made_.pop_back()) ::rmdir(made_.back().c_str());
}

/// False, and by whom, while another process has the lock.
bool FolderLock::take(std::string& holder) {
  if (!make_folders()) return false;
  const std::string file = (unfinished() / "lock").string();
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (fd < 0 && errno == ENOENT) {  // the last one took its folder away
    try_again_or_fail(file);
    return false;
  }
  if (fd < 0) cannot_write(folder_, file, errno);
  const bool locked = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  const bool taken = !locked && errno == EWOULDBLOCK;
  struct stat opened {
  }, named{};
  const bool same = ::fstat(fd, &opened) == 0 && ::stat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino;
  if (taken || !same) {
    holder = content_of(fd);
    ::close(fd);
    if (taken)
      vanished_ = 0;
    else
      try_again_or_fail(file);
    return false;
  }
  const std::string text = this_process();
  if (::ftruncate(fd, 0) == 0) [[maybe_unused]]
    const auto written = ::pwrite(fd, text.data(), text.size(), 0);
  descriptor_ = fd;
  return true;
}

bool is_free(const fs::path& folder) {
  std::error_code ignored;  // it may have gone: then it is free
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const auto name = entry.path().filename();
    if (name != unfinished_folder && !(name == "lost+found" && entry.is_directory(ignored))) return false;
  }
  return true;
}

}  // namespace hysteron
