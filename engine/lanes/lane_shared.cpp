#include "engine/lanes/lane_shared.h"

#include <algorithm>

#include "engine/diagram/index.h"
#include "engine/program/parameter_values.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

constexpr std::size_t largest_table = 4'000'000;  // numbers: 32 MB, a tenth of what a study may take

}  // namespace

std::vector<bool> shared_blocks(const Program& program, std::span<const int> parameters) {
  std::vector<bool> shared(program.blocks.size(), false);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const BlockInstance& b = program.blocks[i];
    shared[i] = b.sizes.states == 0 && b.memory_count() == 0 && b.history_index < 0 && b.mode_index < 0 &&
                !block_varies(program, b, parameters);
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < shared.size(); ++i) {
      const auto& source = program.blocks[i].source;
      if (!shared[i] ||
          std::all_of(source.begin(), source.end(), [&](int s) { return shared[at(program.signals[at(s)].block)]; }))
        continue;
      shared[i] = false;
      changed = true;
    }
  }
  return shared;
}

SharedNumbers::SharedNumbers(ProgramPointer program, const Run& run, const std::vector<Step>& steps,
                             const std::vector<bool>& shared, std::span<const int> read, std::vector<Instant> instants)
    : program_(std::move(program)), run_(run), work_(*program_), instants_(std::move(instants)), x_(run.x) {
  const auto want = [&](Order order, int signal) {
    if (!shared[at(program_->signals[at(signal)].block)]) return;
    const auto same = [&](const Slot& s) { return s.order == order && s.index == signal; };
    if (std::none_of(slots_.begin(), slots_.end(), same)) slots_.push_back({order, signal});
  };
  for (const Step& step : steps) {
    if (shared[at(step.block)]) {
      steps_.push_back(step);
      continue;
    }
    const BlockInstance& b = program_->blocks[at(step.block)];
    const bool reads_rates =
        step.order == Order::rate || (step.order == Order::derivative && b.kernel->derivative_wants_rate);
    for (const int s : b.source) {
      want(Order::value, s);
      if (reads_rates && program_->has_rate[at(s)]) want(Order::rate, s);
    }
  }
  for (const int s : read) want(Order::value, s);
  now_.resize(slots_.size());
  constant_.assign(slots_.size(), false);
  if (slots_.size() * instants_.size() > largest_table) return;
  table_.resize(slots_.size() * instants_.size());
  for (std::size_t i = 0; i < instants_.size(); ++i) evaluate(instants_[i], table_.data() + i * slots_.size());
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    bool same = true;
    for (std::size_t i = 1; i < instants_.size(); ++i) same = same && table_[i * slots_.size() + s] == table_[s];
    constant_[s] = same;
  }
}

const double* SharedNumbers::numbers(std::size_t instant) {
  if (slots_.empty()) return now_.data();
  if (!table_.empty()) return table_.data() + instant * slots_.size();
  evaluate(instants_[instant], now_.data());
  return now_.data();
}

void SharedNumbers::evaluate(const Instant& instant, double* to) {
  run_.branch = instant.branch;
  steps::begin(*program_, run_, work_, instant.t);
  steps::run(steps_, *program_, work_, x_.data());
  for (std::size_t s = 0; s < slots_.size(); ++s)
    to[s] = (slots_[s].order == Order::value ? work_.y : work_.rate)[at(slots_[s].index)];
}

}  // namespace hysteron
