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

/// The content of `file`. Throws Error "no_file", "is_directory", "not_a_file" (a device), "cannot_read".
std::string read_file(const std::string& file);

}  // namespace hysteron
