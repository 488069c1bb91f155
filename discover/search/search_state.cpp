#include "discover/search/search_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "discover/models/parts.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

/// Lines of the mains in the user's own model, by the output that they are on. Nobody knows their phase in a recording
/// that was not there yet.
void lines_of_user(const SearchState& state, std::vector<std::optional<WanderingLine>>& lines) {
  const Effect* mains = state.effects.find("mains_interference");
  if (mains == nullptr) return;
  const Program& program = state.base_model->program();
  for (const auto& block : program.blocks) {
    if (block.kernel->declaration.type != mains->block_type) continue;
    const auto* frequency = program.find_parameter(block.path + ".frequency");
    int harmonics = 0;
    while (program.find_parameter(fmt::format("{}.cosine[{}]", block.path, harmonics)) != nullptr) ++harmonics;
    if (frequency == nullptr || harmonics == 0) continue;
    for (const int o : outputs_behind(program, program.block_index(block.path)))
      for (std::size_t k = 0; k < lines.size(); ++k)
        if (state.base_model->outputs()[k] == program.output_names[static_cast<std::size_t>(o)])
          lines[k] = WanderingLine{frequency->value, harmonics, true};
  }
}

/// Lines of the mains that stand, by the output that they are on.
std::vector<std::optional<WanderingLine>> lines_of(const SearchState& state, const CandidateModel& model) {
  std::vector<std::optional<WanderingLine>> lines(state.base_model->outputs().size());
  lines_of_user(state, lines);
  for (std::size_t i = 0; i < model.placed.size(); ++i)
    for (const auto& p : parameters_of(model, static_cast<int>(i))) {
      if (p.law->line_bands.empty() || p.estimate == nullptr) continue;
      // A cosine and a sine of each harmonic are found anew in each recording.
      const auto& free = model.placed[i].law.free;
      const auto amplitudes = std::count_if(free.begin(), free.end(), [](const auto& f) { return f.per_recording; });
      for (const int o : measured_moved(state, model, model.placed[i].place.moves_from()))
        lines[static_cast<std::size_t>(o)] = WanderingLine{p.estimate->used, static_cast<int>(amplitudes / 2), false};
    }
  return lines;
}

}  // namespace

SearchState::SearchState(const Diagram& diagram, const DataSet& given, const Registry& all_blocks,
                         const Effects& all_effects, const DiscoverOptions& wishes)
    : registry(all_blocks),
      effects(all_effects),
      options(wishes),
      data(std::make_shared<const DataSet>(given)),
      user(diagram) {
  context.registry = &registry;
  context.data = data;
  context.free_paths = options.free_paths;
  context.looser = options.looser;
  context.threads = options.threads;
}

void SearchState::progress(const std::string& what, double done) const {
  if (!options.progress) return;
  const std::lock_guard one_at_a_time(telling_);
  options.progress(what, std::min(done, 1.0));
}

bool SearchState::unless_stopped(const std::function<void()>& work, double until) const {
  const StopScope scope([&] { return stopped() || (until < whole_time && spent() >= until); });
  try {
    work();
    return true;
  } catch (const Stopped&) {
    return false;
  }
}

std::size_t SearchState::side_by_side(std::size_t n, const std::function<bool(std::size_t, const FitContext&)>& job,
                                      double until) const {
  std::vector<std::shared_ptr<DerivativeStore>> derivatives(n);
  std::atomic<std::size_t> first{n};
  context.threads.each(n, [&](std::size_t i) {
    if (i > first || stopped()) return;
    FitContext own = context;
    own.derivatives = derivatives[i] = std::make_shared<DerivativeStore>(context.derivatives);
    bool answer = false;
    const double now = spent(), turns = std::ceil(static_cast<double>(n - i) / context.threads.count());
    const double part = std::max(0.0, until - now) / turns;  // what others leave of theirs is for those behind
    unless_stopped([&] { answer = job(i, own); }, until < whole_time ? now + part : whole_time);
    if (!answer) return;
    for (std::size_t was = first; i < was && !first.compare_exchange_weak(was, i);) continue;
  });
  for (std::size_t i = 0; i < n && i <= first; ++i)
    if (derivatives[i]) context.derivatives->add(*derivatives[i]);
  return first;
}

bool SearchState::wanted(const Effect& effect) const {
  if (options.only.empty()) return effect.law_of.empty();
  return std::find(options.only.begin(), options.only.end(), effect.id) != options.only.end();
}

void SearchState::settle(const Prediction& best, const CandidateModel& with_lines) {
  evidence->known_lines(lines_of(*this, with_lines), [&] { return without_lines(context, with_lines); });
  evidence->settle(best);
}

void SearchState::settle(CandidateModel& best) {
  settle(best.prediction, best);
  best.error_of = evidence->error(best.prediction);
}

void unless_it_fails(SearchState& state, const std::function<void()>& work) {
  try {
    state.unless_stopped(work);
  } catch (const Error& e) {
    const std::string early =
        fmt::format("the search for what explains the recordings as well ended early: {}", e.what());
    auto& told = state.d.warnings;
    if (std::find(told.begin(), told.end(), early) == told.end()) told.push_back(early);
  }
}

}  // namespace hysteron
