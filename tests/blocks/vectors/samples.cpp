// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples vectors{{"mux", {}, 3},
                      {"demux", {{"lengths", {2, 1}}}, 3},
                      {"select", {{"indices", {2, 0}}}, 3},
                      {"matrix_gain", {{"matrix", {1, -2, 0.5, 0, 3, 1}}, {"matrix columns", {3}}}, 3}};

}  // namespace
}  // namespace hysteron::bench
