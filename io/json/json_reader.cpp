#include "io/json/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/files/atomic_file.h"
#include "io/files/encoding.h"

namespace hysteron {
namespace {

constexpr int newest_format = 1;

[[noreturn]] void fail_at(const std::string& file, int line, std::string code, std::string path, std::string what,
                          std::string cure) {
  throw Error(Fault::input, {{std::move(code), std::move(path), std::move(what), std::move(cure), file, line}});
}

/// nlohmann's texts begin with "[json.exception.parse_error.101] parse error at line 3, column 5: "; the rest is for
/// people.
std::string plain_message(const std::string& message) {
  const auto colon = message.find(": ");
  const auto bracket = message.find("] ");
  if (message.find("parse error at") != message.npos && colon != message.npos) return message.substr(colon + 2);
  return bracket == message.npos ? message : message.substr(bracket + 2);
}

[[noreturn]] void fail_syntax(const std::string& file, std::string_view text, std::size_t byte,
                              const std::string& message) {
  const auto [line, column] = line_and_column(text, byte);
  std::string cure = "correct the JSON there; an editor that knows JSON shows the place";
  if (byte < text.size() && (text[byte] == '/' || text[byte] == '#'))
    cure = "JSON knows no comments: take it out, or write it as a \"remark\"";
  else if (message.find("unexpected '}'") != message.npos || message.find("unexpected ']'") != message.npos)
    cure = "take out the comma before the closing bracket, or add what is missing there";
  else if (message.find("expected ',' or") != message.npos || message.find("expected end of input") != message.npos)
    cure = "a comma or a closing bracket is missing just before it";
  else if (message.find("unexpected end of input") != message.npos)
    cure = "the file ends too early: a closing bracket or quote is missing";
  fail_at(file, line, "bad_json", fmt::format("column {}", column), "this is not JSON: " + plain_message(message),
          cure);
}

JsonTree parse(const std::string& file, const std::string& text) {
  try {
    return JsonTree(text);
  } catch (const nlohmann::json::parse_error& error) {
    fail_syntax(file, text, error.byte > 0 ? error.byte - 1 : 0, error.what());
  } catch (const nlohmann::json::exception& error) {
    // A number too large for a double: the message quotes it and gives no position.
    const std::string message = error.what();
    const auto first = message.find('\''), last = message.rfind('\'');
    const auto token = first < last ? message.substr(first + 1, last - first - 1) : std::string();
    const auto at = token.empty() ? 0 : text.find(token);
    fail_syntax(file, text, at == text.npos ? 0 : at, message);
  }
}

bool is_letter(char c, bool capitals) { return (c >= 'a' && c <= 'z') || (capitals && c >= 'A' && c <= 'Z'); }

bool is_name(const std::string& name, bool capitals) {
  return !name.empty() && is_letter(name[0], capitals) && std::all_of(name.begin(), name.end(), [&](char c) {
    return is_letter(c, capitals) || (c >= '0' && c <= '9') || c == '_';
  });
}

/// The nearest allowed name: lower case, everything else an underscore.
std::string tidy_name(const std::string& name) {
  std::string tidy;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') {
      tidy += static_cast<char>(c - 'A' + 'a');
    } else {
      tidy += (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c : '_';
    }
  }
  if (tidy.empty() || tidy[0] < 'a' || tidy[0] > 'z') tidy.insert(0, "x");
  return tidy;
}

}  // namespace

JsonFile::JsonFile(const std::string& file) : file_(file) {
  std::string text = read_file(file);
  refuse_utf16(file, text);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // byte order mark: no part of the JSON (RFC 8259, 8.1)
  if (text.find_first_not_of(" \t\r\n") == text.npos)
    fail_at(file, 1, "empty_file", file, "the file is empty",
            "write a diagram or data set into it, or name another file");
  tree_ = parse(file, text);
  if (tree_.too_deep_line() > 0)
    fail_at(file, tree_.too_deep_line(), "too_deep", file, "brackets are nested more than 100 deep",
            "move inner parts into diagrams of their own");
  for (const auto& twice : tree_.duplicates())
    add("duplicate_key", twice.pointer,
        fmt::format("this key stands here a second time; the first is in line {}", twice.first_line),
        "take one of them out, or give it another name");
  for (std::size_t i = 0; i < problems_.size(); ++i) problems_[i].line = tree_.duplicates()[i].line;
  throw_if_any();
}

JsonPlace JsonFile::root() { return {*this, 0, ""}; }

void JsonFile::add(std::string code, const std::string& pointer, std::string what, std::string cure) {
  problems_.push_back({std::move(code), pointer, std::move(what), std::move(cure), file_, tree_.line(pointer)});
}

void JsonFile::add(const Error& error) {
  problems_.insert(problems_.end(), error.problems.begin(), error.problems.end());
}

void JsonFile::throw_if_any() const {
  if (!problems_.empty()) throw Error(Fault::input, problems_);
}

void JsonPlace::add(std::string code, std::string what, std::string cure) const {
  file_->add(std::move(code), pointer_, std::move(what), std::move(cure));
}

bool JsonPlace::is_object() const { return kind() == JsonTree::Kind::object; }
bool JsonPlace::is_array() const { return kind() == JsonTree::Kind::list; }
bool JsonPlace::is_text() const { return kind() == JsonTree::Kind::text; }
bool JsonPlace::is_number() const {
  return kind() == JsonTree::Kind::whole || kind() == JsonTree::Kind::natural || kind() == JsonTree::Kind::real;
}
bool JsonPlace::is_null() const { return kind() == JsonTree::Kind::null; }

std::string JsonPlace::found() const {
  if (is_object()) return "an object {...}";
  if (is_array()) return "a list [...]";
  if (is_text()) return "the text " + file_->tree().dump(at_);
  if (is_number()) return "the number " + file_->tree().dump(at_);
  return file_->tree().dump(at_);  // true, false, null
}

void JsonPlace::add_wrong_type(const std::string& expected) const {
  add("wrong_type", fmt::format("found {}, expected {}", found(), expected), "write " + expected + " here");
}

std::optional<std::string> JsonPlace::text() const {
  if (is_text()) return std::string(file_->tree().text(at_));
  add_wrong_type("a text in quotes");
  return {};
}

std::optional<double> JsonPlace::number() const {
  if (is_number()) return file_->tree().number(at_);
  add_wrong_type("a number");
  return {};
}

std::optional<bool> JsonPlace::truth() const {
  if (kind() == JsonTree::Kind::truth) return file_->tree().truth(at_);
  add_wrong_type("true or false");
  return {};
}

bool JsonPlace::expect_object(const char* example) const {
  if (!is_object()) add_wrong_type(fmt::format("an object such as {}", example));
  return is_object();
}

bool JsonPlace::expect_array(const char* example) const {
  if (!is_array()) add_wrong_type(fmt::format("a list such as {}", example));
  return is_array();
}

std::optional<JsonPlace> JsonPlace::find(const std::string& key) const {
  if (!is_object()) return {};
  const JsonTree::Index found = file_->tree().find(at_, key);
  if (found == JsonTree::none) return {};
  return JsonPlace(*file_, found, pointer_to(pointer_, key));
}

std::optional<JsonPlace> JsonPlace::need(const std::string& key, const std::string& cure) const {
  auto place = find(key);
  if (!place) add("missing_key", fmt::format("the key \"{}\" is missing", key), cure);
  return place;
}

void JsonPlace::only(const std::vector<std::string>& known) const {
  for (const auto& [key, place] : members())
    if (std::find(known.begin(), known.end(), key) == known.end())
      place.add("unknown_key", fmt::format("\"{}\" is not known here", key), did_you_mean(key, known));
}

std::vector<std::pair<std::string, JsonPlace>> JsonPlace::members() const {
  const JsonTree& tree = file_->tree();
  std::vector<std::pair<std::string, JsonPlace>> list;
  if (!is_object()) return list;
  list.reserve(tree.size(at_));
  for (auto member = tree.first(at_); member != JsonTree::none; member = tree.next(member, at_))
    list.emplace_back(tree.key(member), JsonPlace(*file_, member, pointer_to(pointer_, tree.key(member))));
  return list;
}

std::vector<JsonPlace> JsonPlace::elements() const {
  const JsonTree& tree = file_->tree();
  std::vector<JsonPlace> list;
  if (!is_array()) return list;
  list.reserve(tree.size(at_));
  for (auto element = tree.first(at_); element != JsonTree::none; element = tree.next(element, at_))
    list.emplace_back(*file_, element, pointer_to(pointer_, std::to_string(list.size())));
  return list;
}

std::string text_member(const JsonPlace& object, const std::string& key) {
  const auto place = object.find(key);
  return place ? place->text().value_or("") : "";
}

std::optional<double> number_member(const JsonPlace& object, const std::string& key) {
  const auto place = object.find(key);
  return place ? place->number() : std::nullopt;
}

void check_format(const JsonPlace& root, const std::string& kind) {
  const auto place = root.need("format", "write \"format\": 1 at the head of the file");
  if (!place) return;
  const auto format = place->number();
  if (!format) return;
  if (*format > newest_format)
    fail_at(root.file().file(), root.file().line("/format"), "newer_format", "/format",
            fmt::format("this {} has format {}, this hysteron reads up to format {}", kind, *format, newest_format),
            "install a newer hysteron, or save the file in an older format");
  if (*format != newest_format)
    place->add("bad_format", fmt::format("there is no format {}", *format),
               fmt::format("write \"format\": {}", newest_format));
}

bool check_name(const JsonPlace& place, const std::string& name, const std::string& kind, Capitals capitals) {
  if (is_name(name, capitals == Capitals::allowed)) return true;
  place.add("bad_name",
            fmt::format("\"{}\" cannot be the name of {}: names are {}letters, digits and _, a letter first", name,
                        kind, capitals == Capitals::allowed ? "" : "lower-case "),
            fmt::format("call it \"{}\"", tidy_name(name)));
  return false;
}

}  // namespace hysteron
