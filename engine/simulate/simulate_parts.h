// Decides what all ways of simulating check, count and tell. Internal to them.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>

#include "engine/events/events.h"
#include "engine/simulate/simulate.h"

namespace hysteron {

/// Counts of events and loops for the statistics.
void tell_counts(const Program& program, const Events& events, const Work& work, Statistics& statistics);

/// Adds the time of its life to a phase [s].
class Stopwatch {
 public:
  explicit Stopwatch(double& phase) : phase_(phase), begin_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { phase_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& phase_;
  std::chrono::steady_clock::time_point begin_;
};

/// Tells SimulateOptions::progress how far a simulation is. Costs nothing that is felt where nobody asks.
class HowFar {
 public:
  HowFar(const SimulateOptions& options, double until)
      : told_(options.progress), begin_(options.begin), span_(until - options.begin) {}
  void operator()(double t) {
    if (told_ && span_ > 0 && steps_++ % every == 0) tell(t);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr unsigned every = 16;  // steps: looking at the clock each time would be felt
  static constexpr std::chrono::milliseconds shortest_period{50};
  void tell(double t) {
    const auto now = Clock::now();
    if (now - last_ < shortest_period) return;
    last_ = now;
    told_(std::clamp((t - begin_) / span_, 0.0, 1.0));
  }

  const std::function<void(double)>& told_;
  double begin_, span_;
  unsigned steps_ = 0;
  Clock::time_point last_{};
};

/// Throws Error "unbound_input" if an input of the diagram has no series.
void check_inputs(const Program& program, const Run& run);

}  // namespace hysteron
