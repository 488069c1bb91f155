// Decides what Ctrl-C does: end at once while nothing would be lost, or be noticed at the next safe point.
// Does not decide what a verb keeps.
#pragma once

#include <stdexcept>
#include <string>

namespace hysteron {

/// Thrown at a safe point after Ctrl-C; what() says what was kept.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From now on Ctrl-C (SIGINT, SIGTERM) prints "interrupted; what was not finished is not written" and ends with 130; a
/// file that grows beyond the limit of the shell is an error of its write and no signal.
void watch_interrupts();

/// While one of these lives, the first Ctrl-C only sets interrupted(); a second one ends at once all the same,
/// unless `never_at_once` (while a folder is being put in place).
class DeferInterrupts {
 public:
  explicit DeferInterrupts(bool never_at_once = false);
  ~DeferInterrupts();
  DeferInterrupts(const DeferInterrupts&) = delete;
  DeferInterrupts& operator=(const DeferInterrupts&) = delete;

 private:
  int before_;
};

bool interrupted();
int interrupts();  ///< so many until now

/// Thrown, after Ctrl-C, by work that has found nothing yet.
[[noreturn]] void throw_nothing_found();

}  // namespace hysteron
