// Samples of the blocks of this room.
#include "tests/blocks/samples.h"

namespace hysteron::bench {
namespace {

const Samples sources{
    {"constant", {{"value", {2.5}}}},
    {"sine", {{"amplitude", {3}}, {"offset", {1}}, {"frequency", {0.7}}, {"phase", {0.4}}}},
    {"triangle", {{"amplitude", {3}}, {"offset", {1}}, {"frequency", {0.7}}, {"phase", {0.4}}}},
    {"step", {{"before", {1}}, {"after", {4}}, {"time", {0.35}}}},
    {"staircase", {{"levels", {1, 4, 2}}, {"duration", {0.3}}}},
    {"chirp",
     {{"amplitude", {3}},
      {"offset", {1}},
      {"from", {0.5}},
      {"to", {6}},
      {"duration", {0.9}},
      {"sweep", {1}},
      {"phase", {0.2}}}},
    {"multisine",
     {{"rms", {2}}, {"offset", {1}}, {"lowest", {0.5}}, {"highest", {4}}, {"spacing", {0.5}}, {"seed", {3}}}}};

}  // namespace
}  // namespace hysteron::bench
