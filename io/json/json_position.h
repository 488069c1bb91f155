// Decides in which line of a JSON text a JSON pointer stands, and which keys stand twice in one object.
// Does not judge syntax: the text must be valid JSON (json_reader.h checks that first).
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hysteron {

class JsonPositions {
 public:
  struct Duplicate {
    std::string pointer;
    int line = 0, first_line = 0;
  };

  JsonPositions() = default;
  explicit JsonPositions(std::string_view valid_json);

  /// Line of the key (or list element) that `pointer` names, 1-based; of the nearest parent if there is no such place.
  int line(std::string pointer) const;
  bool has(const std::string& pointer) const { return lines_.contains(pointer); }
  const std::vector<Duplicate>& duplicates() const { return duplicates_; }
  int too_deep_line() const { return too_deep_line_; }  ///< where nesting passes 100 levels; 0 = nowhere

 private:
  std::unordered_map<std::string, int> lines_;
  std::vector<Duplicate> duplicates_;
  int too_deep_line_ = 0;
};

/// "/blocks" + "a/b" = "/blocks/a~1b" (RFC 6901).
std::string pointer_to(const std::string& parent, std::string_view key);

/// Line and column, both 1-based, of a byte of a text.
std::pair<int, int> line_and_column(std::string_view text, std::size_t byte);

}  // namespace hysteron
