// Decides how work ends before its end: whoever begins it says by what, and its loops look up between their steps.
// Does not decide what is kept of it.
#pragma once

#include <functional>

namespace hysteron {

/// Thrown where work was asked to stop. No std::exception: whoever takes a failure for an answer ("this candidate
/// cannot be simulated") must not take this for one. Caught only where something that was found is kept.
struct Stopped {};

/// While one of these lives, look_up() in its thread asks `asked`; in place of what a scope around it asks. Threads
/// that take part of the work (Threads::each) open one with what current_stop() says. Scopes of a thread end in the
/// reverse order of their beginning.
class StopScope {
 public:
  using Asked = std::function<bool()>;  ///< true: stop. Asked often and by any thread: it must cost next to nothing.

  explicit StopScope(Asked asked);
  /// What `asked` says, which outlives the scope; nullptr: work in it goes to its end.
  explicit StopScope(const Asked* asked);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  Asked own_;
  const Asked* before_;
};

/// What look_up() asks in this thread; nullptr: nothing.
const StopScope::Asked* current_stop();

/// Is the work of this thread asked to stop?
bool stop_asked();

/// Throws Stopped if it is. Stands in every loop that can last longer than a tenth of a second, where what it leaves
/// behind can be thrown away.
void look_up();

/// look_up() in a loop whose steps are so short that asking each time would be felt.
class LookUp {
 public:
  void operator()() {
    if (++steps_ % every == 0) look_up();
  }

 private:
  static constexpr unsigned every = 64;
  unsigned steps_ = 0;
};

}  // namespace hysteron
