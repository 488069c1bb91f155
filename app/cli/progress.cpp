// Decides how long work shows where it stands: one line on stderr, only where that is a terminal.
// Does not know what the work is.
#include "app/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace hysteron {
namespace {

std::string duration_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60);
}

}  // namespace

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Progress::Progress(bool quiet) : visible_(!quiet && isatty(STDERR_FILENO) == 1), start_(Clock::now()) {}
Progress::~Progress() { clear(); }

void Progress::show(double fraction, const std::string& what) {
  if (!visible_) return;
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;  // a terminal is slow, and nobody reads faster
  last_ = now;
  std::string line;
  const double spent = std::chrono::duration<double>(now - start_).count();
  if (fraction >= 0) line = fmt::format("{:3.0f} %  ", 100 * fraction);
  if (fraction > 0.02 && spent > 1) line += duration_text(spent / fraction * (1 - fraction)) + " left  ";
  line += what;
  if (line.size() > 96) line = line.substr(0, 93) + "...";
  std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace hysteron
