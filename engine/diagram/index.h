// Decides how a place in a list becomes an index of a vector. Places are int, and -1 means none.
#pragma once

#include <cstddef>

namespace hysteron {

inline std::size_t at(int place) { return static_cast<std::size_t>(place); }

}  // namespace hysteron
