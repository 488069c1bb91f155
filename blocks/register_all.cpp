#include "blocks/register_all.h"

namespace hysteron {

Registry all_blocks() {
  Registry registry;
  for (const auto block : blocks::block_functions()) registry.add(block());
  return registry;
}

}  // namespace hysteron
