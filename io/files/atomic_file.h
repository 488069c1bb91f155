// Decides how files reach the disk and come back: written whole or not at all, read whole or refused with a reason.
// Does not know what stands in them.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

/// Writes `content` to `file`: a temporary file in the same folder, flushed to the disk, then renamed over it; so
/// `file` holds the old or the new content, never a part. A device or pipe (/dev/full) is written directly. Folders
/// must exist. Throws Error "cannot_write".
void write_file(const std::string& file, std::string_view content);

/// A file that others write piece by piece: beside `file` under another name until it is finished.
class UnfinishedFile {
 public:
  /// Throws Error "cannot_write".
  explicit UnfinishedFile(std::string file);
  /// Without finish() nothing is left.
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Where to write; it is there, and empty.
  const std::string& path() const { return temporary_; }
  /// Flushes to the disk what was written and closed, and renames it.
  void finish();
  /// A write to path() failed: throws Error "cannot_write" with the reason that errno tells.
  [[noreturn]] void fail_now() const;

 private:
  std::string file_, temporary_;
};

/// Does a process write this unfinished file at present? Told by locks: false where the file system has none.
bool is_being_written(const std::string& unfinished);

/// How the names begin under which an UnfinishedFile of `file` lies.
std::string unfinished_prefix(const std::string& file);

/// The content of `file`. Throws Error "no_file", "is_directory", "not_a_file" (a device), "cannot_read".
std::string read_file(const std::string& file);

/// Throws what read_file() would throw for a file that is not there, a folder or a device.
void check_readable(const std::string& file);

}  // namespace hysteron
