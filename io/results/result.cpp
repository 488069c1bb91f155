// Decides how a document stands in result.json (format 1) and how it is read back.
// Does not decide where the folder lies nor when it may be replaced (result_folder.cpp), nor how it looks (report/).
#include "io/results/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "io/data/table_file.h"
#include "io/files/atomic_file.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int format = 1;

std::string dump(const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Indented like a file that people read: an array of plain values stays on one line.
void print(const Json& j, int depth, std::string& out) {
  const bool nested = j.is_object() || (j.is_array() && std::any_of(j.begin(), j.end(),
                                                                    [](const Json& e) { return e.is_structured(); }));
  if (!nested || j.empty()) {
    out += dump(j);
    return;
  }
  const std::string indent(2 * static_cast<std::size_t>(depth + 1), ' ');
  out += j.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& item : j.items()) {
    out += first ? "\n" : ",\n";
    out += indent;
    if (j.is_object()) out += dump(Json(item.key())) + ": ";
    print(item.value(), depth + 1, out);
    first = false;
  }
  out += '\n' + indent.substr(2) + (j.is_object() ? "}" : "]");
}

Json write(const Curve& c) {
  Json j{{"name", c.name}, {"style", c.style}, {"role", c.role}};
  if (c.trace.empty()) {
    j["x"] = c.x;
    j["y"] = c.y;
  } else {
    j["trace"] = c.trace;
    j["x"] = c.x_column;
    j["y"] = c.y_column;
  }
  if (!c.colour.empty()) j["colour"] = c.colour;
  return j;
}

Json write(const Bar& b) { return {{"label", b.label}, {"value", b.value}, {"text", b.text}, {"role", b.role}}; }

Json write(const Figure& f);
Json write(const Table& t);
Json write(const Section& s);

template <class T>
Json write_all(const std::vector<T>& list) {
  Json j = Json::array();
  for (const auto& item : list) j.push_back(write(item));
  return j;
}

Json write(const Figure& f) {
  Json j{{"title", f.title}, {"kind", f.kind}, {"x_label", f.x_label}, {"y_label", f.y_label}};
  if (f.log_x) j["log_x"] = true;
  if (f.log_y) j["log_y"] = true;
  if (!f.x_range.empty()) j["x_range"] = f.x_range;
  if (!f.y_range.empty()) j["y_range"] = f.y_range;
  if (!f.curves.empty()) j["curves"] = write_all(f.curves);
  if (!f.bars.empty()) j["bars"] = write_all(f.bars);
  if (!f.picture.empty()) j["picture"] = f.picture;
  if (!f.caption.empty()) j["caption"] = f.caption;
  return j;
}

Json write(const Table& t) { return {{"title", t.title}, {"columns", t.columns}, {"rows", t.rows}}; }

Json write(const Section& s) {
  Json j{{"title", s.title}};
  if (!s.text.empty()) j["text"] = s.text;
  if (!s.tables.empty()) j["tables"] = write_all(s.tables);
  if (!s.figures.empty()) j["figures"] = write_all(s.figures);
  if (!s.preformatted.empty()) j["preformatted"] = {{"title", s.preformatted_title}, {"text", s.preformatted}};
  return j;
}

/// A key that may be absent: what a newer writer of the same format leaves out keeps its default.
template <class T>
void take(const nlohmann::json& j, const char* key, T& value) {
  if (const auto found = j.find(key); found != j.end()) value = found->get<T>();
}

double number_or_nan(const nlohmann::json& j) {
  return j.is_null() ? std::numeric_limits<double>::quiet_NaN() : j.get<double>();
}

/// NaN stands as null in JSON: a gap in a curve.
void take_numbers(const nlohmann::json& j, const char* key, std::vector<double>& values) {
  if (const auto found = j.find(key); found != j.end())
    for (const auto& item : *found) values.push_back(number_or_nan(item));
}

void read(const nlohmann::json& j, Curve& c) {
  take(j, "name", c.name);
  take(j, "style", c.style);
  take(j, "role", c.role);
  take(j, "trace", c.trace);
  if (c.trace.empty()) {
    take_numbers(j, "x", c.x);
    take_numbers(j, "y", c.y);
  } else {
    take(j, "x", c.x_column);
    take(j, "y", c.y_column);
  }
  take(j, "colour", c.colour);
}

void read(const nlohmann::json& j, Bar& b) {
  take(j, "label", b.label);
  if (j.contains("value")) b.value = number_or_nan(j["value"]);
  take(j, "text", b.text);
  take(j, "role", b.role);
}

void read(const nlohmann::json& j, Figure& f);
void read(const nlohmann::json& j, Table& t);
void read(const nlohmann::json& j, Section& s);

template <class T>
void read_all(const nlohmann::json& j, const char* key, std::vector<T>& list) {
  if (const auto found = j.find(key); found != j.end())
    for (const auto& item : *found) read(item, list.emplace_back());
}

void read(const nlohmann::json& j, Figure& f) {
  take(j, "title", f.title);
  take(j, "kind", f.kind);
  take(j, "x_label", f.x_label);
  take(j, "y_label", f.y_label);
  take(j, "log_x", f.log_x);
  take(j, "log_y", f.log_y);
  take(j, "x_range", f.x_range);
  take(j, "y_range", f.y_range);
  read_all(j, "curves", f.curves);
  read_all(j, "bars", f.bars);
  take(j, "picture", f.picture);
  take(j, "caption", f.caption);
}

void read(const nlohmann::json& j, Table& t) {
  take(j, "title", t.title);
  take(j, "columns", t.columns);
  take(j, "rows", t.rows);
}

void read(const nlohmann::json& j, Section& s) {
  take(j, "title", s.title);
  take(j, "text", s.text);
  read_all(j, "tables", s.tables);
  read_all(j, "figures", s.figures);
  if (const auto found = j.find("preformatted"); found != j.end()) {
    take(*found, "title", s.preformatted_title);
    take(*found, "text", s.preformatted);
  }
}

void check_header(const nlohmann::json& j, const std::string& file) {
  if (!j.is_object() || j.value("program", "") != "hysteron")
    fail("not_a_result", file, "this is not a result of hysteron: it has no \"program\": \"hysteron\"",
         "give the folder that a verb wrote with -o");
  if (const int found = j.value("format", 0); found > format)
    fail("newer_format", file,
         fmt::format("format {} was written by a newer hysteron ({})", found, j.value("version", "?")),
         fmt::format("read it with that version; this one reads formats up to {}", format));
}

}  // namespace

std::string result_text(const Document& d) {
  Json j{{"$schema", "result.schema.json"}, {"format", format},       {"program", "hysteron"},
         {"version", HYSTERON_VERSION},     {"verb", d.verb},         {"title", d.title},
         {"headline", d.headline},          {"verdict", d.verdict},   {"sentences", d.sentences},
         {"warnings", d.warnings},          {"facts", Json::object()}};
  if (d.facts && !d.facts->is_null()) j["facts"] = Json(*d.facts);
  if (!d.answer.empty()) j["answer"] = write_all(d.answer);
  j["sections"] = write_all(d.sections);
  j["traces"] = Json::array();
  for (const auto& trace : d.traces) j["traces"].push_back(trace.file);
  j["files"] = Json::array();
  for (const auto& [name, content] : d.files) j["files"].push_back(name);
  if (!d.data.empty()) j["data"] = d.data;
  std::string text;
  print(j, 0, text);
  return text + '\n';
}

bool is_result(std::string_view text) {
  const auto j = nlohmann::json::parse(text, nullptr, false);
  return j.is_object() && j.contains("program") && j["program"] == "hysteron";
}

Document read_result(const std::string& folder) {
  const fs::path root(folder);
  const std::string file = (root / "result.json").string();
  const std::string text = read_file(file);
  Document d;
  try {
    const auto j = nlohmann::json::parse(text);  // sorted by name: facts may have very many members
    check_header(j, file);
    take(j, "verb", d.verb);
    take(j, "title", d.title);
    take(j, "headline", d.headline);
    take(j, "verdict", d.verdict);
    take(j, "sentences", d.sentences);
    take(j, "warnings", d.warnings);
    take(j, "data", d.data);
    d.facts = std::make_shared<nlohmann::json>(j.value("facts", nlohmann::json::object()));
    read_all(j, "answer", d.answer);
    read_all(j, "sections", d.sections);
    for (const auto& name : j.value("traces", std::vector<std::string>{})) {
      d.traces.push_back(read_table((root / "traces" / name).string()));
      d.traces.back().file = name;
    }
    for (const auto& name : j.value("files", std::vector<std::string>{}))
      d.files.emplace_back(name, read_file((root / name).string()));
  } catch (const nlohmann::json::exception& e) {
    fail("bad_result", file, fmt::format("the file is damaged: {}", e.what()), "write the result again");
  }
  return d;
}

}  // namespace hysteron
