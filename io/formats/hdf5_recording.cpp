// Decides how an HDF5 file of a laboratory is read: datasets of numbers by their paths, their units from attributes.
#include <fmt/format.h>

#include <algorithm>

#include "engine/diagram/error.h"
#include "io/files/child_read.h"
#include "io/formats/file_format.h"
#include "io/formats/hdf5_library.h"
#include "io/formats/hdf5_values.h"
#include "io/formats/named_vectors.h"

namespace hysteron {
namespace {

constexpr int deepest = 8;  // groups within groups; links may lead round in circles
constexpr std::size_t most_channels = 10'000;

constexpr char cure_of_hdf5[] = "export it again, or as CSV";

struct Hdf5Content {
  std::vector<MeasuredColumn> vectors;
  std::vector<std::string> assumed;
};

void put(PipeWriter& to, const Hdf5Content& content) {
  to.put(std::uint64_t{content.vectors.size()});
  for (const auto& v : content.vectors) {
    to.put(std::string_view(v.name));
    to.put(std::string_view(v.unit));
    to.put(std::span<const double>(v.values));
  }
  to.put(std::uint64_t{content.assumed.size()});
  for (const auto& fact : content.assumed) to.put(std::string_view(fact));
}

void take(PipeReader& from, Hdf5Content& content) {
  content = {};
  for (std::uint64_t k = from.number(); k > 0; --k) {
    MeasuredColumn v{from.text(), from.text()};
    v.values = from.numbers();
    content.vectors.push_back(std::move(v));
  }
  for (std::uint64_t k = from.number(); k > 0; --k) content.assumed.push_back(from.text());
}

/// hdf5_mutex() is held by the caller.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::string& file) : file_(file), h_(hdf5()) {}

  Hdf5Content read() {
    const Hdf5Id access(h_.H5Pcreate(h_.file_access), h_.H5Pclose);
    h_.H5Pset_file_locking(access, false, true);
    const Hdf5Id file(h_.H5Fopen(file_.c_str(), 0, access), h_.H5Fclose);
    if (!file.good()) damaged("it cannot be opened");
    group(file, "", 0);
    return std::move(content_);
  }

 private:
  [[noreturn]] void damaged(const std::string& why) const {
    throw Error(Fault::input, {{"damaged_file", file_, fmt::format("this HDF5 file cannot be read: {}", why),
                                cure_of_hdf5, file_, 0}});
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
    if (in_rows && columns > 1) content_.assumed.push_back(fmt::format("{}: each row is a channel", name));
    std::string unit;
    for (const char* attribute : {"unit", "units", "Unit", "Units", "unit_string"})
      if (unit.empty()) unit = hdf5_text_attribute(at, attribute);
    for (std::size_t c = 0; c < columns; ++c) {
      std::vector<double> column(rows);
      for (std::size_t k = 0; k < rows; ++k) column[k] = numbers->values[in_rows ? c * rows + k : k * columns + c];
      content_.vectors.push_back({columns == 1 ? name : fmt::format("{}_{}", name, c + 1), unit, std::move(column)});
    }
  }

  const std::string& file_;
  const Hdf5Library& h_;
  Hdf5Content content_;
  std::vector<haddr_t> above_;  ///< groups within which this one stands
  std::size_t seen_ = 0;
};

}  // namespace

bool is_hdf5(std::string_view bytes) { return bytes.starts_with("\x89HDF\r\n\x1A\n"); }

MeasuredTable read_hdf5(const std::string& file, const ReadingChoices& choices) {
  hdf5();  // loaded before the child is there
  const std::lock_guard lock(hdf5_mutex());
  Hdf5Content content = read_in_child<Hdf5Content>({file, "HDF5 file", "the HDF5 library", cure_of_hdf5},
                                                   [&] { return Hdf5Reader(file).read(); });
  MeasuredTable table;
  table.file = file;
  table.assumed = std::move(content.assumed);
  table.assumed.push_back("an HDF5 file");
  return table_of_vectors(std::move(table), std::move(content.vectors), choices);
}

}  // namespace hysteron
