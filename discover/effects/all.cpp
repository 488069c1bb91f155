#include "discover/effects/all.h"

namespace hysteron {

Effects all_effects() {
  std::vector<Effect> list;
  for (const auto effect : effects::effect_functions()) list.push_back(effect());
  return Effects(std::move(list));
}

}  // namespace hysteron
