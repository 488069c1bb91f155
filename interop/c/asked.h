// Decides when the function that a caller gave (hy_watch) is told how far work is, and asked whether it shall end: now
// and then, by one thread at a time.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

#include "app/cli/watch.h"
#include "interop/c/hysteron.h"

namespace hysteron::interop {

/// Outlives the Watch that it gives. NULL is allowed for `told`: nobody is told, and nothing ends.
class Asked {
 public:
  Asked(hy_watch told, void* context) : told_(told), context_(context), last_(Clock::now()) {}

  Watch watch();
  /// Tells what was told last, if it is time. Any thread.
  bool stop();
  bool somebody() const { return told_ != nullptr; }
  /// What is told from here on; an answer of before is forgotten.
  void begin(double fraction, const char* what);

 private:
  using Clock = std::chrono::steady_clock;
  bool due() const { return Clock::now() - last_.load() >= shortest_period; }
  void ask();

  static constexpr std::chrono::milliseconds shortest_period{50};
  hy_watch told_;
  void* context_;
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
  std::atomic<Clock::time_point> last_;
  double fraction_ = -1;
  std::string what_;
};

}  // namespace hysteron::interop
