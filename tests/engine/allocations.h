// Counts what is allocated, also inside libraries, so that tests can say "nothing".
#pragma once

namespace hysteron {

/// Calls of malloc, calloc and realloc in this process so far; always 0 in a build with sanitizers.
long allocations();

}  // namespace hysteron
