#include "io/fmi/exported_description.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "engine/diagram/index.h"
#include "engine/program/feedthrough.h"
#include "engine/program/nominal.h"
#include "engine/simulate/simulate.h"
#include "io/fmi/fmi_variables.h"

namespace hysteron {
namespace {

/// Which signals a change of one moves at the same instant.
class Moves {
 public:
  explicit Moves(const Program& program) : moved_(program.signals.size()) {
    for (std::size_t b = 0; b < program.blocks.size(); ++b) {
      const auto& block = program.blocks[b];
      const auto through = feedthrough(program, static_cast<int>(b));
      for (int y = 0; y < block.sizes.outputs; ++y)
        for (int u = 0; u < block.n_u; ++u)
          if (through[at(y * block.n_u + u)]) moved_[at(block.source[at(u)])].push_back(block.y_begin + y);
    }
  }

  std::set<int> by(int signal) const {
    std::set<int> reached;
    std::vector<int> todo{signal};
    while (!todo.empty()) {
      const int one = todo.back();
      todo.pop_back();
      if (!reached.insert(one).second) continue;
      todo.insert(todo.end(), moved_[at(one)].begin(), moved_[at(one)].end());
    }
    return reached;
  }

 private:
  std::vector<std::vector<int>> moved_;
};

std::vector<double> usual_sizes(const Program& program) {
  Run run = start(program);
  for (const auto& input : program.input_names)
    bind_input(program, run, input, std::make_shared<Series>(Series{{0.0}, {0.0}, Between::hold}));
  return nominal_sizes(program, run).signals;
}

class Exported {
 public:
  explicit Exported(const Program& program)
      : program_(program), variables_(fmi_variables(program)), sizes_(usual_sizes(program)) {}

  void fill(FmiDescription& d) const {
    std::set<std::string> units;
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      const auto& v = variables_[i];
      d.variables.push_back(scalar(v, static_cast<unsigned>(i)));
      if (!v.unit.text.empty() && units.insert(v.unit.text).second) d.units.push_back({v.unit.text, v.unit});
    }
    for (auto& output : outputs()) {
      d.initial_unknowns.push_back({output.reference, {}});  // at the start it may depend on all that is given
      d.outputs.push_back(std::move(output));
    }
  }

 private:
  FmiScalar scalar(const FmiVariable& v, unsigned reference) const {
    FmiScalar s;
    s.name = v.name;
    s.reference = reference;
    s.unit = v.unit.text;
    s.relative = v.difference;
    switch (v.role) {
      case FmiRole::time:
        s.causality = "independent";
        s.description = "time of the simulation";
        break;
      case FmiRole::input:
        s.causality = "input";
        s.start = 0;
        set_nominal(s, v, program_.input_signals[at(v.place)]);
        break;
      case FmiRole::parameter:
        tell_parameter(s, v);
        break;
      case FmiRole::output:
        s.causality = "output";
        [[fallthrough]];
      case FmiRole::local:
        s.initial = "calculated";
        set_nominal(s, v, v.place);
        break;
    }
    return s;
  }

  void set_nominal(FmiScalar& s, const FmiVariable& v, int signal) const {
    const double size = sizes_[at(signal)] / v.unit.scale;
    if (size > 0 && std::isfinite(size)) s.nominal = size;
  }

  void tell_parameter(FmiScalar& s, const FmiVariable& v) const {
    const ParameterInfo& p = program_.parameters[at(v.place)];
    s.causality = "parameter";
    s.variability = "fixed";
    s.initial = "exact";
    s.start = v.from_si(p.value);
    const double lower = v.from_si(p.lower), upper = v.from_si(p.upper);
    if (std::isfinite(lower)) s.lower = lower;
    if (std::isfinite(upper)) s.upper = upper;
    const auto& block = program_.blocks[at(p.block)];
    for (std::size_t i = 0; i < block.kernel->declaration.parameters.size(); ++i) {
      const int begin = block.p_begin + block.p_at[i], end = block.p_begin + block.p_at[i + 1];
      if (p.slots.front() >= begin && p.slots.front() < end)
        s.description = block.kernel->declaration.parameters[i].meaning;
    }
  }

  std::vector<FmiUnknown> outputs() const {
    std::vector<FmiUnknown> list;
    for (std::size_t i = 0; i < variables_.size(); ++i)
      if (variables_[i].role == FmiRole::output) list.push_back({static_cast<unsigned>(i), std::vector<unsigned>{}});
    const Moves moves(program_);
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (variables_[i].role != FmiRole::input) continue;
      const auto reached = moves.by(program_.input_signals[at(variables_[i].place)]);
      for (auto& output : list)
        if (reached.contains(variables_[output.reference].place))
          output.dependencies->push_back(static_cast<unsigned>(i));
    }
    return list;
  }

  const Program& program_;
  std::vector<FmiVariable> variables_;
  std::vector<double> sizes_;
};

}  // namespace

FmiDescription exported_description(const Program& program, int version, const std::string& identifier,
                                    const std::string& token) {
  FmiDescription d;
  d.version = version;
  d.name = program.title.empty() ? identifier : program.title;
  d.identifier = identifier;
  d.token = token;
  d.copies_state = true;
  const SimulateOptions options = simulate_options(program);
  d.start = options.begin;
  d.stop = options.until;
  d.tolerance = options.relative_tolerance;
  if (options.every > 0) d.step = options.every;
  Exported(program).fill(d);
  return d;
}

}  // namespace hysteron
