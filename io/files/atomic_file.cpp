#include "io/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "engine/diagram/error.h"

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

/// Returns errno, or 0 if everything was written.
int write_all(int fd, std::string_view content) {
  while (!content.empty()) {
    const auto written = ::write(fd, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void write_directly(const std::string& file, std::string_view content) {
  Handle handle(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
  if (handle.fd < 0) fail_write(file, errno);
  int error = write_all(handle.fd, content);
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

void write_and_rename(const std::string& file, std::string_view content, mode_t mode) {
  std::string temporary = file + ".XXXXXX";
  Handle handle(::mkostemp(temporary.data(), O_CLOEXEC));
  if (handle.fd < 0) fail_write(file, errno);
  int error = write_all(handle.fd, content);
  if (error == 0 && ::fchmod(handle.fd, mode) != 0) error = errno;
  if (error == 0 && ::fsync(handle.fd) != 0) error = errno;
  const int at_close = handle.close();
  if (error == 0) error = at_close;
  if (error == 0 && ::rename(temporary.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail_write(file, error);
  }
}

/// Permissions of a new file under the user's mask. umask() can only be read by setting it, which would race between
/// threads; Linux shows it in /proc.
mode_t mode_of_new_files() {
  Handle handle(::open("/proc/self/status", O_RDONLY | O_CLOEXEC));
  char buffer[4096];
  const auto count = handle.fd < 0 ? -1 : ::read(handle.fd, buffer, sizeof buffer - 1);
  if (count <= 0) return 0644;
  buffer[count] = '\0';
  const char* line = std::strstr(buffer, "Umask:");
  if (line == nullptr) return 0644;
  return static_cast<mode_t>(0666 & ~std::strtoul(line + 6, nullptr, 8));
}

}  // namespace

void write_file(const std::string& file, std::string_view content) {
  const std::string target = behind_links(file);
  struct stat status {};
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail_write(file, EISDIR);
  if (exists && !S_ISREG(status.st_mode)) return write_directly(target, content);
  write_and_rename(target, content, exists ? (status.st_mode & 07777) : mode_of_new_files());
}

bool is_being_written(const std::string& unfinished) {
  Handle handle(::open(unfinished.c_str(), O_RDONLY | O_CLOEXEC));
  return handle.fd >= 0 && ::flock(handle.fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

std::string unfinished_prefix(const std::string& file) { return file + ".partial-"; }

UnfinishedFile::UnfinishedFile(std::string file) : file_(std::move(file)) {
  temporary_ = unfinished_prefix(file_) + "XXXXXX";
  Handle handle(::mkostemp(temporary_.data(), O_CLOEXEC));
  if (handle.fd < 0) fail_write(file_, errno);
  ::fchmod(handle.fd, mode_of_new_files());
}

UnfinishedFile::~UnfinishedFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void UnfinishedFile::fail_now() const { fail_write(file_, errno != 0 ? errno : EIO); }

void UnfinishedFile::finish() {
  Handle handle(::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC));
  if (handle.fd >= 0) ::flock(handle.fd, LOCK_EX | LOCK_NB);  // nobody takes it for a leftover
  int error = handle.fd < 0 || ::fsync(handle.fd) != 0 ? errno : 0;
  const int at_close = handle.fd < 0 ? 0 : handle.close();
  if (error == 0) error = at_close;
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
      fail_file("no_file", file, fmt::format("there is no file {}", file),
                "check the path; it counts from where it is written");
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
