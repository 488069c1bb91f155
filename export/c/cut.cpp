#include "export/c/cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/diagram/error.h"
#include "engine/program/names.h"

namespace hysteron {
namespace {

/// "stage" of "stage.y[1]".
std::string block_of(const std::string& signal) { return signal.substr(0, signal.find_first_of(".[")); }
/// "stage.y" of "stage.y[1]".
std::string without_element(const std::string& signal) { return signal.substr(0, signal.find('[')); }

class Cut {
 public:
  Cut(const Diagram& whole, const Program& program) : whole_(whole), program_(program) { cut_.diagram = whole; }

  CutDiagram operator()(const std::vector<std::string>& from, const std::vector<std::string>& to) {
    cut_.diagram.record.clear();
    cut_.diagram.places = {};
    name_outputs(to);
    for (const auto& signal : from) make_input(signal);
    keep(reached());
    for (const auto& [name, input] : cut_.diagram.inputs)
      cut_.inputs.push_back(signal_of_.count(name) ? signal_of_[name] : name);
    return std::move(cut_);
  }

 private:
  bool is_signal(const std::string& signal) const {
    return whole_.blocks.find(block_of(signal)) != nullptr || whole_.inputs.find(block_of(signal)) != nullptr;
  }
  void need(const std::string& option, const std::string& signal) const {
    if (is_signal(signal)) return;
    std::vector<std::string> known = whole_.blocks.names();
    for (const auto& name : whole_.inputs.names()) known.push_back(name);
    if (option == "--to")
      for (const auto& name : whole_.outputs.names()) known.push_back(name);
    fail("unknown_signal", option,
         fmt::format("there is no signal \"{}\" at the outermost level of the diagram", signal),
         did_you_mean(signal, known));
  }
  void name_outputs(const std::vector<std::string>& to) {
    if (to.empty()) {
      if (whole_.outputs.empty())
        fail("no_output", "/outputs", "the diagram says of no signal that it is its output",
             "name what the code is to work out: --to drive");
      return;
    }
    cut_.diagram.outputs = {};
    for (const auto& signal : to) {
      const std::string* output = whole_.outputs.find(signal);
      if (output == nullptr || whole_.blocks.find(signal) != nullptr) need("--to", signal);
      std::string name = signal;
      std::replace(name.begin(), name.end(), '.', '_');
      cut_.diagram.outputs[name] = output != nullptr && whole_.blocks.find(signal) == nullptr ? *output : signal;
    }
  }

  /// Elements of a signal and the unit of the first.
  DiagramInput as_input(const std::string& signal) const {
    const std::string name = program_name(whole_, signal);
    DiagramInput input;
    int index = find_named_signal(program_, name);
    if (index < 0) {
      while (find_named_signal(program_, fmt::format("{}[{}]", name, input.length)) >= 0) ++input.length;
      if (input.length > 0) index = find_named_signal(program_, name + "[0]");
    }
    if (index < 0) index = named_signal(program_, name);  // throws with the nearest names
    input.unit = program_.signals[static_cast<std::size_t>(index)].unit.text;
    return input;
  }

  /// Readers of `signal` read an input instead.
  void make_input(const std::string& signal) {
    need("--from", signal);
    if (signal.find('[') != std::string::npos)
      fail("unknown_signal", "--from", fmt::format("\"{}\" is one element of a vector", signal),
           fmt::format("name the whole: --from {}", without_element(signal)));
    if (whole_.inputs.find(signal) != nullptr) return;
    const DiagramInput input = as_input(signal);
    const auto dot = signal.find('.');
    std::string name = signal;
    if (dot == std::string::npos) {
      cut_.diagram.blocks.erase(signal);  // an input of its name takes its place
    } else {
      name[dot] = '_';
      while (whole_.blocks.find(name) != nullptr || whole_.inputs.find(name) != nullptr) name += '_';
      const bool only = find_named_signal(program_, program_name(whole_, block_of(signal))) ==
                        find_named_signal(program_, program_name(whole_, signal));
      rewire(signal, name, only ? block_of(signal) : "");
    }
    cut_.diagram.inputs[name] = input;
    signal_of_[name] = signal;
  }

  void rewire(const std::string& signal, const std::string& input, const std::string& block) {
    const auto change = [&](std::string& wire) {
      const std::string element = wire.substr(without_element(wire).size());
      const std::string read = without_element(wire);
      if (read == signal || (!block.empty() && read == block)) wire = input + element;
    };
    for (auto& [name, node] : cut_.diagram.blocks) {
      for (auto& wire : node.in) change(wire.from);
      if (node.runs) {
        change(node.runs->enable);
        change(node.runs->trigger);
      }
    }
    for (auto& [name, wire] : cut_.diagram.outputs) change(wire);
  }

  /// Blocks and inputs on which the outputs depend.
  std::set<std::string> reached() const {
    std::set<std::string> found;
    std::vector<std::string> next;
    const auto read = [&](const std::string& wire) {
      if (!wire.empty() && found.insert(block_of(wire)).second) next.push_back(block_of(wire));
    };
    for (const auto& [name, wire] : cut_.diagram.outputs) read(wire);
    while (!next.empty()) {
      const std::string name = next.back();
      next.pop_back();
      const Node* node = cut_.diagram.blocks.find(name);
      if (node == nullptr) continue;
      for (const auto& wire : node->in) read(wire.from);
      if (!node->runs) continue;
      read(node->runs->enable);
      read(node->runs->trigger);
    }
    return found;
  }

  void keep(const std::set<std::string>& needed) {
    for (const auto& name : cut_.diagram.blocks.names())
      if (!needed.contains(name)) cut_.diagram.blocks.erase(name);
    for (const auto& name : cut_.diagram.inputs.names())
      if (!needed.contains(name)) cut_.diagram.inputs.erase(name);
    if (cut_.diagram.blocks.empty())
      fail("nothing_between", "--to", "no block stands between the signals that were named",
           "name a signal further back: --from reference");
    auto& settings = cut_.diagram.simulate;
    const auto forget = [&](auto& list) {
      for (const auto& name : list.names())
        if (cut_.diagram.blocks.find(name.substr(0, name.find_first_of("./["))) == nullptr) list.erase(name);
    };
    forget(settings.past);
    forget(settings.memory);
    forget(settings.guess);
  }

  const Diagram& whole_;
  const Program& program_;
  CutDiagram cut_;
  std::map<std::string, std::string> signal_of_;
};

}  // namespace

CutDiagram cut_diagram(const Diagram& whole, const Program& program, const std::vector<std::string>& from,
                       const std::vector<std::string>& to) {
  return Cut(whole, program)(from, to);
}

}  // namespace hysteron
