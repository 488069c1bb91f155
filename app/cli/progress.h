// Decides how long work shows where it stands: one line on stderr, only where that is a terminal.
// Does not know what the work is.
#pragma once

#include <chrono>
#include <string>

namespace hysteron {

/// [s] from then till now.
double seconds_since(std::chrono::steady_clock::time_point begin);

class Progress {
 public:
  /// Silent when `quiet` or when stderr is no terminal.
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` done (0..1; negative = unknown) and what is being done. Cheap to call often.
  void show(double fraction, const std::string& what);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool visible_;
  bool drawn_ = false;
  Clock::time_point start_, last_{};
};

}  // namespace hysteron
