// Decides how values go from a child process to its parent, in the order in which they were put: numbers, texts, lists
// of them. Both are the same program, so nothing is turned round. Does not start the child. Internal to io.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

/// The pipe ended before what was asked for, or nobody reads it: the other process is gone.
struct PipeEnded {};

/// The end of the child.
class PipeWriter {
 public:
  explicit PipeWriter(int descriptor) : descriptor_(descriptor) {}

  // All throw PipeEnded.
  void put(std::uint64_t number);
  void put(std::string_view text);
  void put(std::span<const double> numbers);
  /// What was put may wait in memory until then.
  void flush();

 private:
  void put_bytes(const void* bytes, std::size_t count);

  int descriptor_;
  std::string buffer_;
};

/// The end of the parent. Takes memory as bytes arrive, never as a length says that they will: a child whose memory is
/// broken may send any.
class PipeReader {
 public:
  /// `child` is what pidfd_open() gives, or -1: a child that is gone ends the pipe, even where a third process has got
  /// its other end by a fork of its own.
  PipeReader(int descriptor, int child) : descriptor_(descriptor), child_(child) {}

  // All throw PipeEnded, and Stopped where the work of this thread is asked to stop (engine/diagram/stop.h).
  std::uint64_t number();
  std::string text();
  std::vector<double> numbers();

 private:
  void take_bytes(void* bytes, std::size_t count);
  template <class Container>
  Container grown(std::uint64_t count);

  int descriptor_, child_;
};

}  // namespace hysteron
