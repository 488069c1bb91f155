// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples measurement{
    {"wheatstone_bridge", {{"supply", {5}}, {"resistance", {350}}, {"gauge_factor", {0.02}}}},
    {"wheatstone_bridge_inverse", {{"supply", {50}}, {"resistance", {350}}, {"gauge_factor", {0.02}}}},
    {"sensor_noise", {{"rms", {0.3}}, {"period", {0.05}}, {"seed", {11}}}}};

}  // namespace
}  // namespace hysteron::bench
