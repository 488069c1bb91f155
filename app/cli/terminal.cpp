// Decides how texts and tables are laid out in a terminal of 100 columns.
// Does not know what they say.
#include "app/cli/terminal.h"

#include <algorithm>
#include <sstream>

namespace hysteron {
namespace {

/// Columns that a text takes: UTF-8 continuation bytes take none.
std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::string> broken(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream paragraphs(text);
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    std::istringstream words(paragraph);
    std::string line;
    for (std::string word; words >> word;) {
      if (!line.empty() && columns_of(line) + 1 + columns_of(word) > width) {
        lines.push_back(line);
        line.clear();
      }
      if (!line.empty()) line += ' ';
      line += word;
    }
    lines.push_back(line);
  }
  return lines;
}

std::string without_trailing_spaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out;
  for (const auto& line : broken(text, terminal_width - indent))
    out += without_trailing_spaces(std::string(indent, ' ') + line) + '\n';
  return out;
}

std::string table_text(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows,
                       std::size_t indent) {
  std::vector<std::size_t> widths;
  const auto measure = [&](const std::vector<std::string>& row) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(row[i]));
  };
  measure(heads);
  for (const auto& row : rows) measure(row);
  std::size_t before_last = indent;
  for (std::size_t i = 0; i + 1 < widths.size(); ++i) before_last += widths[i] + 2;
  const std::size_t last_width = std::max<std::size_t>(24, terminal_width - std::min(terminal_width, before_last));

  std::string out;
  const auto print = [&](const std::vector<std::string>& row) {
    std::string line(indent, ' ');
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
      line += row[i] + std::string(widths[i] - columns_of(row[i]) + 2, ' ');
    const auto last = row.empty() ? std::vector<std::string>{} : broken(row.back(), last_width);
    out += without_trailing_spaces(line + (last.empty() ? "" : last.front())) + '\n';
    for (std::size_t i = 1; i < last.size(); ++i) out += std::string(before_last, ' ') + last[i] + '\n';
  };
  if (!heads.empty()) print(heads);
  for (const auto& row : rows) print(row);
  return out;
}

}  // namespace hysteron
