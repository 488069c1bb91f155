// Decides how numbers and texts come out of an open HDF5 file, whoever wrote it. hdf5_mutex() is held by the caller.
// Does not know names. Internal to io.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

using Hdf5Handle = std::int64_t;  // hid_t of the library

inline constexpr std::size_t most_hdf5_objects = 10'000;  // of a file

struct Hdf5Numbers {
  std::vector<std::size_t> sizes;  ///< as the file has them, the last runs fastest
  std::vector<double> values;
};

/// The numbers of a dataset of at most `most_sizes` dimensions, of any width, kind and byte order; nothing where it
/// holds none or none was written. `damaged` is called, and throws, where they cannot be read.
std::optional<Hdf5Numbers> numbers_of_hdf5(Hdf5Handle dataset, int most_sizes,
                                           const std::function<void(const std::string&)>& damaged);

/// The text of an attribute, "" where there is none.
std::string hdf5_text_attribute(Hdf5Handle at, const char* name);

/// Calls `with` for each link of a group that leads to something, in the order of their names.
void each_hdf5_object(Hdf5Handle group, std::size_t most,
                      const std::function<void(const std::string& name, Hdf5Handle)>& with);

}  // namespace hysteron
