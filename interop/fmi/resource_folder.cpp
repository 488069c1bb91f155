#include "interop/fmi/resource_folder.h"

#include <dlfcn.h>

#include <filesystem>

namespace hysteron::interop {
namespace {

/// binaries/linux64/stage.so -> resources
std::string beside_the_binary() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&resource_folder), &info) == 0 || info.dli_fname == nullptr) return "";
  const std::filesystem::path binary = std::filesystem::absolute(info.dli_fname);
  return (binary.parent_path().parent_path().parent_path() / "resources").string();
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// RFC 3986: "%20" is a blank.
std::string decoded(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escaped = text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
    out += escaped ? static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2])) : text[i];
    if (escaped) i += 2;
  }
  return out;
}

}  // namespace

std::string resource_folder(const std::string& given) {
  if (given.empty()) return beside_the_binary();
  constexpr char scheme[] = "file:";
  if (!given.starts_with(scheme)) return given;
  std::string path = given.substr(sizeof scheme - 1);
  if (path.starts_with("//")) {  // an authority: none, or this machine
    const auto slash = path.find('/', 2);
    path = slash == std::string::npos ? "" : path.substr(slash);
  }
  return decoded(path);
}

}  // namespace hysteron::interop
