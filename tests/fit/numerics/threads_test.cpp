// Independent work over threads: each piece once, exceptions handed on, work inside work by those that are idle.
#include "fit/numerics/threads.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

/// True if somebody else arrives, too, before a minute is over: two threads are at work.
bool meets(std::atomic<int>& arrived) {
  ++arrived;
  for (int i = 0; i < 60'000 && arrived < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return arrived >= 2;
}

TEST(Threads, EachPieceIsDoneOnce) {
  for (const int count : {-1, 1, 2, 7, 200}) {
    std::vector<std::atomic<int>> done(100);
    Threads(count).each(done.size(), [&](std::size_t i) { ++done[i]; });
    for (std::size_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i], 1) << i << " of " << count << " threads";
  }
  Threads(2).each(0, [](std::size_t) { FAIL(); });
}

TEST(Threads, AreStoppedByWhatStopsTheCaller) {
  std::atomic<int> stopped{0}, arrived{0};
  const StopScope scope([] { return true; });
  EXPECT_THROW(Threads(2).each(2,
                               [&](std::size_t) {
                                 meets(arrived);
                                 try {
                                   look_up();
                                 } catch (const Stopped&) {
                                   ++stopped;
                                   throw;
                                 }
                               }),
               Stopped);
  EXPECT_EQ(stopped, 2);
}

TEST(Threads, OneIsTheCaller) {
  Threads().each(3,
                 [caller = std::this_thread::get_id()](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); });
}

TEST(Threads, TwoWorkAtOnce) {
  std::atomic<int> arrived{0};
  Threads(2).each(2, [&](std::size_t) { EXPECT_TRUE(meets(arrived)); });
}

/// Did two threads share two pieces of work.
bool shared(const Threads& threads) {
  std::array<std::thread::id, 2> by;
  threads.each(2, [&](std::size_t k) {
    by[k] = std::this_thread::get_id();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  return by[0] != by[1];
}

TEST(Threads, WorkInsideWorkTakesThoseThatAreIdle) {
  const Threads two(2);
  for (const std::size_t long_one : {0, 1}) {  // in the caller's thread, or in the other
    std::atomic<bool> short_one_done{false};
    two.each(2, [&](std::size_t i) {
      if (i != long_one) {
        short_one_done = true;
        return;
      }
      while (!short_one_done) std::this_thread::yield();
      // The other one is idle a moment later.
      bool helped = false;
      for (int k = 0; k < 10'000 && !helped; ++k) helped = shared(two);
      EXPECT_TRUE(helped);
    });
  }
}

TEST(Threads, NoMoreAreTakenThanThereAre) {
  const Threads two(2);
  std::atomic<int> at_work{0}, most{0};
  two.each(4, [&](std::size_t) {
    two.each(4, [&](std::size_t) {
      const int now = ++at_work;
      for (int was = most; was < now && !most.compare_exchange_weak(was, now);) continue;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      --at_work;
    });
  });
  EXPECT_EQ(most, 2);
}

TEST(Threads, TheFirstExceptionIsHandedOnAndAllElseIsDone) {
  for (const int count : {1, 3}) {
    std::atomic<int> done{0};
    try {
      Threads(count).each(20, [&](std::size_t i) {
        if (i % 7 == 3) throw std::runtime_error(std::to_string(i));
        ++done;
      });
      FAIL() << "the exception of the third is lost";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "3");
    }
    EXPECT_EQ(done, 17);
  }
}

}  // namespace
}  // namespace hysteron
