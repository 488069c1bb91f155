// Decides how independent pieces of work are spread over threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

namespace hysteron {

/// So many threads, the caller's among them, shared by all copies: work inside work takes those that are idle just
/// then, so one long piece at the end of many is cut into its own pieces.
class Threads {
 public:
  Threads(int count = 1);

  int count() const { return shared_->count; }
  /// Calls job(i) once for each i in [0, n), begun in this order. What a job leaves must be its own: then nothing
  /// depends on the number of threads. A job that throws stops no other one; afterwards the exception of the first of
  /// them, by i, is thrown. What the caller's work is stopped by (engine/diagram/stop.h) stops all of them.
  void each(std::size_t n, const std::function<void(std::size_t)>& job) const;

 private:
  struct Shared {
    int count = 1;
    std::atomic<int> idle{0};
  };
  bool take() const;
  void give() const { ++shared_->idle; }

  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
};

}  // namespace hysteron
