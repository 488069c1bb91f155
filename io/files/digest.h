// Decides how content that is too long to be kept twice is told apart: 64 bits of FNV-1a (Fowler, Noll, Vo).
// Every change of one byte gives another digest. No protection against intent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

class Digest {
 public:
  void add(const void* bytes, std::size_t size) {
    const auto* b = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ b[i]) * 0x100000001b3ULL;
  }
  void add(std::uint64_t number) { add(&number, sizeof number); }
  template <class T>
  void add(const std::vector<T>& list) {
    add(static_cast<std::uint64_t>(list.size()));
    if (!list.empty()) add(list.data(), list.size() * sizeof(T));
  }
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    add(text.data(), text.size());
  }
  std::uint64_t value() const { return value_; }
  /// 16 hexadecimal digits.
  std::string text() const {
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[value_ >> shift & 15];
    return digits;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace hysteron
