#include "fit/model/free_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/program/names.h"
#include "fit/model/model.h"

namespace hysteron {
namespace {

/// Blocks that hold a parameter.
std::vector<std::size_t> blocks_of(const Program& program, const ParameterInfo& info) {
  std::vector<std::size_t> list;
  for (const int slot : info.slots)
    for (std::size_t b = 0; b < program.blocks.size(); ++b) {
      const auto& block = program.blocks[b];
      if (slot >= block.p_begin && slot < block.p_begin + block.p_at.back()) list.push_back(b);
    }
  return list;
}

const ParameterDeclaration* declaration_of(const Program& program, const ParameterInfo& info) {
  const auto blocks = blocks_of(program, info);
  if (blocks.empty()) return nullptr;
  const auto& block = program.blocks[blocks.front()];
  const auto& declared = block.kernel->declaration.parameters;
  for (std::size_t i = 0; i < declared.size(); ++i)
    if (info.slots.front() - block.p_begin < block.p_at[i + 1]) return &declared[i];
  return nullptr;
}

/// Declared linear, or a pure delay: a block that remembers nothing but the past of its input hands that on.
bool passes_linearly(const BlockInstance& b) {
  return b.kernel->declaration.is_linear || (b.sizes.history && b.sizes.memory == 0 && b.sizes.states == 0);
}

/// Parameters that share a fate: same block, offset or not.
struct Kind {
  std::size_t block = 0;
  bool offset = false;
  std::size_t parameters = 0;
};

class Prover {
 public:
  Prover(const Program& program, const std::vector<int>& output_signals) : program_(program) {
    for (std::size_t b = 0; b < program.blocks.size(); ++b)
      below_.push_back(program.downstream_of(static_cast<int>(b)));
    for (const int s : output_signals)
      ends_.push_back(static_cast<std::size_t>(program.signals[static_cast<std::size_t>(s)].block));
  }

  /// Alone affine: declared so, in one block, and linear from there to the outputs.
  bool alone(const ParameterInfo& info) const {
    const auto blocks = blocks_of(program_, info);
    if (!info.linear || blocks.size() != 1) return false;
    const std::size_t b = blocks.front();
    if (below_[b][b] && !info.offset) return false;  // its own output comes back to its input
    for (std::size_t d = 0; d < program_.blocks.size(); ++d)
      if (below_[b][d] && reaches_output(d) && !passes_linearly(program_.blocks[d])) return false;
    return true;
  }

  bool together(const Kind& a, const Kind& b) const { return !multiplies(a, b) && !multiplies(b, a); }

 private:
  /// Does the downstream one scale the response to the upstream one?
  bool multiplies(const Kind& up, const Kind& down) const {
    return up.block != down.block && below_[up.block][down.block] && !down.offset;
  }
  bool reaches_output(std::size_t b) const {
    return std::any_of(ends_.begin(), ends_.end(), [&](std::size_t e) { return e == b || below_[b][e]; });
  }

  const Program& program_;
  std::vector<std::vector<bool>> below_;
  std::vector<std::size_t> ends_;
};

/// The heaviest set of kinds that go together; all subsets while there are few, else one after the other.
std::vector<bool> heaviest_set(const std::vector<Kind>& kinds, const Prover& prover) {
  const std::size_t n = kinds.size();
  std::vector<bool> best(n, false);
  if (n > 16) {
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return kinds[a].parameters > kinds[b].parameters; });
    for (const std::size_t i : order) {
      bool fits = true;
      for (std::size_t j = 0; j < n; ++j) fits = fits && (!best[j] || prover.together(kinds[i], kinds[j]));
      best[i] = fits;
    }
    return best;
  }
  std::size_t most = 0;
  for (std::size_t set = 1; set < (std::size_t{1} << n); ++set) {
    std::size_t count = 0;
    bool fits = true;
    for (std::size_t i = 0; i < n && fits; ++i) {
      if (!(set >> i & 1)) continue;
      count += kinds[i].parameters;
      for (std::size_t j = 0; j < i && fits; ++j) fits = !(set >> j & 1) || prover.together(kinds[i], kinds[j]);
    }
    if (!fits || count <= most) continue;
    most = count;
    for (std::size_t i = 0; i < n; ++i) best[i] = (set >> i & 1) != 0;
  }
  return best;
}

FreeParameter make(const Program& program, const ParameterInfo& info) {
  FreeParameter f;
  f.parameter = static_cast<int>(&info - program.parameters.data());
  f.start = info.value;
  f.lower = info.lower;
  f.upper = info.upper;
  const auto* declared = declaration_of(program, info);
  const bool positive = declared != nullptr && declared->exclusive_minimum && declared->minimum >= 0;
  const bool wide = info.lower > 0 && std::isfinite(info.upper) && info.upper / info.lower > 100;
  f.log_scale = info.value > 0 && !info.linear && (positive || wide || info.lower > 0);
  return f;
}

}  // namespace

FreeParameter free_parameter(const Program& program, const std::string& path) {
  return make(program, program.parameters[static_cast<std::size_t>(parameter_index(program, path))]);
}

std::vector<FreeParameter> free_parameters(const Program& program, const std::vector<std::string>& extra) {
  std::vector<bool> chosen(program.parameters.size(), false);
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = program.parameters[i].free;
  for (const auto& path : extra) {
    for (const int place : named_parameters(program, path)) chosen[static_cast<std::size_t>(place)] = true;
  }
  std::vector<FreeParameter> free;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) free.push_back(make(program, program.parameters[i]));
  return free;
}

std::vector<bool> jointly_affine(const Program& program, const std::vector<int>& parameters,
                                 const std::vector<int>& output_signals) {
  const Prover prover(program, output_signals);
  std::vector<Kind> kinds;
  std::vector<int> kind_of(parameters.size(), -1);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& info = program.parameters[static_cast<std::size_t>(parameters[i])];
    if (!prover.alone(info)) continue;
    const std::size_t block = blocks_of(program, info).front();
    auto k = std::find_if(kinds.begin(), kinds.end(),
                          [&](const Kind& kind) { return kind.block == block && kind.offset == info.offset; });
    if (k == kinds.end()) k = kinds.insert(kinds.end(), {block, info.offset, 0});
    ++k->parameters;
    kind_of[i] = static_cast<int>(k - kinds.begin());
  }
  const auto chosen = heaviest_set(kinds, prover);
  std::vector<bool> affine(parameters.size(), false);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    affine[i] = kind_of[i] >= 0 && chosen[static_cast<std::size_t>(kind_of[i])];
  return affine;
}

}  // namespace hysteron
