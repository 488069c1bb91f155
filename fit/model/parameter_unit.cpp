// A block may leave the unit of a parameter to its wires ("$b/$a"). Where the file gives no unit (a zero, a default),
// this works it out from the signals at the block's ports.
#include <algorithm>
#include <map>

#include "fit/model/model.h"

namespace hysteron {
namespace {

/// Unit variables of a block: "$a" -> the unit in which the signal at that port is shown.
std::map<std::string, Unit> variables_of(const Program& program, const BlockInstance& block) {
  std::map<std::string, Unit> units;
  const auto note = [&](const std::string& expression, int signal) {
    if (expression.empty() || expression.front() != '$' || expression.find_first_of("*/") != std::string::npos) return;
    const auto& s = program.signals[static_cast<std::size_t>(signal)];
    units[expression] = s.unit.dimension == s.dimension && s.unit.offset == 0 ? s.unit : si_unit(s.dimension);
  };
  const auto& d = block.kernel->declaration;
  if (d.has_vector_ports()) return units;  // each element has its own: SI will do
  for (std::size_t i = 0; i < d.inputs.size() && i < block.source.size(); ++i) note(d.inputs[i].unit, block.source[i]);
  for (std::size_t i = 0; i < d.outputs.size(); ++i) note(d.outputs[i].unit, block.y_begin + static_cast<int>(i));
  return units;
}

/// "$b/$a" with the variables put in: its text, and the dimension that the text must have.
struct Resolved {
  std::string text;
  Dimension dimension;
};

Resolved resolve(const std::string& expression, const std::map<std::string, Unit>& variables) {
  Resolved r;
  bool divide = false;
  for (std::size_t i = 0; i <= expression.size();) {
    const auto end = std::min(expression.find_first_of("*/", i), expression.size());
    const std::string token = expression.substr(i, end - i);
    const auto found = variables.find(token);
    Unit unit = found != variables.end()           ? found->second
                : token.empty() || token[0] == '$' ? Unit{}
                                                   : parse_unit(token);
    r.dimension = divide ? r.dimension / unit.dimension : r.dimension * unit.dimension;
    if (i > 0) r.text += divide ? "/" : " ";
    // "um/V" per "s" is "um/V/s", but divided by "V s" it would be wrong: brackets keep it right.
    const bool simple = unit.text.find_first_of(" */") == std::string::npos;
    r.text += unit.text.empty() ? "1" : simple ? unit.text : "(" + unit.text + ")";
    divide = end < expression.size() && expression[end] == '/';
    i = end + 1;
  }
  return r;
}

}  // namespace

Unit parameter_unit(const Program& program, const ParameterInfo& parameter) {
  if (!parameter.unit.text.empty() || parameter.block < 0) return parameter.unit;
  const auto& block = program.blocks[static_cast<std::size_t>(parameter.block)];
  const auto& declared = block.kernel->declaration.parameters;
  const int slot = parameter.slots.front() - block.p_begin;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    if (slot >= block.p_at[i + 1]) continue;
    if (declared[i].unit.find('$') == std::string::npos) return parameter.unit;
    const auto resolved = resolve(declared[i].unit, variables_of(program, block));
    if (resolved.dimension.none()) return parameter.unit;
    try {
      const Unit unit = parse_unit(resolved.text);
      if (unit.dimension == resolved.dimension && unit.offset == 0) return unit;
    } catch (const Error&) {  // an unusual spelling: SI will do
    }
    return si_unit(resolved.dimension);
  }
  return parameter.unit;
}

}  // namespace hysteron
