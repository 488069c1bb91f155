#include "engine/events/reversals.h"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {
constexpr double shift = 1e-6;  // of the nominal rate
}

Reversals::Reversals(const Program& program, const NominalSizes& sizes, double tolerance) {
  for (std::size_t i = 0; i < program.memory_blocks.size(); ++i) {
    const auto& block = program.blocks[static_cast<std::size_t>(program.memory_blocks[i])];
    if (block.source.empty()) continue;
    const int signal = block.source.front();  // memory blocks follow their first input
    if (!program.has_rate[static_cast<std::size_t>(signal)]) continue;
    const auto found =
        std::find_if(watched_.begin(), watched_.end(), [&](const Watched& w) { return w.signal == signal; });
    if (found != watched_.end()) {
      found->directions.push_back(i);
      continue;
    }
    const double size = sizes.signals[static_cast<std::size_t>(signal)];
    const double rate = (size > 0 ? size : 1.0) / (sizes.time_scale > 0 ? sizes.time_scale : 1.0);
    watched_.push_back({signal, {i}, std::max(shift, tolerance) * rate});
  }
}

void Reversals::indicate(const Run& run, const Work& work, double* g) const {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const auto& w = watched_[i];
    g[i] = run.direction[w.directions.front()] * work.rate[static_cast<std::size_t>(w.signal)] + w.threshold;
  }
}

bool Reversals::open(const Run& run) const {
  return std::any_of(watched_.begin(), watched_.end(),
                     [&](const Watched& w) { return run.direction[w.directions.front()] == 0; });
}

int Reversals::follow(Run& run, const Work& work) const {
  int turned = 0;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const auto& w = watched_[i];
    const double rate = work.rate[static_cast<std::size_t>(w.signal)];
    const auto direction = run.direction[w.directions.front()];
    if (direction == 0 && std::abs(rate) > w.threshold) {
      for (const auto d : w.directions) run.direction[d] = rate > 0 ? 1 : -1;
    } else if (direction * rate + w.threshold < 0) {
      turn(run, static_cast<int>(i));
      ++turned;
    }
  }
  return turned;
}

void Reversals::turn(Run& run, int i) const {
  for (const auto d : watched_[static_cast<std::size_t>(i)].directions)
    run.direction[d] = static_cast<signed char>(-run.direction[d]);
}

}  // namespace hysteron
