#include "io/files/shell_word.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace hysteron {
namespace {

bool means_nothing(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("_./:=@%+,-").find(c) != std::string_view::npos;
}

/// $'...': the only quotes in which a newline can be written without being one.
std::string with_escapes(const std::string& word) {
  std::string text = "$'";
  for (const char c : word) {
    if (is_control(c))
      text += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    else if (c == '\'' || c == '\\')
      text += std::string("\\") + c;
    else
      text += c;
  }
  return text + "'";
}

}  // namespace

std::string shell_word(const std::string& word) {
  if (!word.empty() && std::all_of(word.begin(), word.end(), means_nothing)) return word;
  if (std::any_of(word.begin(), word.end(), is_control)) return with_escapes(word);
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace hysteron
