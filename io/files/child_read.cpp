#include "io/files/child_read.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

/// What the child sends first. Behind `values` come these, then `whole`: without it the child broke while it sent.
enum Sent : std::uint64_t { values, error, no_memory, exception, whole };

constexpr std::uintmax_t least_seconds = 10, bytes_per_second = 1'000'000;  // a hundredth of what libraries read

unsigned most_seconds(const ReadByLibrary& what) {
  if (what.most_seconds > 0) return what.most_seconds;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(what.file, unknown);
  return static_cast<unsigned>(least_seconds + (unknown ? 0 : size / bytes_per_second));
}

constexpr int signals_of_crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP};

// ---- the child ------------------------------------------------------------------------------------------------------

/// The host may have handlers for anything. A crash ends the child, without words and without a core; what is typed at
/// the keyboard is for its parent, with which it ends.
void settle_child(pid_t parent, unsigned most_seconds) {
  for (const int s : signals_of_crashes) ::signal(s, SIG_DFL);
  for (const int s : {SIGTERM, SIGPIPE, SIGXCPU}) ::signal(s, SIG_DFL);
  for (const int s : {SIGINT, SIGQUIT, SIGHUP}) ::signal(s, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlimit processor{most_seconds, most_seconds + 1};
  ::setrlimit(RLIMIT_CPU, &processor);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
}

void put_error(PipeWriter& to, const Error& e) {
  to.put(std::uint64_t{error});
  to.put(static_cast<std::uint64_t>(e.fault));
  to.put(std::uint64_t{e.problems.size()});
  for (const auto& p : e.problems) {
    for (const auto* text : {&p.code, &p.path, &p.what, &p.cure, &p.file}) to.put(std::string_view(*text));
    to.put(static_cast<std::uint64_t>(p.line));
  }
}

[[noreturn]] void be_child(int descriptor, const std::function<void()>& read,
                           const std::function<void(PipeWriter&)>& put) noexcept {
  try {
    PipeWriter to(descriptor);
    try {
      read();
      to.put(std::uint64_t{values});
      put(to);
      to.put(std::uint64_t{whole});
    } catch (const Error& e) {
      put_error(to, e);
    } catch (const std::bad_alloc&) {
      to.put(std::uint64_t{no_memory});
    } catch (const std::exception& e) {
      to.put(std::uint64_t{exception});
      to.put(std::string_view(e.what()));
    }
    to.flush();
  } catch (...) {  // nobody listens any more
    ::_exit(1);
  }
  ::_exit(0);
}

// ---- its parent -----------------------------------------------------------------------------------------------------

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

/// Ended and waited for at the end, whatever happened.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ > 0) ::kill(id_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// How it ended; nothing where the host has asked the system to forget its children.
  std::optional<int> wait() {
    int status = 0;
    const pid_t id = std::exchange(id_, 0);
    if (id <= 0) return std::nullopt;
    while (::waitpid(id, &status, 0) < 0)
      if (errno != EINTR) return std::nullopt;
    return status;
  }

 private:
  pid_t id_;
};

[[noreturn]] void throw_error(PipeReader& from) {
  const auto fault = static_cast<Fault>(from.number());
  std::vector<Problem> problems;
  for (std::uint64_t k = from.number(); k > 0; --k) {
    Problem p;
    for (auto* text : {&p.code, &p.path, &p.what, &p.cure, &p.file}) *text = from.text();
    p.line = static_cast<int>(from.number());
    problems.push_back(std::move(p));
  }
  throw Error(fault, std::move(problems));
}

void receive(PipeReader from, const std::function<void(PipeReader&)>& take) {
  switch (from.number()) {
    case values:
      take(from);
      if (from.number() == whole) return;
      throw PipeEnded{};
    case error:
      throw_error(from);
    case no_memory:
      throw std::bad_alloc();
    case exception:
      throw std::runtime_error(from.text());
    default:
      throw PipeEnded{};
  }
}

bool is_crash(int signal) {
  return std::find(std::begin(signals_of_crashes), std::end(signals_of_crashes), signal) !=
         std::end(signals_of_crashes);
}

[[noreturn]] void fail_of_child(const ReadByLibrary& what, std::optional<int> status) {
  const int by = status && WIFSIGNALED(*status) ? WTERMSIG(*status) : 0;
  if (by != 0 && by != SIGXCPU && !is_crash(by))
    throw Error(Fault::input,
                {{"reading_ended", what.file,
                  fmt::format("the process that read this {} was killed from outside (signal {}, {})", what.kind, by,
                              ::strsignal(by)),
                  "try again; if the machine is short of memory, export a shorter recording", what.file, 0}});
  const std::string how = by == 0         ? "ends its process"
                          : by == SIGXCPU ? fmt::format("has come to no end in {} s", most_seconds(what))
                                          : fmt::format("crashes on it (signal {}, {})", by, ::strsignal(by));
  throw Error(Fault::input, {{"damaged_file", what.file,
                              fmt::format("this {} cannot be read: it is damaged, {} {}", what.kind, what.read_by, how),
                              what.cure, what.file, 0}});
}

}  // namespace

void in_child(const ReadByLibrary& what, const std::function<void()>& read, const std::function<void(PipeWriter&)>& put,
              const std::function<void(PipeReader&)>& take) {
  const unsigned seconds = most_seconds(what);
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) return read();
  const Descriptor of_parent(ends[0]);
  Descriptor of_child(ends[1]);
  const pid_t parent = ::getpid(), id = ::fork();
  if (id < 0) return read();
  if (id == 0) {
    settle_child(parent, seconds);
    be_child(of_child.number(), read, put);
  }
  Child child(id);
  of_child.close();
  const Descriptor end_of_child(static_cast<int>(::syscall(SYS_pidfd_open, id, 0)));
  try {
    receive(PipeReader(of_parent.number(), end_of_child.number()), take);
  } catch (const PipeEnded&) {
    fail_of_child(what, child.wait());
  }
}

}  // namespace hysteron
