#include "report/page/html.h"

namespace hysteron {

std::string escape(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 16);
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else if (u >= 0x20 ? u != 0x7f : c == '\n' || c == '\t')
      out += c;
  }
  return out;
}

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) || (static_cast<unsigned char>(c) & 0x80); }

/// "3 um -> 1 um" with an arrow that no line ends within.
std::string with_arrows(std::string text) {
  for (auto at = text.find(" -> "); at != std::string::npos; at = text.find(" -> ", at + 1))
    text.replace(at, 4, "\u00a0→ ");
  return text;
}

/// "3.2 %", "0.4 um": no line break between a number and a short word behind it, which is mostly its unit.
std::string glue_units(std::string_view text) {
  constexpr std::size_t longest_unit = 5;
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    bool unit = false;
    if (text[i] == ' ' && i > 0 && std::isdigit(static_cast<unsigned char>(text[i - 1]))) {
      std::size_t end = i + 1;
      while (end < text.size() && (is_letter(text[end]) || text[end] == '/')) ++end;
      unit = (end > i + 1 && end - i - 1 <= longest_unit) || (end < text.size() && text[end] == '%');
    }
    if (unit)
      out += "\u00a0";
    else
      out += text[i];
  }
  return out;
}

}  // namespace

std::string escape_prose(std::string_view prose) {
  const std::string glued = with_arrows(glue_units(prose));
  std::string_view text = glued;
  std::string out;
  while (!text.empty()) {
    const auto open = text.find('`');
    const auto close = open == std::string_view::npos ? open : text.find('`', open + 1);
    if (close == std::string_view::npos) return out + escape(text);
    out += escape(text.substr(0, open));
    out += "<code>" + escape(text.substr(open + 1, close - open - 1)) + "</code>";
    text.remove_prefix(close + 1);
  }
  return out;
}

std::string escape_json(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace hysteron
