// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples continuous{
    {"ageing", {{"per_decade", {0.03}}, {"first", {50}}, {"swing", {0.3}}}},
    {"load_dependence", {{"compliance", {0.2}}, {"softening", {0.1}}}},
    {"resonance", {{"frequency", {0.8}}, {"damping", {0.2}}}},
    {"modes",
     {{"frequencies", {0.8, 1.3}}, {"dampings", {0.2, 0.1}}, {"positions", {0.4, 0.1}}, {"velocities", {-0.3, 0.2}}}},
    {"integrator", {{"initial", {0.6}}}},
    {"transfer_function", {{"gain", {2}}, {"num", {1, 3}}, {"den", {0.5, 2, 8}}}},
    {"transfer_function", {{"gain", {2}}, {"num", {1, 0.2, 3}}, {"den", {0.5, 2, 8}}}},
    {"state_space",
     {{"a", {0, 1, -8, -2}},
      {"a columns", {2}},
      {"b", {0, 1, 8, 0.5}},
      {"b columns", {2}},
      {"c", {1, 0, 0.5, 2, 1, 1}},
      {"c columns", {2}},
      {"initial", {0.3, -0.2}}},
     2},
    {"state_space",
     {{"a", {-2}},
      {"a columns", {1}},
      {"b", {1, -3}},
      {"b columns", {2}},
      {"c", {4}},
      {"c columns", {1}},
      {"d", {0.5, 1}},
      {"d columns", {2}},
      {"input_unit", {'m', 'V'}},
      {"output_unit", {'u', 'm'}}},
     2},
    {"pi_controller", {{"kp", {1.2}}, {"ki", {3}}, {"initial", {0.1}}}},
    {"lag", {{"times", {0.3}}}},
    {"lag", {{"times", {0.3, 0.7}}}},
    {"creep", {{"amounts", {0.1, 0.3}}, {"times", {0.2, 2}}}},
    {"logarithmic_creep", {{"per_decade", {0.2}}, {"first_time", {0.1}}, {"times", {0.05, 0.2, 2}}}},
    {"dead_time", {{"delay", {0.21}}}},
    {"rate_limiter", {{"rise", {4}}, {"fall", {2}}, {"time", {0.05}}}},
    {"slew_limit", {{"rate", {4}}, {"fall", {2}}, {"time", {0.05}}}},
    {"current_limit", {{"source", {0.4}}, {"sink", {0.2}}, {"capacitance", {0.1}}, {"time", {0.05}}}},
    {"tank", {{"area", {2}}, {"outlet", {0.6}}, {"reference", {1}}, {"brim", {4}}, {"initial", {1}}}},
    {"tank",
     {{"area", {2}}, {"outlet", {0.6}}, {"reference", {1}}, {"law", {2}}, {"exponent", {0.8}}, {"initial", {1}}}},
    {"tank", {{"area", {2}}, {"outlet", {0.6}}, {"reference", {1}}, {"law", {1}}, {"brim", {9}}, {"initial", {1}}}},
    {"thermal_network",
     {{"capacities", {4, 3}}, {"to_ambient", {0.2, 0.3}}, {"between", {0.7}}, {"initial", {300, 310}}},
     3}};

}  // namespace
}  // namespace hysteron::bench
