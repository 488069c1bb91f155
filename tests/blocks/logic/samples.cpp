// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

Numbers codes(const std::string& text) { return {text.begin(), text.end()}; }

const Samples logic{
    {"compare", {{"is", {4}}}},
    {"comparator", {{"level", {0.2}}, {"above", {3}}, {"below", {-1}}}},
    {"logic", {{"is", {4}}}, 3},
    {"enabling", {}, 2},
    {"switch", {{"level", {0.2}}}},
    {"manual_switch", {{"position", {1}}}},
    {"sample_and_hold", {{"initial", {0.3}}}},
    {"edge", {{"edge", {2}}, {"period", {0.1}}}},
    {"counter", {{"by", {2}}}},
    {"timer", {}},
    {"state_machine",
     {{"states", codes("low, high, late")},
      {"transitions", codes("low -> high: u > 0.3; high -> late: u < -0.3 and time > v; late -> low: v < 0")}},
     2}};

}  // namespace
}  // namespace hysteron::bench
