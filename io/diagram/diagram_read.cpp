// Decides how the text of a diagram file becomes a Diagram, with all that it names: nested diagrams,
// parameter sets, recorded inputs. Does not judge block types, their parameters, wires or units: the engine does.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "engine/diagram/smooth_series.h"
#include "engine/simulate/simulate.h"
#include "io/data/recording_file.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/job_command.h"
#include "io/diagram/parameter_table.h"
#include "io/diagram/place_kinds.h"
#include "io/files/project_path.h"
#include "io/fmi/imported_fmu.h"
#include "io/json/file_kind.h"
#include "io/json/json_reader.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

/// Keys of a block that are no parameters of its type.
const std::vector<std::string> choice_keys{"choose", "in", "from", "effect"};

std::string canonical_name(const std::string& file) {
  std::error_code error;
  const auto path = std::filesystem::weakly_canonical(file, error);
  return error ? file : path.string();
}

class DiagramReader {
 public:
  /// `open_files`: the diagrams that are being read, outermost first, to find one that contains itself.
  /// `prefix` stands before the pointers of origins: "" for the file that the user named, "file#" for those inside.
  DiagramReader(const std::string& file, const ProjectPaths& paths, std::vector<std::string>& open_files,
                std::string prefix)
      : file_(file), paths_(paths), open_files_(open_files), prefix_(std::move(prefix)) {}

  Diagram read() {
    const JsonPlace root = file_.root();
    if (!root.expect_object("{\"format\": 1, \"blocks\": {...}}")) file_.throw_if_any();
    check_kind(root, FileKind::diagram);
    check_format(root, "diagram");
    if (const auto what = root.find("do")) {  // of a job every other key would be wrong
      const std::string kind = what->is_text() ? *what->text() : "fit";
      what->add("is_job", "this file is a job, not a diagram",
                fmt::format("run it with \"{}\", or name the diagram that it names",
                            job_command(kind == "runs" || kind == "study" ? kind : "fit", file_.file())));
      file_.throw_if_any();
    }
    root.only({"$schema", "format", "title", "source", "remark", "parameters", "inputs", "blocks", "outputs", "record",
               "places", "simulate", "effect"});
    // "effect" is what a diagram means where it is put on a wire (discover/hypotheses/effect_file.h); as a diagram it
    // runs without.
    if (const auto effect = root.find("effect")) effect->expect_object("{\"id\": \"my_effect\"}");
    diagram_.file = file_.file();
    diagram_.schema = text_member(root, "$schema");
    diagram_.title = text_member(root, "title");
    diagram_.source = text_member(root, "source");
    diagram_.remark = text_member(root, "remark");
    for_members(root, "parameters", "{\"kp\": {\"value\": 1.2, \"unit\": \"V/um\"}}",
                [&](const std::string& name, const JsonPlace& place) { parameter(name, place); });
    for_members(root, "inputs", "{\"u\": {\"unit\": \"V\"}}",
                [&](const std::string& name, const JsonPlace& place) { input(name, place); });
    root.need("blocks", "write \"blocks\": {\"drive\": {\"type\": \"sine\", ...}, ...}");
    if (const auto blocks = root.find("blocks")) diagram_.blocks.reserve(blocks->size());
    for_members(root, "blocks", "{\"drive\": {\"type\": \"sine\", ...}}",
                [&](const std::string& name, const JsonPlace& place) {
                  if (check_name(place, name, "a block")) diagram_.blocks[name] = node(place, true);
                });
    for_members(root, "outputs", "{\"y\": \"stage.displacement\"}",
                [&](const std::string& name, const JsonPlace& place) {
                  if (!check_name(place, name, "an output", Capitals::allowed)) return;
                  if (auto signal = place.text()) diagram_.outputs[name] = *signal;
                });
    if (const auto list = root.find("record")) diagram_.record = texts(*list, "[\"drive\", \"stage.displacement\"]");
    places(root);
    simulate(root);
    file_.throw_if_any();
    return std::move(diagram_);
  }

 private:
  template <class Action>
  void for_members(const JsonPlace& root, const char* key, const char* example, Action action) {
    const auto place = root.find(key);
    if (!place || !place->expect_object(example)) return;
    for (const auto& [name, member] : place->members()) action(name, member);
  }

  std::string origin(const JsonPlace& place) const { return prefix_ + place.pointer(); }

  /// "a" or ["a", "b"].
  std::vector<std::string> texts(const JsonPlace& place, const char* example) {
    std::vector<std::string> list;
    if (place.is_text()) return {*place.text()};
    if (!place.expect_array(example)) return list;
    for (const auto& element : place.elements())
      if (auto text = element.text()) list.push_back(std::move(*text));
    return list;
  }

  void parameter(const std::string& name, const JsonPlace& place) {
    if (!check_name(place, name, "a parameter")) return;
    DiagramParameter parameter;
    if (auto value = read_value(place, origin(place), {"bounds", "free", "remark"}))
      parameter.value = std::move(*value);
    if (place.is_object()) {
      if (const auto bounds = place.find("bounds")) read_bounds(*bounds, parameter);
      if (const auto free = place.find("free")) parameter.free = free->truth();
      parameter.remark = text_member(place, "remark");
    }
    diagram_.parameters[name] = std::move(parameter);
  }

  static void read_bounds(const JsonPlace& place, DiagramParameter& parameter) {
    if (!place.expect_array("[0, 10]")) return;
    const auto ends = place.elements();
    if (ends.size() != 2) return place.add_wrong_type("two numbers such as [0, 10] (null = no bound)");
    if (!ends[0].is_null()) parameter.lower = read_number(ends[0]);
    if (!ends[1].is_null()) parameter.upper = read_number(ends[1]);
    if (parameter.lower && parameter.upper && parameter.lower->unit == parameter.upper->unit &&
        parameter.lower->value > parameter.upper->value)
      place.add("bad_value", "the lower bound is above the upper bound", "write the smaller one first");
  }

  void input(const std::string& name, const JsonPlace& place) {
    if (!check_name(place, name, "an input", Capitals::allowed) || !place.expect_object("{\"unit\": \"V\"}")) return;
    place.only({"unit", "length", "remark"});
    diagram_.inputs[name] = {text_member(place, "unit"), text_member(place, "remark"), length_member(place)};
  }

  /// How many elements an input carries; 0 where it is not stated.
  static int length_member(const JsonPlace& place) {
    const auto length = place.find("length");
    const auto number = length ? length->number() : std::nullopt;
    if (!number) return 0;
    if (*number >= 1 && *number <= 10'000 && *number == std::floor(*number)) return static_cast<int>(*number);
    length->add("bad_value", fmt::format("a signal cannot have {} elements", *number),
                "write a whole number, 1 or more");
    return 0;
  }

  /// A block, or a candidate of a choice (which has no inputs of its own and is no choice again).
  Node node(const JsonPlace& place, bool is_block) {
    Node node;
    if (!place.expect_object("{\"type\": \"gain\", \"gain\": 2, \"in\": \"drive\"}")) return node;
    node.origin = origin(place);
    if (is_block) {
      if (const auto in = place.find("in")) node.in = wires(*in);
      // "from" alone may be a parameter of a type (chirp).
      if (place.find("choose") || (place.find("from") && !place.find("type"))) return choice(place, std::move(node));
    } else if (const auto in = place.find("in")) {
      in->add("unknown_key", "a candidate has no inputs of its own",
              "write \"in\" beside \"choose\": all candidates read the same");
    }
    const auto type =
        place.need("type", is_block ? "write \"type\": \"...\" (hysteron blocks lists them), or \"choose\" and \"from\""
                                    : "write \"type\": \"...\" (hysteron blocks lists them)");
    if (type) node.type = type->text().value_or("");
    if (node.type == "diagram") {
      nest(place, node);
      node.runs = runs_when(place);
    }
    if (!is_block) {
      node.effect = text_member(place, "effect");
      node.upon = text_member(place, "upon");
    }
    for (const auto& [key, member] : place.members())
      if (is_block || (key != "effect" && key != "upon")) node_member(node, key, member);
    if (node.type == "recorded") load_samples(place, node);
    if (node.type == "fmu") load_fmu(place, node);
    return node;
  }

  void node_member(Node& node, const std::string& key, const JsonPlace& member) {
    if (key == "type" || key == "in") return;
    if (key == "parameters") return parameter_set(node, member);
    if ((key == "file" || key == "enable" || key == "trigger") && node.type == "diagram") return;
    if ((node.type == "recorded" && (key == "file" || key == "column")) || (node.type == "fmu" && key == "file")) {
      // Names of files and columns are text, also where they look like a number ("5 Hz").
      Value value;
      value.content = member.text().value_or("");
      value.origin = origin(member);
      node.parameters[key] = std::move(value);
      return;
    }
    if (auto value = read_value(member, origin(member))) node.parameters[key] = std::move(*value);
  }

  /// "enable" and "trigger" of a nested diagram: a signal, or an object with the signal and what goes with it.
  static std::optional<RunsWhen> runs_when(const JsonPlace& place) {
    const auto enable = place.find("enable"), trigger = place.find("trigger");
    if (!enable && !trigger) return {};
    RunsWhen runs;
    if (enable) {
      runs.enable = signal_member(*enable, {"in", "states", "outputs"});
      runs.resets_states = word_member(*enable, "states", {"hold", "reset"}) == "reset";
      runs.zeroes_outputs = word_member(*enable, "outputs", {"hold", "zero"}) == "zero";
    }
    if (trigger) {
      runs.trigger = signal_member(*trigger, {"in", "edge"});
      runs.edge = word_member(*trigger, "edge", {"rising", "falling", "either"});
    }
    return runs;
  }

  /// "drive", or "in" of an object that has these keys.
  static std::string signal_member(const JsonPlace& place, const std::vector<std::string>& keys) {
    if (place.is_text()) return place.text().value_or("");
    if (!place.expect_object("a signal \"on\", or {\"in\": \"on\", ...}")) return "";
    place.only(keys);
    const auto in = place.need("in", "write the signal: \"in\": \"on\"");
    return in ? in->text().value_or("") : "";
  }

  /// One of the words, the first where none is written.
  static std::string word_member(const JsonPlace& place, const char* key, const std::vector<std::string>& words) {
    const auto member = place.is_object() ? place.find(key) : std::nullopt;
    const auto text = member ? member->text() : std::nullopt;
    if (!text) return words.front();
    if (std::find(words.begin(), words.end(), *text) != words.end()) return *text;
    member->add("bad_value", fmt::format("\"{}\" cannot be \"{}\"", key, *text), did_you_mean(*text, words));
    return words.front();
  }

  Node choice(const JsonPlace& place, Node node) {
    place.only(choice_keys);
    node.effect = text_member(place, "effect");
    const auto choose = place.need("choose", "write \"choose\": \"name of the candidate in use\"");
    const auto from = place.need("from", "write \"from\": {\"off\": {\"type\": \"pass\"}, ...}");
    if (choose) node.choose = choose->text().value_or("");
    if (!from || !from->expect_object("{\"off\": {\"type\": \"pass\"}, ...}")) return node;
    for (const auto& [name, candidate] : from->members())
      if (check_name(candidate, name, "a candidate")) node.from[name] = this->node(candidate, false);
    if (node.from.empty())
      from->add("missing_key", "there is no candidate to choose from",
                "write at least one: \"off\": {\"type\": \"pass\"}");
    check_upon(*from, node);
    return node;
  }

  /// Each candidate that an effect put here says which one, and stands upon one before it: no circles.
  static void check_upon(const JsonPlace& from, const Node& choice) {
    std::vector<std::string> before;
    for (const auto& [name, candidate] : choice.from) {
      if (candidate.effect.empty() != candidate.upon.empty())
        from.find(name)->add("missing_key", "\"effect\" and \"upon\" go together",
                             "write both: which effect put this candidate here, upon which other candidate");
      else if (!candidate.upon.empty() && std::find(before.begin(), before.end(), candidate.upon) == before.end())
        from.find(name)->find("upon")->add("bad_choice",
                                           fmt::format("no candidate \"{}\" stands before it", candidate.upon),
                                           did_you_mean(candidate.upon, before));
      before.push_back(name);
    }
  }

  /// "a", ["a", "b"] or {"port": "a", "other": ["b", "c"]}.
  std::vector<Wire> wires(const JsonPlace& place) {
    std::vector<Wire> list;
    if (place.is_object()) {
      for (const auto& [port, sources] : place.members())
        for (auto& from : texts(sources, "[\"a\", \"b\"]")) list.push_back({port, std::move(from)});
      return list;
    }
    if (!place.is_text() && !place.is_array()) {
      place.add_wrong_type("a signal \"drive\", a list [\"a\", \"b\"] or ports {\"u\": \"a\", \"force\": \"b\"}");
      return list;
    }
    for (auto& from : texts(place, "[\"a\", \"b\"]")) list.push_back({"", std::move(from)});
    return list;
  }

  /// The path to open for a file named at `place`; notes "outside_project".
  std::optional<std::string> file_to_open(const JsonPlace& place, const std::string& written) {
    if (written.empty()) {
      place.add("bad_value", "the name of the file is empty", "name the file, as it is seen from this one");
      return {};
    }
    auto path = paths_.resolve(file_.file(), written);
    if (!path)
      place.add("outside_project", fmt::format("\"{}\" lies outside the project {}", written, paths_.project()),
                outside_cure(written));
    return path;
  }

  /// Runs an action on another file; its problems become ours, and a file that is not there is told where it is named.
  template <class Action>
  void with_file(const JsonPlace& place, Action action) {
    try {
      action();
    } catch (const Error& error) {
      if (error.problems.size() == 1 && error.problems.front().file.empty()) {
        const auto& p = error.problems.front();
        return place.add(p.code, p.what, p.cure);
      }
      file_.add(error);
    }
  }

  void nest(const JsonPlace& place, Node& node) {
    const auto name = place.need("file", "write \"file\": \"stage.json\"");
    const auto written = name ? name->text() : std::nullopt;
    if (!written) return;
    node.file = *written;
    const auto path = file_to_open(*name, *written);
    if (!path) return;
    const std::string identity = canonical_name(*path);
    if (std::find(open_files_.begin(), open_files_.end(), identity) != open_files_.end()) {
      std::string chain;
      for (const auto& open : open_files_) chain += std::filesystem::path(open).filename().string() + " -> ";
      return name->add("nested_in_itself", fmt::format("this diagram contains itself: {}{}", chain, *written),
                       "name another file, or take this block out");
    }
    with_file(*name, [&] {
      open_files_.push_back(identity);
      const std::shared_ptr<void> leave(nullptr, [&](void*) { open_files_.pop_back(); });
      node.nested = std::make_shared<const Diagram>(DiagramReader(*path, paths_, open_files_, *path + "#").read());
    });
  }

  /// A parameter set: a flat map of values, each perhaps with what a fit knows of it.
  void parameter_set(Node& node, const JsonPlace& place) {
    const auto written = place.text();
    if (!written) return;
    node.parameter_file = *written;
    const auto path = file_to_open(place, *written);
    if (!path) return;
    if (path->ends_with(".csv") || path->ends_with(".f64"))
      return with_file(place, [&] { node.parameters_from_file = read_parameter_table(*path); });
    with_file(place, [&] {
      JsonFile set(*path);
      const JsonPlace root = set.root();
      if (root.expect_object("{\"alpha\": \"0.6 um/V\"}"))
        for (const auto& [key, member] : root.members()) {
          if (key == "$schema" || key == "format" || key == "title" || key == "source" || key == "remark" ||
              key == "fit")
            continue;
          if (auto value = read_value(member, *path + "#" + member.pointer(),
                                      {"std", "source", "free", "scale", "bounds", "remark"}))
            node.parameters_from_file[key] = std::move(*value);
        }
      set.throw_if_any();
    });
  }

  /// A recorded input: its samples are read here, once, and become a parameter of the block.
  void load_samples(const JsonPlace& place, Node& node) {
    const auto file = place.need("file", "write \"file\": \"drive.csv\"");
    const auto column = place.need("column", "write \"column\": \"u\"");
    for (const char* key : {"samples", "unit"})
      if (const auto given = place.find(key))
        given->add("unknown_key", fmt::format("{} cannot stand in a diagram file", key),
                   "they stand in the CSV; name it: \"file\", \"column\"");
    if (!file || !column || !file->is_text() || !column->is_text()) return;
    const auto path = file_to_open(*file, *file->text());
    if (!path) return;
    with_file(*file, [&] {
      const RecordingFile recording = read_recording_file(*path, 1);
      const auto values = recording.columns.find(*column->text());
      if (values == recording.columns.end())
        return column->add("missing_column", fmt::format("{} has no column \"{}\"", *path, *column->text()),
                           did_you_mean(*column->text(), recording.names));
      Series series{recording.t, values->second, Between::linear};
      if (const auto* between = node.parameters.find("between_samples"))
        if (const auto* text = std::get_if<std::string>(&between->content)) series.between = between_of(*text);
      Value samples(std::make_shared<const Series>(in_straight_pieces(std::move(series))));
      samples.origin = origin(place);
      node.parameters["samples"] = std::move(samples);
      Value unit;
      unit.content = recording.units.at(values->first).text;  // text, also where it looks like a number ("1/s")
      unit.origin = origin(*column);
      node.parameters["unit"] = std::move(unit);
    });
  }

  /// Another simulator's unit: what it takes and gives is read here, and becomes a parameter of the block.
  void load_fmu(const JsonPlace& place, Node& node) {
    const auto file = place.need("file", "write \"file\": \"drive.fmu\"");
    if (const auto given = place.find("interface"))
      given->add("unknown_key", "interface cannot stand in a diagram file", "it is made from the file; take it out");
    if (!file || !file->is_text()) return;
    const auto path = file_to_open(*file, *file->text());
    if (!path) return;
    with_file(*file, [&] {
      Value interface;
      interface.content = foreign_interface_text(imported_fmu(*path, *file->text(), paths_.trusts(*path)));
      interface.origin = origin(*file);
      node.parameters["interface"] = std::move(interface);
    });
  }

  void places(const JsonPlace& root) {
    const auto place = root.find("places");
    if (!place || !place->expect_object("{\"core\": \"drive\"}")) return;
    place->only(place_kinds);
    for (const auto& [kind, wires] : place->members()) diagram_.places[kind] = texts(wires, "[\"drive\"]");
  }

  static std::optional<Number> number_at(const JsonPlace& object, const char* key) {
    const auto place = object.find(key);
    return place ? read_number(*place) : std::nullopt;
  }

  void simulate(const JsonPlace& root) {
    const auto place = root.find("simulate");
    if (!place || !place->expect_object("{\"until\": \"1 s\", \"every\": \"1 ms\"}")) return;
    place->only({"until", "every", "start", "past", "memory", "solver", "loops", "guess"});
    auto& s = diagram_.simulate;
    s.until = number_at(*place, "until");
    s.every = number_at(*place, "every");
    if (const auto start = place->find("start")) s.start = start->text();
    for_members(*place, "past", "{\"hysteresis\": [\"0 V\", \"10 V\", \"0 V\"]}",
                [&](const std::string& block, const JsonPlace& values) {
                  if (const auto list = read_numbers(values)) s.past[block] = *list;
                });
    for_members(*place, "memory", "{\"hysteresis\": [\"0 V\", \"-0.2 V\"]}",
                [&](const std::string& block, const JsonPlace& values) {
                  if (const auto list = read_numbers(values)) s.memory[block] = *list;
                });
    if (const auto loops = place->find("loops")) s.loops = loops->text();
    for_members(*place, "guess", "{\"error\": \"1 um\"}", [&](const std::string& signal, const JsonPlace& value) {
      if (const auto number = read_number(value)) s.guess[signal] = *number;
    });
    const auto solver = place->find("solver");
    if (!solver || !solver->expect_object("{\"method\": \"bdf\", \"relative_tolerance\": 1e-8}")) return;
    solver->only({"method", "relative_tolerance", "absolute_tolerance", "max_step", "step"});
    if (const auto method = solver->find("method")) {
      s.method = method->text();
      const auto& known = method_names();
      if (s.method && std::find(known.begin(), known.end(), *s.method) == known.end())
        method->add("bad_value", fmt::format("there is no method {}", json_quoted(*s.method)),
                    did_you_mean(*s.method, known));
    }
    s.relative_tolerance = tolerance(*solver, "relative_tolerance");
    s.absolute_tolerance = tolerance(*solver, "absolute_tolerance");
    s.max_step = number_at(*solver, "max_step");
    s.step = number_at(*solver, "step");
  }

  static std::optional<double> tolerance(const JsonPlace& solver, const char* key) {
    const auto value = number_member(solver, key);
    if (value && !(*value > 0)) solver.find(key)->add("bad_value", "a tolerance must be above 0", "write 1e-6, say");
    return value;
  }

  JsonFile file_;
  const ProjectPaths& paths_;
  std::vector<std::string>& open_files_;
  std::string prefix_;
  Diagram diagram_;
};

}  // namespace

bool is_diagram_file(const std::string& file) {
  try {
    JsonFile json(file);
    const JsonPlace root = json.root();
    return root.is_object() && root.find("blocks") && !root.find("effect");
  } catch (const Error&) {
    return false;
  }
}

Diagram read_diagram(const std::string& file, const std::vector<std::string>& allowed) {
  const ProjectPaths paths(file, allowed);
  std::vector<std::string> open_files{canonical_name(file)};
  return DiagramReader(file, paths, open_files, "").read();
}

}  // namespace hysteron
