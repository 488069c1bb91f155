// Decides how the program takes memory from the system: in pages of 2 MB where there are such. Of a diagram of 31 000
// blocks, whose parts lie anywhere, two thirds of the time of a check were spent on the way to memory
// (docs/performance.md). The library and what is linked to it leave that to the process that they stand in.

// NOLINTNEXTLINE: read by jemalloc under this name (jemalloc(3), "TUNING").
extern "C" {
__attribute__((visibility("default"))) extern const char* const malloc_conf;
const char* const malloc_conf = "thp:always,dirty_decay_ms:30000,muzzy_decay_ms:30000";
}
