// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples sampled{
    {"sample_hold", {{"period", {0.1}}}},
    {"quantizer", {{"bits", {5}}, {"lower", {-3}}, {"upper", {3}}, {"period", {0.1}}}},
    {"sampled_noise", {{"rms", {0.3}}, {"seed", {11}}, {"period", {0.1}}}},
    {"delay_line", {{"samples", {3}}, {"before", {0.4}}, {"period", {0.1}}}},
    {"delay_line", {{"samples", {0}}, {"period", {0.1}}}},
    {"discrete_transfer_function",
     {{"gain", {2}}, {"num", {1, -0.3, 0.2}}, {"den", {2, -0.5, 0.1, 0.05}}, {"before", {0.5}}, {"period", {0.1}}}},
    {"discrete_transfer_function",
     {{"gain", {2}}, {"num", {1, -0.3}}, {"den", {2, -0.5}}, {"direct", {1}}, {"period", {0.1}}}},
    {"sampled_pid",
     {{"kp", {1.2}},
      {"ki", {3}},
      {"kd", {0.1}},
      {"filter", {0.2}},
      {"lower", {-2}},
      {"upper", {2}},
      {"rule", {2}},
      {"anti_windup", {2}},
      {"period", {0.1}}}},
    {"impedance_estimator",
     {{"samples", {20}}, {"layers", {2}}, {"area", {0.5}}, {"thickness", {0.1}}, {"period", {0.1}}}}};

}  // namespace
}  // namespace hysteron::bench
