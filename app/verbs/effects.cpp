// The verb effects: the physical effects that hysteron knows, from their own declarations, with a picture of each.
// Does not look at data.
#include <fmt/format.h>

#include <algorithm>

#include "app/cli/load.h"
#include "app/cli/target.h"
#include "app/cli/terminal.h"
#include "app/cli/verb.h"
#include "discover/hypotheses/bounds.h"
#include "discover/hypotheses/effect.h"
#include "engine/diagram/error.h"
#include "io/files/atomic_file.h"
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
    for (const auto& v : registry().find(type)->declaration.variations)
      if (!effect.variation.empty() && v.name == effect.variation) types.push_back(type);
  return fmt::format("{}", fmt::join(types, ", "));
}

/// What an effect varies instead of a wire: types of blocks, or a parameter.
std::string varied(const Effect& effect) {
  const std::string types = varied_blocks(effect);
  // The first is the plain one; "hysteron effects ID" names the others.
  if (!types.empty()) return types.find(',') == std::string::npos ? types : types.substr(0, types.find(',')) + " ...";
  return effect.way == Way::vary ? fmt::format("{} of a block", effect.parameter) : "";
}

void print_all(const Effects& effects) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& effect : effects.list())
    rows.push_back({effect.id, fmt::format("{}", fmt::join(effect.places, ", ")), varied(effect), effect.title});
  fmt::print("{}", table_text({"effect", "enters at", "or varies", "what it is"}, rows));
  fmt::print("\n\"hysteron effects ID\" shows one in full, \"hysteron add ID DIAGRAM.json\" puts it into a diagram.\n");
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
  if (effect.variation.empty() || effect.way == Way::insert) add(shown.neutral);
  for (const auto& type : registry().types())
    for (const auto& v : registry().find(type)->declaration.variations) {
      if (effect.variation.empty() || v.name != effect.variation) continue;
      std::vector<NeutralValue> declared;
      for (const auto& n : v.neutral) declared.push_back({n.parameter, n.value});
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

void print_one(const Effect& effect, const std::vector<Section>& sections, const Demonstration& shown) {
  fmt::print("{}", wrapped(fmt::format("{}: {}", effect.id, effect.title)));
  for (const auto& section : sections) {
    fmt::print("\n{}\n", section.title);
    for (const auto& text : section.text) fmt::print("{}", wrapped(text, 2));
    for (const auto& table : section.tables) fmt::print("{}", table_text(table.columns, table.rows));
    if (section.title != "law") continue;
    fmt::print("\npicture\n{}\n{}", wrapped(picture_caption(shown), 2), picture_text(shown));
  }
}

/// The page, or the picture alone.
void write_picture(const std::string& file, const Effect& effect, std::vector<Section> sections,
                   const Demonstration& shown) {
  const auto figures = picture_figures(shown);
  Document page;
  page.verb = "effects";
  page.title = effect.title;
  page.headline = fmt::format("{}: {}", effect.id, effect.title);
  if (file.ends_with(".svg")) {
    write_file(file, figure_file(page, figures.front()));
  } else {
    Section picture;
    picture.title = "picture";
    picture.figures = figures;
    sections.insert(sections.begin(), std::move(picture));
    page.sections = std::move(sections);
    write_file(file, report_html(page));
  }
  fmt::print("\nwrote {}\n", file);
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

int effects(const Arguments& arguments) {
  const Effects library = load_effects(arguments);
  const std::string file = wanted_file(arguments);
  if (!arguments.has("effect")) {
    print_all(library);
    return exit_code::done;
  }
  const Effect& effect = library.get(arguments.text("effect"));
  const Demonstration shown = demonstrate(effect, library, registry());
  const auto sections = sections_of(effect, library, shown);
  print_one(effect, sections, shown);
  if (!file.empty()) write_picture(file, effect, sections, shown);
  return exit_code::done;
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
          effects};
}

}  // namespace hysteron
