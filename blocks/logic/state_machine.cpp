#include "blocks/logic/state_machine.h"

#include <fmt/format.h>

#include <algorithm>

#include "blocks/math/expression_units.h"
#include "engine/diagram/error.h"

namespace hysteron::blocks {
namespace {

using expression::Code;
using expression::Wrong;

const char* const time_name = "time";

/// What the texts of one block say.
struct Machine {
  std::vector<std::string> states, outputs;
  std::vector<state_machine::Transition> transitions;
};

/// Throws Error at the text that is wrong.
template <class TextOf>
Machine machine(const TextOf& text_of_parameter) {
  Machine m;
  std::string name;
  try {
    m.states = state_machine::names_in(text_of_parameter(name = "states"));
    if (m.states.empty()) throw Wrong("there is no state", 1, "name them: \"search, leave, home\"");
    m.outputs = state_machine::names_in(text_of_parameter(name = "outputs"));
    m.transitions = state_machine::transitions_in(text_of_parameter(name = "transitions"), m.states);
  } catch (const Wrong& wrong) {
    fail("bad_value", "/" + name, fmt::format("\"{}\": {}", name, wrong.what()), wrong.cure);
  }
  return m;
}

Machine machine_of(const Shape& shape) {
  return machine([&](const std::string& name) { return shape.free_text(name); });
}

const Value* given(const Node& block, const std::string& name) {
  const Value* value = block.parameters.find(name);
  return value != nullptr ? value : block.parameters_from_file.find(name);
}

int input_at(const Declaration& d, const std::string& name) {
  for (std::size_t i = 0; i < d.inputs.size(); ++i)
    if (d.inputs[i].name == name) return static_cast<int>(i);
  return -1;
}

/// Its place in the list, where it is put if it is not there.
int place_among(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto place = static_cast<int>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return place;
}

}  // namespace

void StateMachine::describe(Declaration& d) {
  d.name("state_machine", "state machine: states, transitions and outputs per state").in_group("logic");
  d.law(
       "in the state \"from\", when the condition of \"from -> to: condition\" holds, the state becomes "
       "\"to\"; each output has the value of its list for the state")
      .from("definition; conditions as those of \"expression\"");
  d.named_by("transitions");
  d.remark(
      "\"states\": \"search, leave, home\"; the first is the initial state. \"transitions\": \"search -> "
      "leave: at_stop; leave -> home: not at_stop and time > t0\"; if several conditions hold, the first "
      "is taken; \"*\" stands for every other state.");
  d.remark(
      "Names in conditions are parameters if the block has a value for them, else inputs; \"time\" is the "
      "time since the state was entered. The instants at which a condition becomes true are located.");
  d.remark(
      "\"outputs\": \"velocity, brake\" names further outputs; each is a list with one value per state: \"velocity\": "
      "[\"-20 mm/s\", \"5 mm/s\", \"0 mm/s\"].");
  d.inputs_any("in", "$in", "the names in the conditions that are not parameters, in order of appearance");
  d.output("state", "", "the state: 0, 1, 2 ... in the order of \"states\"");
  d.state("time", "s", "time since the state was entered").nominal(1.0);
  d.text("states", {}, "names of the states; the first is the initial state");
  d.text("transitions", {}, "transitions: \"from -> to: condition; ...\"");
  d.text("outputs", {}, "names of further outputs, each with a list of one value per state").optional("");
}

Declaration StateMachine::instance(const Declaration& type, const Node& block) {
  const Machine m = machine([&](const std::string& name) {
    const Value* value = given(block, name);
    const auto text = value == nullptr ? std::optional<std::string>("") : written_text(*value);
    if (!text) fail("wrong_type", "/" + name, fmt::format("\"{}\" is a text", name), "write it in quotes");
    return *text;
  });
  Declaration d = type;
  d.inputs.clear();
  for (const auto& name : m.outputs) {
    d.list(name, "$" + name, "one value per state").linear();
    d.output(name, "$" + name, "value for the present state");
  }
  for (const auto& t : m.transitions)
    for (const auto& name : t.condition.symbols) {
      if (name == time_name || d.parameter_index(name) >= 0 || input_at(d, name) >= 0) continue;
      if (given(block, name) != nullptr)
        d.parameter(name, "$" + name, "in a condition");
      else
        d.input(name, "$" + name, "in a condition; or a parameter: give the block a value for it");
    }
  return d;
}

Sizes StateMachine::sizes(const Shape& shape) {
  const Declaration& d = *shape.declaration;
  Sizes s;
  s.states = 1;
  s.feedthrough = false;
  s.smoothness = Smoothness::jumps;
  try {
    const Machine m = machine_of(shape);
    s.outputs = 1 + static_cast<int>(m.outputs.size());
    for (const auto& name : m.outputs)
      if (const int i = d.parameter_index(name); i >= 0 && shape.length(name) != static_cast<int>(m.states.size()))
        s.error = fmt::format("\"{}\" has {} values for {} states", name, shape.length(name), m.states.size());
    std::vector<std::string> found;  // inputs of a type without a declaration of its own
    for (const auto& t : m.transitions) {
      std::vector<bool> is_parameter;
      std::vector<double> at_inputs, at_parameters;
      for (const auto& name : t.condition.symbols) {
        const int own = d.parameter_index(name), input = input_at(d, name);
        is_parameter.push_back(own >= first_of_its_own);
        if (own >= first_of_its_own)
          at_parameters.push_back(shape.inputs + own);
        else
          at_inputs.push_back(name == time_name ? time_in_state : input >= 0 ? input : place_among(found, name));
      }
      const auto code = expression::compile(t.condition, is_parameter).code;
      const std::size_t symbols_of = t.condition.symbols.size();
      for (const double x :
           {static_cast<double>(t.from), static_cast<double>(t.to),
            static_cast<double>(head_size + symbols_of + code.size()), static_cast<double>(symbols_of)})
        s.code.push_back(x);
      s.code.insert(s.code.end(), at_inputs.begin(), at_inputs.end());
      s.code.insert(s.code.end(), at_parameters.begin(), at_parameters.end());
      s.code.insert(s.code.end(), code.begin(), code.end());
      s.kinks += Code::count(code.data(), Code::kinks);
    }
    s.constants = static_cast<int>(s.code.size());
  } catch (const Error& e) {
    s.error = e.problems.front().what;
  } catch (const Wrong& wrong) {
    s.error = wrong.what();
  }
  return s;
}

void StateMachine::units(const Shape& shape, InstanceUnits& units) {
  const Declaration& d = *shape.declaration;
  units.parameter = "transitions";
  try {
    for (const auto& t : machine_of(shape).transitions) {
      expression::UnitsOfTree of{std::vector<InstanceUnits::Known>(t.condition.symbols.size()), Dimension{}};
      InstanceUnits::Known time = parse_unit("s").dimension;
      std::vector<InstanceUnits::Known*> known;
      for (const auto& name : t.condition.symbols) {
        const int own = d.parameter_index(name), input = input_at(d, name);
        known.push_back(own >= first_of_its_own ? &units.parameters[static_cast<std::size_t>(own)]
                        : input >= 0            ? &units.inputs[static_cast<std::size_t>(input)]
                                                : &time);
        of.symbols[known.size() - 1] = *known.back();
      }
      expression::infer_units(t.condition, of, units.name);
      for (std::size_t i = 0; i < known.size(); ++i) *known[i] = of.symbols[i];
    }
  } catch (const Wrong& wrong) {
    units.error = wrong.what();
    units.cure = wrong.cure;
  }
}

void StateMachine::kinks(const View<double>& v) {
  double* out = v.out;
  any_of(v, [&](const double*, const double* code, double* slots) {
    expression::evaluate(code, slots, out);
    out += Code::count(code, Code::kinks);
    return false;
  });
}

Kernel state_machine_block() {
  Kernel k = kernel<StateMachine>();
  k.instance = &StateMachine::instance;
  k.units = &StateMachine::units;
  return k;
}

}  // namespace hysteron::blocks
