#include "engine/program/breakpoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A dead time below this share of the span does not shorten the steps further; its block extrapolates over the rest.
constexpr double shortest_capped_delay = 1e-5;

double reach_back(const Program& program, const Run& run, int block) {
  const auto* kernel = program.blocks[static_cast<std::size_t>(block)].kernel;
  return kernel->reach_back != nullptr ? kernel->reach_back(view_of(program, run, block)) : 0.0;
}

}  // namespace

Breakpoints::Breakpoints(const Program& program, const Run& run, double begin)
    : program_(program), run_(run), t_(begin) {
  for (int b = 0; b < static_cast<int>(program.blocks.size()); ++b) {
    const auto& block = program.blocks[static_cast<std::size_t>(b)];
    if (block.kernel->next_breakpoint != nullptr) sources_.push_back({b, breakpoint_behind(program, run, b, begin)});
    if (block.history_index >= 0) delays_.push_back(reach_back(program, run, b));
  }
  add_delayed(begin, 0);
}

double breakpoint_behind(const Program& program, const Run& run, int block, double t) {
  auto view = view_of(program, run, block);
  const auto* kernel = program.blocks[static_cast<std::size_t>(block)].kernel;
  // A source that rounds its corner to just above t would stop us there for ever: ask again from a little further on.
  for (double from = t, nudge = same_instant(t);; from = t + nudge, nudge *= 2) {
    view.t = view.branch = from;
    const double breakpoint = kernel->next_breakpoint(view);
    if (breakpoint > t + same_instant(t)) return breakpoint;
    if (nudge != 0 && nudge <= 1e-9 * std::max(1.0, std::abs(t))) continue;
    const auto& b = program.blocks[static_cast<std::size_t>(block)];
    fail("bad_value", b.path,
         fmt::format("{} \"{}\" names {} s as its next corner behind {} s", b.kernel->declaration.type, b.path,
                     breakpoint, t),
         "check its times: they do not go on");
  }
}

void Breakpoints::add_delayed(double t, int generation) {
  if (generation >= static_cast<int>(delays_.size())) return;
  for (const double delay : delays_)
    if (delay > 0) delayed_.emplace(t + delay, generation + 1);
}

double Breakpoints::next() const {
  double first = delayed_.empty() ? infinity : delayed_.top().first;
  for (const auto& source : sources_) first = std::min(first, source.next);
  return first;
}

double Breakpoints::branch() const {
  const double breakpoint = next();
  return breakpoint < infinity ? t_ + (breakpoint - t_) / 2 : t_ + 1;
}

void Breakpoints::pass(double t) {
  t_ = t;
  const double reached = t + same_instant(t);
  bool breakpoint = false;
  for (auto& source : sources_) {
    if (source.next > reached) continue;
    source.next = breakpoint_behind(program_, run_, source.block, t);
    breakpoint = true;
  }
  int generation = breakpoint ? 0 : std::numeric_limits<int>::max();
  while (!delayed_.empty() && delayed_.top().first <= reached) {
    generation = std::min(generation, delayed_.top().second);
    delayed_.pop();
  }
  add_delayed(t, generation);
}

namespace {

/// What happens in it hangs on more than where its inputs are at the ends of a step.
bool is_switched(const BlockInstance& b) {
  return b.sizes.memory > 0 || b.mode_index >= 0 || b.sizes.kinks > 0 || b.history_index >= 0;
}

// A smooth curve of one signal makes harmonics of it; those of a cubic are the usual ones.
constexpr double harmonics = 3;

double highest_input(const Program& program, const BlockInstance& block, const std::vector<double>& frequency) {
  double highest = 0;
  for (const int s : block.source)
    highest =
        std::max(highest, frequency[static_cast<std::size_t>(program.signals[static_cast<std::size_t>(s)].block)]);
  return highest;
}

/// Per block: the highest of the frequencies of the sources that drive it [Hz]. What is sampled is constant between its
/// instants, where steps end.
std::vector<double> driving_frequencies(const Program& program, const Run& run) {
  std::vector<double> frequency(program.blocks.size(), 0.0);
  std::vector<int> others;
  for (int b = 0; b < static_cast<int>(program.blocks.size()); ++b) {
    const auto& info = program.blocks[static_cast<std::size_t>(b)];
    if (info.n_u > 0 && !info.kernel->is_sampled()) others.push_back(b);
    // A series is monotone between its samples, and those are stops already.
    if (info.n_u > 0 || info.kernel->shortest_period == nullptr || info.series_index >= 0) continue;
    const double shortest_period = info.kernel->shortest_period(view_of(program, run, b));
    if (shortest_period > 0) frequency[static_cast<std::size_t>(b)] = 1 / shortest_period;
  }
  for (bool rises = true; rises;) {  // at most once along the longest way
    rises = false;
    for (const int b : others) {
      const double highest = highest_input(program, program.blocks[static_cast<std::size_t>(b)], frequency);
      rises = rises || highest > frequency[static_cast<std::size_t>(b)];
      frequency[static_cast<std::size_t>(b)] = std::max(frequency[static_cast<std::size_t>(b)], highest);
    }
  }
  return frequency;
}

/// Per block: the highest frequency in what it puts out [Hz]. On ways without states curves make harmonics, and the
/// frequencies of factors add up in their product. States that move by harmonics are followed by the control of their
/// error; those that rest are seen at what drives them.
std::vector<double> highest_frequencies(const Program& program, const Run& run) {
  auto frequency = driving_frequencies(program, run);
  for (const int block : program.value_order) {
    const auto b = static_cast<std::size_t>(block);
    const auto& info = program.blocks[b];
    if (info.n_u == 0 || info.sizes.states > 0 || info.kernel->is_sampled()) continue;
    const double highest = highest_input(program, info, frequency);
    double sum = 0;
    for (const int s : info.source)
      sum += frequency[static_cast<std::size_t>(program.signals[static_cast<std::size_t>(s)].block)];
    const bool curved = !info.kernel->declaration.is_linear && !is_switched(info);
    frequency[b] = !curved ? highest : info.n_u > 1 ? sum : harmonics * highest;
  }
  return frequency;
}

}  // namespace

double longest_step(const Program& program, const Run& run, double span) {
  double longest = infinity;
  if (std::none_of(program.blocks.begin(), program.blocks.end(), is_switched)) return longest;
  const auto frequency = highest_frequencies(program, run);
  for (int b = 0; b < static_cast<int>(program.blocks.size()); ++b) {
    const auto& block = program.blocks[static_cast<std::size_t>(b)];
    if (!is_switched(block)) continue;
    if (block.history_index >= 0)
      longest = std::min(longest, std::max(reach_back(program, run, b), shortest_capped_delay * span));
    for (const int s : block.source) {
      const double f = frequency[static_cast<std::size_t>(program.signals[static_cast<std::size_t>(s)].block)];
      if (f > 0) longest = std::min(longest, 1 / (4 * f));
    }
  }
  return longest;
}

}  // namespace hysteron
