// Decides what Ctrl-C does: end at once while nothing would be lost, or be noticed at the next safe point.
// Only async-signal-safe calls stand in the handler.
#include "app/cli/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace hysteron {
namespace {

enum Mode : int { at_once, first_deferred, all_deferred };

std::atomic<int> mode{at_once};
std::atomic<int> count{0};
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int) {
  const int seen = ++count;
  const int now = mode.load();
  if (now == all_deferred || (now == first_deferred && seen == 1)) return;
  constexpr char text[] = "\ninterrupted; what was not finished is not written (files are written whole)\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(130);
}

void ignore(int) {}

}  // namespace

void watch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A file beyond the limit of the shell (ulimit -f): the write that fails tells more than death by a signal. A
  // handler, not SIG_IGN, which programs that are started from here would inherit.
  action.sa_handler = ignore;
  sigaction(SIGXFSZ, &action, nullptr);
}

DeferInterrupts::DeferInterrupts(bool never_at_once)
    : before_(mode.exchange(never_at_once ? all_deferred : first_deferred)) {}
DeferInterrupts::~DeferInterrupts() { mode = before_; }

bool interrupted() { return count.load() > 0; }
int interrupts() { return count.load(); }

void throw_nothing_found() {
  throw Interrupted("interrupted before anything was found; nothing is written, and what stood in the folder stays");
}

}  // namespace hysteron
