#include "tests/reference/diagram.h"

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

namespace reference {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

double one_unit(const std::string& name) {
  static const std::map<std::string, double> units = {{"", 1},      {"1", 1},     {"s", 1},
                                                      {"ms", 1e-3}, {"us", 1e-6}, {"Hz", 1},
                                                      {"kHz", 1e3}, {"rad", 1},   {"deg", std::numbers::pi / 180},
                                                      {"m", 1},     {"mm", 1e-3}, {"um", 1e-6},
                                                      {"nm", 1e-9}, {"ohm", 1},   {"H", 1},
                                                      {"N", 1},     {"mN", 1e-3}, {"kN", 1e3},
                                                      {"kg", 1},    {"g", 1e-3},  {"V", 1},
                                                      {"A", 1},     {"C", 1}};
  const auto power = name.find('^');
  const auto at = units.find(name.substr(0, power));
  if (at == units.end()) throw Unknown("unit " + name);
  return power == std::string::npos ? at->second : std::pow(at->second, std::stod(name.substr(power + 1)));
}

/// "N*s/m", "1/s".
double unit_factor(const std::string& text) {
  double factor = 1;
  bool over = true;
  std::string name;
  for (const char c : text + "*") {
    if (c != '*' && c != '/') {
      if (c != ' ') name += c;
      continue;
    }
    factor = over ? factor * one_unit(name) : factor / one_unit(name);
    name.clear();
    over = c == '*' ? over : false;
  }
  return factor;
}

double number_of(const Json& value, const Json& parameters) {
  if (value.is_number()) return value.get<double>();
  if (value.is_object()) return value.at("value").get<double>() * unit_factor(value.value("unit", std::string()));
  const auto text = value.get<std::string>();
  if (text.starts_with("$")) return number_of(parameters.at(text.substr(1)), parameters);
  std::size_t used = 0;
  const double number = std::stod(text, &used);
  return number * unit_factor(text.substr(used));
}

bool is_number_text(const std::string& text) {
  if (text.starts_with("$")) return true;
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end != text.c_str() && !(std::isalpha(end[-1]) != 0 && std::isalpha(*end) != 0);  // "nand"
}

/// t and one column of a CSV file.
void read_column(Block& block, const fs::path& file) {
  std::ifstream in(file);
  std::string line, cell;
  std::getline(in, line);
  std::istringstream head(line);
  int column = -1;
  for (int i = 0; std::getline(head, cell, ','); ++i)
    if (cell.substr(0, cell.find(' ')) == block.texts.at("column")) column = i;
  if (column < 0) throw Unknown("no column in " + file.string());
  while (std::getline(in, line)) {
    std::istringstream row(line);
    for (int i = 0; std::getline(row, cell, ','); ++i) {
      if (i == 0) block.instants.push_back(std::stod(cell));
      if (i == column) block.samples.push_back(std::stod(cell));
    }
  }
}

class Reader {
 public:
  FlatDiagram read(const fs::path& file) {
    const Json json = parsed(file);
    open(json, file, "", {});
    for (const auto& name : json.at("record")) flat.record.push_back(signal(name.get<std::string>(), "", {}));
    flat.until = number_of(json.at("simulate").at("until"), {});
    flat.every = number_of(json.at("simulate").at("every"), {});
    for (auto& block : flat.blocks)
      for (auto& wire : block.in) wire.second = resolved(wire.second);
    for (auto& name : flat.record) name = resolved(name);
    return flat;
  }

 private:
  using Wires = std::map<std::string, std::string>;  ///< input of a nested diagram: the signal outside

  static Json parsed(const fs::path& file) {
    std::ifstream in(file);
    if (!in) throw Unknown("no file " + file.string());
    return Json::parse(in);
  }

  static std::string signal(const std::string& name, const std::string& prefix, const Wires& outside) {
    const auto at = outside.find(name);
    return at == outside.end() ? prefix + name : at->second;
  }

  static std::vector<std::pair<std::string, std::string>> wires_of(const Json& in, const std::string& prefix,
                                                                   const Wires& outside) {
    std::vector<std::pair<std::string, std::string>> wires;
    if (in.is_string()) wires.emplace_back("", signal(in.get<std::string>(), prefix, outside));
    if (in.is_array())
      for (const auto& one : in) wires.emplace_back("", signal(one.get<std::string>(), prefix, outside));
    if (in.is_object())
      for (const auto& [port, one] : in.items())
        wires.emplace_back(port, signal(one.get<std::string>(), prefix, outside));
    return wires;
  }

  void open(const Json& json, const fs::path& file, const std::string& prefix, const Wires& outside,
            const Json& given = Json::object()) {
    Json parameters = json.value("parameters", Json::object());
    for (const auto& [name, value] : given.items()) parameters[name] = value;
    for (const auto& [name, written] : json.at("blocks").items()) {
      Json block = written;
      if (block.contains("choose")) {
        Json candidate = block.at("from").at(block.at("choose").get<std::string>());
        if (block.contains("in") && !candidate.contains("in")) candidate["in"] = block["in"];
        block = candidate;
      }
      const auto wires = wires_of(block.value("in", Json()), prefix, outside);
      if (block.at("type") == "diagram")
        nested(block, file, prefix + name, wires, parameters);
      else
        flat.blocks.push_back(plain(block, file, prefix + name, wires, parameters));
    }
  }

  void nested(const Json& block, const fs::path& file, const std::string& name,
              const std::vector<std::pair<std::string, std::string>>& wires, const Json& parameters) {
    const fs::path inner = file.parent_path() / block.at("file").get<std::string>();
    const Json json = parsed(inner);
    Wires inside;
    std::size_t place = 0;
    const Json inputs = json.value("inputs", Json::object());
    for (const auto& [input, declared] : inputs.items()) {
      for (std::size_t i = 0; i < wires.size(); ++i)
        if (wires[i].first == input || (wires[i].first.empty() && i == place)) inside[input] = wires[i].second;
      ++place;
    }
    Json given = Json::object();
    for (const auto& [key, value] : block.items())
      if (key != "type" && key != "file" && key != "in") given[key] = number_of(value, parameters);
    open(json, inner, name + "/", inside, given);
    const Json outputs = json.value("outputs", Json::object());
    for (const auto& [output, from] : outputs.items()) {
      const std::string source = signal(from.get<std::string>(), name + "/", inside);
      alias[name + "." + output] = source;
      if (outputs.size() == 1) alias[name] = source;
    }
  }

  static Block plain(const Json& json, const fs::path& file, const std::string& name,
                     std::vector<std::pair<std::string, std::string>> wires, const Json& parameters) {
    Block block{name, json.at("type"), std::move(wires)};
    for (const auto& [key, value] : json.items()) {
      if (key == "type" || key == "in") continue;
      if (value.is_array()) {
        auto& list = block.numbers[key];
        for (const auto& one : value)
          if (one.is_array())  // a row of a matrix
            for (const auto& cell : one) list.push_back(number_of(cell, parameters));
          else
            list.push_back(number_of(one, parameters));
      } else if (value.is_string() && (key == "signs" || !is_number_text(value.get<std::string>()))) {
        block.texts[key] = value.get<std::string>();
      } else {
        block.numbers[key] = {number_of(value, parameters)};
      }
    }
    if (block.type == "recorded") read_column(block, file.parent_path() / block.texts.at("file"));
    return block;
  }

  std::string resolved(std::string name) const {
    for (auto at = alias.find(name); at != alias.end(); at = alias.find(name)) name = at->second;
    return name;
  }

  FlatDiagram flat{};
  std::map<std::string, std::string> alias{};
};

}  // namespace

FlatDiagram read_flat(const std::string& file) { return Reader().read(file); }

double Block::number(const std::string& key) const {
  const auto at = numbers.find(key);
  if (at == numbers.end()) throw Unknown(name + " has no " + key);
  return at->second.at(0);
}

double Block::number(const std::string& key, double otherwise) const {
  const auto at = numbers.find(key);
  return at == numbers.end() ? otherwise : at->second.at(0);
}

const std::vector<double>& Block::list(const std::string& key) const {
  const auto at = numbers.find(key);
  if (at == numbers.end()) throw Unknown(name + " has no " + key);
  return at->second;
}

std::string Block::text(const std::string& key, const std::string& otherwise) const {
  const auto at = texts.find(key);
  return at == texts.end() ? otherwise : at->second;
}

LawPointer make_law(const Block& block) {
  for (const auto make : {make_source, make_static, make_math, make_logic, make_hysteresis, make_linear, make_integral,
                          make_body, make_drive, make_machine, make_sampled})
    if (LawPointer law = make(block)) return law;
  throw Unknown("block type " + block.type);
}

}  // namespace reference
