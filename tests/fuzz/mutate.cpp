#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace hysteron::fuzz {

/// What counts, lengths and offsets are when they are wrong: nothing, one too many, the largest of 8, 16, 32, 64 bits.
void Mutator::put_number(std::string& bytes) {
  static constexpr std::uint64_t extremes[] = {0,          1,          0x7f,       0x80,       0xff,       0x7fff,
                                               0x8000,     0xffff,     0x10000,    0x7fffffff, 0x80000000, 0xffffffff,
                                               1ULL << 32, 1ULL << 62, 1ULL << 63, ~0ULL,      1000,       1ULL << 24};
  static constexpr std::size_t sizes[] = {1, 2, 4, 8};
  std::uint64_t number = extremes[pick(std::size(extremes))];
  const std::size_t size = sizes[pick(std::size(sizes))];
  if (bytes.size() < size) return;
  char* const at = bytes.data() + pick(bytes.size() - size + 1);
  if (pick(2) == 0) {  // near to what stands there
    std::uint64_t there = 0;
    std::memcpy(&there, at, size);
    number = there + pick(9) - 4;
  }
  if (pick(4) == 0) {
    char turned[8];
    std::memcpy(turned, &number, size);
    std::reverse(turned, turned + size);
    std::memcpy(at, turned, size);
  } else {
    std::memcpy(at, &number, size);
  }
}

void Mutator::change(std::string& bytes, const std::string& other) {
  if (bytes.empty()) bytes = other;
  if (bytes.empty()) return;
  const std::size_t at = pick(bytes.size());
  switch (pick(8)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ 1 << pick(8));
      break;
    case 1:
      bytes[at] = static_cast<char>(pick(256));
      break;
    case 2:
    case 3:
      put_number(bytes);
      break;
    case 4:
      bytes.erase(at, 1 + pick(pick(8) == 0 ? bytes.size() : 16));
      break;
    case 5:
      bytes.insert(at, bytes.substr(pick(bytes.size()), 1 + pick(64)));
      break;
    case 6:
      if (!other.empty()) bytes.replace(at, 1 + pick(32), other.substr(pick(other.size()), 1 + pick(256)));
      break;
    default:
      if (!words_.empty()) bytes.replace(at, pick(8), words_[pick(words_.size())]);
  }
}

std::string Mutator::mutated(std::string bytes, const std::string& other, std::size_t longest) {
  for (std::size_t k = std::size_t{1} << pick(4); k > 0; --k) change(bytes, other);
  if (bytes.size() > longest) bytes.resize(longest);
  return bytes;
}

}  // namespace hysteron::fuzz
