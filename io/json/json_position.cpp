#include "io/json/json_position.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hysteron {
namespace {

constexpr std::size_t deepest = 100;  // our own files need about 10

/// One open object or list while the text is scanned.
struct Level {
  std::string pointer;
  bool is_object = false;
  bool at_key = false;  ///< the next string is a key
  std::size_t index = 0;
  std::unordered_map<std::string, int> keys{};
};

/// Walks valid JSON once, without recursion, so that depth costs memory only.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  /// Returns the line where the text is nested too deeply (and stops there), or 0.
  int scan(std::unordered_map<std::string, int>& lines, std::vector<JsonPositions::Duplicate>& duplicates) {
    lines[""] = 1;
    while (at_ < text_.size()) {
      if (levels_.size() > deepest) return line_;
      const char c = text_[at_];
      switch (c) {
        case '{':
        case '[':
          open(lines, c == '{');
          break;
        case '}':
        case ']':
          levels_.pop_back();
          ++at_;
          break;
        case ',':
          separate();
          break;
        case '"':
          text_or_key(lines, duplicates);
          break;
        case '\n':
          ++line_;
          ++at_;
          break;
        case ':':
        case ' ':
        case '\t':
        case '\r':
          ++at_;
          break;
        default:
          if (c > ' ' && static_cast<unsigned char>(c) < 0x80) note_element(lines);
          skip_plain();
      }
    }
    return 0;
  }

 private:
  /// Pointer of the value that begins here.
  std::string pointer_here() const {
    if (levels_.empty()) return "";
    const auto& level = levels_.back();
    return level.is_object ? key_pointer_ : pointer_to(level.pointer, std::to_string(level.index));
  }

  void note_element(std::unordered_map<std::string, int>& lines) const {
    if (!levels_.empty() && !levels_.back().is_object) lines.emplace(pointer_here(), line_);
  }

  void open(std::unordered_map<std::string, int>& lines, bool is_object) {
    note_element(lines);
    levels_.push_back({pointer_here(), is_object, is_object});
    ++at_;
  }

  void separate() {
    auto& level = levels_.back();
    level.at_key = level.is_object;
    if (!level.is_object) ++level.index;
    ++at_;
  }

  void text_or_key(std::unordered_map<std::string, int>& lines, std::vector<JsonPositions::Duplicate>& duplicates) {
    const std::size_t begin = at_++;
    while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
    ++at_;
    if (levels_.empty() || !levels_.back().at_key) return note_element(lines);

    auto& level = levels_.back();
    level.at_key = false;
    const auto token = text_.substr(begin, at_ - begin);
    const std::string key = token.find('\\') == token.npos ? std::string(token.substr(1, token.size() - 2))
                                                           : nlohmann::json::parse(token).get<std::string>();
    key_pointer_ = pointer_to(level.pointer, key);
    const auto [known, is_new] = level.keys.emplace(key, line_);
    if (!is_new) duplicates.push_back({key_pointer_, line_, known->second});
    lines[key_pointer_] = line_;
  }

  /// Numbers and literals.
  void skip_plain() {
    const auto end = text_.find_first_of(",]}\n \t\r", at_ + 1);
    at_ = end == text_.npos ? text_.size() : end;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<Level> levels_;
  std::string key_pointer_;
};

}  // namespace

JsonPositions::JsonPositions(std::string_view valid_json) {
  too_deep_line_ = Scanner(valid_json).scan(lines_, duplicates_);
}

int JsonPositions::line(std::string pointer) const {
  while (true) {
    if (const auto found = lines_.find(pointer); found != lines_.end()) return found->second;
    const auto slash = pointer.rfind('/');
    if (slash == pointer.npos) return 1;
    pointer.resize(slash);
  }
}

std::string pointer_to(const std::string& parent, std::string_view key) {
  std::string pointer = parent + "/";
  for (const char c : key) {
    if (c == '~') {
      pointer += "~0";
    } else if (c == '/') {
      pointer += "~1";
    } else {
      pointer += c;
    }
  }
  return pointer;
}

std::pair<int, int> line_and_column(std::string_view text, std::size_t byte) {
  const auto before = text.substr(0, byte);
  const auto line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
  const auto newline = before.rfind('\n');
  const auto column = newline == before.npos ? before.size() + 1 : before.size() - newline;
  return {line, static_cast<int>(column)};
}

}  // namespace hysteron
