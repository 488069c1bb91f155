#include "app/computed.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "engine/error.h"
#include "models/prandtl_ishlinskii_inverse.h"

namespace hysteron {

Quantity computed(const WrittenText& name) {
  static const std::map<std::string, Quantity (*)()> formulas{};
  const auto found = formulas.find(name.text);
  if (found != formulas.end()) return found->second();
  std::vector<std::string> known;
  for (const auto& [n, formula] : formulas) known.push_back(n);
  fail("unknown_figure", name.pointer, fmt::format("there is no formula \"{}\"", name.text),
       did_you_mean(name.text, known));
}

}  // namespace hysteron
