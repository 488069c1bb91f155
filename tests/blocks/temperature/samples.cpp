// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples temperature{
    {"pyro_charge", {{"coefficient", {0.4}}, {"time", {0.7}}}},
    {"temperature_gain", {{"sensitivity", {0.2}}, {"reference", {0.5}}, {"curvature", {0.1}}}},
    {"thermal_expansion", {{"coefficients", {0.4, -0.2}}, {"times", {0.3, 1.1}}, {"reference", {0.5}}}, 2}};

}  // namespace
}  // namespace hysteron::bench
