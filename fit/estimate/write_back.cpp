// Where a fitted number goes: into the diagram value, and into a parameter file.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/diagram/number_text.h"
#include "fit/estimate/fit.h"

namespace hysteron {
namespace {

double shown(const Unit& unit, bool difference, double si) {
  return difference ? unit.difference_from_si(si) : unit.from_si(si);
}

/// Place of a number in a list (column) or a matrix.
struct Index {
  int row = -1, column = -1;  ///< -1: none
};

/// Splits "core.weights[2]" and "coupling.matrix[0][1]" into name and index.
std::pair<std::string, Index> without_index(const std::string& path) {
  if (path.empty() || path.back() != ']') return {path, {}};
  const auto open = path.rfind('[');
  Index index{-1, leading_whole_number(path.substr(open + 1), 0)};
  if (open == 0 || path[open - 1] != ']') return {path.substr(0, open), index};
  const auto first = path.rfind('[', open - 1);
  index.row = leading_whole_number(path.substr(first + 1), 0);
  return {path.substr(0, first), index};
}

/// Puts a number into a value, keeping the unit that was written there.
void put(Value& value, Index index, double number, const Unit& unit, bool worked_out) {
  Number* old = std::get_if<Number>(&value.content);
  auto* list = std::get_if<NumberList>(&value.content);
  if (auto* matrix = std::get_if<NumberMatrix>(&value.content); matrix != nullptr && index.row >= 0) {
    if (static_cast<std::size_t>(index.row) >= matrix->rows.size()) return;
    list = &matrix->rows[static_cast<std::size_t>(index.row)];
  }
  if (list != nullptr && index.column >= 0) {
    if (static_cast<std::size_t>(index.column) >= list->size()) return;
    old = &(*list)[static_cast<std::size_t>(index.column)];
  }
  if (old == nullptr) {
    value = Value(Number{});
    old = std::get_if<Number>(&value.content);
    worked_out = true;
  }
  old->value = number;
  if (worked_out && !old->unit && !unit.text.empty())
    old->unit = unit.text;  // a plain zero needed none, this number does
}

class Writer {
 public:
  Writer(const ParameterInfo& info, const Unit& unit, double number,
         std::vector<std::pair<std::string, Diagram>>* nested)
      : info_(info), unit_(unit), number_(number), nested_(nested) {}

  void write(Diagram& diagram, const std::string& path) const {
    const auto slash = path.find('/');
    if (slash != std::string::npos) return write_nested(diagram, path.substr(0, slash), path.substr(slash + 1));
    const auto [name, index] = without_index(path);
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) {
      DiagramParameter* parameter = diagram.parameters.find(name);
      if (parameter == nullptr) lost();
      return put_here(parameter->value, index);
    }
    Node* node = body(diagram, name.substr(0, dot));
    write_at(*node, name.substr(dot + 1), index);
  }

 private:
  void put_here(Value& value, Index index) const { put(value, index, number_, unit_, info_.unit.text.empty()); }

  [[noreturn]] void lost() const {
    fail("unknown_parameter", info_.path, fmt::format("the diagram has no place for \"{}\"", info_.path),
         "write the value by hand");
  }

  Node* body(Diagram& diagram, const std::string& block) const {
    Node* node = diagram.blocks.find(block);
    if (node != nullptr && !node->from.empty()) node = node->from.find(node->choose);
    if (node == nullptr) lost();
    return node;
  }

  void write_at(Node& node, const std::string& parameter, Index index) const {
    if (node.parameters.find(parameter) == nullptr)
      if (const Value* from_file = node.parameters_from_file.find(parameter))
        node.parameters[parameter] = *from_file;  // the set keeps its own value, this block gets another
    put_here(node.parameters[parameter], index);
  }

  void write_nested(Diagram& diagram, const std::string& block, const std::string& rest) const {
    Node* node = body(diagram, block);
    if (!node->nested) lost();
    const auto [name, index] = without_index(rest);
    if (name.find('.') == std::string::npos && name.find('/') == std::string::npos) {
      // A parameter of the nested diagram is given where the diagram is used; its file stays as it is.
      if (node->parameters.find(name) == nullptr)
        if (const DiagramParameter* inner = node->nested->parameters.find(name)) node->parameters[name] = inner->value;
      return put_here(node->parameters[name], index);
    }
    auto copy = std::make_shared<Diagram>(*node->nested);
    write(*copy, rest);
    if (nested_ != nullptr) rename(*node, *copy);
    node->nested = std::move(copy);
  }

  void rename(Node& node, Diagram& copy) const {
    const auto new_name = [](const std::string& file) {
      const std::filesystem::path p(file);
      const std::string stem = p.stem().string();
      if (stem.size() >= 7 && stem.ends_with("_fitted")) return file;
      return (p.parent_path() / (stem + "_fitted" + p.extension().string())).generic_string();
    };
    node.file = new_name(node.file);
    if (!copy.file.empty()) copy.file = new_name(copy.file);
    for (auto& [file, content] : *nested_)
      if (file == node.file) {
        content = copy;
        return;
      }
    nested_->emplace_back(node.file, copy);
  }

  const ParameterInfo& info_;
  const Unit& unit_;
  double number_;
  std::vector<std::pair<std::string, Diagram>>* nested_;
};

/// Where a setting gave a value without a unit one, plain bounds beside it would be read in that unit: they get it too.
void keep_bounds(Diagram& diagram, const Program& program) {
  for (auto& [name, parameter] : diagram.parameters) {
    const auto* number = std::get_if<Number>(&parameter.value.content);
    const ParameterInfo* info = program.find_parameter(name);
    if (info == nullptr) info = program.find_parameter(name + "[0]");  // one number where a block takes a list
    if (!was_set(parameter.value.origin) || number == nullptr || !number->unit || info == nullptr) continue;
    const auto keep = [&](std::optional<Number>& bound, double si) {
      if (bound && !bound->unit)
        bound = Number{rounded_to_digits(shown(info->unit, info->difference, si), 12), number->unit};
    };
    keep(parameter.lower, info->lower);
    keep(parameter.upper, info->upper);
  }
}

}  // namespace

Diagram with_parameters(const Diagram& diagram, const Program& program, const std::vector<ParameterValue>& values,
                        int digits, std::vector<std::pair<std::string, Diagram>>* nested) {
  Diagram result = diagram;
  for (const auto& v : values) {
    if (v.recording >= 0) continue;  // a diagram knows no recordings
    const auto& info = program.parameters[static_cast<std::size_t>(v.parameter)];
    const Unit unit = parameter_unit(program, info);
    Writer(info, unit, rounded_to_digits(shown(unit, info.difference, v.value), digits), nested)
        .write(result, info.path);
  }
  keep_bounds(result, program);
  return result;
}

namespace {

using Json = nlohmann::ordered_json;

double shown(const ParameterEstimate& e, double si, int digits) {
  return rounded_to_digits(shown(e.unit, e.difference, si), digits);
}

/// What a fit knows of one number, in words.
std::string knowledge(const ParameterEstimate& e) {
  if (!e.determined) return e.path + " is not determined by the data: this is its start value";
  if (e.at_lower || e.at_upper)
    return fmt::format("{} is held at its {} bound", e.path, e.at_lower ? "lower" : "upper");
  if (!e.low95 || !e.high95) return "";
  return fmt::format("{}: 95 % within {} .. {} {}", e.path, shown(e, *e.low95, 6), shown(e, *e.high95, 6), e.unit.text);
}

/// All elements of a list or matrix, those that were not fitted as they stand in the program: a block takes it only as
/// a whole.
Json list_value(const std::string& name, const std::vector<ParameterEstimate>& estimates, const Program& program,
                std::string& remark, std::string& unit) {
  Json values = Json::array();
  Json stds = Json::array();
  for (const auto& info : program.parameters) {
    const auto [own_name, index] = without_index(info.path);
    if (own_name != name) continue;
    const ParameterEstimate* fitted = nullptr;
    for (const auto& e : estimates)
      if (e.path == info.path) fitted = &e;
    const Unit own = parameter_unit(program, info);
    unit = own.text;
    const auto row = static_cast<std::size_t>(std::max(index.row, 0));
    if (index.row >= 0 && values.size() <= row) {
      values.push_back(Json::array());
      stds.push_back(Json::array());
    }
    (index.row >= 0 ? values[row] : values)
        .push_back(rounded_to_digits(shown(own, info.difference, fitted != nullptr ? fitted->used : info.value), 8));
    (index.row >= 0 ? stds[row] : stds)
        .push_back(fitted != nullptr && fitted->sigma
                       ? Json(rounded_to_digits(own.difference_from_si(*fitted->sigma), 4))
                       : Json());
    if (fitted == nullptr) continue;
    if (const auto known = knowledge(*fitted); !known.empty()) remark += (remark.empty() ? "" : "; ") + known;
  }
  return {{"value", std::move(values)}, {"unit", unit}, {"std", std::move(stds)}};
}

/// "core." if everything that was fitted belongs to that block: then it can name the file as its parameter set.
std::string common_block(const FitResult& result) {
  std::string prefix;
  for (const auto& e : result.estimates) {
    if (e.recording >= 0) continue;
    const auto dot = e.path.rfind('.');
    const std::string block = dot == std::string::npos ? "" : e.path.substr(0, dot + 1);
    if (block.empty() || (!prefix.empty() && block != prefix)) return "";
    prefix = block;
  }
  return prefix;
}

/// What a reader of the file wants to know of the fit: from what, how, when; and the values of single recordings.
Json origin_json(const FitResult& result, const DataSet& data, const FitOrigin& origin) {
  Json json;
  if (!origin.diagram.empty()) json["diagram"] = origin.diagram;
  json["data"] = !origin.data.empty() ? origin.data : data.file.empty() ? data.title : data.file;
  json["method"] = result.method;
  json["seed"] = origin.seed;
  if (!origin.date.empty()) json["date"] = origin.date;
  json["error_over_noise"] = rounded_to_digits(std::sqrt(result.s2), 4);
  for (const auto& e : result.estimates) {
    if (e.recording < 0 || !e.value) continue;
    Json one{{"value", shown(e, *e.value, 8)}, {"unit", e.unit.text}};
    if (e.sigma) one["std"] = rounded_to_digits(e.unit.difference_from_si(*e.sigma), 4);
    json["recordings"][data.recordings[static_cast<std::size_t>(e.recording)].name][e.path] = std::move(one);
  }
  return json;
}

}  // namespace

std::string parameter_file_text(const FitResult& result, const Program& program, const DataSet& data,
                                const FitOrigin& origin) {
  Json file = {{"format", 1},
               {"title", "fitted parameters"},
               {"source", fmt::format("fit of {} by {}", data.file.empty() ? data.title : data.file, result.method)}};
  std::string undetermined;
  for (const auto& u : result.undetermined) undetermined += (undetermined.empty() ? "" : "; ") + u.sentence;
  if (!undetermined.empty()) file["remark"] = undetermined;
  file["fit"] = origin_json(result, data, origin);
  const std::string block = common_block(result);
  for (const auto& e : result.estimates) {
    if (e.recording >= 0) continue;
    const auto [name, index] = without_index(e.path);
    const std::string key = name.substr(block.size());
    if (file.contains(key)) continue;
    std::string remark, unit = e.unit.text;
    Json one;
    if (index.column >= 0) {
      one = list_value(name, result.estimates, program, remark, unit);
    } else if (e.value) {  // what the data do not determine has no value
      one = {{"value", shown(e, *e.value, 8)}, {"unit", unit}};
      if (e.sigma) one["std"] = rounded_to_digits(e.unit.difference_from_si(*e.sigma), 4);
      remark = knowledge(e);
    } else {
      continue;
    }
    if (unit.empty()) one.erase("unit");
    if (!remark.empty()) one["remark"] = remark;
    file[key] = std::move(one);
  }
  return file.dump(2) + "\n";
}

}  // namespace hysteron
