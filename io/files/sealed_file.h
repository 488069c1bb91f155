// Decides how a file shows that it is still what was written: its last line is a digest of all bytes before it. Bits
// that a disk, a memory or a network turned over are seen. Does not know what stands in the file.
#pragma once

#include <string>

namespace hysteron {

enum class Seal { whole, broken, none };

/// Reads all of the file. Throws Error "no_file", "cannot_read"; Stopped (engine/diagram/stop.h).
Seal seal_of(const std::string& file);

/// The line that seals the file as it is now. Throws as seal_of() does.
std::string seal_line(const std::string& file);

}  // namespace hysteron
