// Decides how it is shown how far work is: one line on a terminal, or a line of JSON for each event on stderr.
// Does not know what the work is.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace hysteron {

/// The JSON Schema of one line of ProgressLine::Form::json.
std::string progress_schema();

/// Any thread may call. Goes from the terminal with this value.
class ProgressLine {
 public:
  enum class Form { silent, terminal, json };

  explicit ProgressLine(Form form) : form_(form) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `fraction` done (0..1; negative = unknown). Cheap to call often: most calls show nothing.
  void show(double fraction, const std::string& what);
  /// One line on stderr, whatever the form, that no later one takes away.
  void say(const std::string& line);
  /// Nothing stands on the terminal any more.
  void clear();
  /// For programs, the last event: all is done, or what was found until it was interrupted.
  void end(bool is_whole);

 private:
  using Clock = std::chrono::steady_clock;
  void wipe();

  const Form form_;
  std::mutex mutex_;
  bool drawn_ = false;
  double fraction_ = -1;  ///< as it was shown last
  Clock::time_point start_ = Clock::now(), last_{};
};

}  // namespace hysteron
