#include "engine/program/parameter_values.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/diagram/index.h"
#include "engine/diagram/value_text.h"

namespace hysteron {
namespace {

void check_value(const Program& program, const Run& run, int parameter, double si) {
  const ParameterInfo& info = program.parameters[at(parameter)];
  const auto shown = [&](double value) { return value_text(value, info.unit, info.difference); };
  if (!(si >= info.lower && si <= info.upper))
    fail("bad_value", info.path,
         fmt::format("\"{}\" is {}, outside its range {} ... {}", info.path, shown(si), shown(info.lower),
                     shown(info.upper)),
         "draw it inside its range");
  for (const int slot : info.slots)
    for (const BlockInstance& b : program.blocks) {
      if (slot < b.p_begin || slot >= b.p_begin + b.p_at.back()) continue;
      const auto which = std::upper_bound(b.p_at.begin(), b.p_at.end(), slot - b.p_begin) - b.p_at.begin() - 1;
      const ParameterDeclaration& p = b.kernel->declaration.parameters[static_cast<std::size_t>(which)];
      const auto begin = at(b.p_at[static_cast<std::size_t>(which)]),
                 end = at(b.p_at[static_cast<std::size_t>(which) + 1]);
      if (!lies_in_range(p, si))
        fail("bad_value", info.path,
             fmt::format("\"{}\" is {}, and must be greater than {}", info.path, shown(si), shown(p.minimum)),
             "draw it inside its range");
      if (p.is_increasing && first_that_does_not_increase({run.p.data() + at(b.p_begin) + begin, end - begin}) > 0)
        fail("bad_value", info.path, fmt::format("\"{}\" of \"{}\" does not increase", p.name, b.path),
             "draw its elements from ranges that lie one behind the other");
    }
}

}  // namespace

bool lies_in_range(const ParameterDeclaration& p, double si) {
  return (p.exclusive_minimum ? si > p.minimum : si >= p.minimum) && si <= p.maximum;
}

std::size_t first_that_does_not_increase(std::span<const double> list) {
  for (std::size_t k = 1; k < list.size(); ++k)
    if (!(list[k] > list[k - 1])) return k;
  return 0;
}

bool block_varies(const Program& program, const BlockInstance& b, std::span<const int> parameters) {
  return std::any_of(parameters.begin(), parameters.end(), [&](int parameter) {
    const auto& slots = program.parameters[at(parameter)].slots;
    return std::any_of(slots.begin(), slots.end(),
                       [&](int slot) { return slot >= b.p_begin && slot < b.p_begin + b.p_at.back(); });
  });
}

void set_parameters(const Program& program, Run& run, std::span<const int> parameters, std::span<const double> values,
                    RefusedValues refused) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    for (const int slot : program.parameters[at(parameters[i])].slots) run.p[at(slot)] = values[i];
  for (std::size_t i = 0; i < parameters.size(); ++i) check_value(program, run, parameters[i], values[i]);
  for (std::size_t i = 0; i < program.blocks.size(); ++i) {
    const BlockInstance& b = program.blocks[i];
    if (b.kernel->check == nullptr && b.kernel->prepare == nullptr) continue;
    if (!block_varies(program, b, parameters)) continue;
    if (refused == RefusedValues::end_the_run) {
      prepare(program, run, static_cast<int>(i));
    } else if (b.kernel->prepare != nullptr) {
      View<double> v = view_of(program, run, static_cast<int>(i));
      v.out = run.c.data() + b.c_begin;
      b.kernel->prepare(v);
    }
  }
}

}  // namespace hysteron
