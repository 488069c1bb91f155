// Decides how a file is read by a library that may crash on it, or never come to an end: in a child process, so that a
// damaged file costs the child and not the program, nor the program that calls ours as a library. Does not know
// formats. Internal to io.
//
// The child is a plain fork: a library has no program of its own that could be started in its place, and what calls it
// may be Python. Of a process with threads a fork has the calling one alone, so the child must not wait for a lock that
// another thread held at that moment:
//   - memory: glibc, jemalloc and the sanitizers put their locks in order around a fork;
//   - the loader: glibc does so, too, and the library is loaded before, so that the child has no need of it;
//   - the library: its mutex is held by the thread that forks, so no other is inside it;
//   - streams, locales, the interpreter of the host: the child touches none, and ends by _exit().
// The memory of the child is a copy: what the library breaks there is gone with it. What was read comes through a pipe.
#pragma once

#include <functional>
#include <string>

#include "io/files/child_pipe.h"

namespace hysteron {

struct ReadByLibrary {
  std::string file;
  std::string kind;           ///< of the file: "HDF5 file"
  std::string read_by;        ///< "the HDF5 library"
  std::string cure;           ///< where the file is damaged
  unsigned most_seconds = 0;  ///< of the processor; 0: what the size of the file allows, at 1 MB/s
};

/// `read` runs in a child, whose copy of the memory then holds what it read; `put` sends that, `take` receives it here.
/// Throws what `read` throws: Error as it is, another std::exception by its words. Throws Error "damaged_file" where
/// the library crashes or takes longer than `most_seconds`, "reading_ended" where the child was killed from outside;
/// Stopped. Where the system has no further process, `read` runs in this one.
void in_child(const ReadByLibrary& what, const std::function<void()>& read, const std::function<void(PipeWriter&)>& put,
              const std::function<void(PipeReader&)>& take);

/// As in_child(), with put(PipeWriter&, const T&) and take(PipeReader&, T&) of the type.
template <class T>
T read_in_child(const ReadByLibrary& what, const std::function<T()>& read) {
  T result;
  in_child(
      what, [&] { result = read(); }, [&](PipeWriter& to) { put(to, result); },
      [&](PipeReader& from) { take(from, result); });
  return result;
}

}  // namespace hysteron
