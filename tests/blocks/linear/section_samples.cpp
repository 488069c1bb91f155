// Samples of sections by frequency and damping.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples sections{
    {"lead_lag", {{"gain", {1.4}}, {"zero", {0.3}}, {"pole", {1.1}}}},
    {"notch", {{"frequency", {0.8}}, {"damping", {0.4}}, {"depth", {0.2}}}},
    {"second_order", {{"gain", {1.4}}, {"frequency", {0.8}}, {"damping", {0.4}}}},
    {"second_order", {{"gain", {1.4}}, {"frequency", {0.8}}, {"damping", {0.4}}, {"pass", {1}}}},
    {"second_order", {{"gain", {1.4}}, {"frequency", {0.8}}, {"damping", {0.4}}, {"pass", {2}}}},
    {"biquads",
     {{"gain", {1.4}},
      {"zero_frequencies", {0.8, 1.3}},
      {"zero_dampings", {0.1, -0.2}},
      {"pole_frequencies", {0.7, 0.9}},
      {"pole_dampings", {0.5, 0.7}}}},
    {"zero_pole_gain",
     {{"gain", {1.4}}, {"zeros", {-3}}, {"poles", {-2}}, {"pole_pairs", {-1, 4}}, {"pole_pairs columns", {2}}}},
    {"zero_pole_gain", {{"zeros", {3}}, {"zero_pairs", {-1, 2}}, {"zero_pairs columns", {2}}, {"poles", {-2, -1, -4}}}},
    {"input_shaper", {{"frequency", {1.3}}, {"damping", {0.2}}}}};

}  // namespace
}  // namespace hysteron::bench
