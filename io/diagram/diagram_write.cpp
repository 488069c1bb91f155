// Decides how a Diagram stands as text: the keys in the order of docs/diagrams.md, one block per line where it fits, so
// that a diff shows only what changed. Does not read.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"
#include "io/files/atomic_file.h"
#include "io/files/project_path.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

constexpr std::size_t line_width = 160;

/// An object before it is laid out: keys with the text of their values.
using Members = std::vector<std::pair<std::string, std::string>>;

std::string one_line(const Members& members) {
  std::vector<std::string> parts;
  for (const auto& [key, text] : members) parts.push_back(json_quoted(key) + ": " + text);
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

/// One member per line, the values aligned as in a table. `indent` is that of the closing bracket.
std::string lines(const Members& members, std::size_t indent) {
  std::size_t width = 0;
  for (const auto& [key, text] : members) width = std::max(width, json_quoted(key).size() + 1);
  std::string out = "{";
  for (std::size_t i = 0; i < members.size(); ++i)
    out += fmt::format("{}\n{:{}}{:<{}} {}", i > 0 ? "," : "", "", indent + 2, json_quoted(members[i].first) + ":",
                       width, members[i].second);
  return out + fmt::format("\n{:{}}}}", "", indent);
}

/// On one line if it fits behind `used` characters, else wrapped between members, continued under the first one.
std::string fitted(const Members& members, std::size_t used) {
  const std::string line = one_line(members);
  if (used + line.size() <= line_width) return line;
  std::string out = "{";
  std::size_t at = used + 1;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::string part =
        json_quoted(members[i].first) + ": " + members[i].second + (i + 1 < members.size() ? "," : "}");
    if (i > 0 && at + 1 + part.size() > line_width) {
      out += fmt::format("\n{:{}}", "", used + 1);
      at = used + 1;
    } else if (i > 0) {
      out += ' ';
      ++at;
    }
    out += part;
    at += part.size();
  }
  return out;
}

std::string list_text(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const auto& text : texts) parts.push_back(json_quoted(text));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string text_or_list(const std::vector<std::string>& texts) {
  return texts.size() == 1 ? json_quoted(texts.front()) : list_text(texts);
}

class DiagramWriter {
 public:
  explicit DiagramWriter(const Diagram& diagram) : d_(diagram) {}

  std::string text() const {
    // The head: $schema and format share a line.
    std::string out = "{\n  ";
    if (!d_.schema.empty()) out += fmt::format("\"$schema\": {}, ", json_quoted(d_.schema));
    out += "\"format\": 1";
    const auto section = [&](const char* key, const std::string& text) {
      out += fmt::format(",\n  \"{}\": {}", key, text);
    };
    if (!d_.title.empty()) section("title", json_quoted(d_.title));
    if (!d_.source.empty()) section("source", json_quoted(d_.source));
    if (!d_.remark.empty()) section("remark", json_quoted(d_.remark));
    if (!d_.parameters.empty()) section("parameters", lines(parameters(), 2));
    if (!d_.inputs.empty()) section("inputs", fitted(inputs(), 12));
    section("blocks", d_.blocks.empty() ? "{}" : lines(blocks(), 2));
    if (!d_.outputs.empty()) section("outputs", fitted(outputs(), 13));
    if (!d_.record.empty()) section("record", list_text(d_.record));
    if (!d_.places.empty()) section("places", fitted(places(), 12));
    if (const auto s = simulate(); !s.empty()) section("simulate", fitted(s, 14));
    return out + "\n}\n";
  }

 private:
  Members parameters() const {
    Members list;
    for (const auto& [name, p] : d_.parameters) {
      const auto* number = std::get_if<Number>(&p.value.content);
      const bool plain = !p.lower && !p.upper && !p.free && p.remark.empty() && !p.value.known_to;
      if (plain && !(number != nullptr && number->unit)) {
        list.emplace_back(name, value_text(p.value));
        continue;
      }
      Members m;
      if (number != nullptr && number->unit) {
        m.emplace_back("value", exact_number_text(number->value));
        m.emplace_back("unit", json_quoted(*number->unit));
      } else {
        Value alone = p.value;
        alone.known_to.reset();
        m.emplace_back("value", value_text(alone));
      }
      if (p.value.known_to) m.emplace_back("known_to", known_to_text(*p.value.known_to));
      if (p.lower || p.upper)
        m.emplace_back("bounds", fmt::format("[{}, {}]", p.lower ? value_text(*p.lower) : "null",
                                             p.upper ? value_text(*p.upper) : "null"));
      if (p.free) m.emplace_back("free", *p.free ? "true" : "false");
      if (!p.remark.empty()) m.emplace_back("remark", json_quoted(p.remark));
      list.emplace_back(name, one_line(m));
    }
    return list;
  }

  Members inputs() const {
    Members list;
    for (const auto& [name, input] : d_.inputs) {
      Members m{{"unit", json_quoted(input.unit)}};
      if (input.length > 0) m.emplace_back("length", std::to_string(input.length));
      if (!input.remark.empty()) m.emplace_back("remark", json_quoted(input.remark));
      list.emplace_back(name, one_line(m));
    }
    return list;
  }

  Members blocks() const {
    std::size_t width = 0;
    for (const auto& [name, node] : d_.blocks) width = std::max(width, name.size() + 3);
    Members list;
    for (const auto& [name, node] : d_.blocks) list.emplace_back(name, block(name, node, 4 + width + 1));
    return list;
  }

  /// `used`: the column where the block's text begins.
  std::string block(const std::string& name, const Node& node, std::size_t used) const {
    if (node.from.empty()) return fitted(members(name, node, true), used);
    Members m{{"choose", json_quoted(node.choose)}};
    if (!node.effect.empty()) m.emplace_back("effect", json_quoted(node.effect));
    if (!node.in.empty()) m.emplace_back("in", wires(name, node.in));
    Members candidates;
    for (const auto& [candidate, body] : node.from)
      candidates.emplace_back(candidate, one_line(members(candidate, body, false)));
    m.emplace_back("from", one_line(candidates));
    const std::string line = one_line(m);
    if (used + line.size() <= line_width) return line;
    // What is chosen on the first line, the candidates below, one each.
    m.pop_back();
    std::string out = one_line(m);
    out.pop_back();
    out += fmt::format(",\n{:{}}\"from\": {{", "", used + 1);
    const std::size_t column = used + 1 + std::string_view("\"from\": {").size();
    std::size_t width = 0;
    for (const auto& [candidate, text] : candidates) width = std::max(width, candidate.size() + 3);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto& [candidate, body] = *(node.from.begin() + static_cast<std::ptrdiff_t>(i));
      out += fmt::format("{}{:<{}} {}", i > 0 ? fmt::format(",\n{:{}}", "", column) : "", json_quoted(candidate) + ":",
                         width, fitted(members(candidate, body, false), column + width + 1));
    }
    return out + "}}";
  }

  Members members(const std::string& name, const Node& node, bool with_inputs) const {
    Members m;
    if (!node.upon.empty()) m = {{"effect", json_quoted(node.effect)}, {"upon", json_quoted(node.upon)}};
    m.emplace_back("type", json_quoted(node.type));
    if (!node.file.empty()) m.emplace_back("file", json_quoted(node.file));
    if (node.nested && node.file.empty())
      fail("not_writable", "/blocks/" + name, "a nested diagram that stands in no file cannot be written",
           "write it to a file and name that");
    if (!node.parameter_file.empty()) m.emplace_back("parameters", json_quoted(node.parameter_file));
    for (const auto& [key, value] : node.parameters) {
      // Samples and their unit stand in the CSV that "file" and "column" name.
      if (node.type == "recorded" && (key == "samples" || key == "unit") && node.parameters.find("file") != nullptr)
        continue;
      if (node.type == "fmu" && key == "interface" && node.parameters.find("file") != nullptr) continue;
      m.emplace_back(key, value_text(value));
    }
    if (with_inputs && !node.in.empty()) m.emplace_back("in", wires(name, node.in));
    if (node.runs) runs_when(*node.runs, m);
    return m;
  }

  /// A signal alone where all else is as it is without a word.
  static void runs_when(const RunsWhen& runs, Members& m) {
    Members enable, trigger;
    if (runs.resets_states) enable.emplace_back("states", json_quoted("reset"));
    if (runs.zeroes_outputs) enable.emplace_back("outputs", json_quoted("zero"));
    if (runs.edge != RunsWhen{}.edge) trigger.emplace_back("edge", json_quoted(runs.edge));
    const auto add = [&m](const char* key, const std::string& signal, Members& with) {
      if (signal.empty()) return;
      with.insert(with.begin(), {"in", json_quoted(signal)});
      m.emplace_back(key, with.size() == 1 ? json_quoted(signal) : one_line(with));
    };
    add("enable", runs.enable, enable);
    add("trigger", runs.trigger, trigger);
  }

  static std::string wires(const std::string& block, const std::vector<Wire>& in) {
    std::vector<std::string> by_position;
    Ordered<std::vector<std::string>> by_port;
    for (const auto& wire : in) {
      if (wire.port.empty())
        by_position.push_back(wire.from);
      else
        by_port[wire.port].push_back(wire.from);
    }
    if (by_port.empty()) return text_or_list(by_position);
    if (!by_position.empty())
      fail("not_writable", "/blocks/" + block + "/in", "some inputs are listed by name and some by position",
           "name the port of each");
    Members m;
    for (const auto& [port, from] : by_port) m.emplace_back(port, text_or_list(from));
    return one_line(m);
  }

  Members outputs() const {
    Members m;
    for (const auto& [name, signal] : d_.outputs) m.emplace_back(name, json_quoted(signal));
    return m;
  }

  Members places() const {
    Members m;
    for (const auto& [kind, list] : d_.places) m.emplace_back(kind, text_or_list(list));
    return m;
  }

  Members simulate() const {
    const auto& s = d_.simulate;
    Members m, solver, guess, past, memory;
    if (s.until) m.emplace_back("until", value_text(*s.until));
    if (s.every) m.emplace_back("every", value_text(*s.every));
    if (s.method) solver.emplace_back("method", json_quoted(*s.method));
    if (s.relative_tolerance) solver.emplace_back("relative_tolerance", exact_number_text(*s.relative_tolerance));
    if (s.absolute_tolerance) solver.emplace_back("absolute_tolerance", exact_number_text(*s.absolute_tolerance));
    if (s.step) solver.emplace_back("step", value_text(*s.step));
    if (s.max_step) solver.emplace_back("max_step", value_text(*s.max_step));
    if (!solver.empty()) m.emplace_back("solver", one_line(solver));
    if (s.loops) m.emplace_back("loops", json_quoted(*s.loops));
    if (s.start) m.emplace_back("start", json_quoted(*s.start));
    for (const auto& [block, values] : s.past) past.emplace_back(block, numbers_text(values));
    if (!past.empty()) m.emplace_back("past", one_line(past));
    for (const auto& [block, values] : s.memory) memory.emplace_back(block, numbers_text(values));
    if (!memory.empty()) m.emplace_back("memory", one_line(memory));
    for (const auto& [signal, number] : s.guess) guess.emplace_back(signal, value_text(number));
    if (!guess.empty()) m.emplace_back("guess", one_line(guess));
    return m;
  }

  const Diagram& d_;
};

/// Paths that a node names, as seen from the new place of its file.
void move_paths(Node& node, const std::string& from, const std::string& to) {
  node.file = moved_path(node.file, from, to);
  node.parameter_file = moved_path(node.parameter_file, from, to);
  if (node.type == "recorded" || node.type == "fmu")
    if (Value* file = node.parameters.find("file"))
      if (auto* text = std::get_if<std::string>(&file->content)) *text = moved_path(*text, from, to);
  for (auto& [name, candidate] : node.from) move_paths(candidate, from, to);
}

bool is_address(const std::string& text) { return text.find("://") != text.npos; }

/// schema/diagram.schema.json in the nearest folder upwards, for diagrams that name no schema yet.
std::string nearest_schema(const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto folder = fs::weakly_canonical(fs::absolute(file), error).parent_path();
  for (auto at = folder;; at = at.parent_path()) {
    if (fs::is_regular_file(at / "schema" / "diagram.schema.json", error))
      return (at / "schema" / "diagram.schema.json").lexically_relative(folder).generic_string();
    if (at == at.parent_path()) return "";
  }
}

}  // namespace

std::string diagram_text(const Diagram& diagram) { return DiagramWriter(diagram).text(); }

Diagram moved_diagram(const Diagram& diagram, const std::string& file) {
  Diagram moved = diagram;
  if (moved.schema.empty())
    moved.schema = nearest_schema(file);
  else if (!is_address(moved.schema))
    moved.schema = moved_path(moved.schema, diagram.file, file);
  for (auto& [name, node] : moved.blocks) move_paths(node, diagram.file, file);
  moved.file = file;
  return moved;
}

void write_diagram(const std::string& file, const Diagram& diagram) {
  write_file(file, diagram_text(moved_diagram(diagram, file)));
}

}  // namespace hysteron
