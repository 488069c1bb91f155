// Decides how a LabVIEW measurement file (LVM, text) is read, from its published layout: a header of the file, and for
// each segment a header with one entry per channel (units, start, interval) and its rows.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "io/formats/cells.h"
#include "io/formats/decoded_text.h"
#include "io/formats/file_format.h"
#include "io/formats/text_layout.h"

namespace hysteron {
namespace {

constexpr std::string_view end_of_header = "***End_of_Header***";

class LvmReader {
 public:
  explicit LvmReader(const std::string& file) : text_(decoded(read_file(file)).text), lines_(lines_of(text_)) {
    table_.file = file;
  }

  MeasuredTable read() {
    file_header();
    table_.assumed.push_back("a LabVIEW measurement (LVM)");
    if (form_.decimal == ',') table_.assumed.push_back("decimal comma");
    segment_header();
    rows();
    times();
    return std::move(table_);
  }

 private:
  using Cells = std::vector<std::string_view>;

  [[noreturn]] void refuse(std::string code, std::size_t line, std::string what, std::string cure) const {
    throw Error(Fault::input, {{std::move(code), table_.file, std::move(what), std::move(cure), table_.file,
                                static_cast<int>(line) + 1}});
  }

  Cells cells(std::size_t line) const {
    Cells list;
    split_cells(lines_[line], form_.separator, list);
    if (list.empty()) list.emplace_back();
    return list;
  }

  void file_header() {
    for (; at_ < lines_.size(); ++at_) {
      const auto line = lines_[at_];
      if (line.starts_with(end_of_header)) break;
      const auto cut = line.find_first_of("\t,;");
      const auto key = line.substr(0, cut);
      const auto value = cut == line.npos ? std::string_view() : without_blanks(line.substr(cut + 1));
      if (key == "Separator") form_.separator = value.starts_with("Comma") ? ',' : '\t';
      if (key == "Decimal_Separator") form_.decimal = value.starts_with(',') || line.ends_with(",,") ? ',' : '.';
      if (key == "X_Columns") x_columns_ = lower_case_of(value.substr(0, value.find(form_.separator)));
    }
    if (at_ == lines_.size())
      refuse("no_header", 0, "the header of this LVM file does not end (***End_of_Header***)", "record it again");
    ++at_;
  }

  /// Entries of each channel, by their key; then the line of names.
  void segment_header() {
    for (; at_ < lines_.size(); ++at_) {
      const Cells list = cells(at_);
      if (list.front().starts_with(end_of_header)) break;
      if (!list.front().empty()) entries_[std::string(list.front())] = {list.begin() + 1, list.end()};
    }
    if (at_ + 1 >= lines_.size())
      refuse("no_table", lines_.size() - 1, "this LVM file holds no samples", "record again, or name another file");
    names_ = cells(++at_);
    ++at_;
    channels_ = static_cast<std::size_t>(leading_whole_number(std::string(entry("Channels", 0)), 0));
    const std::size_t most = names_.size();
    if (channels_ == 0 || channels_ > most)
      refuse("no_header", at_ - 1, fmt::format("{} names stand above {} channels", most, channels_),
             "the file is damaged: export it again");
    const std::size_t stride = x_columns_ == "multi" ? 2 : 1;
    for (std::size_t c = 0; c < channels_; ++c) {
      const std::size_t cell =
          x_columns_ == "multi" ? stride * c + 1 : c + 1;  // a column of X stands first, even empty
      if (cell >= most) refuse("no_header", at_ - 1, "a channel has no name", "the file is damaged: export it again");
      cells_of_.push_back(cell);
      table_.columns.push_back({std::string(names_[cell]), std::string(entry("Y_Unit_Label", c)), {}});
    }
  }

  std::string_view entry(const char* key, std::size_t channel) const {
    const auto found = entries_.find(key);
    return found == entries_.end() || channel >= found->second.size() ? std::string_view() : found->second[channel];
  }

  std::optional<double> number_of_entry(const char* key, std::size_t channel) const {
    return cell_number(entry(key, channel), form_.decimal);
  }

  void rows() {
    LookUp look_up;
    for (; at_ < lines_.size(); ++at_) {
      if ((at_ & 1023) == 0) look_up();
      if (without_blanks(lines_[at_]).empty()) continue;
      const Cells list = cells(at_);
      if (entries_.contains(std::string(list.front())) || list.front() == "Channels")
        refuse("second_table", at_, "a second segment begins here",
               "keep one recording in each file: save segments apart, or cut the file before this line");
      if (list.size() <= cells_of_.front()) refuse("row_length", at_, "this row has no sample", "the file is damaged");
      for (std::size_t c = 0; c < channels_; ++c)
        table_.columns[c].values.push_back(value(cells_of_[c] < list.size() ? list[cells_of_[c]] : std::string_view()));
      if (x_columns_ != "no") x_.push_back(value(list.front()));
      table_.lines.push_back(static_cast<int>(at_) + 1);
    }
  }

  double value(std::string_view cell) const {
    if (const auto number = cell_number(cell, form_.decimal)) return is_overload(*number) ? no_value : *number;
    if (says_no_value(cell) || says_overload(cell)) return no_value;
    throw Error(
        Fault::input,
        {{"bad_number", table_.file, fmt::format("a cell holds \"{}\", a number was expected", cell.substr(0, 40)),
          "take the row out, or cut the recording there", table_.file, static_cast<int>(at_) + 1}});
  }

  void times() {
    for (std::size_t c = 1; c < channels_; ++c)
      for (const char* key : {"X0", "Delta_X"})
        if (number_of_entry(key, c) != number_of_entry(key, 0))
          refuse("ambiguous_time", 0,
                 fmt::format("channel {} has another {} than the first", table_.columns[c].name, key),
                 "export channels that were sampled together into one file, and the others into files of their own");
    if (x_columns_ != "no") {
      table_.time = 0;
      table_.columns.insert(table_.columns.begin(), MeasuredColumn{"X_Value", "s", std::move(x_)});
    } else if (const auto interval = number_of_entry("Delta_X", 0); interval && *interval > 0) {
      table_.clock = SampleClock{number_of_entry("X0", 0).value_or(0), *interval};
    }
  }

  MeasuredTable table_;
  std::string text_;
  std::vector<std::string_view> lines_;
  std::size_t at_ = 0;
  CellForm form_{'\t', '.'};
  std::string x_columns_ = "one";
  std::map<std::string, Cells> entries_;
  Cells names_;
  std::size_t channels_ = 0;
  std::vector<std::size_t> cells_of_;  ///< where each channel stands in a row
  std::vector<double> x_;
};

}  // namespace

bool is_lvm(std::string_view bytes) { return decoded(bytes.substr(0, 64)).text.starts_with("LabVIEW Measurement"); }

MeasuredTable read_lvm(const std::string& file, const ReadingChoices&) { return LvmReader(file).read(); }

}  // namespace hysteron
