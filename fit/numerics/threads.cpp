#include "fit/numerics/threads.h"

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

#include "engine/diagram/stop.h"

namespace hysteron {

Threads::Threads(int count) {
  shared_->count = std::max(1, count);
  shared_->idle = shared_->count - 1;
}

bool Threads::take() const {
  for (int idle = shared_->idle; idle > 0;)
    if (shared_->idle.compare_exchange_weak(idle, idle - 1)) return true;
  return false;
}

void Threads::each(std::size_t n, const std::function<void(std::size_t)>& job) const {
  std::vector<std::exception_ptr> thrown(n);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < n; i = next++) try {
        job(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
  };
  std::vector<std::jthread> others;
  while (others.size() + 1 < n && take())
    others.emplace_back([&, asked = current_stop()] {
      const StopScope same(asked);
      work();
      give();
    });
  work();
  if (!others.empty()) {
    give();  // this one waits, too: who is still at work may have it
    others.clear();
    --shared_->idle;
  }
  for (const auto& e : thrown)
    if (e) std::rethrow_exception(e);
}

}  // namespace hysteron
