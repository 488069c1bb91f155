// Decides how a JSON text is held while it is read: all of its values in one list, in the order of the text, each with
// its line. Members of large objects are found by hash. Does not know what the values mean (json_reader.h).
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/diagram/name_index.h"

namespace hysteron {

class JsonTree {
 public:
  enum class Kind : std::uint8_t { null, truth, whole, natural, real, text, object, list };
  using Index = std::uint32_t;  ///< of a value; 0 is the whole text
  static constexpr Index none = std::numeric_limits<Index>::max();

  struct Duplicate {
    std::string pointer;
    int line = 0, first_line = 0;
  };

  JsonTree() = default;
  /// Reads a text of UTF-8. Throws what nlohmann::json::parse() does.
  explicit JsonTree(std::string_view text);

  Kind kind(Index at) const { return values_[at].kind; }
  std::string_view key(Index at) const { return view(values_[at].key); }  ///< of a member of an object
  std::string_view text(Index at) const { return view(values_[at].content.text); }
  double number(Index at) const;
  bool truth(Index at) const { return values_[at].content.whole != 0; }
  std::string dump(Index at) const;                      ///< of a number, a text, true, false or null: as JSON
  int line(Index at) const { return values_[at].line; }  ///< of its key, if it has one; 1-based

  std::size_t size(Index at) const;  ///< members or elements
  /// Members of an object or elements of a list: from the first, each before the next one, until none.
  Index first(Index at) const { return values_[at].behind > at + 1 ? at + 1 : none; }
  Index next(Index at, Index parent) const {
    return values_[at].behind < values_[parent].behind ? values_[at].behind : none;
  }
  Index find(Index object, std::string_view key) const;  ///< the first member with this key, or none

  /// What a JSON pointer (RFC 6901) names, or none.
  Index at(const std::string& pointer) const;
  /// Line of what it names; of the nearest parent where there is no such place.
  int line(const std::string& pointer) const;

  const std::vector<Duplicate>& duplicates() const { return duplicates_; }  ///< keys that stand twice in one object
  int too_deep_line() const { return too_deep_line_; }                      ///< nesting passes 100 levels; 0 = nowhere

 private:
  friend class JsonTreeBuilder;

  /// Bytes of texts_.
  struct Span {
    std::size_t begin = 0;
    std::uint32_t size = 0;
  };
  union Content {
    Span text{};
    double real;
    std::int64_t whole;
    std::uint64_t natural;
  };
  struct Value {
    Content content{};
    Span key{};
    Index behind = 0;  ///< the first value that is not inside of this one
    int line = 1;
    Kind kind = Kind::null;
  };
  /// Of an object or a list with many values inside: where each of them stands.
  struct Inside {
    std::vector<Index> values;
    NameIndex keys;
  };

  std::string_view view(const Span& span) const { return std::string_view(texts_).substr(span.begin, span.size); }
  auto keys_of(const Inside& inside) const {
    return [this, &inside](std::size_t place) { return key(inside.values[place]); };
  }
  /// The member or element that one token of a pointer names.
  Index inside(Index parent, const std::string& token) const;
  /// As far as the pointer leads: the innermost place, and whether it is the whole pointer.
  std::pair<Index, bool> follow(const std::string& pointer) const;

  std::vector<Value> values_;
  std::string texts_;  ///< keys and texts, one behind the other
  std::unordered_map<Index, Inside> large_;
  std::vector<Duplicate> duplicates_;
  int too_deep_line_ = 0;
};

}  // namespace hysteron
