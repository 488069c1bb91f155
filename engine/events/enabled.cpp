#include "engine/events/enabled.h"

#include <algorithm>

#include "engine/diagram/index.h"

namespace hysteron {
namespace {

bool switches_off(const ModeChange& change) { return runs_in_mode(change.before) && !runs_in_mode(change.after); }
bool switches_on(const ModeChange& change) { return !runs_in_mode(change.before) && runs_in_mode(change.after); }

/// A run at its start that shares nothing with this one but its numbers.
Run begun_anew(const Program& program, const Run& run) {
  Run fresh;
  fresh.p = run.p;
  fresh.c = run.c;
  fresh.m.resize(run.m.size());
  fresh.x.resize(run.x.size());
  fresh.direction.resize(run.direction.size());
  fresh.mode.resize(run.mode.size());
  fresh.hits.resize(run.hits.size());
  fresh.series = run.series;
  fresh.histories.resize(run.histories.size());
  reset(program, fresh);
  return fresh;
}

}  // namespace

bool runs_at_edges(const Program& program, const BlockInstance& block) {
  for (int e = block.enabling; e >= 0; e = program.enablings[at(e)].outer)
    if (program.enablings[at(e)].triggered) return true;
  return false;
}

EnabledDiagrams::EnabledDiagrams(const Program& program)
    : program_(program), enabling_of_(program.modal_blocks.size(), -1), early_(program.modal_blocks.size(), false) {
  for (std::size_t e = 0; e < program.enablings.size(); ++e)
    enabling_of_[at(block(program.enablings[e].block).mode_index)] = static_cast<int>(e);
  for (std::size_t i = 0; i < early_.size(); ++i)
    early_[i] = enabling_of_[i] >= 0 || runs_at_edges(program, block(program.modal_blocks[i]));
}

const Enabling* EnabledDiagrams::enabling(const ModeChange& change) const {
  const int e = enabling_of_[at(change.modal)];
  return e < 0 ? nullptr : &program_.enablings[at(e)];
}

bool EnabledDiagrams::has_run(const Run& run, int modal) const {
  const int e = enabling_of_[at(modal)];
  return e >= 0 && program_.enablings[at(e)].triggered && runs_in_mode(run.mode[at(modal)]);
}

void EnabledDiagrams::complete(const Run& run, std::vector<ModeChange>& changes, bool starting) const {
  for (auto& change : changes)
    if (const Enabling* e = enabling(change); starting && e != nullptr && e->triggered) change.after %= enabled_mode;
  for (std::size_t i = 0; i < changes.size(); ++i) {  // the list grows
    const Enabling* off = enabling(changes[i]);
    if (off == nullptr || !switches_off(changes[i])) continue;
    for (const Enabling& inner : program_.enablings) {
      if (inner.outer < 0 || &program_.enablings[at(inner.outer)] != off) continue;
      const int modal = block(inner.block).mode_index, mode = run.mode[at(modal)];
      const auto same = std::find_if(changes.begin(), changes.end(), [&](const auto& c) { return c.modal == modal; });
      if (same != changes.end())
        same->after %= enabled_mode;
      else if (runs_in_mode(mode))
        changes.push_back({modal, inner.block, mode, inner.triggered ? mode % enabled_mode : 0});
    }
  }
}

void EnabledDiagrams::switch_off(Run& run, const Work& work, std::span<const ModeChange> changes) const {
  std::vector<bool> zeroed(program_.blocks.size(), false);
  for (const auto& change : changes) {
    const Enabling* e = enabling(change);
    if (e == nullptr || !switches_off(change)) continue;
    for (const int b : e->inside) {
      const BlockInstance& own = block(b);
      double* held = run.m.data() + own.held_while_off;
      // What was off before, further in, has long been held.
      if (!is_off(program_, run, own)) std::copy_n(work.y.begin() + own.y_begin, own.sizes.outputs, held);
      zeroed[at(b)] = zeroed[at(b)] || e->zeroes_outputs;
      if (!e->triggered) continue;
      std::copy_n(work.m.begin() + own.m_begin, own.sizes.memory, run.m.begin() + own.m_begin);
      if (own.hit_index >= 0) ++run.hits[at(own.hit_index)];
    }
  }
  for (std::size_t b = 0; b < zeroed.size(); ++b)
    if (zeroed[b]) std::fill_n(run.m.data() + program_.blocks[b].held_while_off, program_.blocks[b].sizes.outputs, 0.0);
}

void EnabledDiagrams::switch_on(Run& run, std::vector<double>& x, std::span<const ModeChange> changes) const {
  for (const auto& change : changes) {
    const Enabling* e = enabling(change);
    if (e == nullptr || !e->resets_states || !switches_on(change)) continue;
    const Run fresh = begun_anew(program_, run);
    for (const int b : e->inside) {
      const BlockInstance& own = block(b);
      std::copy_n(fresh.x.begin() + own.x_begin, own.sizes.states, x.begin() + own.x_begin);
      std::copy_n(fresh.m.begin() + own.m_begin, own.memory_count(), run.m.begin() + own.m_begin);
      if (own.mode_index >= 0) run.mode[at(own.mode_index)] = fresh.mode[at(own.mode_index)];
    }
  }
}

void EnabledDiagrams::list_inside(std::span<const ModeChange> changes, std::vector<int>& blocks) const {
  for (const auto& change : changes)
    if (const Enabling* e = enabling(change); e != nullptr && runs_in_mode(change.before) != runs_in_mode(change.after))
      blocks.insert(blocks.end(), e->inside.begin(), e->inside.end());
}

std::vector<int> EnabledDiagrams::triggered_samples(const Run& run) const {
  std::vector<int> list;
  for (std::size_t i = 0; i < program_.sampled_blocks.size(); ++i) {
    const BlockInstance& b = block(program_.sampled_blocks[i]);
    if (runs_at_edges(program_, b) && !is_off(program_, run, b)) list.push_back(static_cast<int>(i));
  }
  return list;
}

std::vector<int> EnabledDiagrams::running(const Run& run, std::span<const int> sampled) const {
  std::vector<int> list;
  for (const int i : sampled)
    if (!is_off(program_, run, block(program_.sampled_blocks[at(i)]))) list.push_back(i);
  return list;
}

}  // namespace hysteron
