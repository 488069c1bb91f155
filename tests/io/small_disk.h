// Decides how tests meet a full disk without filling one: no file may grow beyond some bytes.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace hysteron {

struct SmallDisk {
  explicit SmallDisk(rlim_t bytes) : former_handler(::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &former);
    rlimit small = former;
    small.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &former);
    ::signal(SIGXFSZ, former_handler);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  rlimit former{};
  void (*former_handler)(int);
};

}  // namespace hysteron
