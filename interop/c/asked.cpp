#include "interop/c/asked.h"

namespace hysteron::interop {

Watch Asked::watch() {
  Watch watch;
  if (told_ == nullptr) return watch;
  watch.show = [this](double fraction, const std::string& what) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    fraction_ = fraction;
    what_ = what;
    ask();
  };
  watch.stop = [this] { return stop(); };
  return watch;
}

bool Asked::stop() {
  if (!stopped_ && due()) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) ask();
  }
  return stopped_.load();
}

void Asked::begin(double fraction, const char* what) {
  fraction_ = fraction;
  what_ = what;
  stopped_ = false;
}

void Asked::ask() {
  if (stopped_ || !due()) return;
  stopped_ = told_(context_, fraction_, what_.c_str()) != 0;
  last_ = Clock::now();
}

}  // namespace hysteron::interop
