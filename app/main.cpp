// Decides nothing: hands the words of the command line over.
// See command_line.h for reading and failing, verb.h for the verbs.
#include "app/cli/command_line.h"

// How jemalloc, where the program is linked to it, takes memory from the system (jemalloc(3), "TUNING"): in pages of 2
// MB where there are such. Of a diagram of 31 000 blocks, whose parts lie anywhere, two thirds of a check were spent on
// the way to memory (docs/performance.md). The library leaves that to the process that it stands in.
extern "C" {
__attribute__((visibility("default"))) extern const char* const malloc_conf;
const char* const malloc_conf = "thp:always,dirty_decay_ms:30000,muzzy_decay_ms:30000";
}

int main(int argc, char** argv) { return hysteron::run_command_line({argv + 1, argv + argc}); }
