#include "blocks/fmi/fmu.h"

#include <fmt/format.h>

#include <algorithm>

#include "blocks/fmi/fmu_runs.h"
#include "engine/diagram/error.h"

namespace hysteron::blocks {
namespace {

FmuRuns& runs_of(const View<double>& v) { return FmuRuns::at_number(static_cast<int>(v.c[0])); }

double own_number(const ForeignVariable& variable, double si) { return (si - variable.offset) / variable.scale; }

/// Which of the FMU's parameters the block has values for: constants behind the number of its runs.
std::vector<std::pair<int, double>> parameters_of(const View<double>& v, const ForeignInterface& interface) {
  std::vector<std::pair<int, double>> list;
  for (int i = 1; i < v.n_c; ++i) {
    const auto place = static_cast<int>(v.c[i]);
    list.emplace_back(place, own_number(interface.parameters[static_cast<std::size_t>(place)],
                                        v.parameter(Fmu::first_of_its_own + i - 1)));
  }
  return list;
}

/// The first instant is its start.
long node_of(const View<double>& v) {
  if (v.hit > 0) return static_cast<long>(v.x[0]);
  FmuRuns& runs = runs_of(v);
  return runs.root(v.t, parameters_of(v, runs.interface()));
}

std::string interface_of(const Node& block) {
  const auto text = written_text(block, "interface");
  if (!text) fail("missing_parameter", "/file", "the block says no file", "name an FMU: \"file\": \"drive.fmu\"");
  return *text;
}

int place_of(const std::vector<ForeignVariable>& list, const std::string& port) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& v) { return v.port == port; });
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

std::vector<std::string> ports_of(const std::vector<ForeignVariable>& list) {
  std::vector<std::string> names;
  for (const auto& v : list) names.push_back(v.port);
  return names;
}

}  // namespace

void Fmu::describe(Declaration& d) {
  d.name("fmu", "FMU of another tool (FMI co-simulation), stepped with a fixed period").in_group("sampled");
  d.law(
       "at each instant the outputs are read from the FMU; then it advances by one period with the inputs "
       "of this instant")
      .from("Functional Mock-up Interface 2.0.4 and 3.0.1, fmi-standard.org");
  d.named_by("interface");
  d.remark(
      "Inputs, outputs and parameters are those of the FMU; in their names, characters other than letters "
      "and digits become \"_\". Parameters are given next to the file: \"mass\": \"2 kg\". A parameter "
      "that is not given has the value from the FMU.");
  d.remark(
      "An FMU contains native code that runs with your permissions. It runs only if you state that you "
      "trust it: --allow drive.fmu. Without this option its diagrams can be read, checked and drawn, but "
      "not run.");
  d.remark(
      "An input affects the outputs one period later. There are no derivatives of an FMU, so fits and "
      "linearize do not work through it (docs/fmi.md).");
  d.inputs_any("in", "$in", "inputs of the FMU, by name");
  d.outputs_any("y", "$result", "outputs of the FMU, by name");
  d.text("file", {}, "the FMU, e.g. \"drive.fmu\"");
  d.text("interface", {}, "made from the file; not written").optional("");
  d.sampled();
}

Declaration Fmu::instance(const Declaration& type, const Node& block) {
  const ForeignInterface interface = foreign_interface(interface_of(block));
  Declaration d = type;
  d.inputs.clear();
  d.outputs.clear();
  for (const auto& v : interface.inputs) d.input(v.port, v.unit, "input of the FMU");
  for (const auto& v : interface.outputs) d.output(v.port, v.unit, "output of the FMU");
  Problems problems;
  const auto names = ports_of(interface.parameters);
  const auto take = [&](const std::string& name) {
    if (type.parameter_index(name) >= 0 || d.parameter_index(name) >= 0) return;
    const int place = place_of(interface.parameters, name);
    if (place < 0)
      problems.add("unknown_parameter", "/" + name, fmt::format("the FMU has no parameter \"{}\"", name),
                   names.empty() ? "take it out" : did_you_mean(name, names));
    else
      d.parameter(name, interface.parameters[static_cast<std::size_t>(place)].unit, "parameter of the FMU");
  };
  for (const auto& [name, value] : block.parameters) take(name);
  for (const auto& [name, value] : block.parameters_from_file) take(name);
  problems.throw_if_any();
  return d;
}

Sizes Fmu::sizes(const Shape& shape) {
  Sizes s;
  s.sampled_states = 1;
  s.feedthrough = false;
  const std::string text = shape.free_text("interface");
  if (text.empty()) return s;
  const int number = FmuRuns::number_of(text);
  const ForeignInterface& interface = FmuRuns::at_number(number).interface();
  s.outputs = static_cast<int>(interface.outputs.size());
  s.code = {static_cast<double>(number)};
  const auto& parameters = shape.declaration->parameters;
  for (std::size_t i = first_of_its_own; i < parameters.size(); ++i)
    s.code.push_back(place_of(interface.parameters, parameters[i].name));
  s.constants = static_cast<int>(s.code.size());
  return s;
}

void Fmu::give(const View<double>& v) {
  FmuRuns& runs = runs_of(v);
  const auto values = runs.outputs(node_of(v));
  const auto& outputs = runs.interface().outputs;
  for (std::size_t i = 0; i < values.size(); ++i) v.out[i] = outputs[i].scale * values[i] + outputs[i].offset;
}

void Fmu::go_on(const View<double>& v) {
  FmuRuns& runs = runs_of(v);
  const auto& inputs = runs.interface().inputs;
  std::vector<double> values;
  for (std::size_t i = 0; i < inputs.size(); ++i) values.push_back(own_number(inputs[i], v.u[i]));
  v.out[0] = static_cast<double>(runs.advanced(node_of(v), values, v.t, v.parameter(period)));
}

void Fmu::refuse_slopes() {
  fail("no_slopes", "fmu", "slopes do not pass through an FMU: it is a program of somebody else",
       "take a method without slopes, or put a model of your own in its place");
}

Kernel fmu_block() {
  Kernel k = kernel<Fmu>();
  k.instance = &Fmu::instance;
  return k;
}

}  // namespace hysteron::blocks
