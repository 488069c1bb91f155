#include "io/formats/hdf5_values.h"

#include <array>
#include <cstdint>

#include "io/formats/hdf5_library.h"
#include "io/formats/named_vectors.h"

namespace hysteron {
namespace {

constexpr std::uint64_t most_hdf5_numbers = 1ULL << 31U;
constexpr std::size_t longest_hdf5_text = 4096;

}  // namespace

std::optional<Hdf5Numbers> numbers_of_hdf5(Hdf5Handle dataset, int most_sizes,
                                           const std::function<void(const std::string&)>& damaged) {
  const Hdf5Library& h = hdf5();
  const Hdf5Id type(h.H5Dget_type(dataset), h.H5Tclose), space(h.H5Dget_space(dataset), h.H5Sclose);
  const auto kind = h.H5Tget_class(type);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) return std::nullopt;
  const int rank = h.H5Sget_simple_extent_ndims(space);
  std::array<hsize_t, 4> sizes{};
  if (rank < 1 || rank > most_sizes || rank > static_cast<int>(sizes.size())) return std::nullopt;
  if (h.H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0) return std::nullopt;
  Hdf5Numbers numbers;
  std::uint64_t count = 1;
  for (int d = 0; d < rank; ++d) {
    const std::uint64_t size = sizes[static_cast<std::size_t>(d)];
    if (size == 0) return std::nullopt;
    if (count > most_hdf5_numbers / size) damaged("it has more samples than bytes");
    count *= size;
    numbers.sizes.push_back(size);
  }
  const std::uint64_t stored = h.H5Dget_storage_size(dataset);
  if (stored == 0) return std::nullopt;
  if (count > most_numbers_per_byte * stored) damaged("it has more samples than bytes");
  numbers.values.resize(count);
  if (h.H5Dread(dataset, h.real, 0, 0, 0, numbers.values.data()) < 0)
    damaged("its samples are damaged, or packed by a filter that is not installed here");
  return numbers;
}

std::string hdf5_text_attribute(Hdf5Handle at, const char* name) {
  const Hdf5Library& h = hdf5();
  if (h.H5Aexists(at, name) <= 0) return "";
  const Hdf5Id attribute(h.H5Aopen(at, name, 0), h.H5Aclose);
  if (!attribute.good()) return "";
  const Hdf5Id type(h.H5Aget_type(attribute), h.H5Tclose), space(h.H5Aget_space(attribute), h.H5Sclose);
  if (h.H5Tget_class(type) != H5T_STRING || h.H5Sget_simple_extent_npoints(space) != 1) return "";
  if (h.H5Tis_variable_str(type) > 0) {
    char* text = nullptr;
    if (h.H5Aread(attribute, type, static_cast<void*>(&text)) < 0 || text == nullptr) return "";
    std::string copy = text;
    h.H5free_memory(text);
    return copy;
  }
  const std::size_t size = h.H5Tget_size(type);
  if (size == 0 || size > longest_hdf5_text) return "";
  std::string text(size, '\0');
  if (h.H5Aread(attribute, type, text.data()) < 0) return "";
  return text.substr(0, text.find('\0'));
}

void each_hdf5_object(Hdf5Handle group, std::size_t most,
                      const std::function<void(const std::string& name, Hdf5Handle)>& with) {
  const Hdf5Library& h = hdf5();
  H5G_info_t info;
  if (h.H5Gget_info(group, &info) < 0) return;
  for (hsize_t k = 0; k < info.nlinks && k < most; ++k) {
    std::array<char, 1024> name{};
    if (h.H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), 0) <= 0) continue;
    const Hdf5Id object(h.H5Oopen(group, name.data(), 0), h.H5Oclose);
    if (object.good()) with(name.data(), object);
  }
}

}  // namespace hysteron
