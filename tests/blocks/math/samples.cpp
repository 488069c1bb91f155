// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

/// A text as the codes of its characters.
Numbers codes(const std::string& text) { return {text.begin(), text.end()}; }

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
    {"late_cross_coupling", {{"coefficient", {0.3}}, {"time", {0.6}}}},
    {"expression", {{"y", codes("sin(a)*b + max(a, 0.3*b) - a^3/(1 + b^2)")}}, 2},
    {"expression", {{"y", codes("if(a > 0.2 and b < 1, abs(b), 2)*(floor(a) + sign(b))")}}, 2},
    {"lookup", {{"values", {1, 3, 2.5, -1}}, {"at", {-1, 0.1, 0.7, 2}}}, 1},
    {"lookup", {{"values", {1, 3, 2.5, -1}}, {"at", {-1, 0.1, 0.7, 2}}, {"between", {1}}, {"outside", {1}}}, 1},
    {"lookup", {{"values", {1, 3, 2.5, -1, 0, 2}}, {"at", {-1, 0.7}}, {"at_2", {-0.5, 0.2, 1}}, {"between", {2}}}, 2},
    {"divide", {}},
    {"abs", {}},
    {"sign", {}},
    {"min_max", {{"is", {1}}}, 3},
    {"trigonometry", {{"function", {5}}}, 1},
    {"trigonometry", {{"function", {0}}}, 1}};

}  // namespace
}  // namespace hysteron::bench
