// Decides how tests read the sources of the project.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace hysteron::sources {

inline bool is_source(const std::filesystem::path& file) {
  return file.extension() == ".h" || file.extension() == ".cpp";
}

/// Byte for byte; "" where there is no such file.
inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace hysteron::sources
