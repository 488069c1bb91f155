// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples disturbances{
    {"sensor_drift", {{"rate", {0.3}}, {"zero", {0.1}}}},
    {"mains_interference", {{"frequency", {1.3}}, {"cosine", {0.4, 0.1}}, {"sine", {-0.2, 0.3}}}}};

}  // namespace
}  // namespace hysteron::bench
