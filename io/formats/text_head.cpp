#include "io/formats/text_head.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "engine/diagram/error.h"
#include "engine/diagram/units.h"
#include "io/formats/instrument_unit.h"

namespace hysteron {
namespace {

using Cells = std::vector<std::string_view>;

constexpr std::size_t lines_of_settings = 100;  // beside a table; the oldest layouts have 18

std::string_view without_mark(std::string_view text) {  // of a comment
  while (!text.empty() && (text.front() == '#' || text.front() == '%')) text.remove_prefix(1);
  return without_blanks(text);
}

/// "Sample Interval:" as "sample interval".
std::string key_of(std::string_view text) {
  text = without_mark(text);
  while (!text.empty() && (text.back() == ':' || text.back() == '=' || text.back() == ' ')) text.remove_suffix(1);
  std::string key = lower_case_of(heading_of(text).name);
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

// What instruments call them; the first that is there counts.
constexpr const char* interval_keys[] = {"sample interval",
                                         "sampling interval",
                                         "sample period",
                                         "sampling period",
                                         "xinc",
                                         "x increment",
                                         "xincrement",
                                         "xincr",
                                         "increment",
                                         "tinc",
                                         "delta t",
                                         "delta x",
                                         "dt",
                                         "dx",
                                         "time interval",
                                         "time increment",
                                         "interval",
                                         "abtastzeit",
                                         "horizontal interval",
                                         "abtastintervall"};
constexpr const char* rate_keys[] = {"sample rate",        "sampling rate", "samplerate", "sample frequency", "fs",
                                     "sampling frequency", "scan rate",     "abtastrate", "abtastfrequenz"};
constexpr const char* start_keys[] = {"xorg", "xorigin", "x origin", "xstart", "xzero", "t0", "x0", "start"};

using Keys = std::span<const char* const>;

bool is_any(const std::string& key, Keys keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const char* k) { return key == k; });
}

/// A setting: its key with all that stands behind.
using Settings = std::map<std::string, std::vector<std::string>>;

class Head {
 public:
  Head(const std::string& file, const std::vector<std::string_view>& lines, const TextLayout& layout)
      : file_(file), lines_(lines), layout_(layout), columns_(layout.cells - layout.skipped) {}

  TextHead read(const std::vector<std::string>& names) {
    settings_above(layout_.begin);
    settings_beside();
    if (names.empty())
      name_columns();
    else
      for (const auto& name : names) head_.headings.push_back(heading_of(name));
    use_settings();
    return std::move(head_);
  }

 private:
  Cells cells(std::size_t line) const {
    Cells list;
    split_cells(without_mark(lines_[line]), layout_.form.separator, list);
    return list;
  }

  static std::size_t filled(const Cells& cells) {  // without the empty ones at the end
    std::size_t n = cells.size();
    while (n > 0 && cells[n - 1].empty()) --n;
    return n;
  }

  void add_setting(std::string_view key, std::vector<std::string> values) {
    const std::string name = key_of(key);
    const auto unit = heading_of(without_mark(key)).unit;
    if (!unit.empty() && values.size() == 1) values.front() += " " + unit;
    if (!name.empty() && !values.empty()) settings_.emplace(name, std::move(values));
  }

  /// "Sample Interval,0.001", "XInc: 1e-9", "#Sample rate: 8e+06Hz", "t0 = -0.005".
  void settings_of(const Cells& list) {
    std::vector<std::string> values;
    for (std::size_t i = 1; i < filled(list); ++i) values.emplace_back(list[i]);
    if (!values.empty()) add_setting(list.front(), std::move(values));
    for (const auto cell : list)
      if (const auto sign = cell.find_first_of("=:"); sign != cell.npos && sign > 0 && sign + 1 < cell.size())
        add_setting(cell.substr(0, sign), {std::string(without_blanks(cell.substr(sign + 1)))});
  }

  void settings_above(std::size_t end) {
    for (std::size_t i = 0; i < end; ++i) settings_of(cells(i));
  }

  /// Cells before the table, in its own lines.
  void settings_beside() {
    if (layout_.skipped == 0) return;
    for (std::size_t i = layout_.begin; i < std::min(lines_.size(), layout_.begin + lines_of_settings); ++i) {
      Cells list = cells(i);
      list.resize(std::min(list.size(), layout_.skipped));
      if (filled(list) > 0) settings_of(list);
    }
  }

  /// Lines above the table that say something, from the nearest on.
  std::vector<std::size_t> lines_above() const {
    std::vector<std::size_t> list;
    for (std::size_t i = layout_.begin; i > 0; --i)
      if (!without_mark(lines_[i - 1]).empty()) list.push_back(i - 1);
    return list;
  }

  /// The cells of a line as headings, if it has one for each column; cells behind them are settings.
  Cells heading_cells(std::size_t line) const {
    Cells list = cells(line);
    if (layout_.form.separator == ' ' && filled(list) != columns_) {  // names with blanks stand two blanks apart
      list.clear();
      const auto text = without_mark(lines_[line]);
      for (std::size_t begin = 0; begin < text.size();) {
        auto end = std::min(text.find("  ", begin), text.find('\t', begin));
        end = std::min(end, text.size());
        if (end > begin) list.push_back(without_blanks(text.substr(begin, end - begin)));
        begin = end + 1;
      }
      std::erase_if(list, [](std::string_view c) { return c.empty(); });
    }
    if (list.size() > layout_.skipped && layout_.skipped > 0 && filled(list) > columns_)
      list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(layout_.skipped));
    return list;
  }

  static bool is_setting(std::string_view cell) {
    const std::string key = key_of(cell.substr(0, cell.find('=')));
    return is_any(key, interval_keys) || is_any(key, start_keys) || is_any(key, rate_keys);
  }

  /// The names that a line gives to the columns: one each, empty ones at the end for columns that are always empty.
  bool names_columns(const Cells& list) const {
    const std::size_t n = filled(list);
    if (n == 0) return false;
    if (!std::any_of(list.begin(), list.end(), [&](std::string_view c) {
          return !c.empty() && !cell_number(c, layout_.form.decimal) && !clock_time(c);
        }))
      return false;  // numbers name nothing
    for (std::size_t i = columns_; i < n; ++i)
      if (!list[i].empty() && !is_setting(list[i]) && list[i] != "Comment") return false;
    return n + trailing_empty_ >= columns_;
  }

  bool is_unit_row(const Cells& units, const Cells& names) const {
    if (filled(names) < filled(units)) return false;
    bool any = false;
    for (std::size_t i = 0; i < filled(units); ++i) {
      if (units[i].empty() || is_counter_name(units[i])) continue;
      if (i < names.size() && is_setting(names[i])) continue;
      if (!looks_like_unit(units[i])) return false;
      any = true;
    }
    return any;
  }

  /// Cells at the end of each row that are always empty, as where each line ends with a separator.
  std::size_t count_trailing_empty() const {
    std::size_t least = columns_;
    Cells list;
    for (std::size_t i = layout_.begin; i < std::min(lines_.size(), layout_.begin + 100); ++i) {
      if (says_nothing(lines_[i])) continue;
      split_cells(lines_[i], layout_.form.separator, list);
      if (list.size() == layout_.cells) least = std::min(least, list.size() - filled(list));
    }
    return least;
  }

  void name_columns() {
    trailing_empty_ = count_trailing_empty();
    const auto above = lines_above();
    if (above.empty()) return name_without_header();
    Cells names = heading_cells(above[0]), units;
    std::size_t line = above[0];
    if (above.size() > 1) {
      const Cells higher = heading_cells(above[1]);
      if (is_unit_row(names, higher) && names_columns(higher)) {
        units = names;
        names = higher;
        line = above[1];
        head_.assumed.push_back(fmt::format("units from line {}", above[0] + 1));
      }
    }
    if (!names_columns(names)) {
      check_decimal_commas(names);
      return name_without_header();
    }
    if (line > 0) head_.assumed.push_back(fmt::format("{} line{} above the header", line, line == 1 ? "" : "s"));
    for (std::size_t i = 0; i < columns_; ++i) {
      Heading heading = i < names.size() ? heading_of(names[i]) : Heading{};
      if (i < units.size() && looks_like_unit(units[i]))
        heading.unit = std::string(without_blanks(units[i])), heading.has_unit = true;
      head_.headings.push_back(std::move(heading));
    }
    // Where the settings say how far apart the samples are, they stand beside the names: Start, Increment.
    for (std::size_t i = columns_ - trailing_empty_; i < names.size(); ++i)
      if (is_setting(names[i]) && names[i].find('=') == names[i].npos && above[0] != line) {
        const Cells values = cells(above[0]);
        if (i < values.size()) add_setting(names[i], {std::string(values[i])});
      }
  }

  /// Twice as many cells as names: commas between the columns, and in the numbers.
  void check_decimal_commas(const Cells& names) const {
    const std::size_t n = filled(names);
    if (layout_.form.separator != ',' || n < 2 || columns_ != 2 * n) return;
    throw Error(
        Fault::input,
        {{"ambiguous_decimal", file_,
          fmt::format("{} names stand above rows of {} cells: a comma separates the columns, and the decimals too", n,
                      columns_),
          "export it with another separator (\";\" or tabs) or with decimal points", file_,
          static_cast<int>(layout_.begin) + 1}});
  }

  /// The settings may still say what was recorded: "Source,CH1".
  void name_without_header() {
    const auto source = settings_.find("source");
    if (source == settings_.end() || layout_.skipped == 0 || columns_ - trailing_empty_ < 2) {
      throw Error(
          Fault::input,
          {{"no_header", file_,
            fmt::format("no line above the numbers names their {} column{}", columns_ - trailing_empty_,
                        columns_ - trailing_empty_ == 1 ? "" : "s"),
            "write a line of names above them, or say them with --names, such as --names \"t [s],u [V],y [um]\"", file_,
            static_cast<int>(layout_.begin) + 1}});
    }
    head_.headings.push_back({"t", "s", true});
    for (std::size_t i = 1; i < columns_; ++i)
      head_.headings.push_back({i <= source->second.size() ? source->second[i - 1] : "", "", false});
    head_.assumed.push_back("names from the settings of the instrument");
  }

  /// A number with its unit, in SI: "8e+06Hz", "0,001", "Analog:1e-9".
  std::optional<double> setting(Keys keys, const char* dimension) const {
    for (const char* key : keys) {
      const auto found = settings_.find(key);
      if (found == settings_.end()) continue;
      for (std::string text : found->second) {
        if (const auto colon = text.rfind(':'); colon != text.npos && !clock_time(text)) text = text.substr(colon + 1);
        if (layout_.form.decimal == ',') std::replace(text.begin(), text.end(), ',', '.');
        double number = 0;
        std::string unit;
        if (!split_quantity(without_blanks(text), number, unit)) continue;
        const auto known = instrument_unit(unit.empty()   ? dimension
                                           : unit == "Hz" ? "1/s"
                                                          : unit,
                                           "", dimension[0] == 's');
        if (known.answer != UnitAnswer::known) continue;
        try {
          const Unit read = parse_unit(known.unit.empty() ? dimension : known.unit);
          const Dimension plain = parse_unit(dimension).dimension;
          if (read.dimension == plain) return read.to_si(number);
          if (read.dimension == parse_unit("Hz").dimension && plain == parse_unit("1/s").dimension)
            return read.to_si(number);
        } catch (const Error&) {
          continue;
        }
      }
    }
    return {};
  }

  void use_settings() {
    auto interval = setting(interval_keys, "s");
    if (!interval)
      if (const auto rate = setting(rate_keys, "1/s"); rate && *rate > 0) interval = 1 / *rate;
    if (interval && *interval > 0) head_.clock = SampleClock{setting(start_keys, "s").value_or(0), *interval};
    const std::size_t first = !head_.headings.empty() && first_is_no_signal() ? 1 : 0;
    use_list("label", first, [](Heading& heading, const std::string& text) { heading.name = text; });
    for (const char* key : {"vertical units", "vertical unit", "y units", "y unit label"})
      use_list(key, first, [](Heading& heading, const std::string& text) {
        if (!heading.has_unit && looks_like_unit(text)) heading.unit = text, heading.has_unit = true;
      });
    const auto horizontal = settings_.find("horizontal units");
    if (horizontal != settings_.end() && first == 1 && !head_.headings[0].has_unit)
      head_.headings[0].unit = horizontal->second.front(), head_.headings[0].has_unit = true;
  }

  bool first_is_no_signal() const {
    const Heading& first = head_.headings.front();
    return is_time_name(first.name) || is_counter_name(first.name) ||
           instrument_unit(first.unit, "", true).unit == "s" || lower_case_of(first.name) == "source";
  }

  /// A setting that says one thing per channel: "Label,drive,sensor", "Vertical Units,CH1:V,CH2:V".
  template <class Use>
  void use_list(const char* key, std::size_t first, Use use) {
    const auto found = settings_.find(key);
    if (found == settings_.end()) return;
    bool used = false;
    for (std::size_t i = 0; i < found->second.size() && first + i < head_.headings.size(); ++i) {
      std::string text = found->second[i];
      if (const auto colon = text.rfind(':'); colon != text.npos) text = text.substr(colon + 1);
      if (without_blanks(text).empty()) continue;
      use(head_.headings[first + i], text);
      used = true;
    }
    if (used && std::string_view(key) == "label") head_.assumed.push_back("names from the labels of the channels");
  }

  const std::string& file_;
  const std::vector<std::string_view>& lines_;
  const TextLayout& layout_;
  std::size_t columns_;
  std::size_t trailing_empty_ = 0;
  Settings settings_;
  TextHead head_;
};

}  // namespace

TextHead head_of(const std::string& file, const std::vector<std::string_view>& lines, const TextLayout& layout,
                 const std::vector<std::string>& names) {
  return Head(file, lines, layout).read(names);
}

}  // namespace hysteron
