// Decides how many names of a list a sentence holds: a file may have a thousand columns.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

/// "a, b, c", and of more than `most` the first ones: "a, b and 40 more".
inline std::string name_list(const std::vector<std::string>& names, std::size_t most = 8) {
  std::string text;
  const std::size_t told = names.size() > most ? most - 1 : names.size();
  for (std::size_t i = 0; i < told; ++i) text += (i == 0 ? "" : ", ") + names[i];
  return told == names.size() ? text : text + " and " + std::to_string(names.size() - told) + " more";
}

}  // namespace hysteron
