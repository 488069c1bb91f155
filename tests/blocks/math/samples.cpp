// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples math{
    {"gain", {{"gain", {-1.7}}}},
    {"sum", {{"signs", {'+', '-', '+'}}}, 3},
    {"product", {}},
    {"pass", {}},
    {"saturation", {{"lower", {-1}}, {"upper", {1.4}}}},
    {"calibration", {{"gain", {1.1}}, {"offset", {0.3}}}},
    {"polynomial", {{"coefficients", {0.2, 1, -0.3, 0.1}}, {"reference", {2}}, {"lower", {-1}}, {"upper", {1.7}}}},
    {"soft_saturation", {{"limit", {1.3}}, {"sharpness", {3}}}},
    {"rectifier", {{"mix", {0.4}}}},
    {"rounding", {{"step", {0.3}}}},
    {"cross_coupling", {{"coefficient", {0.3}}}},
    {"late_cross_coupling", {{"coefficient", {0.3}}, {"time", {0.6}}}}};

}  // namespace
}  // namespace hysteron::bench
