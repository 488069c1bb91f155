#include "studio/view.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "draw/layout.h"
#include "draw/moved.h"
#include "draw/pictogram.h"
#include "engine/compile/draft.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/layout_file.h"
#include "io/files/atomic_file.h"
#include "io/files/digest.h"
#include "io/json/problems_json.h"
#include "studio/sheet_json.h"

namespace hysteron::studio {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Problem> located(const std::vector<Problem>& problems, const std::string& file) {
  if (problems.empty()) return {};
  Error error(Fault::input, problems);
  locate_problems(error, file);
  return error.problems;
}

/// What is wrong with a file stands there for each block that holds it: it is told once.
Json each_once(const Json& problems) {
  Json list = Json::array();
  std::set<std::string> told;
  for (const auto& p : problems)
    if (told.insert(p.dump(-1, ' ', false, Json::error_handler_t::replace)).second) list.push_back(p);
  return list;
}

/// A text as its lines, which "\n" joins again: where one line is changed, only that one has to be told.
Json lines_of(const std::string& text) {
  Json lines = Json::array();
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  lines.push_back(text.substr(begin));
  return lines;
}

Json points_json(const draw::Curve& curve) {
  Json points = Json::array();
  for (const auto& [x, y] : curve) points.push_back({x, y});
  return points;
}

/// Is a port of a nested diagram no input of it, but what enables or triggers it?
bool switches(const Node& node, const draw::Item& item, std::size_t port) {
  const auto* body = node.from.empty() ? &node : node.from.find(node.choose);
  return body != nullptr && body->nested && port >= body->nested->inputs.size() && port < item.in.size();
}

/// The diagram with one more wire: all inputs of the block by the names of their ports.
Diagram wired(const Diagram& diagram, const draw::Item& to, std::size_t port, const std::string& signal) {
  Diagram changed = diagram;
  if (to.type == "output") {
    changed.outputs[to.name] = signal;
    return changed;
  }
  Node* node = changed.blocks.find(to.name);
  if (node == nullptr) return changed;
  node->in.clear();
  for (std::size_t i = 0; i < to.in.size(); ++i) {
    const std::string& from = i == port ? signal : to.reads[i];
    if (!from.empty() && !switches(*node, to, i)) node->in.push_back({to.in[i], from});
  }
  return changed;
}

using Told = std::set<std::string>;

Told told_of(const DraftProgram& draft) {
  Told told;
  for (const auto& p : draft.problems) told.insert(p.what);
  return told;
}

/// What a change makes wrong that was not before; "" if nothing.
std::string first_new(const DraftProgram& draft, const Told& before) {
  for (const auto& p : draft.problems)
    if (!before.contains(p.what)) return p.what;
  return "";
}

/// The unit behind a block that is wrong is not known: what the others would want there is not what it gives.
void leave_out_units(draw::Sheet& sheet, const std::vector<Problem>& problems) {
  const std::string blocks = "/blocks/";
  std::set<std::string> wrong;
  for (const auto& p : problems)
    if (p.path.starts_with(blocks))
      wrong.insert(p.path.substr(blocks.size(), p.path.find('/', blocks.size()) - blocks.size()));
  for (auto& item : sheet.items)
    if (wrong.contains(item.name)) item.out_units.clear();
}

/// Blocks that were moved by hand. A layout file that is wrong moves none, and is told.
void place(draw::Sheet& sheet, const std::string& file, Json& view) {
  try {
    const BlockPlaces places = read_layout(file);
    draw::move_items(sheet, places);
    for (const auto& [name, at] : places) view["places"][name] = at;
  } catch (const Error& error) {
    for (const auto& p : problem_list(error.problems)) view["problems"].push_back(p);
  }
}

}  // namespace

Json view_of(const std::string& file, const Registry& registry, const ViewOptions& options) {
  Json view;
  const std::string text = read_file(file);
  Digest digest;
  digest.add(text);
  view["lines"] = lines_of(text);
  view["hash"] = digest.text();
  view["sheet"] = nullptr;
  view["places"] = Json::object();
  try {
    const Diagram diagram = read_diagram(file, options.allowed);
    const DraftProgram draft = compile_draft(diagram, registry);
    view["problems"] = problem_list(located(draft.problems, file));
    view["warnings"] = problem_list(located(draft.warnings, file));
    draw::Sheet sheet = draw::draft_sheet(diagram, draft.program.get(), registry, options.depth);
    leave_out_units(sheet, draft.problems);
    draw::lay_out(sheet);
    place(sheet, file, view);
    view["sheet"] = sheet_json(sheet);
  } catch (const Error& error) {
    auto problems = view.contains("problems") ? view["problems"] : Json::array();
    for (const auto& p : problem_list(error.problems)) problems.push_back(p);
    view["problems"] = problems;
    if (!view.contains("warnings")) view["warnings"] = Json::array();
  }
  view["problems"] = each_once(view["problems"]);
  return view;
}

Json fits_of(const std::string& file, const std::string& signal, const Registry& registry, const ViewOptions& options) {
  const Diagram diagram = read_diagram(file, options.allowed);
  const DraftProgram draft = compile_draft(diagram, registry);
  const Told before = told_of(draft);
  const draw::Sheet sheet = draw::draft_sheet(diagram, draft.program.get(), registry, 0);
  Json list = Json::array();
  for (std::size_t i = 0; i < sheet.items.size(); ++i)
    for (std::size_t port = 0; port < sheet.items[i].in.size(); ++port) {
      const DraftProgram tried = compile_draft(wired(diagram, sheet.items[i], port, signal), registry);
      list.push_back({{"item", i}, {"in", port}, {"why", first_new(tried, before)}});
    }
  return list;
}

Json pictograms() {
  Json all;
  for (const auto& [name, picture] : draw::all_pictograms()) {
    Json curves = Json::array(), arrows = Json::array();
    for (const auto& curve : picture.curves) curves.push_back(points_json(curve));
    for (const auto& [way, size] : picture.arrows) arrows.push_back({{"way", points_json(way)}, {"size", size}});
    all[name] = {{"axes", picture.axes}, {"time", picture.time}, {"curves", curves}, {"arrows", arrows}};
  }
  return all;
}

}  // namespace hysteron::studio
