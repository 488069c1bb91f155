#include "app/cli/progress_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/cli/answer_json.h"
#include "app/cli/shape.h"

namespace hysteron {
namespace {

constexpr std::chrono::milliseconds terminal_pace{100};  // a terminal is slow, and nobody reads faster
constexpr std::chrono::milliseconds json_pace{50};

std::string duration_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60);
}

/// Absent while it cannot be told.
std::optional<double> seconds_left(double fraction, double spent) {
  if (!(fraction > 0.02 && spent > 1)) return std::nullopt;
  return spent / fraction * (1 - fraction);
}

std::string terminal_text(double fraction, const std::string& what, const std::optional<double>& left) {
  std::string line;
  if (fraction >= 0) line = fmt::format("{:3.0f} %  ", 100 * fraction);
  if (left) line += duration_text(*left) + " left  ";
  line += what;
  return line.size() > 96 ? line.substr(0, 93) + "..." : line;
}

void print_event(double fraction, const std::string& what, const std::optional<double>& left) {
  nlohmann::ordered_json event{{"fraction", nullptr}, {"what", what}, {"seconds_left", nullptr}};
  if (fraction >= 0) event["fraction"] = std::min(fraction, 1.0);
  if (left) event["seconds_left"] = *left;
  const std::string line = event.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

std::string progress_schema() {
  using namespace shape;
  return schema_text("progress of hysteron",
                     object("One line of what is printed on the error stream with --progress json.",
                            {{"fraction", number("done, 0 .. 1; null where nobody knows; 1 in the last line")},
                             {"what", text("is being done")},
                             {"seconds_left", number("[s], or null while it cannot be told")}}));
}

void ProgressLine::show(double fraction, const std::string& what) {
  if (form_ == Form::silent) return;
  if (form_ == Form::json && fraction >= 1) return;  // said once, by end()
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (now - last_ < (form_ == Form::json ? json_pace : terminal_pace)) return;
  last_ = now;
  if (fraction >= 0 && fraction < fraction_) start_ = now;  // another piece of work
  if (fraction >= 0) fraction_ = fraction;
  const auto left = seconds_left(fraction, std::chrono::duration<double>(now - start_).count());
  if (form_ == Form::json) return print_event(fraction, what, left);
  std::fprintf(stderr, "\r\x1b[K%s", terminal_text(fraction, what, left).c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressLine::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  wipe();
  std::fprintf(stderr, "%s\n", line.c_str());
}

void ProgressLine::clear() {
  const std::lock_guard lock(mutex_);
  wipe();
}

void ProgressLine::wipe() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

void ProgressLine::end(bool is_whole) {
  clear();
  if (form_ == Form::json) print_event(is_whole ? 1 : fraction_, is_whole ? "done" : "interrupted", 0.0);
}

}  // namespace hysteron
