#include "studio/sheet_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "draw/branches.h"

namespace hysteron::studio {
namespace {

using Json = nlohmann::ordered_json;

/// Tenths of a pixel are enough.
double px(double value) { return std::round(value * 10) / 10; }

const char* name_of(draw::Outline outline) {
  switch (outline) {
    case draw::Outline::circle:
      return "circle";
    case draw::Outline::triangle:
      return "triangle";
    case draw::Outline::port:
      return "port";
    case draw::Outline::frame:
      return "frame";
    case draw::Outline::box:
      return "box";
  }
  return "box";
}

const char* name_of(draw::Side side) {
  return side == draw::Side::left ? "left" : side == draw::Side::top ? "top" : "bottom";
}

Json symbol_json(const draw::Symbol& symbol) {
  return {{"outline", name_of(symbol.outline)}, {"picture", symbol.picture}, {"text", symbol.text},
          {"fraction", symbol.fraction},        {"note", symbol.note},       {"signs", symbol.signs},
          {"port_names", symbol.port_names}};
}

Json inputs_json(const draw::Item& item) {
  Json list = Json::array();
  for (std::size_t i = 0; i < item.in.size(); ++i) {
    const draw::Point at = draw::in_port(item, static_cast<int>(i));
    list.push_back({{"name", item.in[i]},
                    {"x", px(at.x)},
                    {"y", px(at.y)},
                    {"side", name_of(i < item.side.size() ? item.side[i] : draw::Side::left)},
                    {"reads", i < item.reads.size() ? item.reads[i] : ""}});
  }
  return list;
}

Json outputs_json(const draw::Item& item) {
  Json list = Json::array();
  for (std::size_t i = 0; i < item.out.size(); ++i) {
    const draw::Point at = draw::out_port(item, static_cast<int>(i));
    list.push_back({{"name", item.out[i]},
                    {"x", px(at.x)},
                    {"y", px(at.y)},
                    {"unit", i < item.out_units.size() ? item.out_units[i] : ""},
                    {"length", i < item.out_lengths.size() ? item.out_lengths[i] : 1}});
  }
  return list;
}

Json wire_json(const draw::Sheet& sheet, const draw::Wire& wire) {
  const draw::Item& from = sheet.items[static_cast<std::size_t>(wire.from)];
  Json path = Json::array();
  for (const auto& p : wire.path) path.push_back({px(p.x), px(p.y)});
  const auto out = static_cast<std::size_t>(wire.out);
  return {{"from", wire.from},
          {"out", wire.out},
          {"to", wire.to},
          {"in", wire.in},
          {"signal", wire.signal},
          {"feedback", wire.feedback},
          {"length", out < from.out_lengths.size() ? from.out_lengths[out] : 1},
          {"path", path}};
}

}  // namespace

Json item_json(const draw::Item& item) {
  Json json{{"path", item.path},
            {"name", item.name},
            {"type", item.type},
            {"x", px(item.x)},
            {"y", px(item.y)},
            {"width", px(item.width())},
            {"height", px(item.height())},
            {"symbol", symbol_json(item.symbol)},
            {"in", inputs_json(item)},
            {"out", outputs_json(item)},
            {"caption", item.caption},
            {"tip", item.tip}};
  if (item.candidates > 0) json["choice"] = {{"chosen", item.chosen}, {"candidates", item.candidates}};
  if (item.inside) json["inside"] = sheet_json(*item.inside);
  return json;
}

Json sheet_json(const draw::Sheet& sheet) {
  Json items = Json::array(), wires = Json::array(), dots = Json::array();
  for (const auto& item : sheet.items) items.push_back(item_json(item));
  for (const auto& wire : sheet.wires) wires.push_back(wire_json(sheet, wire));
  for (const auto& p : draw::branches_of(sheet)) dots.push_back({px(p.x), px(p.y)});
  return {{"width", px(sheet.width)}, {"height", px(sheet.height)}, {"items", items}, {"wires", wires}, {"dots", dots}};
}

}  // namespace hysteron::studio
