// The verb export: a diagram as a program for somewhere else. Does not write any: each kind has a source of its own.
#include <fmt/format.h>

#include <algorithm>

#include "app/cli/verb.h"
#include "app/exports/export_c.h"
#include "app/exports/export_kind.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

const std::vector<ExportKind>& kinds() {
  static const std::vector<ExportKind> all{export_c(), export_fmu()};
  return all;
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const auto& kind : kinds()) list.push_back(kind.name);
  return list;
}

std::vector<OptionSpec> common_options() {
  OptionSpec folder = options::output_folder();
  folder.meaning = "where it goes: a folder for C, a file for an FMU; default: named after the diagram";
  folder.placeholder = "FILE|FOLDER";
  return {{"kind", "KIND", "what is written: " + fmt::format("{}", fmt::join(names(), ", ")), true, false},
          options::diagram(),
          folder,
          options::set(),
          options::choose(),
          options::allow()};
}

/// Each option once, whichever kinds take it.
std::vector<OptionSpec> all_options() {
  std::vector<OptionSpec> list = common_options();
  for (const auto& kind : kinds())
    for (const auto& option : kind.options)
      if (std::none_of(list.begin(), list.end(), [&](const OptionSpec& o) { return o.name == option.name; }))
        list.push_back(option);
  return list;
}

/// An option of another kind is no option of this one.
void check_options(const ExportKind& kind, const Arguments& arguments) {
  const auto has = [](const std::vector<OptionSpec>& list, const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const OptionSpec& o) { return o.name == name; });
  };
  for (const auto& option : all_options())
    if (arguments.has(option.name) && !has(common_options(), option.name) && !has(kind.options, option.name))
      fail("bad_command_line", option.name, fmt::format("export {} has no option {}", kind.name, option.name),
           "leave it out; see hysteron export --help");
}

Answer export_act(const Arguments& arguments, const Watch& watch) {
  const std::string wish = arguments.text("kind");
  const auto kind = std::find_if(kinds().begin(), kinds().end(), [&](const auto& k) { return k.name == wish; });
  if (kind == kinds().end())
    fail("bad_command_line", "kind", fmt::format("nothing is exported as \"{}\"", wish), did_you_mean(wish, names()));
  check_options(*kind, arguments);
  Answer answer = kind->act(arguments, watch);
  answer.facts.set("kind", kind->name);
  return answer;
}

std::string export_help() {
  std::string text =
      "Answers: how does this run somewhere else.\n\nExamples:\n  hysteron export c controller.json -o out\n"
      "  hysteron export fmu stage.json\n";
  for (const auto& kind : kinds()) text += fmt::format("\n{}: {}\n\n{}\n", kind.name, kind.summary, kind.help);
  return text + "\nExit codes: 0 done, 2 the diagram is wrong or cannot be written so, 3 the numerics failed.";
}

std::vector<shape::Member> export_shape() {
  std::vector<shape::Member> members{{"kind", shape::choice("what was written", names())}};
  for (const auto& kind : kinds())
    for (auto& member : kind.shape()) {
      if (std::any_of(members.begin(), members.end(), [&](const auto& m) { return m.name == member.name; })) continue;
      member.sometimes = member.sometimes || kinds().size() > 1;
      members.push_back(member);
    }
  return members;
}

}  // namespace

Verb export_verb() {
  return {"export",      "a diagram as a program for somewhere else: C code, a unit for other simulators",
          export_help(), all_options(),
          export_act,    export_shape};
}

}  // namespace hysteron
