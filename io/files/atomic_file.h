// Decides how files reach the disk and come back: written whole or not at all, read whole or refused with a reason.
// Does not know what stands in them.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace hysteron {

/// Writes `content` to `file`: a temporary file in the same folder, flushed to the disk, then renamed over it; so
/// `file` holds the old or the new content, never a part. A device or pipe (/dev/full) is written directly. Folders
/// must exist. Throws Error "cannot_write"; Stopped (engine/diagram/stop.h), and then `file` is the old one.
void write_file(const std::string& file, std::string_view content);
/// The same for what is too long to be held in memory: `next_piece` gives piece by piece, an empty one at the end.
void write_file_in_pieces(const std::string& file, const std::function<std::string_view()>& next_piece);

/// A file that is written piece by piece: beside `file` under another name until it is finished. Locked while it is
/// written, so that others tell it from what a killed process left.
class UnfinishedFile {
 public:
  /// Removes what a killed process left of this very file. Throws Error "cannot_write".
  explicit UnfinishedFile(std::string file);
  /// Without finish() nothing is left.
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Where to write; it is there, and empty.
  const std::string& path() const { return temporary_; }
  /// Behind what was written so far.
  void append(std::string_view content);
  /// Flushes to the disk what was written, and renames it. A file that is replaced hands on its permissions.
  void finish();
  /// A write to path() failed: throws Error "cannot_write" with the reason that errno tells.
  [[noreturn]] void fail_now() const;

 private:
  bool begin(const std::string& temporary);

  std::string file_, temporary_;
  int descriptor_ = -1;
};

/// Where an UnfinishedFile of `file` lies: its name begins so.
std::string unfinished_prefix(const std::string& file);

/// Removes an unfinished file whose process is dead. Returns false where it is being written, where the file system has
/// no locks that would tell, or where it is no file.
bool remove_leftover(const std::string& unfinished);

/// The content of `file`. Throws Error "no_file", "is_directory", "not_a_file" (a device), "cannot_read".
std::string read_file(const std::string& file);

/// Throws what read_file() would throw for a file that is not there, a folder or a device.
void check_readable(const std::string& file);

}  // namespace hysteron
