#include "io/files/sealed_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "io/files/digest.h"

namespace hysteron {
namespace {

constexpr char opening[] = "\nhysteron digest ";
constexpr std::size_t opening_size = sizeof opening - 1, line_size = opening_size + 16 + 1;
constexpr std::size_t read_at_once = 1 << 20;

/// The digest of all that stands before `behind`, which are the last bytes of the file, at most `behind_size`.
std::string read_through(const std::string& file, std::size_t behind_size, std::string& behind) {
  check_readable(file);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  Digest digest;
  std::vector<char> buffer(read_at_once);
  behind.clear();
  while (stream && !std::feof(stream.get()) && !std::ferror(stream.get())) {
    look_up();
    behind.append(buffer.data(), std::fread(buffer.data(), 1, buffer.size(), stream.get()));
    if (behind.size() <= behind_size) continue;
    digest.add(behind.data(), behind.size() - behind_size);
    behind.erase(0, behind.size() - behind_size);
  }
  if (!stream || std::ferror(stream.get()))
    fail("cannot_read", file, fmt::format("cannot read {}: {}", file, std::strerror(errno)), "copy it to a sound disk");
  return digest.text();
}

}  // namespace

std::string seal_line(const std::string& file) {
  std::string nothing;
  return opening + read_through(file, 0, nothing) + "\n";
}

Seal seal_of(const std::string& file) {
  std::string line;
  const std::string digest = read_through(file, line_size, line);
  if (!line.starts_with(opening)) return Seal::none;
  return line == opening + digest + "\n" ? Seal::whole : Seal::broken;
}

}  // namespace hysteron
