// Decides how a workbook (xlsx, ISO/IEC 29500) is read: the cells of one sheet as a text of tabs, which is then read as
// any other (delimited_text.h). Formulas count by the values that were saved with them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "io/files/zip_archive.h"
#include "io/formats/cells.h"
#include "io/formats/delimited_text.h"
#include "io/formats/file_format.h"

namespace hysteron {
namespace {

constexpr std::size_t most_columns = 16384, most_rows = 1 << 20;  // of a sheet

class Workbook : public ZipArchive {
 public:
  explicit Workbook(const std::string& file)
      : ZipArchive(file, {"workbook", "open it in a spreadsheet and save it again, or save it as CSV"}) {}

  pugi::xml_document xml(const std::string& name) const {
    pugi::xml_document document;
    const std::string text = part(name);
    if (!document.load_buffer(text.data(), text.size())) damaged(name + " is no XML");
    return document;
  }
};

/// "xl/worksheets/sheet1.xml", seen from "xl/workbook.xml".
std::string resolved(const std::string& target) {
  return target.starts_with('/') ? target.substr(1)
                                 : std::filesystem::path("xl/" + target).lexically_normal().generic_string();
}

/// The file of the sheet that the user names, else of the first.
std::string sheet_part(const Workbook& archive, const std::string& file, const std::string& wanted, std::string& name) {
  const auto book = archive.xml("xl/workbook.xml");
  std::vector<std::string> names;
  std::string id;
  for (const auto sheet : book.child("workbook").child("sheets").children("sheet")) {
    names.emplace_back(sheet.attribute("name").value());
    if (!id.empty() || (!wanted.empty() && names.back() != wanted)) continue;
    id = sheet.attribute("r:id").value();
    name = names.back();
  }
  if (id.empty() && !wanted.empty())
    throw Error(Fault::input, {{"missing_column", "--sheet", fmt::format("there is no sheet \"{}\"", wanted),
                                did_you_mean(wanted, names), file, 0}});
  const auto links = archive.xml("xl/_rels/workbook.xml.rels");
  for (const auto link : links.child("Relationships").children("Relationship"))
    if (id == link.attribute("Id").value()) return resolved(link.attribute("Target").value());
  archive.damaged("it has no sheet");
}

std::string text_of(const pugi::xml_node& node) {  // of <si> or <is>: one run, or several
  std::string text = node.child("t").text().get();
  for (const auto run : node.children("r")) text += run.child("t").text().get();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// 27 of "AB12", counted from 0.
std::optional<std::size_t> column_of(std::string_view reference) {
  std::size_t column = 0;
  std::size_t letters = 0;
  for (; letters < reference.size() && reference[letters] >= 'A' && reference[letters] <= 'Z'; ++letters) {
    column = 26 * column + static_cast<std::size_t>(reference[letters] - 'A' + 1);
    if (column > most_columns) return {};
  }
  return letters == 0 ? std::nullopt : std::optional(column - 1);
}

/// Which styles show a number as a date or a time of day.
std::vector<bool> time_styles(const Workbook& archive) {
  std::vector<bool> is_time;
  if (!archive.has("xl/styles.xml")) return is_time;
  const auto styles = archive.xml("xl/styles.xml");
  std::map<int, bool> formats;
  for (const auto format : styles.child("styleSheet").child("numFmts").children("numFmt")) {
    std::string code = lower_case_of(format.attribute("formatCode").value());
    for (auto open = code.find('['); open != code.npos; open = code.find('['))  // colours, elapsed hours
      code.erase(open, std::min(code.find(']', open), code.size() - 1) - open + 1);
    formats[format.attribute("numFmtId").as_int()] =
        code.find_first_of("hsy") != code.npos || code.find("mm") != code.npos || code.find('d') != code.npos;
  }
  for (const auto style : styles.child("styleSheet").child("cellXfs").children("xf")) {
    const int id = style.attribute("numFmtId").as_int();
    const auto own = formats.find(id);
    is_time.push_back(own != formats.end() ? own->second : (id >= 14 && id <= 22) || (id >= 45 && id <= 47));
  }
  return is_time;
}

/// A day number as a date and time of day; the fraction is good to about a microsecond.
std::string clock_text(double days) {
  const double whole = std::floor(days);
  std::int64_t us = std::llround((days - whole) * 86'400e6);
  std::int64_t z =
      static_cast<std::int64_t>(whole) - 25569 + 719468;  // from 1899-12-30 to the era that begins in March
  if (us >= 86'400'000'000) us -= 86'400'000'000, ++z;
  const std::int64_t era = (z >= 0 ? z : z - 146096) / 146097, day = z - era * 146097;
  const std::int64_t year = (day - day / 1460 + day / 36524 - day / 146096) / 365;
  const std::int64_t of_year = day - (365 * year + year / 4 - year / 100), month = (5 * of_year + 2) / 153;
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}.{:06}", year + era * 400 + (month >= 10 ? 1 : 0),
                     month < 10 ? month + 3 : month - 9, of_year - (153 * month + 2) / 5 + 1, us / 3'600'000'000,
                     us / 60'000'000 % 60, us / 1'000'000 % 60, us % 1'000'000);
}

class Sheet {
 public:
  explicit Sheet(const Workbook& archive) : archive_(archive), is_time_(time_styles(archive)) {
    if (!archive.has("xl/sharedStrings.xml")) return;
    const auto shared = archive.xml("xl/sharedStrings.xml");
    for (const auto text : shared.child("sst").children("si")) texts_.push_back(text_of(text));
  }

  /// Its rows as lines of tabs; empty rows stay, so that lines are rows.
  std::string text(const pugi::xml_document& sheet) {
    std::string lines;
    std::size_t row = 0;
    for (const auto node : sheet.child("worksheet").child("sheetData").children("row")) {
      const auto number = static_cast<std::size_t>(node.attribute("r").as_ullong(row + 1));
      if (number > most_rows) archive_.damaged("it has a row beyond the last one that a sheet has");
      for (; row + 1 < number; ++row) lines += '\n';
      lines += line(node);
      ++row;
    }
    return lines;
  }

 private:
  std::string line(const pugi::xml_node& row) {
    std::vector<std::string> cells;
    for (const auto cell : row.children("c")) {
      const auto at = column_of(cell.attribute("r").value());
      const std::size_t column = at ? *at : cells.size();
      if (column >= most_columns) archive_.damaged("it has a column beyond the last one that a sheet has");
      if (column >= cells.size()) cells.resize(column + 1);
      cells[column] = content(cell);
    }
    return fmt::format("{}\n", fmt::join(cells, "\t"));
  }

  std::string content(const pugi::xml_node& cell) const {
    const std::string_view type = cell.attribute("t").value();
    const std::string value = cell.child("v").text().get();
    if (type == "inlineStr") return text_of(cell.child("is"));
    if (type == "s") {
      const int index = leading_whole_number(value, -1);
      return index >= 0 && static_cast<std::size_t>(index) < texts_.size() ? texts_[static_cast<std::size_t>(index)]
                                                                           : "";
    }
    if (type == "e") return "NaN";  // #DIV/0!
    const auto style = static_cast<std::size_t>(cell.attribute("s").as_uint());
    const auto number = number_of(value);
    const bool is_clock = type.empty() && style < is_time_.size() && is_time_[style];
    return is_clock && number && *number >= 0 && *number < 1e5 ? clock_text(*number) : value;
  }

  const Workbook& archive_;
  std::vector<bool> is_time_;
  std::vector<std::string> texts_;
};

}  // namespace

bool is_xlsx(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04") &&
         (bytes.find("[Content_Types].xml") != bytes.npos || bytes.find("xl/") != bytes.npos ||
          bytes.find("_rels/.rels") != bytes.npos);
}

MeasuredTable read_xlsx(const std::string& file, const ReadingChoices& choices) {
  const Workbook archive(file);
  if (!archive.has("xl/workbook.xml")) {  // a document of another kind in the same kind of archive
    const KnownFile known = known_file("PK\x03\x04", file);
    throw Error(Fault::input,
                {{"unknown_file_type", file, fmt::format("this is {}, not a recording that hysteron reads", known.what),
                  known.cure, file, 0}});
  }
  std::string name;
  const std::string part = sheet_part(archive, file, choices.sheet, name);
  const std::string text = Sheet(archive).text(archive.xml(part));
  ReadingChoices of_text = choices;
  of_text.decimal = "point";  // numbers stand so in the file, whatever the spreadsheet shows
  MeasuredTable table = read_delimited_text(file, text, of_text);
  std::erase_if(table.assumed, [](const std::string& fact) { return fact.starts_with("separated by"); });
  table.assumed.insert(table.assumed.begin(), fmt::format("sheet \"{}\" of a workbook", name));
  return table;
}

}  // namespace hysteron
