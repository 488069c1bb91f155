#include "blocks/c_laws.h"

#include <map>
#include <string>

namespace hysteron {

const CLaw* find_c_law(const std::string& type) {
  static const std::map<std::string, CLaw> all = [] {
    std::map<std::string, CLaw> laws;
    for (const auto make : blocks::c_law_functions()) {
      CLaw law = make();
      laws.emplace(law.type, law);
    }
    return laws;
  }();
  const auto found = all.find(type);
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace hysteron
