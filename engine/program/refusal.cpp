#include "engine/program/refusal.h"

#include <algorithm>
#include <cstdlib>

#include "engine/diagram/index.h"
#include "engine/diagram/value_text.h"

namespace hysteron {
namespace {

struct NamedNumber {
  int slot = -1;  ///< in Run::p; -1: the block has no such parameter
  Unit unit{};
  bool difference = false;
};

/// The first number of a parameter of the block.
NamedNumber place_of(const Program& program, const BlockInstance& block, const std::string& name) {
  const auto& declared = block.kernel->declaration.parameters;
  const auto found = std::find_if(declared.begin(), declared.end(), [&](const auto& p) { return p.name == name; });
  if (found == declared.end()) return {};
  NamedNumber place;
  place.slot = block.p_begin + block.p_at[at(static_cast<int>(found - declared.begin()))];
  place.difference = found->is_difference;
  for (const auto& info : program.parameters)
    if (std::find(info.slots.begin(), info.slots.end(), place.slot) != info.slots.end()) place.unit = info.unit;
  return place;
}

}  // namespace

std::string refusal_text(const Program& program, const Run& run, int block, const std::string& text) {
  const BlockInstance& b = program.blocks[at(block)];
  std::string filled;
  std::size_t from = 0;
  for (std::size_t open = text.find('{'); open != text.npos; open = text.find('{', from)) {
    const std::size_t close = text.find('}', open);
    if (close == text.npos) break;
    filled += text.substr(from, open - from);
    const std::string mark = text.substr(open + 1, close - open - 1);
    const std::size_t in = mark.find(" in ");
    const NamedNumber place = place_of(program, b, in == mark.npos ? mark : mark.substr(in + 4));
    if (place.slot < 0)
      filled += "{" + mark + "}";  // no mark of ours: a piece of JSON, for example
    else
      filled += value_text(in == mark.npos ? run.p[at(place.slot)] : std::strtod(mark.c_str(), nullptr), place.unit,
                           place.difference);
    from = close + 1;
  }
  return filled + text.substr(from);
}

}  // namespace hysteron
