#include "io/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_file(std::string code, const std::string& file, std::string what, std::string cure) {
  throw Error(Fault::input, {{std::move(code), file, std::move(what), std::move(cure), {}, 0}});
}

[[noreturn]] void fail_write(const std::string& file, int error) {
  std::string cure = "choose another place with -o, or make that one writable";
  if (error == ENOSPC || error == EDQUOT)
    cure = "free space there, or choose another place with -o; nothing was left half written";
  if (error == ENOENT || error == ENOTDIR) cure = "make the folder first, or choose another place with -o";
  if (error == EISDIR) cure = "name a file, not a folder";
  if (error == EFBIG) cure = "raise the limit for the size of files (ulimit -f), or choose another place with -o";
  fail_file("cannot_write", file, fmt::format("cannot write {}: {}", file, std::strerror(error)), cure);
}

/// A file descriptor that closes itself.
struct Handle {
  explicit Handle(int descriptor) : fd(descriptor) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (fd >= 0) ::close(fd);
  }
  /// Some file systems tell of a full disk only here. Returns errno or 0.
  int close() {
    const int result = ::close(fd);
    fd = -1;
    return result == 0 ? 0 : errno;
  }
  int fd;
};

constexpr std::size_t written_at_once = 16 << 20;  // tens of milliseconds of a disk, then work may be asked to stop

/// Returns errno, or 0 if everything was written.
int write_all(int fd, std::string_view content) {
  while (!content.empty()) {
    look_up();
    const auto written = ::write(fd, content.data(), std::min(content.size(), written_at_once));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void write_directly(const std::string& file, const std::function<std::string_view()>& next_piece) {
  Handle handle(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
  if (handle.fd < 0) fail_write(file, errno);
  int error = 0;
  for (auto piece = next_piece(); error == 0 && !piece.empty(); piece = next_piece())
    error = write_all(handle.fd, piece);
  const int at_close = handle.close();
  if (error == 0) error = at_close;
  if (error != 0) fail_write(file, error);
}

/// Where `file` really lies, so that a symbolic link stays one and what it points at is replaced.
std::string behind_links(const std::string& file) {
  std::error_code ignored;
  if (!fs::is_symlink(file, ignored)) return file;
  const auto target = fs::weakly_canonical(file, ignored);
  return ignored ? file : target.string();
}

/// Does `path` still name what was opened? Another process may have removed or renamed it meanwhile.
bool is_named(int fd, const std::string& path) {
  struct stat opened {
  }, named{};
  return ::fstat(fd, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

constexpr int most_writers = 1000;  // of one file at once

}  // namespace

void write_file(const std::string& file, std::string_view content) {
  write_file_in_pieces(file, [&] { return std::exchange(content, {}); });
}

void write_file_in_pieces(const std::string& file, const std::function<std::string_view()>& next_piece) {
  const std::string target = behind_links(file);
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail_write(file, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) return write_directly(target, next_piece);
  UnfinishedFile unfinished(target);
  for (auto piece = next_piece(); !piece.empty(); piece = next_piece()) unfinished.append(piece);
  unfinished.finish();
}

std::string unfinished_prefix(const std::string& file) { return file + ".partial-"; }

bool remove_leftover(const std::string& unfinished) {
  const Handle handle(::open(unfinished.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat status {};
  return handle.fd >= 0 && ::fstat(handle.fd, &status) == 0 && S_ISREG(status.st_mode) &&
         ::flock(handle.fd, LOCK_EX | LOCK_NB) == 0 && is_named(handle.fd, unfinished) &&
         ::unlink(unfinished.c_str()) == 0;
}

UnfinishedFile::UnfinishedFile(std::string file) : file_(std::move(file)) {
  for (int writer = 1; writer <= most_writers; ++writer) {
    const std::string name = unfinished_prefix(file_) + "hysteron" + (writer == 1 ? "" : std::to_string(writer));
    if (begin(name) || (remove_leftover(name) && begin(name))) return;
  }
  fail_write(file_, EEXIST);
}

/// Makes `temporary` and locks it; false where that name is taken.
bool UnfinishedFile::begin(const std::string& temporary) {
  Handle handle(::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666));
  if (handle.fd < 0 && errno == EEXIST) return false;
  if (handle.fd < 0) fail_write(file_, errno);
  // Another process may take it for a leftover until it is locked; a file system may have no locks at all.
  if (::flock(handle.fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  if (!is_named(handle.fd, temporary)) return false;
  descriptor_ = std::exchange(handle.fd, -1);
  temporary_ = temporary;
  return true;
}

UnfinishedFile::~UnfinishedFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
}

void UnfinishedFile::fail_now() const { fail_write(file_, errno != 0 ? errno : EIO); }

void UnfinishedFile::append(std::string_view content) {
  if (const int error = write_all(descriptor_, content); error != 0) fail_write(file_, error);
}

void UnfinishedFile::finish() {
  struct stat status {};
  const bool replaces = ::stat(file_.c_str(), &status) == 0 && S_ISREG(status.st_mode);
  int error = replaces && ::fchmod(descriptor_, status.st_mode & 07777) != 0 ? errno : 0;
  if (error == 0 && ::fsync(descriptor_) != 0) error = errno;  // some file systems tell of a full disk only here
  if (error == 0 && ::rename(temporary_.c_str(), file_.c_str()) != 0) error = errno;
  if (error != 0) fail_write(file_, error);
  temporary_.clear();
}

namespace {

/// Its size, where it is a file that can be read.
off_t size_of_readable(const std::string& file) {
  if (file.empty()) fail_file("no_file", file, "the name of the file is empty", "write the name of a file");
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT || errno == ENOTDIR)
      fail_file(
          "no_file", file, fmt::format("there is no file {}", file),
          "check the path: on the command line it counts from the current folder, in a file from the folder of that file");
    fail_file("cannot_read", file, fmt::format("cannot read {}: {}", file, std::strerror(errno)), "make it readable");
  }
  if (S_ISDIR(status.st_mode))
    fail_file("is_directory", file, fmt::format("{} is a folder, a file was expected", file), "name a file inside it");
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode))
    fail_file("not_a_file", file, fmt::format("{} is a device, a file was expected", file), "name an ordinary file");
  return status.st_size;
}

}  // namespace

void check_readable(const std::string& file) { size_of_readable(file); }

std::string read_file(const std::string& file) {
  const off_t size = size_of_readable(file);
  Handle handle(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (handle.fd < 0)
    fail_file("cannot_read", file, fmt::format("cannot read {}: {}", file, std::strerror(errno)), "make it readable");
  std::string content;
  std::size_t used = 0;
  content.resize(static_cast<std::size_t>(size) + 1);  // one more, so that the end is seen without growing
  while (true) {
    if (used == content.size()) content.resize(2 * content.size());
    const auto count = ::read(handle.fd, content.data() + used, content.size() - used);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      fail_file("cannot_read", file, fmt::format("cannot read {}: {}", file, std::strerror(errno)),
                "copy it to a sound disk");
    if (count == 0) break;
    used += static_cast<std::size_t>(count);
  }
  content.resize(used);
  return content;
}

}  // namespace hysteron
