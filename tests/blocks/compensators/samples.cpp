// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples compensators{
    {"prandtl_ishlinskii_inverse", {{"thresholds", {0, 0.4, 1.1}}, {"weights", {1, 0.3, 0.2}}, {"before", {-2}}}},
    {"prandtl_ishlinskii_inverse",
     {{"thresholds", {0, 0.4, 1.1}}, {"weights", {1, 0.3, -0.2}}, {"sides", {1}}, {"before", {3}}}},
    {"bouc_wen_inverse", {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"origin", {0.2}}}},
    {"bouc_wen_inverse",
     {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"exponent", {2}}, {"scale", {0.5}}}},
    {"sampled_bouc_wen_inverse",
     {{"alpha", {0.6}}, {"beta", {0.24}}, {"gamma", {0.02}}, {"d_p", {1.6}}, {"initial", {0.1}}, {"period", {0.1}}}}};

}  // namespace
}  // namespace hysteron::bench
