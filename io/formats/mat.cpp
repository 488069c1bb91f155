// Decides how a MAT file is read: levels 4, 5 and 7 by the library matio, 7.3 by ours over HDF5 (mat73.cpp); what its
// variables mean stands in mat_value.cpp. The library is loaded when the first file needs it: with it comes HDF5, whose
// loading would double the start of every verb.
#include <dlfcn.h>
#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>

#include "engine/diagram/error.h"
#include "io/files/child_read.h"
#include "io/formats/file_format.h"
#include "io/formats/mat_layout.h"
#include "io/formats/mat_pipe.h"
#include "io/formats/mat_value.h"
#include "io/formats/named_vectors.h"

namespace hysteron {
namespace {

constexpr std::size_t most_numbers = 1ULL << 31;  // of one variable

struct MatLibrary {
  decltype(&::Mat_Open) open = nullptr;
  decltype(&::Mat_Close) close = nullptr;
  decltype(&::Mat_VarReadNext) read_next = nullptr;
  decltype(&::Mat_VarFree) free = nullptr;
  decltype(&::Mat_VarGetNumberOfFields) field_count = nullptr;
  decltype(&::Mat_VarGetStructFieldnames) field_names = nullptr;
  decltype(&::Mat_VarGetStructFieldByName) field = nullptr;
};

const MatLibrary& matio() {
  static const MatLibrary library = [] {
    const auto cannot = [](const char* why) {
      fail("no_matio", HYSTERON_MATIO_LIBRARY, fmt::format("the library for MAT files cannot be loaded: {}", why),
           "install it (Debian: libmatio11)");
    };
    void* loaded = dlopen(HYSTERON_MATIO_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (loaded == nullptr) cannot(dlerror());
    MatLibrary m;
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(loaded, name));
      if (function == nullptr) cannot(name);
    };
    find(m.open, "Mat_Open");
    find(m.close, "Mat_Close");
    find(m.read_next, "Mat_VarReadNext");
    find(m.free, "Mat_VarFree");
    find(m.field_count, "Mat_VarGetNumberOfFields");
    find(m.field_names, "Mat_VarGetStructFieldnames");
    find(m.field, "Mat_VarGetStructFieldByName");
    return m;
  }();
  return library;
}

struct FreeVariable {
  void operator()(matvar_t* v) const { matio().free(v); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

std::size_t count_of(const matvar_t& v) {
  std::size_t count = 1;
  for (int d = 0; d < v.rank; ++d) {
    if (v.dims[d] > 0 && count > most_numbers / v.dims[d]) return 0;
    count *= v.dims[d];
  }
  return v.rank <= 0 ? 0 : count;
}

template <class T>
std::vector<double> as_numbers(const matvar_t& v, std::size_t count) {
  const T* data = static_cast<const T*>(v.data);
  return {data, data + count};
}

/// Real numbers of any type, no more than `most`; empty for what holds none.
std::vector<double> numbers_of(const matvar_t& v, std::size_t most) {
  const std::size_t count = count_of(v);
  if (count > most || v.data == nullptr || v.isComplex != 0 || count == 0 || v.data_size <= 0 ||
      v.nbytes / static_cast<std::size_t>(v.data_size) < count)
    return {};
  switch (v.data_type) {
    case MAT_T_DOUBLE:
      return as_numbers<double>(v, count);
    case MAT_T_SINGLE:
      return as_numbers<float>(v, count);
    case MAT_T_INT8:
      return as_numbers<std::int8_t>(v, count);
    case MAT_T_UINT8:
      return as_numbers<std::uint8_t>(v, count);
    case MAT_T_INT16:
      return as_numbers<std::int16_t>(v, count);
    case MAT_T_UINT16:
      return as_numbers<std::uint16_t>(v, count);
    case MAT_T_INT32:
      return as_numbers<std::int32_t>(v, count);
    case MAT_T_UINT32:
      return as_numbers<std::uint32_t>(v, count);
    case MAT_T_INT64:
      return as_numbers<std::int64_t>(v, count);
    case MAT_T_UINT64:
      return as_numbers<std::uint64_t>(v, count);
    default:
      return {};
  }
}

std::string text_of(const matvar_t& v) {
  if (v.data == nullptr) return "";
  const std::size_t count = std::min<std::size_t>(count_of(v), 256);
  std::string text;
  if (v.data_size == 1 && v.nbytes >= count) text.assign(static_cast<const char*>(v.data), count);
  if (v.data_size == 2 && v.nbytes >= 2 * count)
    for (std::size_t i = 0; i < count; ++i) {
      const auto c = static_cast<const std::uint16_t*>(v.data)[i];
      text += c < 128 ? static_cast<char>(c) : '?';
    }
  return text.substr(0, text.find('\0'));
}

/// Variables of MATLAB as matio gives them, which is asked for levels 4 and 5 alone. By one thread at a time.
class MatioReader {
 public:
  explicit MatioReader(const std::string& file)
      : file_(file), most_(most_numbers_per_byte * std::filesystem::file_size(file)) {}

  MatVariables read() const {
    const MatLibrary& m = matio();
    MatVariables variables;
    const std::unique_ptr<mat_t, int (*)(mat_t*)> mat(m.open(file_.c_str(), MAT_ACC_RDONLY), m.close);
    if (!mat) return variables;
    while (const Variable v{m.read_next(mat.get())})
      variables.emplace_back(v->name == nullptr ? "" : v->name, value(*v, 0));
    return variables;
  }

 private:
  MatValue value(const matvar_t& v, int depth) const {
    switch (v.class_type) {
      case MAT_C_STRUCT:
        return structure(v, depth);
      case MAT_C_OPAQUE:
      case MAT_C_OBJECT:
      case MAT_C_FUNCTION:
        return {MatValue::Kind::object};
      case MAT_C_CHAR:
        return {MatValue::Kind::text, {}, {}, text_of(v)};
      default:
        return numbers(v);
    }
  }

  MatValue numbers(const matvar_t& v) const {
    MatValue of{MatValue::Kind::numbers, {}, numbers_of(v, most_)};
    if (of.values.empty()) return {};
    of.sizes.assign(v.dims, v.dims + v.rank);
    return of;
  }

  MatValue structure(const matvar_t& v, int depth) const {
    MatValue of{MatValue::Kind::structure};
    auto* const variable = const_cast<matvar_t*>(&v);
    const unsigned fields = matio().field_count(variable);
    char* const* names = matio().field_names(variable);
    if (names == nullptr || v.data == nullptr || depth >= deepest_of_mat) return of;
    of.elements = std::min(count_of(v), most_elements_of_mat);
    for (unsigned f = 0; f < fields; ++f) {
      if (names[f] == nullptr) continue;
      MatValue::Field field{names[f], {}};
      for (std::size_t e = 0; e < of.elements; ++e) {
        const matvar_t* inside = matio().field(variable, names[f], e);
        field.of_element.push_back(inside == nullptr ? MatValue{} : value(*inside, depth + 1));
      }
      of.fields.push_back(std::move(field));
    }
    return of;
  }

  const std::string& file_;
  std::size_t most_;  ///< numbers that the file can hold
};

/// Level 4 has no words at its begin: a whole number of kinds, two sizes, whether it is complex, and the length of a
/// name, which follows (MAT-File Format, MathWorks). Of either byte order.
bool is_mat4(std::string_view bytes) {
  constexpr std::size_t head = 20, longest_name = 63;
  if (bytes.size() < head) return false;
  const auto number = [&](std::size_t at, bool turned) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k)
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + (turned ? 3 - k : k)])) << 8 * k;
    return value;
  };
  for (const bool turned : {false, true}) {
    const std::uint32_t kind = number(0, turned), name = number(16, turned);
    const bool known = kind / 1000 == (turned ? 1 : 0) && kind / 100 % 10 == 0 && kind / 10 % 10 <= 5 && kind % 10 <= 2;
    if (!known || number(12, turned) > 1 || name < 2 || name > longest_name + 1 || bytes.size() < head + name) continue;
    const std::string_view letters = bytes.substr(head, name - 1);
    const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    if (bytes[head + name - 1] == '\0' && std::all_of(letters.begin(), letters.end(), is_of_name)) return true;
  }
  return false;
}

enum class Level { four, five, seven_point_three };

/// By the version in the head, which decides how matio reads: 0x0200 stands for HDF5, in either byte order.
Level level_of(const std::string& file) {
  std::string head(128, '\0');
  std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!head.starts_with("MATLAB")) return Level::four;
  return head[124] == 2 || head[125] == 2 ? Level::seven_point_three : Level::five;
}

}  // namespace

bool is_mat(std::string_view bytes) {
  return bytes.starts_with("MATLAB 5.0 MAT-file") || bytes.starts_with("MATLAB 7.3 MAT-file") || is_mat4(bytes);
}

namespace {

MatVariables variables_of_matio(const std::string& file) {
  static std::mutex mutex;  // the library says nothing of threads
  matio();                  // loaded before the child is there
  const std::lock_guard lock(mutex);
  return read_in_child<MatVariables>({file, "MAT file", "the library for MAT files", "save it again, or as CSV"},
                                     [&] { return MatioReader(file).read(); });
}

}  // namespace

MeasuredTable read_mat(const std::string& file, const ReadingChoices& choices) {
  if (level_of(file) == Level::seven_point_three) return recording_of_mat(file, variables_of_mat73(file), choices);
  const bool fits = level_of(file) == Level::four ? mat4_fits(file) : mat5_fits(file);
  return recording_of_mat(file, fits ? variables_of_matio(file) : MatVariables{}, choices);
}

}  // namespace hysteron
