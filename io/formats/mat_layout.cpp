// "MAT-File Format", MathWorks: level 4 is a sequence of heads of five numbers, each with a name and its numbers behind
// it; level 5 one of elements, a tag of kind and size each, of which those of kind 14 hold elements again, and those of
// kind 15 one element in a stream of zlib.
#include "io/formats/mat_layout.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <vector>

namespace hysteron {
namespace {

constexpr std::uint32_t matrix = 14, compressed = 15;
constexpr int deepest_element = 200;  // of matrices within matrices: the library goes down by calling itself

/// Classes whose second element are their sizes, each number of which stands in the file: cells, structures, texts,
/// numbers.
bool has_plain_sizes(std::uint32_t kind) { return kind == 1 || kind == 2 || kind == 4 || (kind >= 6 && kind <= 15); }

/// A part of a stream as zlib unpacks it, a piece at a time: places may be sought forwards.
class UnpackingBuffer : public std::streambuf {
 public:
  UnpackingBuffer(std::istream& packed, std::uint64_t at, std::uint64_t bytes)
      : packed_(packed), left_(bytes), in_(piece), out_(piece) {
    packed_.seekg(static_cast<std::streamoff>(at));
    works_ = inflateInit(&zlib_) == Z_OK;
  }
  ~UnpackingBuffer() override { inflateEnd(&zlib_); }
  UnpackingBuffer(const UnpackingBuffer&) = delete;
  UnpackingBuffer& operator=(const UnpackingBuffer&) = delete;

 protected:
  int_type underflow() override {
    zlib_.next_out = out_.data();
    zlib_.avail_out = static_cast<uInt>(out_.size());
    while (works_ && zlib_.avail_out == out_.size()) {
      if (zlib_.avail_in == 0) take_packed();
      works_ = inflate(&zlib_, Z_NO_FLUSH) == Z_OK;  // no longer at the end, too
    }
    char* const begin = reinterpret_cast<char*>(out_.data());
    setg(begin, begin, begin + (out_.size() - zlib_.avail_out));
    return gptr() == egptr() ? traits_type::eof() : traits_type::to_int_type(*gptr());
  }

  pos_type seekpos(pos_type to, std::ios_base::openmode) override {
    while (std::streamoff(to) > std::streamoff(zlib_.total_out))
      if (traits_type::eq_int_type(underflow(), traits_type::eof())) return std::streamoff(-1);
    const std::streamoff back = std::streamoff(zlib_.total_out) - std::streamoff(to);
    if (back > egptr() - eback()) return std::streamoff(-1);
    setg(eback(), egptr() - back, egptr());
    return to;
  }

 private:
  static constexpr std::size_t piece = 1U << 16U;  // [byte]

  void take_packed() {
    packed_.read(reinterpret_cast<char*>(in_.data()),
                 static_cast<std::streamsize>(std::min<std::uint64_t>(left_, piece)));
    zlib_.next_in = in_.data();
    zlib_.avail_in = static_cast<uInt>(packed_.gcount());
    left_ -= zlib_.avail_in;
  }

  std::istream& packed_;
  std::uint64_t left_;  ///< [byte] of the part, not yet taken
  std::vector<unsigned char> in_, out_;
  z_stream zlib_{};
  bool works_ = false;
};

class MatLayout {
 public:
  explicit MatLayout(std::istream& in, bool turned = false) : in_(in), turned_(turned) {}

  bool fits_level_4(std::uint64_t size) {
    static constexpr std::array<std::uint64_t, 6> bytes_of_kind{8, 4, 4, 2, 2, 1};
    turned_ = number(0) > 9999;
    for (std::uint64_t at = 0; at < size;) {
      constexpr std::uint64_t head = 20;
      if (size - at < head) return false;
      const std::uint64_t kind = number(at) / 10 % 10, rows = number(at + 4), columns = number(at + 8),
                          complex = number(at + 12), name = number(at + 16), left = size - at - head;
      if (kind >= bytes_of_kind.size() || complex > 1 || name == 0 || name > left) return false;
      const std::uint64_t of_row = columns * bytes_of_kind[kind] * (complex + 1);
      if (of_row > 0 && rows > (left - name) / of_row) return false;
      at += head + name + rows * of_row;
    }
    return true;
  }

  bool fits_level_5(std::uint64_t size) {
    constexpr std::uint64_t head = 128;
    if (size < head) return false;
    in_.seekg(126);
    turned_ = in_.get() == 'M';
    return elements(head, size, 0);
  }

 private:
  /// Zero beyond the end, where the stream fails.
  std::uint32_t number(std::uint64_t at) {
    std::array<unsigned char, 4> bytes{};
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
      if (!in_) return false;
      if (kind == matrix && (depth == deepest_element || !elements(data, data + bytes, depth + 1))) return false;
      if (kind == compressed && depth == 0 && !unpacked_fits(data, bytes)) return false;
      at = is_small ? at + 8 : data + bytes;
      if (depth > 0) at = std::min(end, begin + (at - begin + 7) / 8 * 8);
    }
    return true;
  }

  /// The one element of a compressed one, which must be there to its end.
  bool unpacked_fits(std::uint64_t at, std::uint64_t bytes) {
    UnpackingBuffer buffer(in_, at, bytes);
    std::istream unpacked(&buffer);
    MatLayout inside(unpacked, turned_);
    const std::uint64_t end = 8 + std::uint64_t{inside.number(4)};
    if (inside.number(0) != matrix || !inside.elements(0, end, 0)) return false;
    unpacked.seekg(static_cast<std::streamoff>(end - 1));
    return unpacked.get() != std::istream::traits_type::eof();
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

  std::istream& in_;
  bool turned_;  ///< big-endian
};

}  // namespace

bool mat4_fits(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return MatLayout(in).fits_level_4(std::filesystem::file_size(file));
}

bool mat5_fits(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return MatLayout(in).fits_level_5(std::filesystem::file_size(file));
}

}  // namespace hysteron
