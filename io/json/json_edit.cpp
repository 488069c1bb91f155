#include "io/json/json_edit.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// A member of an object, or an element of a list (which has no key): bytes of the text.
struct JsonMember {
  std::size_t begin = 0;           ///< of the key, or of the value where there is none
  std::size_t key_end = 0;         ///< behind the closing quote
  std::size_t value = 0, end = 0;  ///< of the value
  std::string key{};
};

struct JsonContainer {
  std::size_t begin = 0, end = 0;  ///< of the brackets: at the first, at the last
  bool is_object = false;
  std::vector<JsonMember> members{};
  const JsonMember* find(const std::string& key) const {
    const auto found = std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.key == key; });
    return found == members.end() ? nullptr : &*found;
  }
};

/// Walks valid JSON.
class JsonWalk {
 public:
  explicit JsonWalk(std::string_view text) : text_(text) {}

  std::size_t first() const { return std::min(text_.find_first_not_of(blanks), text_.size()); }

  /// Behind the value that begins there; by counting brackets, so that depth costs nothing.
  std::size_t behind(std::size_t at) const {
    int open = 0;
    do {
      const char c = text_[at];
      if (c == '"') {
        at = behind_text(at);
      } else if (c == '{' || c == '[') {
        ++open, ++at;
      } else if (c == '}' || c == ']') {
        --open, ++at;
      } else if (c == ',' || c == ':' || blanks.find(c) != blanks.npos) {
        ++at;
      } else {
        at = std::min(text_.find_first_of(",:]}{[\" \t\r\n", at), text_.size());
      }
    } while (open > 0);
    return at;
  }

  /// The object or list that begins there; nothing where another value does.
  std::optional<JsonContainer> container(std::size_t at) const {
    if (at >= text_.size() || (text_[at] != '{' && text_[at] != '[')) return {};
    JsonContainer found{at, behind(at) - 1, text_[at] == '{'};
    for (at = skip(at + 1); at < found.end; at = skip(at)) {
      JsonMember member;
      member.begin = at;
      if (found.is_object) {
        member.key_end = behind_text(at);
        member.key = nlohmann::json::parse(text_.substr(at, member.key_end - at)).get<std::string>();
        at = skip(member.key_end);
      } else {
        member.key = std::to_string(found.members.size());
      }
      member.value = at;
      member.end = at = behind(at);
      found.members.push_back(std::move(member));
    }
    return found;
  }

 private:
  std::size_t skip(std::size_t at) const { return std::min(text_.find_first_not_of(" \t\r\n,:", at), text_.size()); }
  std::size_t behind_text(std::size_t at) const {
    for (++at; text_[at] != '"'; ++at)
      if (text_[at] == '\\') ++at;
    return at + 1;
  }

  std::string_view text_;
};

std::vector<std::string> tokens_of(const std::string& pointer) {
  std::vector<std::string> tokens;
  for (std::size_t at = 0; at < pointer.size();) {
    const auto end = std::min(pointer.find('/', at + 1), pointer.size());
    std::string token;
    for (std::size_t i = at + 1; i < end; ++i)
      token += pointer[i] != '~' ? pointer[i] : pointer[++i] == '1' ? '/' : '~';
    tokens.push_back(std::move(token));
    at = end;
  }
  return tokens;
}

[[noreturn]] void no_place(const std::string& pointer, const std::string& what) {
  fail("no_place", pointer, what, "reload the file: it may have been changed in the meantime");
}

/// A place in the text: the value, and the container and member that it is, where it is not the whole.
struct JsonSpot {
  std::size_t value = 0;
  JsonContainer parent{};
  std::size_t index = 0;
  bool is_whole = true;
  const JsonMember& member() const { return parent.members[index]; }
};

JsonSpot spot_of(const std::string& text, const std::string& pointer) {
  const JsonWalk walk(text);
  JsonSpot spot{walk.first()};
  for (const auto& token : tokens_of(pointer)) {
    auto parent = walk.container(spot.value);
    const JsonMember* member = parent ? parent->find(token) : nullptr;
    if (member == nullptr) no_place(pointer, "there is no such place in the text");
    spot.index = static_cast<std::size_t>(member - parent->members.data());
    spot.value = member->value;
    spot.is_whole = false;
    spot.parent = std::move(*parent);
  }
  return spot;
}

std::string quoted(const std::string& key) { return nlohmann::json(key).dump(); }

/// The blanks before a member, from the last line end on.
std::string blanks_before(const std::string& text, std::size_t begin) {
  const auto end = text.find_last_not_of(blanks, begin - 1);
  const std::string all = text.substr(end + 1, begin - end - 1);
  const auto line = all.rfind('\n');
  return line == all.npos ? all : all.substr(line);
}

std::size_t column_of(const std::string& text, std::size_t at) {
  const auto line = text.rfind('\n', at);
  return line == text.npos ? at : at - line - 1;
}

/// Blanks between a new key and its value: as many as bring it into the column of all the others, where these have one.
std::string gap_behind(const std::string& text, const JsonContainer& object, const std::string& quoted_key) {
  const auto& members = object.members;
  std::size_t column = 0;
  bool is_column = false;  // keys of several lengths, or a gap that somebody made
  for (const auto& m : members) {
    const std::size_t here = column_of(text, m.value);
    if (blanks_before(text, m.begin).find('\n') == std::string::npos || (column > 0 && here != column)) return " ";
    column = here;
    const bool other_length = m.key_end - m.begin != members[0].key_end - members[0].begin;
    const bool wide = text.substr(m.key_end, m.value - m.key_end).find("  ") != std::string::npos;
    is_column = is_column || other_length || wide;
  }
  if (!is_column) return " ";
  const std::size_t used = column_of(text, members[0].begin) + quoted_key.size() + 1;
  return used < column ? std::string(column - used, ' ') : " ";
}

std::string inserted(std::string text, const JsonEdit& edit) {
  const JsonSpot spot = spot_of(text, edit.pointer);
  const auto into = JsonWalk(text).container(spot.value);
  if (!into) no_place(edit.pointer, "no object and no list stands there");
  if (into->is_object && into->find(edit.key) != nullptr)
    fail("key_there", edit.pointer + "/" + edit.key, "\"" + edit.key + "\" is there already", "choose another name");
  const std::string key = into->is_object ? quoted(edit.key) : "";
  const auto member_text = [&](const std::string& gap) {
    return into->is_object ? key + ":" + gap + edit.value : edit.value;
  };
  if (into->members.empty()) {
    const std::string between = text.substr(into->begin + 1, into->end - into->begin - 1);
    const auto line = between.rfind('\n');
    const std::string before = line == between.npos ? "" : between.substr(line) + "  ";
    const std::string behind = line == between.npos ? "" : between.substr(line);
    return text.replace(into->begin + 1, between.size(), before + member_text(" ") + behind);
  }
  std::size_t at = into->members.size() - 1;
  if (const JsonMember* anchor = into->is_object ? into->find(edit.after) : nullptr)
    at = static_cast<std::size_t>(anchor - into->members.data());
  const std::size_t model = std::min(at + 1, into->members.size() - 1);  // whose blanks are taken
  std::string before = blanks_before(text, into->members[model].begin);
  if (before.find('\n') == before.npos) before = " ";
  return text.insert(into->members[at].end, "," + before + member_text(gap_behind(text, *into, key)));
}

std::string without(std::string text, const JsonEdit& edit) {
  const JsonSpot spot = spot_of(text, edit.pointer);
  if (spot.is_whole) no_place(edit.pointer, "the whole text cannot be removed");
  const auto& members = spot.parent.members;
  if (spot.index + 1 < members.size())
    return text.erase(spot.member().begin, members[spot.index + 1].begin - spot.member().begin);
  const std::size_t from = spot.index > 0 ? members[spot.index - 1].end : spot.parent.begin + 1;
  return text.erase(from, spot.member().end - from);
}

std::string renamed(std::string text, const JsonEdit& edit) {
  const JsonSpot spot = spot_of(text, edit.pointer);
  if (spot.is_whole || !spot.parent.is_object) no_place(edit.pointer, "no member of an object stands there");
  if (edit.key == spot.member().key) return text;
  if (spot.parent.find(edit.key) != nullptr)
    fail("key_there", edit.pointer, "\"" + edit.key + "\" is there already", "choose another name");
  return text.replace(spot.member().begin, spot.member().key_end - spot.member().begin, quoted(edit.key));
}

std::string replaced(std::string text, const JsonEdit& edit) {
  const JsonSpot spot = spot_of(text, edit.pointer);
  return text.replace(spot.value, JsonWalk(text).behind(spot.value) - spot.value, edit.value);
}

}  // namespace

std::string edited_json(const std::string& text, const std::vector<JsonEdit>& edits) {
  if (!nlohmann::json::accept(text))
    fail("bad_json", "text", "the text is no JSON, so no place in it can be found", "cure it in the text first");
  std::string result = text;
  for (const auto& edit : edits) {
    const bool has_value = edit.kind == JsonEdit::Kind::replace || edit.kind == JsonEdit::Kind::insert;
    if (has_value && !nlohmann::json::accept(edit.value))
      fail("bad_json", edit.pointer, edit.value + " is no JSON",
           "write a number, a text in quotes, a list or an object");
    switch (edit.kind) {
      case JsonEdit::Kind::replace:
        result = replaced(std::move(result), edit);
        break;
      case JsonEdit::Kind::insert:
        result = inserted(std::move(result), edit);
        break;
      case JsonEdit::Kind::remove:
        result = without(std::move(result), edit);
        break;
      case JsonEdit::Kind::rename:
        result = renamed(std::move(result), edit);
        break;
    }
  }
  return result;
}

}  // namespace hysteron
