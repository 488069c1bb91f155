// "MAT-File Format", MathWorks: level 4 is a sequence of heads of five numbers, each with a name and its numbers behind
// it; level 5 one of elements, a tag of kind and size each, of which those of kind 14 hold elements again.
#include "io/formats/mat_layout.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "io/formats/mat_value.h"

namespace hysteron {
namespace {

constexpr std::uint32_t matrix = 14;

/// Classes whose second element are their sizes, each number of which stands in the file: cells, structures, texts,
/// numbers.
bool has_plain_sizes(std::uint32_t kind) { return kind == 1 || kind == 2 || kind == 4 || (kind >= 6 && kind <= 15); }

class MatLayout {
 public:
  explicit MatLayout(const std::string& file) : in_(file, std::ios::binary), size_(std::filesystem::file_size(file)) {}

  bool fits_level_4() {
    static constexpr std::array<std::uint64_t, 6> bytes_of_kind{8, 4, 4, 2, 2, 1};
    turned_ = number(0) > 9999;
    for (std::uint64_t at = 0; at < size_;) {
      constexpr std::uint64_t head = 20;
      if (size_ - at < head) return false;
      const std::uint64_t kind = number(at) / 10 % 10, rows = number(at + 4), columns = number(at + 8),
                          complex = number(at + 12), name = number(at + 16), left = size_ - at - head;
      if (kind >= bytes_of_kind.size() || complex > 1 || name == 0 || name > left) return false;
      const std::uint64_t of_row = columns * bytes_of_kind[kind] * (complex + 1);
      if (of_row > 0 && rows > (left - name) / of_row) return false;
      at += head + name + rows * of_row;
    }
    return true;
  }

  bool fits_level_5() {
    constexpr std::uint64_t head = 128;
    if (size_ < head) return false;
    in_.seekg(126);
    turned_ = in_.get() == 'M';
    return elements(head, size_, 0);
  }

 private:
  std::uint32_t number(std::uint64_t at) {
    std::array<unsigned char, 4> bytes{};
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    if (turned_) std::reverse(bytes.begin(), bytes.end());
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8U |
           static_cast<std::uint32_t>(bytes[2]) << 16U | static_cast<std::uint32_t>(bytes[3]) << 24U;
  }

  /// Elements one behind the other; within a matrix each begins at a multiple of eight bytes.
  bool elements(std::uint64_t at, std::uint64_t end, int depth) {
    std::uint32_t kind_of_matrix = 0;
    const std::uint64_t begin = at;
    for (int k = 0; at < end; ++k) {
      if (end - at < 8) return depth > 0;  // padding
      const std::uint32_t first = number(at);
      const bool is_small = first >> 16U != 0;  // kind and size in one number, the data in the next
      const std::uint32_t kind = is_small ? first & 0xFFFFU : first;
      const std::uint64_t bytes = is_small ? first >> 16U : number(at + 4), data = at + (is_small ? 4 : 8);
      if (is_small ? bytes > 4 : bytes > end - data) return false;
      if (depth > 0 && k == 0) kind_of_matrix = bytes >= 4 ? number(data) & 0xFFU : 0;
      if (depth > 0 && k == 1 && has_plain_sizes(kind_of_matrix) && !sizes_fit(data, bytes, end - at)) return false;
      if (kind == matrix && depth <= deepest_of_mat && !elements(data, data + bytes, depth + 1)) return false;
      at = is_small ? at + 8 : data + bytes;
      if (depth > 0) at = std::min(end, begin + (at - begin + 7) / 8 * 8);
    }
    return true;
  }

  /// The product of the sizes of a matrix: each number takes a byte at least.
  bool sizes_fit(std::uint64_t data, std::uint64_t bytes, std::uint64_t left) {
    std::uint64_t count = 1;
    bool none = false;
    for (std::uint64_t at = data; at + 4 <= data + bytes; at += 4) {
      const std::uint64_t size = number(at);
      none = none || size == 0;
      if (size > 0 && count > left / size)
        count = left + 1;
      else
        count *= std::max<std::uint64_t>(size, 1);
    }
    return none || count <= left;
  }

  std::ifstream in_;
  std::uint64_t size_;
  bool turned_ = false;
};

}  // namespace

bool mat4_fits(const std::string& file) { return MatLayout(file).fits_level_4(); }
bool mat5_fits(const std::string& file) { return MatLayout(file).fits_level_5(); }

}  // namespace hysteron
