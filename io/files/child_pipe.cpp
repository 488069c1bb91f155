#include "io/files/child_pipe.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iterator>

#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

constexpr std::size_t bytes_at_once = 1 << 16;  // what a pipe of Linux holds
constexpr int look_up_every = 100;              // [ms]

}  // namespace

void PipeWriter::put(std::uint64_t number) { put_bytes(&number, sizeof number); }
void PipeWriter::put(std::string_view text) {
  put(std::uint64_t{text.size()});
  put_bytes(text.data(), text.size());
}
void PipeWriter::put(std::span<const double> numbers) {
  put(std::uint64_t{numbers.size()});
  put_bytes(numbers.data(), numbers.size_bytes());
}

void PipeWriter::put_bytes(const void* bytes, std::size_t count) {
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const std::size_t some = std::min(count, bytes_at_once - buffer_.size());
    buffer_.append(from, some);
    from += some;
    count -= some;
    if (buffer_.size() == bytes_at_once) flush();
  }
}

void PipeWriter::flush() {
  for (std::size_t done = 0; done < buffer_.size();) {
    const ssize_t written = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (written > 0)
      done += static_cast<std::size_t>(written);
    else if (errno != EINTR)
      throw PipeEnded{};
  }
  buffer_.clear();
}

void PipeReader::take_bytes(void* bytes, std::size_t count) {
  char* to = static_cast<char*>(bytes);
  while (count > 0) {
    look_up();
    pollfd waited[] = {{descriptor_, POLLIN, 0}, {child_, POLLIN, 0}};
    if (::poll(waited, std::size(waited), look_up_every) <= 0) continue;
    // All that a child sent before its end is in the pipe by now.
    if (waited[0].revents == 0 && ::poll(waited, 1, 0) <= 0) throw PipeEnded{};
    const ssize_t got = ::read(descriptor_, to, count);
    if (got == 0 || (got < 0 && errno != EINTR)) throw PipeEnded{};
    if (got < 0) continue;
    to += got;
    count -= static_cast<std::size_t>(got);
  }
}

template <class Container>
Container PipeReader::grown(std::uint64_t count) {
  Container all;
  constexpr std::size_t at_once = bytes_at_once / sizeof(typename Container::value_type);
  while (all.size() < count) {
    const std::size_t before = all.size(), some = std::min<std::uint64_t>(count - before, at_once);
    all.resize(before + some);
    take_bytes(all.data() + before, some * sizeof(typename Container::value_type));
  }
  return all;
}

std::uint64_t PipeReader::number() {
  std::uint64_t number = 0;
  take_bytes(&number, sizeof number);
  return number;
}
std::string PipeReader::text() { return grown<std::string>(number()); }
std::vector<double> PipeReader::numbers() { return grown<std::vector<double>>(number()); }

}  // namespace hysteron
