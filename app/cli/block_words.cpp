#include "app/cli/block_words.h"

#include "app/cli/load.h"
#include "blocks/other_names.h"
#include "engine/diagram/error.h"

namespace hysteron {

std::string instead_of_type(const std::string& type) {
  const std::string known = instead_of_other_name(type);
  auto types = registry().types();
  std::erase(types, "input");
  types.push_back("diagram");
  for (const auto& own : types)
    if (plain_name(own) == plain_name(type)) return "it is written \"" + own + "\".";
  return (known.empty() ? did_you_mean(type, types) : known + ".") + " \"hysteron blocks\" shows all types.";
}

}  // namespace hysteron
