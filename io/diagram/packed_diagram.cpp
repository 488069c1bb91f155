#include "io/diagram/packed_diagram.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "engine/diagram/error.h"
#include "engine/diagram/unit_table.h"
#include "engine/program/program.h"
#include "io/files/digest.h"
#include "io/fmi/fmi_variables.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

constexpr int version_of_packing = 1;

/// The members of a structure, once for both ways: `io(key, member)` writes or reads one.
template <class Io, class T>
void members(Io&& io, T& d) requires(std::is_same_v<std::remove_const_t<T>, Diagram>) {
  io("title", d.title), io("parameters", d.parameters), io("inputs", d.inputs), io("blocks", d.blocks);
  io("outputs", d.outputs), io("record", d.record), io("places", d.places), io("simulate", d.simulate);
}
template <class Io, class T>
void members(Io&& io, T& n) requires(std::is_same_v<std::remove_const_t<T>, Node>) {
  io("type", n.type), io("parameters", n.parameters), io("in", n.in), io("at", n.origin), io("choose", n.choose);
  io("from", n.from), io("effect", n.effect), io("upon", n.upon), io("file", n.file), io("nested", n.nested);
  io("runs", n.runs), io("set", n.parameter_file), io("of_set", n.parameters_from_file);
}
template <class Io, class T>
void members(Io&& io, T& s) requires(std::is_same_v<std::remove_const_t<T>, SimulateSettings>) {
  io("until", s.until), io("every", s.every), io("method", s.method), io("relative", s.relative_tolerance);
  io("absolute", s.absolute_tolerance), io("max_step", s.max_step), io("step", s.step), io("loops", s.loops);
  io("start", s.start), io("past", s.past), io("memory", s.memory), io("guess", s.guess);
}
template <class Io, class T>
void members(Io&& io, T& r) requires(std::is_same_v<std::remove_const_t<T>, RunsWhen>) {
  io("enable", r.enable), io("resets", r.resets_states), io("zeroes", r.zeroes_outputs), io("trigger", r.trigger);
  io("edge", r.edge);
}
template <class Io, class T>
void members(Io&& io, T& p) requires(std::is_same_v<std::remove_const_t<T>, DiagramParameter>) {
  io("value", p.value), io("lower", p.lower), io("upper", p.upper), io("free", p.free), io("remark", p.remark);
}
template <class Io, class T>
void members(Io&& io, T& i) requires(std::is_same_v<std::remove_const_t<T>, DiagramInput>) {
  io("unit", i.unit), io("remark", i.remark), io("length", i.length);
}
template <class Io, class T>
void members(Io&& io, T& w) requires(std::is_same_v<std::remove_const_t<T>, Wire>) {
  io("port", w.port), io("from", w.from);
}
template <class Io, class T>
void members(Io&& io, T& n) requires(std::is_same_v<std::remove_const_t<T>, Number>) {
  io("value", n.value), io("unit", n.unit);
}
template <class Io, class T>
void members(Io&& io, T& s) requires(std::is_same_v<std::remove_const_t<T>, Series>) {
  io("t", s.t), io("v", s.v), io("between", s.between);
}

template <class Io, class T>
void members(Io&& io, T& u) requires(std::is_same_v<std::remove_const_t<T>, Unit>) {
  io("text", u.text), io("power", u.dimension.power), io("scale", u.scale), io("offset", u.offset);
}

class Packer {
 public:
  Json operator()(const std::string& text) { return text; }
  Json operator()(bool flag) { return flag; }
  Json operator()(int number) { return number; }
  Json operator()(Between between) { return to_text(between); }
  /// JSON has no words for what is not finite.
  Json operator()(double number) {
    if (std::isfinite(number)) return number;
    return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
  }
  template <class T>
  Json operator()(const std::optional<T>& value) {
    return value ? (*this)(*value) : Json();
  }
  template <class T>
  Json operator()(const std::vector<T>& list) {
    Json json = Json::array();
    for (const auto& item : list) json.push_back((*this)(item));
    return json;
  }
  template <class T>
  Json operator()(const Ordered<T>& list) {
    Json json = Json::array();
    for (const auto& [name, item] : list) json.push_back(Json::array({name, (*this)(item)}));
    return json;
  }
  Json operator()(const std::array<std::int8_t, 9>& powers) { return powers; }
  Json operator()(const std::shared_ptr<const Diagram>& nested) { return nested ? (*this)(*nested) : Json(); }
  /// Once, however often it is read.
  Json operator()(const SeriesPointer& series) {
    const auto [place, is_new] = places_.emplace(series.get(), places_.size());
    if (is_new) series_.push_back((*this)(*series));
    return place->second;
  }
  Json operator()(const Value& value) {
    Json json = Json::array({value.content.index(), std::visit(*this, value.content)});
    if (was_set(value.origin)) json.push_back(value.origin);
    return json;
  }
  Json operator()(const Reference& reference) { return reference.name; }
  Json operator()(const NumberMatrix& matrix) { return (*this)(matrix.rows); }
  Json operator()(const Node& node) {
    Node elsewhere = node;
    elsewhere.origin = without_folder(node.origin);
    return structure_json(elsewhere);
  }
  template <class T>
  Json operator()(const T& structure) requires(std::is_class_v<T>) {
    return structure_json(structure);
  }

  Json take_series() { return std::move(series_); }

 private:
  /// "stage.json#/blocks/a" of "/home/me/stage.json#/blocks/a": folders of this machine concern nobody else.
  static std::string without_folder(const std::string& origin) {
    const auto mark = origin.find('#');
    const auto slash = mark == std::string::npos ? mark : origin.rfind('/', mark);
    return slash == std::string::npos ? origin : origin.substr(slash + 1);
  }

  template <class T>
  Json structure_json(const T& structure) {
    Json json = Json::object();
    members(
        [&](const char* key, const auto& member) {
          Json written = (*this)(member);
          if (!written.is_null() && written != Json::array() && written != Json("")) json[key] = std::move(written);
        },
        structure);
    return json;
  }

  std::map<const Series*, std::size_t> places_;
  Json series_ = Json::array();
};

class Unpacker {
 public:
  explicit Unpacker(const Json& series) {
    for (const auto& one : series) {
      auto read = std::make_shared<Series>();
      (*this)(one, *read);
      series_.push_back(std::move(read));
    }
  }

  void operator()(const Json& json, std::string& text) { text = json.get<std::string>(); }
  void operator()(const Json& json, bool& flag) { flag = json.get<bool>(); }
  void operator()(const Json& json, int& number) { number = json.get<int>(); }
  void operator()(const Json& json, Between& between) { between = between_of(json.get<std::string>()); }
  void operator()(const Json& json, double& number) {
    if (!json.is_string())
      number = json.get<double>();
    else if (json == "nan")
      number = std::numeric_limits<double>::quiet_NaN();
    else
      number = (json == "inf" ? 1 : -1) * std::numeric_limits<double>::infinity();
  }
  template <class T>
  void operator()(const Json& json, std::optional<T>& value) {
    (*this)(json, value.emplace());
  }
  template <class T>
  void operator()(const Json& json, std::vector<T>& list) {
    for (const auto& item : json) {
      T one{};
      (*this)(item, one);
      list.push_back(std::move(one));
    }
  }
  template <class T>
  void operator()(const Json& json, Ordered<T>& list) {
    list.reserve(json.size());
    for (const auto& item : json) (*this)(item.at(1), list[item.at(0).get<std::string>()]);
  }
  void operator()(const Json& json, std::array<std::int8_t, 9>& powers) {
    powers = json.get<std::array<std::int8_t, 9>>();
  }
  void operator()(const Json& json, std::shared_ptr<const Diagram>& nested) {
    auto read = std::make_shared<Diagram>();
    (*this)(json, *read);
    nested = std::move(read);
  }
  void operator()(const Json& json, SeriesPointer& series) { series = series_.at(json.get<std::size_t>()); }
  void operator()(const Json& json, Reference& reference) { reference.name = json.get<std::string>(); }
  void operator()(const Json& json, NumberMatrix& matrix) { (*this)(json, matrix.rows); }
  void operator()(const Json& json, Value& value) {
    read_content(json.at(0).get<std::size_t>(), json.at(1), value,
                 std::make_index_sequence<std::variant_size_v<decltype(value.content)>>());
    if (json.size() > 2) value.origin = json.at(2).get<std::string>();
  }
  template <class T>
  void operator()(const Json& json, T& structure) requires(std::is_class_v<T>) {
    members(
        [&](const char* key, auto& member) {
          if (const auto found = json.find(key); found != json.end()) (*this)(*found, member);
        },
        structure);
  }

 private:
  template <std::size_t... places>
  void read_content(std::size_t kind, const Json& json, Value& value, std::index_sequence<places...> /*all*/) {
    if (kind >= sizeof...(places)) throw std::out_of_range("kind of value");
    ((kind == places ? (*this)(json, value.content.template emplace<places>()) : void()), ...);
  }

  std::vector<SeriesPointer> series_;
};

}  // namespace

std::string packed_diagram(const PackedDiagram& packed) {
  Packer pack;
  Json json{{"packed", version_of_packing}};
  json["units"] = pack(packed.units);
  json["diagram"] = pack(packed.diagram);
  json["series"] = pack.take_series();
  return json.dump();
}

PackedDiagram unpacked_diagram(std::string_view text) {
  try {
    const Json json = Json::parse(text);
    const Json& version = json.at("packed");
    if (version != version_of_packing)
      throw std::runtime_error("its version is " + version.dump() + ", and version " +
                               std::to_string(version_of_packing) + " is read here");
    PackedDiagram packed;
    Unpacker unpack(json.at("series"));
    unpack(json.at("units"), packed.units);
    unpack(json.at("diagram"), packed.diagram);
    return packed;
  } catch (const std::exception& e) {  // of the JSON library, or out_of_range
    fail("damaged_file", "program.json", std::string("this is no packed diagram: ") + e.what(), "export it again");
  }
}

std::string exported_program(const Diagram& diagram, Registry (*blocks)()) {
  PackedDiagram packed{diagram, {}};
  const UnitLog log;
  const Registry all = blocks();
  const ProgramPointer program = compile(unpacked_diagram(packed_diagram(packed)).diagram, all);
  fmi_variables(*program);
  packed.units = log.units();
  return packed_diagram(packed);
}

std::string packed_token(std::string_view text) {
  Digest digest;
  digest.add(text);
  return "hysteron-" + digest.text();
}

}  // namespace hysteron
