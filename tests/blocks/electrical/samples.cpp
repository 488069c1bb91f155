// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples electrical{
    {"winding", {{"resistance", {2}}, {"inductance", {0.7}}, {"initial", {0.3}}}},
    {"voice_coil", {{"force_constant", {1.4}}, {"resistance", {2}}, {"inductance", {0.7}}}},
    {"pwm", {{"frequency", {0.9}}}},
    {"pwm", {{"frequency", {0.9}}, {"modulation", {1}}}},
    {"h_bridge", {{"supply", {3}}, {"resistance", {0.4}}}},
    {"h_bridge_with_dead_time", {{"supply", {3}}, {"resistance", {0.4}}, {"loss", {0.2}}}},
    {"synchronous_motor",
     {{"resistance", {0.4}}, {"inductance_d", {0.5}}, {"inductance_q", {0.8}}, {"flux", {0.6}}, {"pole_pairs", {2}}}},
    {"stepper_motor",
     {{"resistance", {0.4}}, {"inductance", {0.5}}, {"torque_constant", {0.6}}, {"teeth", {3}}, {"detent", {0.2}}}},
    {"battery_cell",
     {{"capacity", {20}},
      {"resistance", {0.1}},
      {"charges", {0, 0.3, 1}},
      {"open_circuit", {3, 3.6, 4.2}},
      {"resistances", {0.2, 0.1}},
      {"times", {0.3, 2}},
      {"initial", {0.8}}}}};

}  // namespace
}  // namespace hysteron::bench
