// Samples of sampled filters, sums and observers.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples filters{
    {"digital_filter", {{"order", {3}}, {"corner", {1.1}}, {"before", {0.4}}, {"period", {0.1}}}},
    {"digital_filter",
     {{"family", {1}}, {"pass", {2}}, {"order", {2}}, {"corner", {1.1}}, {"upper", {2.5}}, {"period", {0.1}}}},
    {"fir", {{"coefficients", {0.5, 0.3, -0.2}}, {"before", {0.4}}, {"period", {0.1}}}},
    {"moving_average", {{"samples", {4}}, {"before", {0.4}}, {"period", {0.1}}}},
    {"discrete_integrator", {{"initial", {0.3}}, {"period", {0.1}}}},
    {"discrete_integrator", {{"rule", {2}}, {"period", {0.1}}}},
    {"discrete_state_space",
     {{"a", {0.4, 0.1, -0.2, 0.8}},
      {"a columns", {2}},
      {"b", {0, 1, 0.4, 0.5}},
      {"b columns", {2}},
      {"c", {1, 0, 0.5, 2}},
      {"c columns", {2}},
      {"initial", {0.3, -0.2}},
      {"period", {0.1}}},
     2},
    {"observer",
     {{"a", {0.4, 0.1, -0.2, 0.8}},
      {"a columns", {2}},
      {"b", {0.4, 0.5}},
      {"b columns", {1}},
      {"c", {1, 0, 0.5, 2}},
      {"c columns", {2}},
      {"d", {0.3, 0}},
      {"d columns", {1}},
      {"gain", {0.5, 0.1, 0, 0.2}},
      {"gain columns", {2}},
      {"initial", {0.3, -0.2}},
      {"period", {0.1}}},
     3},
    {"kalman_filter",
     {{"a", {0.4, 0.1, -0.2, 0.8}},
      {"a columns", {2}},
      {"b", {0.4, 0.5}},
      {"b columns", {1}},
      {"c", {1, 0.5}},
      {"c columns", {2}},
      {"process_noise", {0.1, 0, 0, 0.2}},
      {"process_noise columns", {2}},
      {"measurement_noise", {0.3}},
      {"measurement_noise columns", {1}},
      {"period", {0.1}}},
     2},
    {"disturbance_observer", {{"inertia", {0.4}}, {"corner", {0.9}}, {"period", {0.1}}}},
    {"repetitive_controller",
     {{"samples", {4}}, {"gain", {0.7}}, {"lead", {1}}, {"keep", {0.9}}, {"smoothing", {0.3}}, {"period", {0.1}}}}};

}  // namespace
}  // namespace hysteron::bench
