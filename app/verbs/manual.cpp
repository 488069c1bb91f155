// The verb manual: pages for man(1) and completion for shells, from the tables of the verbs.
// Does not decide how they look (app/manual).
#include <fmt/format.h>

#include <filesystem>

#include "app/cli/answer.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "app/manual/completion.h"
#include "app/manual/manual_page.h"
#include "discover/effects/all.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr char manual_help[] =
    "Writes manual pages of the program and of each verb, and what bash and zsh need to complete words, from\n"
    "the declarations that the program itself uses.\n\n"
    "Examples:\n"
    "  source <(hysteron manual bash)                    completion in this shell; in zsh: hysteron manual zsh\n"
    "  hysteron manual compare | man -l -                one page\n"
    "  hysteron manual -o ~/.local/share                 all of it, where man and the shells look for it\n\n"
    "\"cmake --install\" and the Debian package have them already.\n\n"
    "With -o it writes man/man1/*.1, bash-completion/completions/hysteron and zsh/site-functions/_hysteron into\n"
    "the folder.\n"
    "Exit codes: 0 done, 2 there is no such page, or the folder cannot be written.";

std::vector<Verb> all_verbs() {
  std::vector<Verb> verbs;
  for (const auto make : verb_functions()) verbs.push_back(make());
  return verbs;
}

KnownNames known_names() {
  KnownNames names{{}, all_effects().ids()};
  for (const auto& type : registry().types())
    if (registry().find(type)->declaration.group != "internal") names.blocks.push_back(type);
  return names;
}

/// What "hysteron manual WHAT" prints.
std::string one_text(const std::string& what) {
  const auto verbs = all_verbs();
  if (what == "bash") return bash_completion(verbs, known_names());
  if (what == "zsh") return zsh_completion(verbs, known_names());
  if (what == "hysteron") return manual_page_of_program();
  std::vector<std::string> names{"bash", "zsh", "hysteron"};
  for (const auto& verb : verbs) {
    if (verb.name == what) return manual_page(verb);
    names.push_back(verb.name);
  }
  fail("bad_command_line", "manual", fmt::format("there is no page of \"{}\"", what), did_you_mean(what, names));
}

Answer manual(const Arguments& arguments, const Watch&) {
  Answer answer;
  if (arguments.has("what") == arguments.has("-o"))
    fail("bad_command_line", "manual",
         "a page to print and a folder for all of them are two things, of which one is asked for",
         "write hysteron manual compare, or hysteron manual -o share");
  if (arguments.has("what")) {
    answer.text = one_text(arguments.text("what"));
    answer.facts = Facts::object({{"what", arguments.text("what")}, {"text", answer.text}});
    return answer;
  }
  const std::filesystem::path folder = arguments.text("-o");
  const auto write = [&](const char* below, const std::string& name, std::string text) {
    make_folder((folder / below).string(), "name another with -o FOLDER");
    answer.files.push_back({(folder / below / name).string(), std::move(text)});
    answer.closing += answer.files.back().path + "\n";
  };
  const auto verbs = all_verbs();
  write("man/man1", "hysteron.1", manual_page_of_program());
  for (const auto& verb : verbs) write("man/man1", "hysteron-" + verb.name + ".1", manual_page(verb));
  write("bash-completion/completions", "hysteron", bash_completion(verbs, known_names()));
  write("zsh/site-functions", "_hysteron", zsh_completion(verbs, known_names()));
  answer.facts = Facts::object({{"folder", folder.string()}});
  return answer;
}

std::vector<shape::Member> manual_shape() {
  using namespace shape;
  return {{"what", text("what was asked for"), sometimes},
          {"text", text("the page, or what the shell reads"), sometimes},
          {"folder", text("where all of it lies"), sometimes}};
}

}  // namespace

Verb manual_verb() {
  return {"manual",
          "pages for man, and completion for bash and zsh",
          manual_help,
          {{"what", "WHAT", "bash, zsh, hysteron or a verb", false, false},
           {"-o", "FOLDER", "write all of them below this folder", false, false}},
          manual,
          manual_shape};
}

}  // namespace hysteron
