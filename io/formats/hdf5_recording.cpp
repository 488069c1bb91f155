// Decides how an HDF5 file of a laboratory is read: datasets of numbers by their paths, their units from attributes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "engine/diagram/error.h"
#include "io/formats/file_format.h"
#include "io/formats/hdf5_library.h"
#include "io/formats/named_vectors.h"

namespace hysteron {
namespace {

constexpr int deepest = 8;  // groups within groups; links may lead round in circles
constexpr std::size_t most_objects = 10'000, most_channels = 10'000;
constexpr std::uint64_t densest = 1100;  // samples for each byte of the file: more no compression gives

class Hdf5Reader {
 public:
  Hdf5Reader(const std::string& file, const ReadingChoices& choices) : choices_(choices), h_(hdf5()) {
    table_.file = file;
  }

  MeasuredTable read() {
    {
      const std::lock_guard lock(hdf5_mutex());
      const Hdf5Id access(h_.H5Pcreate(h_.file_access), h_.H5Pclose);
      h_.H5Pset_file_locking(access, false, true);
      const Hdf5Id file(h_.H5Fopen(table_.file.c_str(), 0, access), h_.H5Fclose);
      if (!file.good()) damaged("it cannot be opened");
      group(file, "", 0);
    }
    table_.assumed.push_back("an HDF5 file");
    return table_of_vectors(std::move(table_), std::move(vectors_), choices_);
  }

 private:
  [[noreturn]] void damaged(const std::string& why) const {
    throw Error(Fault::input, {{"damaged_file", table_.file, fmt::format("this HDF5 file cannot be read: {}", why),
                                "export it again, or as CSV", table_.file, 0}});
  }

  void group(hid_t at, const std::string& path, int depth) {
    H5G_info_t info;
    if (depth > deepest || h_.H5Gget_info(at, &info) < 0) return;
    for (hsize_t k = 0; k < info.nlinks && seen_ < most_objects; ++k, ++seen_) {
      std::array<char, 256> name{};
      if (h_.H5Lget_name_by_idx(at, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), 0) <= 0) continue;
      const Hdf5Id object(h_.H5Oopen(at, name.data(), 0), h_.H5Oclose);
      if (!object.good()) continue;
      const std::string full = path.empty() ? name.data() : path + "/" + name.data();
      const auto kind = h_.H5Iget_type(object);
      if (kind == H5I_GROUP) group(object, full, depth + 1);
      if (kind == H5I_DATASET) dataset(object, full);
    }
  }

  void dataset(hid_t at, const std::string& name) {
    const Hdf5Id type(h_.H5Dget_type(at), h_.H5Tclose), space(h_.H5Dget_space(at), h_.H5Sclose);
    const auto kind = h_.H5Tget_class(type);
    if (kind != H5T_FLOAT && kind != H5T_INTEGER) return;
    const int rank = h_.H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 2) return;
    std::array<hsize_t, 2> sizes{1, 1};
    if (h_.H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0) return;
    if (sizes[0] == 1) std::swap(sizes[0], sizes[1]);  // a row is a column
    const auto [rows, columns] = sizes;
    if (rows == 0 || columns == 0 || columns > most_channels) return;
    if (rows > densest * h_.H5Dget_storage_size(at) / columns + 1) damaged(name + " has more samples than bytes");
    std::vector<double> values(rows * columns);
    if (h_.H5Dread(at, h_.real, 0, 0, 0, values.data()) < 0) damaged(name + " cannot be read");
    const std::string unit = unit_of(at);
    for (std::size_t c = 0; c < columns; ++c) {
      std::vector<double> column(rows);
      for (std::size_t k = 0; k < rows; ++k) column[k] = values[k * columns + c];
      vectors_.push_back({columns == 1 ? name : fmt::format("{}_{}", name, c + 1), unit, std::move(column)});
    }
  }

  std::string unit_of(hid_t at) const {
    for (const char* name : {"unit", "units", "Unit", "Units", "unit_string"})
      if (h_.H5Aexists(at, name) > 0) return text_of(at, name);
    return "";
  }

  std::string text_of(hid_t at, const char* name) const {
    const Hdf5Id attribute(h_.H5Aopen(at, name, 0), h_.H5Aclose), type(h_.H5Aget_type(attribute), h_.H5Tclose);
    if (!attribute.good() || h_.H5Tget_class(type) != H5T_STRING) return "";
    const Hdf5Id space(h_.H5Aget_space(attribute), h_.H5Sclose);
    if (h_.H5Sget_simple_extent_npoints(space) != 1) return "";
    if (h_.H5Tis_variable_str(type) > 0) {
      char* text = nullptr;
      if (h_.H5Aread(attribute, type, static_cast<void*>(&text)) < 0 || text == nullptr) return "";
      std::string copy = text;
      h_.H5free_memory(text);
      return copy;
    }
    const std::size_t size = h_.H5Tget_size(type);
    if (size == 0 || size > 4096) return "";
    std::string text(size, '\0');
    if (h_.H5Aread(attribute, type, text.data()) < 0) return "";
    return text.substr(0, text.find('\0'));
  }

  const ReadingChoices& choices_;
  const Hdf5Library& h_;
  MeasuredTable table_;
  std::vector<MeasuredColumn> vectors_;
  std::size_t seen_ = 0;
};

}  // namespace

bool is_hdf5(std::string_view bytes) { return bytes.starts_with("\x89HDF\r\n\x1A\n"); }

MeasuredTable read_hdf5(const std::string& file, const ReadingChoices& choices) {
  return Hdf5Reader(file, choices).read();
}

}  // namespace hysteron
