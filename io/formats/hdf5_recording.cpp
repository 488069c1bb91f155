// Decides how an HDF5 file of a laboratory is read: datasets of numbers by their paths, their units from attributes.
#include <fmt/format.h>

#include <algorithm>

#include "engine/diagram/error.h"
#include "io/formats/file_format.h"
#include "io/formats/hdf5_library.h"
#include "io/formats/hdf5_values.h"
#include "io/formats/named_vectors.h"

namespace hysteron {
namespace {

constexpr int deepest = 8;  // groups within groups; links may lead round in circles
constexpr std::size_t most_channels = 10'000;

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

  /// A group that stands above this one is a link that leads back to it.
  void group(hid_t at, const std::string& path, int depth) {
    H5O_info_t info;
    if (depth > deepest || h_.H5Oget_info2(at, &info, H5O_INFO_BASIC) < 0) return;
    if (std::find(above_.begin(), above_.end(), info.addr) != above_.end()) return;
    above_.push_back(info.addr);
    each_hdf5_object(at, most_hdf5_objects, [&](const std::string& name, hid_t object) {
      if (++seen_ > most_hdf5_objects) return;
      const std::string full = path.empty() ? name : path + "/" + name;
      const auto kind = h_.H5Iget_type(object);
      if (kind == H5I_GROUP) group(object, full, depth + 1);
      if (kind == H5I_DATASET) dataset(object, full);
    });
    above_.pop_back();
  }

  void dataset(hid_t at, const std::string& name) {
    const auto numbers = numbers_of_hdf5(at, 2, [&](const std::string& why) { damaged(name + ": " + why); });
    if (!numbers) return;
    // A row is a column, and what is wider than long holds a channel in each row.
    std::size_t rows = numbers->sizes[0], columns = numbers->sizes.size() == 2 ? numbers->sizes[1] : 1;
    const bool in_rows = columns > rows;
    if (in_rows) std::swap(rows, columns);
    if (columns > most_channels) return;
    if (in_rows && columns > 1) table_.assumed.push_back(fmt::format("{}: each row is a channel", name));
    std::string unit;
    for (const char* attribute : {"unit", "units", "Unit", "Units", "unit_string"})
      if (unit.empty()) unit = hdf5_text_attribute(at, attribute);
    for (std::size_t c = 0; c < columns; ++c) {
      std::vector<double> column(rows);
      for (std::size_t k = 0; k < rows; ++k) column[k] = numbers->values[in_rows ? c * rows + k : k * columns + c];
      vectors_.push_back({columns == 1 ? name : fmt::format("{}_{}", name, c + 1), unit, std::move(column)});
    }
  }

  const ReadingChoices& choices_;
  const Hdf5Library& h_;
  MeasuredTable table_;
  std::vector<MeasuredColumn> vectors_;
  std::vector<haddr_t> above_;  ///< groups within which this one stands
  std::size_t seen_ = 0;
};

}  // namespace

bool is_hdf5(std::string_view bytes) { return bytes.starts_with("\x89HDF\r\n\x1A\n"); }

MeasuredTable read_hdf5(const std::string& file, const ReadingChoices& choices) {
  return Hdf5Reader(file, choices).read();
}

}  // namespace hysteron
