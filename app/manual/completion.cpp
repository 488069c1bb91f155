// What may stand behind an option is read off the word that stands for it in the help ("FILE.json", "FOLDER").
#include "app/manual/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/cli/words.h"

namespace hysteron {
namespace {

enum class Kind { flag, text, any_file, json_file, folder, block, effect, words };

/// What a value may be.
struct Value {
  Kind kind = Kind::text;
  std::vector<std::string> words{};
};

Value value_of(const OptionSpec& spec) {
  const std::string& word = spec.placeholder;
  for (const auto& common : common_options())
    if (common.spec.name == spec.name && !common.values.empty()) return {Kind::words, common.values};
  if (word.empty()) return {Kind::flag};
  if (word == "TYPE") return {Kind::block};
  if (word == "EFFECT" || word == "ID") return {Kind::effect};
  if (word == "FOLDER") return {Kind::folder};
  if (word.ends_with(".json")) return {Kind::json_file};
  if (word.starts_with("FILE") || word == "DATA") return {Kind::any_file};
  return {};
}

std::vector<OptionSpec> all_options(const Verb& verb) {
  std::vector<OptionSpec> all = verb.options;
  for (const auto& common : common_options()) all.push_back(common.spec);
  all.push_back({"--help", "", "what it answers, with examples"});
  return all;
}

bool is_option(const OptionSpec& spec) { return spec.name.starts_with("-"); }

std::string names_of(const std::vector<OptionSpec>& specs) {
  std::vector<std::string> names;
  for (const auto& spec : specs)
    if (is_option(spec)) names.push_back(spec.name);
  return fmt::format("{}", fmt::join(names, " "));
}

/// The command of bash that offers such values for "$word"; "" where there is nothing to offer.
std::string bash_offer(const Value& value, const KnownNames& names) {
  switch (value.kind) {
    case Kind::any_file:
      return "_hysteron_files '*'";
    case Kind::json_file:
      return "_hysteron_files '*.json'";
    case Kind::folder:
      return "_hysteron_folders";
    case Kind::block:
      return fmt::format("_hysteron_words \"{}\"", fmt::join(names.blocks, " "));
    case Kind::effect:
      return fmt::format("_hysteron_words \"{}\"", fmt::join(names.effects, " "));
    case Kind::words:
      return fmt::format("_hysteron_words \"{}\"", fmt::join(value.words, " "));
    case Kind::flag:
    case Kind::text:
      break;
  }
  return "";
}

/// Branches for what stands behind an option, and for the words of a verb in their order.
std::string bash_branches(const Verb& verb, const KnownNames& names, std::string& positional) {
  std::string behind_options;
  int place = 0;
  for (const auto& spec : all_options(verb)) {
    const Value value = value_of(spec);
    if (is_option(spec)) {
      if (value.kind == Kind::flag) continue;
      const std::string offer = bash_offer(value, names);
      behind_options +=
          fmt::format("    {}/{}) {}return ;;\n", verb.name, spec.name, offer.empty() ? "" : offer + "; ");
      continue;
    }
    const std::string offer = bash_offer(value, names);
    ++place;
    if (!offer.empty())
      positional += fmt::format("    {}/{}) {} ;;\n", verb.name, spec.repeated ? "*" : std::to_string(place), offer);
  }
  if (place == 0)  // words behind an option that takes several: new --from a.csv b.csv
    for (const auto& spec : verb.options)
      if (spec.several) positional += fmt::format("    {}/*) {} ;;\n", verb.name, bash_offer(value_of(spec), names));
  return behind_options;
}

constexpr char bash_helpers[] = R"(
_hysteron_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }
_hysteron_folders() { compopt -o filenames 2> /dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$word"); }
# Files of this pattern, and the folders in which more of them may lie.
_hysteron_files() {
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <({ compgen -f -X "!$1" -- "$word"; compgen -d -- "$word"; } | sort -u)
}

)";

/// What zsh's _arguments does with a value: ":message:action", or "" for a flag.
std::string zsh_value(const OptionSpec& spec, const KnownNames& names) {
  const Value value = value_of(spec);
  const auto action = [&]() -> std::string {
    switch (value.kind) {
      case Kind::any_file:
        return "_files";
      case Kind::json_file:
        return "_files -g \"*.json\"";
      case Kind::folder:
        return "_files -/";
      case Kind::block:
        return fmt::format("({})", fmt::join(names.blocks, " "));
      case Kind::effect:
        return fmt::format("({})", fmt::join(names.effects, " "));
      case Kind::words:
        return fmt::format("({})", fmt::join(value.words, " "));
      case Kind::flag:
      case Kind::text:
        break;
    }
    return "";
  };
  return value.kind == Kind::flag ? "" : fmt::format(":{}:{}", spec.placeholder, action());
}

/// A meaning between the brackets and single quotes of _arguments, and between those of _describe.
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\'')
      safe += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      safe += std::string("\\") + c;
    else
      safe += c;
  }
  return safe;
}

std::string zsh_arguments(const Verb& verb, const KnownNames& names) {
  std::string text;
  int place = 0;
  for (const auto& spec : all_options(verb)) {
    std::string value = zsh_value(spec, names);
    if (is_option(spec)) {
      const std::string meaning = zsh_text(spec.meaning);
      text += fmt::format(" \\\n        '{}{}[{}]{}'", spec.repeated ? "*" : "", spec.name, meaning, value);
    } else {
      value.replace(0, 1 + spec.placeholder.size(), ":" + zsh_text(spec.meaning));
      text += fmt::format(" \\\n        '{}{}'", spec.repeated ? "*" : std::to_string(++place), value);
    }
  }
  return text;
}

}  // namespace

std::string bash_completion(const std::vector<Verb>& verbs, const KnownNames& names) {
  std::vector<std::string> words, options_of;
  std::string behind, positional;
  for (const auto& verb : verbs) {
    words.push_back(verb.name);
    options_of.push_back(fmt::format("      {}) _hysteron_words \"{}\" ;;\n", verb.name, names_of(all_options(verb))));
    behind += bash_branches(verb, names, positional);
  }
  return fmt::format(
      "# Completion of hysteron {} in bash; written by \"hysteron manual bash\".\n{}_hysteron() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} verb=${{COMP_WORDS[1]}} i place=1\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n    _hysteron_words \"{} --help --version\"\n    return\n  fi\n"
      "  case $verb/$before in\n{}  esac\n"
      "  if [[ $word == -* ]]; then\n    case $verb in\n{}    esac\n    return\n  fi\n"
      "  # So many words stand before that are no option; those that are the value of one count, too: a guess.\n"
      "  for ((i = 2; i < COMP_CWORD; i++)); do [[ ${{COMP_WORDS[i]}} == -* ]] || place=$((place + 1)); done\n"
      "  case $verb/$place in\n{}    *) _hysteron_files '*' ;;\n  esac\n}}\n"
      "complete -F _hysteron hysteron\n",
      version_of_program(), bash_helpers, fmt::join(words, " "), behind, fmt::join(options_of, ""), positional);
}

std::string zsh_completion(const std::vector<Verb>& verbs, const KnownNames& names) {
  std::string list, cases;
  for (const auto& verb : verbs) {
    list += fmt::format("    '{}:{}'\n", verb.name, zsh_text(verb.summary));
    cases += fmt::format("      {}) _arguments{} ;;\n", verb.name, zsh_arguments(verb, names));
  }
  return fmt::format(
      "#compdef hysteron\n# Completion of hysteron {} in zsh; written by \"hysteron manual zsh\".\n"
      "_hysteron() {{\n  local state line\n  local -a verbs=(\n{}  )\n"
      "  _arguments -C '(-)--help[the list of verbs]' '(-)--version[which version this is]' '1:verb:->verb' "
      "'*::word:->words'\n"
      "  case $state in\n    verb) _describe verb verbs ;;\n    words) case $line[1] in\n{}    esac ;;\n  esac\n}}\n"
      "if [[ $funcstack[1] == _hysteron ]]; then _hysteron \"$@\"; else compdef _hysteron hysteron; fi\n",
      version_of_program(), list, cases);
}

}  // namespace hysteron
