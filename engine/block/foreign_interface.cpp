#include "engine/block/foreign_interface.h"

#include <fmt/format.h>

#include <sstream>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"

namespace hysteron {
namespace {

/// Fields end with a tab, lines with a line end: neither stands in one.
std::string field(std::string text) {
  for (char& c : text)
    if (c == '\t' || c == '\n') c = ' ';
  return text;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> list;
  std::size_t begin = 0;
  for (auto tab = line.find('\t'); tab != std::string::npos; tab = line.find('\t', begin)) {
    list.push_back(line.substr(begin, tab - begin));
    begin = tab + 1;
  }
  list.push_back(line.substr(begin));
  return list;
}

[[noreturn]] void refuse() {
  fail("bad_value", "/interface", "\"interface\" is made from the file and cannot be written",
       "take it out and name the file: \"file\": \"drive.fmu\"");
}

double number(const std::string& text) {
  const auto value = number_of(text);
  if (!value) refuse();
  return *value;
}

constexpr std::size_t head_fields = 5, variable_fields = 6;

}  // namespace

std::string foreign_interface_text(const ForeignInterface& i) {
  std::string text =
      fmt::format("{}\t{}\t{}\t{}\t{}", i.version, field(i.file), field(i.token), field(i.binary), field(i.resources));
  const auto put = [&](char kind, const std::vector<ForeignVariable>& list) {
    for (const auto& v : list)
      text +=
          fmt::format("\n{}\t{}\t{}\t{}\t{}\t{}", kind, field(v.port), v.reference, field(v.unit), v.scale, v.offset);
  };
  put('i', i.inputs), put('o', i.outputs), put('p', i.parameters);
  return text;
}

ForeignInterface foreign_interface(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const auto head = fields_of(line);
  if (head.size() != head_fields) refuse();
  ForeignInterface i;
  i.version = static_cast<int>(number(head[0]));
  i.file = head[1], i.token = head[2], i.binary = head[3], i.resources = head[4];
  while (std::getline(in, line)) {
    const auto f = fields_of(line);
    if (f.size() != variable_fields || f[0].size() != 1) refuse();
    auto& list = f[0] == "i" ? i.inputs : f[0] == "o" ? i.outputs : i.parameters;
    list.push_back({f[1], static_cast<unsigned>(number(f[2])), f[3], number(f[4]), number(f[5])});
  }
  return i;
}

}  // namespace hysteron
