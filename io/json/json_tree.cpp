#include "io/json/json_tree.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>

#include "io/json/json_position.h"

namespace hysteron {
namespace {

constexpr std::size_t deepest = 100;     // our own files need about 10
constexpr std::size_t most_walked = 16;  // members or elements; where there are more an index finds them

/// The bytes of a text, one after the other; it is seen from outside how far they are read.
class Bytes {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Bytes(const char* at, const char** seen) : at_(at), seen_(seen) {}
  const char& operator*() const { return *at_; }
  Bytes& operator++() {
    *seen_ = ++at_;
    return *this;
  }
  bool operator==(const Bytes& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** seen_;
};

/// "a/b" of the token "a~1b" of a pointer.
std::string unescaped(std::string_view token) {
  std::string key;
  for (std::size_t i = 0; i < token.size(); ++i)
    if (token[i] != '~' || i + 1 == token.size())
      key += token[i];
    else
      key += token[++i] == '1' ? '/' : '~';
  return key;
}

}  // namespace

/// Takes the events of the parser.
class JsonTreeBuilder {
 public:
  using Json = nlohmann::json;

  JsonTreeBuilder(std::string_view text, JsonTree& tree) : tree_(tree), counted_(text.data()), seen_(text.data()) {}

  void read(std::string_view text) {
    Json::sax_parse(Bytes(text.data(), &seen_), Bytes(text.data() + text.size(), &seen_), this);
    std::sort(twice_.begin(), twice_.end());
    for (const auto& [second, first] : twice_)
      tree_.duplicates_.push_back({pointer(second), tree_.line(second), tree_.line(first)});
  }

  bool null() { return add(JsonTree::Kind::null, {}); }
  bool boolean(bool truth) { return add(JsonTree::Kind::truth, whole(truth ? 1 : 0)); }
  bool number_integer(std::int64_t number) { return add(JsonTree::Kind::whole, whole(number)); }
  bool number_unsigned(std::uint64_t number) {
    JsonTree::Content content;
    content.natural = number;
    return add(JsonTree::Kind::natural, content);
  }
  bool number_float(double number, const std::string& /*written*/) {
    JsonTree::Content content;
    content.real = number;
    return add(JsonTree::Kind::real, content);
  }
  bool string(const std::string& text) {
    JsonTree::Content content;
    content.text = kept(text);
    return add(JsonTree::Kind::text, content);
  }
  bool binary(Json::binary_t& /*bytes*/) { return true; }  // no part of JSON texts
  bool start_object(std::size_t /*size*/) { return open(JsonTree::Kind::object); }
  bool start_array(std::size_t /*size*/) { return open(JsonTree::Kind::list); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(const std::string& text) {
    key_ = kept(text);
    key_line_ = line();
    return true;
  }
  template <class Exception>
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/, const Exception& error) {
    throw error;
  }

 private:
  static JsonTree::Content whole(std::int64_t number) {
    JsonTree::Content content;
    content.whole = number;
    return content;
  }

  JsonTree::Span kept(const std::string& text) {
    const JsonTree::Span span{tree_.texts_.size(), static_cast<std::uint32_t>(text.size())};
    tree_.texts_ += text;
    return span;
  }

  /// Of the last byte of what was read; behind a number the parser has read one byte more.
  int line() {
    if (const char* last = seen_ - 1; last > counted_) {
      line_ += static_cast<int>(std::count(counted_, last, '\n'));
      counted_ = last;
    }
    return line_;
  }

  bool add(JsonTree::Kind kind, const JsonTree::Content& content) {
    const bool is_member = !open_.empty() && tree_.values_[open_.back()].kind == JsonTree::Kind::object;
    JsonTree::Value& value = tree_.values_.emplace_back();
    value.content = content;
    value.kind = kind;
    value.behind = static_cast<JsonTree::Index>(tree_.values_.size());
    value.line = is_member ? key_line_ : open_.empty() ? 1 : line();
    if (is_member) value.key = key_;
    return true;
  }

  bool open(JsonTree::Kind kind) {
    add(kind, {});
    open_.push_back(static_cast<JsonTree::Index>(tree_.values_.size() - 1));
    if (open_.size() > deepest && tree_.too_deep_line_ == 0) tree_.too_deep_line_ = line();
    return true;
  }

  bool close() {
    const JsonTree::Index own = open_.back();
    open_.pop_back();
    tree_.values_[own].behind = static_cast<JsonTree::Index>(tree_.values_.size());
    inside_.clear();
    for (auto at = tree_.first(own); at != JsonTree::none; at = tree_.next(at, own)) inside_.push_back(at);
    const bool is_object = tree_.kind(own) == JsonTree::Kind::object;
    if (inside_.size() <= most_walked) {
      if (is_object) compare_all();
      return true;
    }
    auto& large = tree_.large_[own];
    large.values = inside_;
    if (!is_object) return true;
    large.keys.rebuild(inside_.size(), tree_.keys_of(large));
    for (std::size_t i = 0; i < inside_.size(); ++i)
      if (const auto first = large.keys.find(tree_.key(inside_[i]), inside_.size(), tree_.keys_of(large));
          first != static_cast<std::ptrdiff_t>(i))
        twice_.emplace_back(inside_[i], inside_[static_cast<std::size_t>(first)]);
    return true;
  }

  /// Which keys of a small object stand twice.
  void compare_all() {
    for (std::size_t i = 1; i < inside_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (tree_.key(inside_[i]) == tree_.key(inside_[k])) {
          twice_.emplace_back(inside_[i], inside_[k]);
          break;
        }
  }

  std::string pointer(JsonTree::Index place) const {
    std::string text;
    for (JsonTree::Index at = 0; at != place;) {
      std::size_t position = 0;
      auto child = tree_.first(at);
      for (; tree_.values_[child].behind <= place; child = tree_.next(child, at)) ++position;
      text = tree_.kind(at) == JsonTree::Kind::object ? pointer_to(text, tree_.key(child))
                                                      : pointer_to(text, std::to_string(position));
      at = child;
    }
    return text;
  }

  JsonTree& tree_;
  const char* counted_;  ///< up to where line_ counts
  const char* seen_;     ///< up to where the parser has read
  int line_ = 1;
  JsonTree::Span key_{};
  int key_line_ = 1;
  std::vector<JsonTree::Index> open_;                               ///< objects and lists
  std::vector<JsonTree::Index> inside_;                             ///< of what was closed last
  std::vector<std::pair<JsonTree::Index, JsonTree::Index>> twice_;  ///< second and first place of a key
};

JsonTree::JsonTree(std::string_view text) {
  JsonTreeBuilder(text, *this).read(text);
  values_.shrink_to_fit();
}

double JsonTree::number(Index at) const {
  const Value& value = values_[at];
  if (value.kind == Kind::real) return value.content.real;
  return value.kind == Kind::natural ? static_cast<double>(value.content.natural)
                                     : static_cast<double>(value.content.whole);
}

std::string JsonTree::dump(Index at) const {
  const Value& value = values_[at];
  nlohmann::json one;
  if (value.kind == Kind::truth) one = truth(at);
  if (value.kind == Kind::whole) one = value.content.whole;
  if (value.kind == Kind::natural) one = value.content.natural;
  if (value.kind == Kind::real) one = value.content.real;
  if (value.kind == Kind::text) one = text(at);
  return one.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::size_t JsonTree::size(Index at) const {
  if (const auto large = large_.find(at); large != large_.end()) return large->second.values.size();
  std::size_t count = 0;
  for (auto child = first(at); child != none; child = next(child, at)) ++count;
  return count;
}

JsonTree::Index JsonTree::find(Index object, std::string_view key) const {
  if (const auto large = large_.find(object); large != large_.end()) {
    const auto& inside = large->second;
    const auto place = inside.keys.find(key, inside.values.size(), keys_of(inside));
    return place < 0 ? none : inside.values[static_cast<std::size_t>(place)];
  }
  for (auto child = first(object); child != none; child = next(child, object))
    if (this->key(child) == key) return child;
  return none;
}

JsonTree::Index JsonTree::inside(Index parent, const std::string& token) const {
  if (kind(parent) == Kind::object) return find(parent, token);
  std::size_t position = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), position);
  if (kind(parent) != Kind::list || error != std::errc{} || end != token.data() + token.size()) return none;
  if (const auto large = large_.find(parent); large != large_.end())
    return position < large->second.values.size() ? large->second.values[position] : none;
  auto child = first(parent);
  for (; child != none && position > 0; --position) child = next(child, parent);
  return child;
}

std::pair<JsonTree::Index, bool> JsonTree::follow(const std::string& pointer) const {
  Index place = 0;
  for (std::size_t begin = 0; begin < pointer.size();) {
    const auto end = std::min(pointer.find('/', begin + 1), pointer.size());
    if (pointer[begin] != '/') return {place, false};
    const Index child = inside(place, unescaped(std::string_view(pointer).substr(begin + 1, end - begin - 1)));
    if (child == none) return {place, false};
    place = child;
    begin = end;
  }
  return {place, true};
}

JsonTree::Index JsonTree::at(const std::string& pointer) const {
  const auto [place, is_whole] = follow(pointer);
  return is_whole ? place : none;
}

int JsonTree::line(const std::string& pointer) const { return line(follow(pointer).first); }

}  // namespace hysteron
