#include "engine/events/start_order.h"

#include <algorithm>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

constexpr int most_sweeps = 100;

}  // namespace

std::vector<int> start_ranks(const Program& program) {
  std::vector<int> before(program.blocks.size(), 0), behind(program.blocks.size(), 0);
  bool moved = !program.modal_blocks.empty();
  for (int sweep = 0; moved && sweep < most_sweeps; ++sweep) {
    moved = false;
    for (const int block : program.value_order) {
      const BlockInstance& b = program.blocks[at(block)];
      int inputs = 0;
      for (const int s : b.source) inputs = std::max(inputs, behind[at(program.signals[at(s)].block)]);
      before[at(block)] = inputs;
      const bool settles = b.mode_index >= 0 || b.history_index >= 0;
      const int outputs = settles ? inputs + 1 : b.sizes.feedthrough ? inputs : 0;
      moved = moved || outputs != behind[at(block)];
      behind[at(block)] = outputs;
    }
  }
  std::vector<int> ranks;
  for (const int block : program.modal_blocks) ranks.push_back(before[at(block)]);
  return ranks;
}

}  // namespace hysteron
