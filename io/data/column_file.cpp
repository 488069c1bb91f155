#include "io/data/column_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>

#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
#include "io/files/sealed_file.h"
#include "io/formats/hdf5_library.h"

namespace hysteron {
namespace {

constexpr hsize_t rows_at_once = 1024;           // of a column: 8 kB, so that a small study is a small file
constexpr unsigned truncate = 2, read_only = 0;  // as HDF5 has them, without the calls that it hides in their names
constexpr char names_fact[] = "columns";
constexpr std::size_t largest_fact = 1 << 26;  // more is damage: a fact is kept in memory

using Id = Hdf5Id;

std::string dataset_name(std::string name) {
  std::replace(name.begin(), name.end(), '/', ':');
  return name;
}

Id text_type(const Hdf5Library& h, std::size_t size) {
  Id type(h.H5Tcopy(h.text), h.H5Tclose);
  h.H5Tset_size(type, std::max<std::size_t>(size, 1));
  return type;
}

bool write_text(const Hdf5Library& h, hid_t to, const std::string& name, const std::string& text) {
  const Id type = text_type(h, text.size());
  const Id space(h.H5Screate(H5S_SCALAR), h.H5Sclose);
  const Id attribute(h.H5Acreate2(to, name.c_str(), type, space, 0, 0), h.H5Aclose);
  return attribute.good() && h.H5Awrite(attribute, type, text.empty() ? "" : text.data()) >= 0;
}

bool write_numbers(const Hdf5Library& h, hid_t to, const std::string& name, const std::vector<std::int64_t>& numbers,
                   bool list) {
  const hsize_t size = numbers.size();
  const Id space(list ? h.H5Screate_simple(1, &size, nullptr) : h.H5Screate(H5S_SCALAR), h.H5Sclose);
  const Id attribute(h.H5Acreate2(to, name.c_str(), h.whole, space, 0, 0), h.H5Aclose);
  return attribute.good() && (size == 0 || h.H5Awrite(attribute, h.whole, numbers.data()) >= 0);
}

bool write_fact(const Hdf5Library& h, hid_t to, const std::string& name, const FileFact& fact) {
  if (const auto* text = std::get_if<std::string>(&fact)) return write_text(h, to, name, *text);
  if (const auto* number = std::get_if<std::int64_t>(&fact)) return write_numbers(h, to, name, {*number}, false);
  return write_numbers(h, to, name, std::get<std::vector<std::int64_t>>(fact), true);
}

}  // namespace

// ---- writing --------------------------------------------------------------------------------------------------------

struct ColumnWriter::Content {
  Content(std::string name, std::vector<ColumnHead> columns) : file(std::move(name)), heads(std::move(columns)) {}
  ~Content() {
    const std::lock_guard lock(hdf5_mutex());
    datasets.clear();
    if (open) open->close();
  }

  void begin(const Hdf5Library& h) {
    const Id creation(h.H5Pcreate(h.file_creation), h.H5Pclose), access(h.H5Pcreate(h.file_access), h.H5Pclose);
    h.H5Pset_obj_track_times(creation, false);
    h.H5Pset_file_locking(access, false, true);  // network file systems may have none
    errno = 0;
    open.emplace(h.H5Fcreate(file.path().c_str(), truncate, creation, access), h.H5Fclose);
    if (!open->good()) file.fail_now();
    const Id dataset(h.H5Pcreate(h.dataset_creation), h.H5Pclose);
    h.H5Pset_obj_track_times(dataset, false);
    h.H5Pset_chunk(dataset, 1, &rows_at_once);
    h.H5Pset_fletcher32(dataset);
    const hsize_t none = 0, unlimited = H5S_UNLIMITED;
    const Id space(h.H5Screate_simple(1, &none, &unlimited), h.H5Sclose);
    for (const auto& head : heads) {
      datasets.emplace_back(
          h.H5Dcreate2(*open, dataset_name(head.name).c_str(), head.whole ? h.whole : h.real, space, 0, dataset, 0),
          h.H5Dclose);
      const bool written = datasets.back().good() && write_text(h, datasets.back(), "name", head.name) &&
                           write_text(h, datasets.back(), "unit", head.unit.empty() ? "1" : head.unit) &&
                           write_text(h, datasets.back(), "meaning", head.meaning);
      if (!written) file.fail_now();
    }
  }

  void flush(const Hdf5Library& h) {
    if (buffered == 0) return;
    const hsize_t first = rows, count = buffered, size = rows + buffered;
    const Id memory(h.H5Screate_simple(1, &count, nullptr), h.H5Sclose);
    for (std::size_t c = 0; c < datasets.size(); ++c) {
      bool good = h.H5Dset_extent(datasets[c], &size) >= 0;
      const Id space(h.H5Dget_space(datasets[c]), h.H5Sclose);
      good = good && h.H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr) >= 0;
      if (heads[c].whole) {
        std::array<std::int64_t, rows_at_once> numbers{};
        for (hsize_t i = 0; i < count; ++i) numbers[i] = static_cast<std::int64_t>(buffer[c * rows_at_once + i]);
        good = good && h.H5Dwrite(datasets[c], h.whole, memory, space, 0, numbers.data()) >= 0;
      } else {
        good = good && h.H5Dwrite(datasets[c], h.real, memory, space, 0, buffer.data() + c * rows_at_once) >= 0;
      }
      if (!good) file.fail_now();
    }
    rows += buffered;
    buffered = 0;
  }

  UnfinishedFile file;
  std::vector<ColumnHead> heads;
  std::optional<Id> open{};
  std::vector<Id> datasets{};
  std::vector<double> buffer{};
  hsize_t rows = 0, buffered = 0;
};

ColumnWriter::ColumnWriter(std::string file, std::vector<ColumnHead> columns)
    : content_(std::make_unique<Content>(std::move(file), std::move(columns))) {
  content_->buffer.resize(content_->heads.size() * rows_at_once);
  const Hdf5Library& h = hdf5();
  const std::lock_guard lock(hdf5_mutex());
  content_->begin(h);
}

ColumnWriter::~ColumnWriter() = default;

void ColumnWriter::append(std::span<const double> row) {
  Content& c = *content_;
  for (std::size_t i = 0; i < row.size(); ++i) c.buffer[i * rows_at_once + c.buffered] = row[i];
  if (++c.buffered < rows_at_once) return;
  const std::lock_guard lock(hdf5_mutex());
  c.flush(hdf5());
}

void ColumnWriter::finish(const FileFacts& facts, bool sealed) {
  Content& c = *content_;
  const Hdf5Library& h = hdf5();
  {
    const std::lock_guard lock(hdf5_mutex());
    c.flush(h);
    std::vector<std::string> names;
    for (const auto& head : c.heads) names.push_back(dataset_name(head.name));
    bool good = write_text(h, *c.open, names_fact, fmt::format("{}", fmt::join(names, "\n")));
    for (const auto& [name, fact] : facts) good = good && write_fact(h, *c.open, name, fact);
    for (auto& dataset : c.datasets) good = dataset.close() && good;
    errno = 0;
    good = c.open->close() && good;
    if (!good) c.file.fail_now();
  }
  if (sealed) c.file.append(seal_line(c.file.path()));
  c.file.finish();
}

// ---- reading --------------------------------------------------------------------------------------------------------

struct ColumnReader::Content {
  [[noreturn]] void damaged(const std::string& why) const {
    fail("damaged_file", name, fmt::format("{} is no file of columns: {}", name, why),
         "remove it, and compute it again");
  }

  std::string text_of(const Hdf5Library& h, hid_t from, const char* fact, const std::string& otherwise) const {
    if (h.H5Aexists(from, fact) <= 0) return otherwise;
    const Id attribute(h.H5Aopen(from, fact, 0), h.H5Aclose);
    const Id type(h.H5Aget_type(attribute), h.H5Tclose);
    if (!attribute.good() || h.H5Tget_class(type) != H5T_STRING) return otherwise;
    if (h.H5Tget_size(type) > largest_fact) damaged("a text is too long");
    std::string text(h.H5Tget_size(type), '\0');
    if (h.H5Aread(attribute, type, text.data()) < 0) damaged("a text cannot be read");
    text.resize(std::min(text.size(), text.find('\0')));
    return text;
  }

  void begin(const Hdf5Library& h) {
    const Id access(h.H5Pcreate(h.file_access), h.H5Pclose);
    h.H5Pset_file_locking(access, false, true);
    open.emplace(h.H5Fopen(name.c_str(), read_only, access), h.H5Fclose);
    if (!open->good()) damaged("it cannot be opened as HDF5");
    std::string names = text_of(h, *open, names_fact, "");
    if (names.empty()) damaged("it does not say which columns it has");
    names += '\n';
    for (std::size_t begin = 0, end = names.find('\n'); end != names.npos;
         begin = end + 1, end = names.find('\n', begin)) {
      datasets.emplace_back(h.H5Dopen2(*open, names.substr(begin, end - begin).c_str(), 0), h.H5Dclose);
      if (!datasets.back().good()) damaged("a column is missing");
      const Id space(h.H5Dget_space(datasets.back()), h.H5Sclose);
      const auto length = static_cast<std::uint64_t>(h.H5Sget_simple_extent_npoints(space));
      if (datasets.size() > 1 && length != rows) damaged("its columns are not equally long");
      rows = length;
      const std::string unit = text_of(h, datasets.back(), "unit", "1");
      heads.push_back({text_of(h, datasets.back(), "name", ""), unit == "1" ? "" : unit,
                       text_of(h, datasets.back(), "meaning", "")});
    }
  }

  ~Content() {
    const std::lock_guard lock(hdf5_mutex());
    datasets.clear();
    if (open) open->close();
  }

  std::string name;
  std::optional<Id> open{};
  std::vector<Id> datasets{};
  std::vector<ColumnHead> heads{};
  std::uint64_t rows = 0;
};

ColumnReader::ColumnReader(const std::string& file) : content_(std::make_unique<Content>()) {
  content_->name = file;
  check_readable(file);
  const Hdf5Library& h = hdf5();
  const std::lock_guard lock(hdf5_mutex());
  content_->begin(h);
}

ColumnReader::~ColumnReader() = default;

const std::vector<ColumnHead>& ColumnReader::columns() const { return content_->heads; }
std::uint64_t ColumnReader::rows() const { return content_->rows; }

std::string ColumnReader::text(const std::string& fact, const std::string& otherwise) const {
  const std::lock_guard lock(hdf5_mutex());
  return content_->text_of(hdf5(), *content_->open, fact.c_str(), otherwise);
}

std::vector<std::int64_t> ColumnReader::list(const std::string& fact) const {
  const Hdf5Library& h = hdf5();
  const std::lock_guard lock(hdf5_mutex());
  if (h.H5Aexists(*content_->open, fact.c_str()) <= 0) return {};
  const Id attribute(h.H5Aopen(*content_->open, fact.c_str(), 0), h.H5Aclose);
  const Id space(h.H5Aget_space(attribute), h.H5Sclose), type(h.H5Aget_type(attribute), h.H5Tclose);
  if (h.H5Tget_class(type) != H5T_INTEGER) return {};
  const auto size = static_cast<std::size_t>(std::max<hssize_t>(0, h.H5Sget_simple_extent_npoints(space)));
  if (size > largest_fact) content_->damaged("a list is too long");
  std::vector<std::int64_t> numbers(size);
  if (!numbers.empty() && h.H5Aread(attribute, h.whole, numbers.data()) < 0)
    content_->damaged("a number cannot be read");
  return numbers;
}

std::int64_t ColumnReader::whole(const std::string& fact, std::int64_t otherwise) const {
  const auto numbers = list(fact);
  return numbers.size() == 1 ? numbers.front() : otherwise;
}

void ColumnReader::read(std::size_t column, std::uint64_t first, std::span<double> values) const {
  const Hdf5Library& h = hdf5();
  const std::lock_guard lock(hdf5_mutex());
  const hsize_t begin = first, count = values.size();
  if (count == 0) return;
  const Id memory(h.H5Screate_simple(1, &count, nullptr), h.H5Sclose);
  const Id space(h.H5Dget_space(content_->datasets[column]), h.H5Sclose);
  const bool good = h.H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &count, nullptr) >= 0 &&
                    h.H5Dread(content_->datasets[column], h.real, memory, space, 0, values.data()) >= 0;
  if (!good) content_->damaged("rows cannot be read");
}

}  // namespace hysteron
