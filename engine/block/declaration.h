// Decides what a block type says of itself: ports, parameters, states, memory, with units and meaning.
// Checks, documentation and JSON Schemas are all made from this one declaration.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

/// A unit expression: a unit ("V", "um/s", "" = dimensionless), a unit variable ("$a"), or products and quotients of
/// both
/// ("$b/$a", "$a*s"). Variables are found per block from wires and from the units written at its parameters.
/// At a vector port "$a" is one unit for all elements and "$a[i]" one per element; in a matrix "$b[row]/$a[column]"
/// speaks of the unit of each row and column.
using UnitExpression = std::string;

struct PortDeclaration {
  std::string name;
  UnitExpression unit;
  std::string meaning;
  bool variadic = false;   ///< input: takes any number of wires, at least one; output "y": any number of y0, y1, ...
  bool is_vector = false;  ///< carries any number of elements; Sizes says how many

  PortDeclaration& vector() { return is_vector = true, *this; }
};

enum class ParameterKind { number, list, text, matrix };

struct ParameterDeclaration {
  std::string name;
  UnitExpression unit;
  std::string meaning;
  ParameterKind kind = ParameterKind::number;
  std::optional<std::string> default_text{};  ///< as it would stand in a file ("0 V", "1"); absent = required. For
                                              ///< lists: one element, e.g. "1"
  std::vector<std::string> choices{};         ///< allowed texts (kind text)
  double minimum = -std::numeric_limits<double>::infinity();  ///< smallest admissible SI value
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusive_minimum = false;
  bool is_linear = false;  ///< the block's outputs are affine in it (jointly with the other linear ones of the block)
  bool is_offset = false;  ///< linear, and its coefficient does not depend on the block's input
  bool is_difference = false;    ///< a temperature here is a difference (0.01 degC = 0.01 K)
  bool is_increasing = false;    ///< a list that must be strictly increasing
  std::string same_length_as{};  ///< a list that must be as long as that other list
  bool may_be_matrix = false;    ///< a list that may also be given as rows, one behind the other
  bool is_structural = false;    ///< whole numbers that fix ports and lengths: read once, no parameter of a run

  ParameterDeclaration& optional(std::string text) { return default_text = std::move(text), *this; }
  ParameterDeclaration& linear() { return is_linear = true, *this; }
  ParameterDeclaration& offset() { return is_linear = is_offset = true, *this; }
  ParameterDeclaration& difference() { return is_difference = true, *this; }
  ParameterDeclaration& positive() { return minimum = 0, exclusive_minimum = true, *this; }
  ParameterDeclaration& not_negative() { return minimum = 0, *this; }
  ParameterDeclaration& increasing() { return is_increasing = true, *this; }
  ParameterDeclaration& or_matrix() { return may_be_matrix = true, *this; }
  ParameterDeclaration& structural() { return is_structural = true, *this; }
  ParameterDeclaration& as_long_as(std::string other) { return same_length_as = std::move(other), *this; }
};

struct StateDeclaration {
  std::string name;
  UnitExpression unit;
  std::string meaning;
  double initial_value = 0;  ///< [SI]
  double nominal_size = 0;   ///< [SI] typical magnitude for the absolute tolerance; 0 = worked out from the inputs
  StateDeclaration& initial(double value) { return initial_value = value, *this; }
  StateDeclaration& nominal(double value) { return nominal_size = value, *this; }
};

/// What a block may be replaced by, to try a hypothesis: another type with the same ports, or other settings of the
/// same type. It keeps the parameters that it has under their names and gets further ones, of which some values change
/// nothing.
struct VariationDeclaration {
  struct Neutral {
    std::string parameter;
    std::string value;  ///< as it would stand in a file
  };
  std::string name;  ///< the hypothesis: "friction"
  std::string type;  ///< that takes the place; may be the block's own
  std::vector<Neutral> null_value;
};

/// Whether an output may jump (a step, a held sample) or has no rate at all (noise).
enum class Smoothness { smooth, jumps, no_rate };

/// All that a block type says of itself, apart from its functions.
class Declaration {
 public:
  std::string type, summary;
  std::string equation;              ///< the law, as text
  std::string source;                ///< literature or standard, with equation numbers
  std::vector<std::string> remarks;  ///< what a user would otherwise get wrong
  std::vector<PortDeclaration> inputs, outputs;
  std::vector<ParameterDeclaration> parameters;
  std::vector<StateDeclaration> states;
  std::vector<std::string> memory_names;  ///< fixed-size blocks: one per member of Memory
  std::string memory_port;     ///< the memory is in the unit of that port; "" = no memory that a diagram could give
  std::string memory_meaning;  ///< what its numbers are
  std::vector<VariationDeclaration> variations;
  std::string group;       ///< "sources", "math", "linear", "hysteresis", ...
  std::string place;       ///< where an effect of this kind would enter: "command", "core", "measured" ... ("" = none)
  bool is_linear = false;  ///< outputs and derivatives are affine in (states, inputs) for fixed parameters
  bool is_rate_independent = false;  ///< derivative is homogeneous of degree one in the rate where that is high, and
                                     ///< zero at rest: a jump of the input is the path of a fast ramp
  bool is_series = false;            ///< driven by a recorded series (parameter "samples")
  bool is_sampled = false;           ///< runs at offset + k period only, and holds its outputs between
  bool is_controller = false;        ///< makes a command of what a sensor reads
  bool is_elementwise = false;       ///< on vectors: one such block per element, with the same parameters
  std::string names_from;  ///< the parameter whose text names inputs and further parameters of a block; "" = none

  Declaration& name(std::string type_name, std::string what) {
    type = std::move(type_name);
    summary = std::move(what);
    return *this;
  }
  Declaration& law(std::string text) { return equation = std::move(text), *this; }
  Declaration& from(std::string text) { return source = std::move(text), *this; }
  Declaration& remark(std::string text) { return remarks.push_back(std::move(text)), *this; }
  Declaration& linear() { return is_linear = true, *this; }
  Declaration& controller() { return is_controller = true, *this; }
  Declaration& elementwise() { return is_elementwise = true, *this; }
  Declaration& named_by(std::string parameter) { return names_from = std::move(parameter), *this; }
  Declaration& rate_independent() { return is_rate_independent = true, *this; }
  /// A sampled block. Adds the parameters "period" and "offset", behind all others.
  Declaration& sampled() {
    is_sampled = true;
    parameter("period", "s", "time from one sampling instant to the next").positive();
    parameter("offset", "s", "first sampling instant").optional("0 s").not_negative();
    return *this;
  }
  /// "simulate": {"memory": ...} may give the memory at the start.
  Declaration& remembers(std::string port, std::string meaning) {
    memory_port = std::move(port);
    memory_meaning = std::move(meaning);
    return *this;
  }
  Declaration& variation(std::string hypothesis, std::string other_type,
                         std::vector<VariationDeclaration::Neutral> null_value) {
    variations.push_back({std::move(hypothesis), std::move(other_type), std::move(null_value)});
    return *this;
  }
  Declaration& at(std::string kind_of_place) { return place = std::move(kind_of_place), *this; }
  Declaration& in_group(std::string text) { return group = std::move(text), *this; }

  PortDeclaration& input(std::string port, UnitExpression unit, std::string meaning) {
    return inputs.push_back({std::move(port), std::move(unit), std::move(meaning)}), inputs.back();
  }
  PortDeclaration& inputs_any(std::string port, UnitExpression unit, std::string meaning) {
    return inputs.push_back({std::move(port), std::move(unit), std::move(meaning), true}), inputs.back();
  }
  PortDeclaration& output(std::string port, UnitExpression unit, std::string meaning) {
    return outputs.push_back({std::move(port), std::move(unit), std::move(meaning)}), outputs.back();
  }
  /// Any number of outputs: "y" makes y0, y1, ... (as many as Sizes::output_lengths has).
  PortDeclaration& outputs_any(std::string port, UnitExpression unit, std::string meaning) {
    return outputs.push_back({std::move(port), std::move(unit), std::move(meaning), true}), outputs.back();
  }
  ParameterDeclaration& parameter(std::string key, UnitExpression unit, std::string meaning,
                                  ParameterKind kind = ParameterKind::number) {
    ParameterDeclaration p;
    p.name = std::move(key);
    p.unit = std::move(unit);
    p.meaning = std::move(meaning);
    p.kind = kind;
    return parameters.push_back(std::move(p)), parameters.back();
  }
  ParameterDeclaration& list(std::string key, UnitExpression unit, std::string meaning) {
    return parameter(std::move(key), std::move(unit), std::move(meaning), ParameterKind::list);
  }
  ParameterDeclaration& matrix(std::string key, UnitExpression unit, std::string meaning) {
    return parameter(std::move(key), std::move(unit), std::move(meaning), ParameterKind::matrix);
  }
  ParameterDeclaration& text(std::string key, std::vector<std::string> choices, std::string meaning) {
    auto& p = parameter(std::move(key), "", std::move(meaning), ParameterKind::text);
    p.choices = std::move(choices);
    if (!p.choices.empty()) p.default_text = p.choices.front();
    return p;
  }
  StateDeclaration& state(std::string key, UnitExpression unit, std::string meaning) {
    StateDeclaration s;
    s.name = std::move(key);
    s.unit = std::move(unit);
    s.meaning = std::move(meaning);
    return states.push_back(std::move(s)), states.back();
  }

  int parameter_index(const std::string& key) const;  ///< -1 if there is none
  std::vector<std::string> parameter_names() const;
  std::vector<std::string> input_names() const;
  std::vector<std::string> output_names() const;
  /// Has a port that carries vectors: Sizes then tells lengths.
  bool has_vector_ports() const;
};

}  // namespace hysteron
