// Decides how a MAT file (v4, v5, v7, v7.3) is read: vectors and matrices by their names, structures of Simulink,
// dSPACE and of one's own by their fields. The library matio is loaded when the first file needs it: with it comes
// HDF5, whose loading would double the start of every verb.
#include <dlfcn.h>
#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "engine/diagram/error.h"
#include "io/formats/file_format.h"
#include "io/formats/named_vectors.h"

namespace hysteron {
namespace {

constexpr std::size_t most_numbers = 1ULL << 31;  // of one variable
constexpr std::size_t densest = 1100;             // numbers for each byte of the file: more no compression gives
constexpr int deepest = 8;                        // structures within structures

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

std::string text_of(const matvar_t* v) {
  if (v == nullptr || v->class_type != MAT_C_CHAR || v->data == nullptr) return "";
  const std::size_t count = std::min<std::size_t>(count_of(*v), 256);
  std::string text;
  if (v->data_size == 1 && v->nbytes >= count) text.assign(static_cast<const char*>(v->data), count);
  if (v->data_size == 2 && v->nbytes >= 2 * count)
    for (std::size_t i = 0; i < count; ++i) {
      const auto c = static_cast<const std::uint16_t*>(v->data)[i];
      text += c < 128 ? static_cast<char>(c) : '?';
    }
  return text.substr(0, text.find('\0'));
}

class MatReader {
 public:
  MatReader(const std::string& file, const ReadingChoices& choices)
      : choices_(choices), most_(densest * std::filesystem::file_size(file)) {
    table_.file = file;
  }

  MeasuredTable read() {
    static std::mutex mutex;  // HDF5, on which newer files rest, is not made for threads
    const std::lock_guard lock(mutex);
    const MatLibrary& m = matio();
    const std::unique_ptr<mat_t, int (*)(mat_t*)> mat(m.open(table_.file.c_str(), MAT_ACC_RDONLY), m.close);
    if (!mat) damaged();
    while (const Variable v{m.read_next(mat.get())}) variable(*v, v->name == nullptr ? "" : v->name, 0);
    if (vectors_.empty() && !objects_.empty()) refuse_objects();
    if (vectors_.empty() && count_ == 0) damaged();
    table_.assumed.insert(table_.assumed.begin(), "a MAT file");
    if (!objects_.empty()) table_.assumed.push_back(fmt::format("left out: {}, an object of MATLAB", objects_.front()));
    if (interval_ && *interval_ > 0) table_.clock = SampleClock{start_.value_or(0), *interval_};
    return table_of_vectors(std::move(table_), std::move(vectors_), choices_);
  }

 private:
  [[noreturn]] void damaged() const {
    throw Error(Fault::input,
                {{"damaged_file", table_.file, "this MAT file cannot be read: it is damaged, or not complete",
                  "save it again", table_.file, 0}});
  }

  [[noreturn]] void refuse_objects() const {
    const std::string& name = objects_.front();
    throw Error(
        Fault::input,
        {{"unknown_file_type", name,
          fmt::format("\"{}\" is an object of MATLAB (a timeseries, a table ...), which only MATLAB reads", name),
          fmt::format(
              "save plain vectors there: for a timeseries t = {0}.Time; y = {0}.Data; save('lab.mat', 't', 'y'); for a "
              "table writetable({0}, 'lab.csv')",
              name),
          table_.file, 0}});
  }

  void variable(const matvar_t& v, const std::string& name, int depth) {
    ++count_;
    if (depth > deepest) return;
    switch (v.class_type) {
      case MAT_C_STRUCT:
        return structure(v, name, depth);
      case MAT_C_OPAQUE:
      case MAT_C_OBJECT:
      case MAT_C_FUNCTION:
        if (!name.empty()) objects_.push_back(name);
        return;
      default:
        return numbers(v, name, "");
    }
  }

  void numbers(const matvar_t& v, const std::string& name, const std::string& unit) {
    std::vector<double> values = numbers_of(v, most_);
    if (values.empty()) return;
    if (values.size() == 1) return setting(name, values.front());
    // n x m samples of m channels; a row or a column is one. Simulink stands samples behind each other: m x 1 x n.
    std::size_t rows = v.dims[0], columns = values.size() / std::max<std::size_t>(rows, 1);
    if (rows == 1 || (v.rank == 3 && v.dims[1] == 1 && v.dims[0] == 1)) std::swap(rows, columns);
    if (v.rank > 2 && columns > 1) return;
    for (std::size_t c = 0; c < columns; ++c)
      vectors_.push_back({columns == 1 ? name : fmt::format("{}_{}", name, c + 1),
                          unit,
                          {values.begin() + static_cast<std::ptrdiff_t>(c * rows),
                           values.begin() + static_cast<std::ptrdiff_t>((c + 1) * rows)}});
  }

  /// Scalars by which PicoScope and others say when the samples stand.
  void setting(const std::string& name, double value) {
    if (name == "Tinterval" || name == "dt" || name == "Ts") interval_ = value;
    if (name == "Tstart" || name == "t0") start_ = value;
    if ((name == "fs" || name == "Fs") && value > 0) interval_ = 1 / value;
  }

  static const matvar_t* field(const matvar_t& v, const char* name, std::size_t index = 0) {
    return matio().field(const_cast<matvar_t*>(&v), name, index);
  }

  void structure(const matvar_t& v, const std::string& name, int depth) {
    const std::size_t elements = std::min<std::size_t>(count_of(v), 1000);
    const unsigned fields = matio().field_count(const_cast<matvar_t*>(&v));
    char* const* names = matio().field_names(&v);
    if (names == nullptr || v.data == nullptr) return;
    for (std::size_t e = 0; e < elements; ++e) {
      if (channel(v, name, e)) continue;
      for (unsigned f = 0; f < fields; ++f) {
        const matvar_t* inside = names[f] == nullptr ? nullptr : field(v, names[f], e);
        if (inside == nullptr) continue;
        const std::string full = fmt::format("{}{}/{}", name, elements > 1 ? fmt::format("_{}", e + 1) : "", names[f]);
        variable(*inside, std::string_view(names[f]) == "signals" || is_axis(names[f]) ? name : full, depth + 1);
      }
    }
  }

  /// Fields that only group channels, by dSPACE: X, Y.
  static bool is_axis(std::string_view name) { return name == "X" || name == "Y"; }

  /// One channel: signals(k) of Simulink (values, label), X(k) and Y(k) of dSPACE (Data, Name, Unit).
  bool channel(const matvar_t& v, const std::string& group, std::size_t element) {
    const matvar_t *values = field(v, "values", element), *data = field(v, "Data", element);
    const matvar_t* samples = values != nullptr ? values : data;
    if (samples == nullptr || samples->class_type == MAT_C_STRUCT) return false;
    std::string label = text_of(field(v, values != nullptr ? "label" : "Name", element));
    std::replace(label.begin(), label.end(), '/', '.');
    if (label.empty()) label = values == nullptr && element == 0 ? "time" : fmt::format("signal_{}", element + 1);
    numbers(*samples, fmt::format("{}/{}", group, label), text_of(field(v, "Unit", element)));
    return true;
  }

  const ReadingChoices& choices_;
  std::size_t most_;  ///< numbers that the file can hold
  MeasuredTable table_;
  std::vector<MeasuredColumn> vectors_;
  std::vector<std::string> objects_;
  std::optional<double> interval_, start_;
  std::size_t count_ = 0;
};

}  // namespace

bool is_mat(std::string_view bytes) {
  return bytes.starts_with("MATLAB 5.0 MAT-file") || bytes.starts_with("MATLAB 7.3 MAT-file");
}

MeasuredTable read_mat(const std::string& file, const ReadingChoices& choices) {
  return MatReader(file, choices).read();
}

}  // namespace hysteron
