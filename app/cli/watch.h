// Decides how a verb speaks with whoever waits for it: how far it is, what must be known at once, and whether it shall
// end. Does not decide how that is shown (progress_line.h).
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace hysteron {

struct Watch {
  /// `fraction` done (0..1; negative = unknown) and what is being done. Cheap to call often, by any thread.
  std::function<void(double fraction, const std::string& what)> show = [](double, const std::string&) {};
  /// What cannot wait for the answer: "--set ... has no effect".
  std::function<void(const std::string& what)> note = [](const std::string&) {};
  /// Shall the work end, with what was found until then? Asked often, by any thread.
  std::function<bool()> stop = [] { return false; };
  /// From here on there is something to keep: whoever wants the work to end waits until stop() was asked.
  std::function<void()> keep = [] {};
};

/// [s] from then till now.
inline double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace hysteron
