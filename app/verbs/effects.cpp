// The verb effects: the physical effects that hysteron knows, from their own declarations, with a picture of each.
// Does not look at data.
#include <fmt/format.h>

#include <algorithm>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "app/cli/terminal.h"
#include "discover/hypotheses/bounds.h"
#include "discover/hypotheses/effect.h"
#include "engine/diagram/error.h"
#include "report/page/figure_file.h"
#include "report/page/report.h"
#include "report/pages/effect_picture.h"

namespace hysteron {
namespace {

constexpr char effects_help[] =
    "Answers: which effects can be named as missing, what is their law, which data show them, what looks alike.\n\n"
    "Examples:\n"
    "  hysteron effects           all of them\n"
    "  hysteron effects creep     one in full, with a picture\n"
    "  hysteron effects creep -o creep.html         as a page; creep.svg: the picture alone\n"
    "  hysteron effects --effects own/              with those of your own: a file each, or a folder\n\n"
    "The picture is simulated: the simplest law of the effect at its start values, and nothing in its place, under\n"
    "a standard signal that brings it out. Prints to the terminal; with -o it writes that file as well.\n"
    "Exit codes: 0 done, 2 there is no such effect.";

/// The block types that offer the variation of an effect: "tank"; "" where it has none.
std::string varied_blocks(const Effect& effect) {
  std::vector<std::string> types;
  for (const auto& type : registry().types())
    if (varied_by(effect, registry().find(type)->declaration) != nullptr) types.push_back(type);
  return fmt::format("{}", fmt::join(types, ", "));
}

/// What an effect varies instead of a wire: types of blocks, or a parameter.
std::string varied(const Effect& effect) {
  const std::string types = varied_blocks(effect);
  // The first is the plain one; "hysteron effects ID" names the others.
  if (!types.empty()) return types.find(',') == std::string::npos ? types : types.substr(0, types.find(',')) + " ...";
  return effect.way == Way::vary ? fmt::format("{} of a block", effect.parameter) : "";
}

std::string all_text(const Effects& effects) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& effect : effects.list())
    rows.push_back({effect.id, fmt::format("{}", fmt::join(effect.places, ", ")), varied(effect), effect.title});
  return table_text({"effect", "enters at", "or varies", "what it is"}, rows) +
         "\n\"hysteron effects ID\" shows one in full, \"hysteron add ID DIAGRAM.json\" puts it into a diagram.\n";
}

std::string way_text(const Effect& effect) {
  const std::string places =
      effect.places.empty() ? "" : fmt::format(" Kinds of place: {}.", fmt::join(effect.places, ", "));
  if (!effect.file.empty()) return fmt::format("The diagram {} is put on a wire.{}", effect.file, places);
  const std::string types = varied_blocks(effect);
  const std::string richer = types.empty() ? "" : fmt::format("A block of type {} becomes one that has it.", types);
  if (effect.way == Way::insert)
    return fmt::format("{} block of type {} is put on a wire.{}", richer.empty() ? "A" : richer + " Or a",
                       effect.block_type, places);
  if (effect.way == Way::vary && !richer.empty())
    return places.empty()
               ? fmt::format("Kind of place: a block that can have it, of type {}. It becomes one that has it.", types)
               : richer + places;
  if (effect.way == Way::vary)
    return fmt::format("A block of the diagram gets the parameter \"{}\".{}", effect.parameter, places);
  return fmt::format("A value of the recording: {}.{}", effect.parameter, places);
}

std::string neutral_text(const std::vector<NeutralValue>& values) {
  std::vector<std::string> list;
  for (const auto& v : values) list.push_back(v.parameter + " " + v.value);
  return fmt::format("{}", fmt::join(list, ", "));
}

/// The values at which nothing changes: those that blocks declare of the variation, and those of a block of its own.
std::string changes_nothing(const Effect& effect, const Demonstration& shown) {
  std::vector<std::string> ways;
  const auto add = [&](const std::vector<NeutralValue>& values) {
    const std::string text = neutral_text(values);
    if (!text.empty() && std::find(ways.begin(), ways.end(), text) == ways.end()) ways.push_back(text);
  };
  if (effect.variation.empty() || effect.way == Way::insert) add(shown.null_value);
  for (const auto& type : registry().types()) {
    const VariationDeclaration* v = varied_by(effect, registry().find(type)->declaration);
    if (v == nullptr) continue;
    std::vector<NeutralValue> declared;
    for (const auto& n : v->null_value) declared.push_back({n.parameter, n.value});
    add(declared);
  }
  return fmt::format("{}", fmt::join(ways, "; in a block that has it "));
}

/// What a parameter is, what is usual and between which values a search looks for it.
std::string parameter_text(const Effect& effect, const EffectParameter& p) {
  std::vector<std::string> parts;
  if (!p.meaning.empty()) parts.push_back(p.meaning);
  if (!p.range.empty()) parts.push_back("usual: " + p.range);
  if (const std::string bounds = bounds_text(effect, p.name); !bounds.empty()) parts.push_back("searched: " + bounds);
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// Effects that are taken for this one, as it says or as they say themselves; each once.
Table look_alikes(const Effect& effect, const Effects& library) {
  Table table;
  table.columns = {"effect", "experiment", "what decides"};
  const auto add = [&](const std::string& id, const LookAlike& how) {
    const auto told = [&](const auto& row) { return row.front() == id; };
    if (std::none_of(table.rows.begin(), table.rows.end(), told))
      table.rows.push_back({id, how.experiment, how.deciding});
  };
  for (const auto& other : effect.look_alikes) add(other.effect, other);
  for (const auto& other : library.list())
    for (const auto& named : other.look_alikes)
      if (named.effect == effect.id) add(other.id, named);
  return table;
}

/// One effect as a page: paragraphs and tables, which the terminal prints too.
std::vector<Section> sections_of(const Effect& effect, const Effects& library, const Demonstration& shown) {
  std::vector<Section> sections;
  const auto part = [&](const std::string& title, const std::string& text) -> void {
    if (text.empty()) return;
    sections.emplace_back().title = title;
    sections.back().text = {text};
  };
  const auto table = [&](const std::string& title, Table rows) {
    if (rows.rows.empty()) return;
    sections.emplace_back().title = title;
    sections.back().tables.push_back(std::move(rows));
  };
  part("cause", effect.cause);
  part("law", effect.equation);
  part("how it enters", way_text(effect));
  if (!effect.law_of.empty())
    part("when it is tried",
         fmt::format("It is a richer law of {0}, which discover tries: it is told as {0}. By itself "
                     "where you name it: --only {1}.",
                     effect.law_of, effect.id));
  Table parameters;
  for (const auto& p : effect.parameters)
    parameters.rows.push_back({p.name, p.unit.empty() ? "1" : p.unit, parameter_text(effect, p)});
  table("parameters", std::move(parameters));
  part("changes nothing with", changes_nothing(effect, shown));
  part("what it leaves in the residual", effect.residual);
  part("data that show it", effect.needs);
  table("taken for it easily", look_alikes(effect, library));
  part("source", effect.source);
  return sections;
}

std::string one_text(const Effect& effect, const std::vector<Section>& sections, const Demonstration& shown) {
  std::string all = wrapped(fmt::format("{}: {}", effect.id, effect.title));
  for (const auto& section : sections) {
    all += fmt::format("\n{}\n", section.title);
    for (const auto& text : section.text) all += wrapped(text, 2);
    for (const auto& table : section.tables) all += table_text(table.columns, table.rows);
    if (section.title != "law") continue;
    all += fmt::format("\npicture\n{}\n{}", wrapped(picture_caption(shown), 2), picture_text(shown));
  }
  return all;
}

/// The page, or the picture alone.
std::string picture_file(const std::string& file, const Effect& effect, std::vector<Section> sections,
                         const Demonstration& shown) {
  const auto figures = picture_figures(shown);
  Document page;
  page.verb = "effects";
  page.title = effect.title;
  page.headline = fmt::format("{}: {}", effect.id, effect.title);
  if (file.ends_with(".svg")) return figure_file(page, figures.front());
  Section picture;
  picture.title = "picture";
  picture.figures = figures;
  sections.insert(sections.begin(), std::move(picture));
  page.sections = std::move(sections);
  return report_html(page);
}

/// What every effect says of itself in the list.
Facts short_facts(const Effect& effect) {
  return Facts::object(
      {{"id", effect.id}, {"title", effect.title}, {"enters_at", effect.places}, {"varies", varied(effect)}});
}

/// All that one_text() says, for programs.
Facts facts_of(const Effect& effect, const Effects& library) {
  Facts facts = short_facts(effect);
  for (const auto& [name, said] : {std::pair<const char*, std::string>{"cause", effect.cause},
                                   {"law", effect.equation},
                                   {"how_it_enters", way_text(effect)},
                                   {"residual", effect.residual},
                                   {"needs", effect.needs},
                                   {"source", effect.source}})
    facts.set(name, said);
  Facts::List parameters, alike;
  for (const auto& p : effect.parameters)
    parameters.push_back(Facts::object({{"name", p.name},
                                        {"unit", p.unit},
                                        {"meaning", p.meaning},
                                        {"usual", p.range},
                                        {"searched", bounds_text(effect, p.name)}}));
  for (const auto& row : look_alikes(effect, library).rows)
    alike.push_back(Facts::object({{"effect", row[0]}, {"experiment", row[1]}, {"what_decides", row[2]}}));
  facts.set("parameters", parameters);
  facts.set("look_alikes", alike);
  return facts;
}

/// "-o", or "" where nothing is to be written.
std::string wanted_file(const Arguments& arguments) {
  const std::string file = arguments.text("-o");
  if (file.empty()) return file;
  if (!arguments.has("effect"))
    fail("bad_command_line", "-o", "a picture is drawn of one effect", "name it: hysteron effects creep -o creep.html");
  need_ending("-o", file, {".html", ".svg"}, "a page or a picture, e.g. -o creep.html");
  return file;
}

Answer effects(const Arguments& arguments, const Watch&) {
  const Effects library = load_effects(arguments);
  const std::string file = wanted_file(arguments);
  Answer answer;
  if (!arguments.has("effect")) {
    Facts::List list;
    for (const auto& effect : library.list()) list.push_back(short_facts(effect));
    answer.text = all_text(library);
    answer.facts = Facts::object({{"effects", list}});
    return answer;
  }
  const Effect& effect = library.get(arguments.text("effect"));
  const Demonstration shown = demonstrate(effect, library, registry());
  const auto sections = sections_of(effect, library, shown);
  answer.text = one_text(effect, sections, shown);
  answer.facts = facts_of(effect, library);
  if (file.empty()) return answer;
  answer.files.push_back({file, picture_file(file, effect, sections, shown)});
  answer.closing = "\nwrote " + file + "\n";
  return answer;
}

/// Of one effect all that it says, else the list.
std::vector<shape::Member> effects_shape() {
  using namespace shape;
  const std::vector<Member> head{{"id", text("as --only and add take it")},
                                 {"title", text("what it is")},
                                 {"enters_at", texts("kinds of place")},
                                 {"varies", text("a block type or a parameter, in place of a wire")}};
  const Facts parameter = object("a parameter", {{"name", text("")},
                                                 {"unit", text("empty: none")},
                                                 {"meaning", text("")},
                                                 {"usual", text("range of values")},
                                                 {"searched", text("between which values")}});
  const Facts alike =
      object("an effect that is taken for it easily", {{"effect", text("its id")},
                                                       {"experiment", text("that tells them apart")},
                                                       {"what_decides", text("what to look at in it")}});
  auto members = head;
  for (const char* name : {"cause", "law", "how_it_enters", "residual", "needs", "source"})
    members.push_back({name, text("as \"hysteron effects ID\" says it")});
  members.push_back({"parameters", list("in their order", parameter)});
  members.push_back({"look_alikes", list("each once", alike)});
  for (auto& member : members) member.sometimes = true;
  members.push_back({"effects", list("all of them, where none was named", object("an effect", head)), sometimes});
  return members;
}

}  // namespace

Verb effects_verb() {
  return {"effects",
          "which effects can be missing, and how they are told apart",
          effects_help,
          {{"effect", "ID", "the effect to show in full", false, false},
           {"-o", "FILE.html|svg", "also write its page, or its picture alone", false, false},
           options::effects(),
           options::allow()},
          effects,
          effects_shape};
}

}  // namespace hysteron
