// Reading in a child process: what comes back, and what is said where the child ends before its end.
#include "io/files/child_read.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <stdexcept>
#include <thread>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

struct Content {
  std::uint64_t number = 0;
  std::string text;
  std::vector<double> values;
};
void put(PipeWriter& to, const Content& c) {
  to.put(c.number);
  to.put(std::string_view(c.text));
  to.put(std::span<const double>(c.values));
}
void take(PipeReader& from, Content& c) {
  c.number = from.number();
  c.text = from.text();
  c.values = from.numbers();
}

const ReadByLibrary what{"lab.h5", "HDF5 file", "the HDF5 library", "export it again"};

Content read(const std::function<Content()>& reading) { return read_in_child<Content>(what, reading); }

Problem refused(const std::function<Content()>& reading) {
  try {
    read(reading);
  } catch (const Error& error) {
    return error.problems.front();
  }
  ADD_FAILURE() << "was read";
  return {};
}

Content killed_by(int signal) {
  ::raise(signal);
  return {};
}

TEST(ChildRead, BringsEveryBitOfWhatWasRead) {
  Content sent{1ULL << 63U, std::string("a\0b", 3),
               std::vector<double>(300'000)};  // 2.4 MB: 37 times what a pipe holds
  for (std::size_t k = 0; k < sent.values.size(); ++k) sent.values[k] = std::sqrt(static_cast<double>(k));
  sent.values[0] = -0.0;
  const Content got = read([&] { return sent; });
  EXPECT_EQ(got.number, sent.number);
  EXPECT_EQ(got.text, sent.text);
  EXPECT_EQ(got.values, sent.values);
  EXPECT_TRUE(std::signbit(got.values[0]));
  EXPECT_TRUE(read([] { return Content{}; }).values.empty());
}

TEST(ChildRead, ACrashIsAnErrorThatNamesTheFile) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    const Problem p = refused([&] { return killed_by(signal); });
    EXPECT_EQ(p.code, "damaged_file");
    EXPECT_EQ(p.file, "lab.h5");
    EXPECT_EQ(p.cure, "export it again");
    EXPECT_NE(p.what.find("damaged, the HDF5 library crashes"), std::string::npos) << p.what;
    EXPECT_NE(p.what.find(::strsignal(signal)), std::string::npos) << p.what;
  }
}

TEST(ChildRead, ACrashIsAnErrorWhateverTheHostDoesWithSignals) {
  struct sigaction before {
  }, own{};
  own.sa_handler = [](int) { ::_exit(0); };
  ::sigaction(SIGSEGV, &own, &before);
  sigset_t segv, mask;
  sigemptyset(&segv);
  sigaddset(&segv, SIGSEGV);
  ::pthread_sigmask(SIG_BLOCK, &segv, &mask);
  const Problem p = refused([] { return killed_by(SIGSEGV); });
  ::pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  ::sigaction(SIGSEGV, &before, nullptr);
  EXPECT_NE(p.what.find("crashes on it"), std::string::npos) << p.what;
}

TEST(ChildRead, AHostThatForgetsItsChildrenReadsAllTheSame) {
  struct sigaction before {
  }, forget{};
  forget.sa_handler = SIG_IGN;
  ::sigaction(SIGCHLD, &forget, &before);
  const Content got = read([] { return Content{7, "whole", {1, 2}}; });
  const Problem p = refused([] { return killed_by(SIGSEGV); });
  ::sigaction(SIGCHLD, &before, nullptr);
  EXPECT_EQ(got.number, 7U);
  EXPECT_EQ(got.values, (std::vector<double>{1, 2}));
  EXPECT_EQ(p.code, "damaged_file");
}

TEST(ChildRead, AChildThatComesToNoEndIsEnded) {
  ReadByLibrary limited = what;
  limited.most_seconds = 1;  // of the processor
  try {
    read_in_child<Content>(limited, [] {
      for (std::atomic<std::uint64_t> k = 0;; ++k) {
      }
      return Content{};
    });
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "damaged_file");
    EXPECT_NE(error.problems.front().what.find("has come to no end in 1 s"), std::string::npos) << error.what();
  }
}

TEST(ChildRead, AChildThatIsKilledFromOutsideSaysNothingOfTheFile) {
  const Problem p = refused([] { return killed_by(SIGKILL); });
  EXPECT_EQ(p.code, "reading_ended");
  EXPECT_NE(p.what.find("signal 9"), std::string::npos) << p.what;
  EXPECT_EQ(p.what.find("damaged"), std::string::npos) << p.what;
}

TEST(ChildRead, AChildThatEndsInTheMiddleOfItsValuesBroke) {
  // The length is sent, the numbers are not: flushed at 64 KiB, of which there is not one.
  int taken = 0;
  const auto attempt = [&] {
    in_child(
        what, [] {},
        [](PipeWriter& to) {
          to.put(std::uint64_t{1} << 60U);
          to.flush();
          ::_exit(0);
        },
        [&](PipeReader& from) {
          ++taken;
          from.numbers();  // 2^60 of them would be more memory than there is
        });
  };
  EXPECT_THROW(attempt(), Error);
  EXPECT_EQ(taken, 1);
}

TEST(ChildRead, WhatIsThrownInTheChildIsThrownHere) {
  const Problem thrown{"some_code", "/place", "what", "cure", "file.h5", 12};
  const Problem p = refused([&]() -> Content { throw Error(Fault::input, {thrown}); });
  EXPECT_EQ(p.code, thrown.code);
  EXPECT_EQ(p.path, thrown.path);
  EXPECT_EQ(p.what, thrown.what);
  EXPECT_EQ(p.cure, thrown.cure);
  EXPECT_EQ(p.file, thrown.file);
  EXPECT_EQ(p.line, thrown.line);
  EXPECT_THROW(read([]() -> Content { throw std::bad_alloc(); }), std::bad_alloc);
  try {
    read([]() -> Content { throw std::logic_error("some words"); });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "some words");
  }
}

TEST(ChildRead, WorkThatIsAskedToStopDoesNotWaitForTheChild) {
  const StopScope until_stopped([] { return true; });
  EXPECT_THROW(read([]() -> Content {
                 for (;;) ::pause();
               }),
               Stopped);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // none is left, nor is its end unasked for
  EXPECT_EQ(errno, ECHILD);
}

// Memory is asked for and given back by others at the moment of each fork.
TEST(ChildRead, OtherThreadsMayDoWhatTheyDo) {
  std::atomic<bool> done = false;
  std::vector<std::thread> others;
  for (int k = 0; k < 3; ++k)
    others.emplace_back([&] {
      while (!done) {
        std::vector<std::string> list;
        for (int i = 0; i < 100; ++i) list.emplace_back(static_cast<std::size_t>(i) + 20, 'x');
      }
    });
  int good = 0;
  for (std::uint64_t k = 0; k < 50; ++k)
    good += read([&] {
              Content c{k, {}, {}};
              for (int i = 0; i < 100; ++i) c.values.push_back(i);
              return c;
            }).number == k;
  done = true;
  for (auto& other : others) other.join();
  EXPECT_EQ(good, 50);
}

// A user of whom the system takes no further process.
TEST(ChildRead, WithoutFurtherProcessesThisOneReads) {
  const pid_t tester = ::fork();
  if (tester == 0) {
    const rlimit none{0, 0};
    if (::setuid(65534) != 0 || ::setrlimit(RLIMIT_NPROC, &none) != 0) ::_exit(2);
    const pid_t self = ::getpid();
    std::uint64_t reader = 0;
    const Content got = read([&] {
      reader = static_cast<std::uint64_t>(::getpid());
      return Content{reader, {}, {}};
    });
    ::_exit(got.number == static_cast<std::uint64_t>(self) ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(tester, &status, 0), tester);
  if (WEXITSTATUS(status) == 2) GTEST_SKIP() << "no other user to be";
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace hysteron
