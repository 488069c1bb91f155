// Decides which kind of our JSON files one is by its keys, so that a file at the wrong place is named as what it is and
// not by every key that would be wrong for another kind.
#pragma once

#include "io/json/json_reader.h"

namespace hysteron {

enum class FileKind { diagram, data_set, job };

/// Throws Error "other_kind" where the file is certainly a diagram or a data set, and not of the kind `expected`.
void check_kind(const JsonPlace& root, FileKind expected);

}  // namespace hysteron
