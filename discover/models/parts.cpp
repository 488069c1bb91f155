#include "discover/models/parts.h"

#include <algorithm>
#include <numeric>

#include "discover/wiring/wiring.h"
#include "fit/model/free_parameter.h"

namespace hysteron {
namespace {

/// Outputs that the effect standing as `name` moves: those behind any of its blocks and of the constants found anew.
std::vector<int> outputs_of(const Program& program, const PlacedEffect& s) {
  std::vector<bool> moved(program.output_signals.size(), false);
  const auto add = [&](int block) {
    for (const int o : outputs_behind(program, block)) moved[static_cast<std::size_t>(o)] = true;
  };
  bool any = false;
  for (std::size_t b = 0; b < program.blocks.size(); ++b) {
    const auto& path = program.blocks[b].path;
    if (path != s.name && !path.starts_with(s.name + "/") && !path.starts_with(s.name + ".")) continue;
    add(static_cast<int>(b));
    any = true;
  }
  if (!any) add(-1);
  for (const auto* anew : {&s.zeros, &s.weights})
    for (const auto& path : *anew)
      add(program.parameters[static_cast<std::size_t>(parameter_index(program, path))].block);
  std::vector<int> list;
  for (std::size_t o = 0; o < moved.size(); ++o)
    if (moved[o]) list.push_back(static_cast<int>(o));
  return list;
}

/// Outputs that something moves together.
class Together {
 public:
  explicit Together(std::size_t n) : first_(n) { std::iota(first_.begin(), first_.end(), std::size_t{0}); }
  std::size_t of(int output) const { return first_[static_cast<std::size_t>(output)]; }
  void join(const std::vector<int>& outputs) {
    for (const int o : outputs) {
      const std::size_t from = of(o), to = of(outputs.front());
      for (auto& f : first_)
        if (f == from) f = to;
    }
  }

 private:
  std::vector<std::size_t> first_;
};

}  // namespace

std::vector<int> outputs_behind(const Program& program, int block) {
  std::vector<int> list;
  const auto below = block >= 0 ? program.downstream_of(block) : std::vector<bool>{};
  for (std::size_t o = 0; o < program.output_signals.size(); ++o) {
    const int at = program.signals[static_cast<std::size_t>(program.output_signals[o])].block;
    if (block < 0 || at == block || below[static_cast<std::size_t>(at)]) list.push_back(static_cast<int>(o));
  }
  return list;
}

bool moves_an_output(const Program& program, int parameter) {
  return !outputs_behind(program, program.parameters[static_cast<std::size_t>(parameter)].block).empty();
}

std::vector<Part> parts_of(const CandidateModel& c, const std::vector<std::string>& free_paths) {
  const Program& program = *c.program;
  const int n = static_cast<int>(program.output_signals.size());
  Together together(program.output_signals.size());
  std::vector<std::vector<int>> moved;
  for (const auto& s : c.placed) together.join(moved.emplace_back(outputs_of(program, s)));
  for (const auto& f : free_parameters(program, free_paths))
    together.join(outputs_behind(program, program.parameters[static_cast<std::size_t>(f.parameter)].block));
  std::vector<Part> parts;
  const auto name = [&](int o) { return program.output_names[static_cast<std::size_t>(o)]; };
  for (int first = 0; first < n; ++first) {
    Part part;
    for (int o = 0; o < n; ++o)
      if (together.of(o) == together.of(first)) part.outputs.push_back(name(o));
    if (part.outputs.front() != name(first)) continue;  // an earlier output's
    for (const auto& by : moved) part.effects.push_back(!by.empty() && together.of(by.front()) == together.of(first));
    parts.push_back(std::move(part));
  }
  return parts;
}

Diagram seen_at(const Diagram& diagram, const std::vector<std::string>& outputs) {
  Diagram seen = diagram;
  for (const auto& [name, wire] : diagram.outputs) {
    if (std::any_of(outputs.begin(), outputs.end(), [&](const auto& o) { return is_of_output(o, name); })) continue;
    seen.outputs.erase(name);
    seen.record.push_back(wire);  // a block that nobody reads is refused
  }
  return seen;
}

}  // namespace hysteron
