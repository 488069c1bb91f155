// The only file that knows the parser; the verbs see Arguments.
#include "app/cli/words.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <memory>

#include "engine/diagram/error.h"

#ifndef HYSTERON_VERSION
#define HYSTERON_VERSION "unknown"
#endif

namespace hysteron {
namespace {

/// A verb as the parser sees it, with the places where it stores what it reads.
struct ParsedVerb {
  Verb verb;
  CLI::App* app = nullptr;
  std::deque<std::vector<std::string>> values;
  std::vector<CLI::Option*> parsed;
};

/// "Usage: hysteron compare [OPTIONS] diagram [other]"
std::string usage_of(const Verb& verb) {
  std::string text = "Usage: hysteron " + verb.name + " [OPTIONS]";
  for (const auto& spec : verb.options) {
    if (spec.name.starts_with("-")) continue;
    const std::string word = spec.name + (spec.repeated ? " ..." : "");
    text += spec.required ? " " + word : " [" + word + "]";
  }
  return text;
}

/// The help as CLI11 writes it, with our words for how a verb is called: its own name positionals "what(1x)".
class HelpOfVerb : public CLI::Formatter {
 public:
  explicit HelpOfVerb(std::string usage) : usage_(std::move(usage)) {}
  std::string make_usage(const CLI::App* /*app*/, std::string /*name*/) const override { return usage_ + "\n"; }

 private:
  std::string usage_;
};

/// The options of a verb that nobody asked for are left out: making them all would take longer than a small diagram.
void add_verb_to(CLI::App& app, ParsedVerb& parsed, bool asked) {
  parsed.app = app.add_subcommand(parsed.verb.name, parsed.verb.summary);
  if (!asked) return;
  parsed.app->description(parsed.verb.summary);
  parsed.app->footer(parsed.verb.help);
  const auto formatter = std::make_shared<HelpOfVerb>(usage_of(parsed.verb));
  formatter->column_width(app.get_formatter()->get_column_width());
  parsed.app->formatter(formatter);
  for (const auto& common : common_options()) parsed.verb.options.push_back(common.spec);
  for (const auto& spec : parsed.verb.options) {
    auto& value = parsed.values.emplace_back();
    CLI::Option* option = nullptr;
    if (spec.placeholder.empty()) {
      option = parsed.app->add_flag(spec.name, spec.meaning);
    } else {
      option = parsed.app->add_option(spec.name, value, spec.meaning);
      option->option_text(spec.placeholder);
      option->required(spec.required);
      option->allow_extra_args(false);
      option->multi_option_policy(spec.repeated ? CLI::MultiOptionPolicy::TakeAll : CLI::MultiOptionPolicy::Throw);
      option->expected(1);
      if (spec.repeated) option->expected(1, 1 << 20)->allow_extra_args(spec.several || !spec.name.starts_with("-"));
    }
    parsed.parsed.push_back(option);
  }
  for (const auto& common : common_options())
    if (!common.values.empty()) parsed.app->get_option(common.spec.name)->check(CLI::IsMember(common.values));
}

Arguments arguments_of(const ParsedVerb& parsed) {
  Arguments arguments;
  for (std::size_t i = 0; i < parsed.parsed.size(); ++i)
    if (parsed.parsed[i]->count() > 0) arguments.set(parsed.verb.options[i].name, parsed.values[i]);
  return arguments;
}

/// Names the first word nobody expected, with the nearest option of the verb.
[[noreturn]] void fail_unexpected(const ParsedVerb& parsed, const std::vector<std::string>& extras) {
  std::vector<std::string> known;
  for (const auto& spec : parsed.verb.options)
    if (spec.name.starts_with("-")) known.push_back(spec.name);
  const std::string word = extras.empty() ? "" : extras.front();
  const std::string bare = word.substr(0, word.find('='));
  fail("bad_command_line", parsed.verb.name, fmt::format("\"{}\" was not expected here", word),
       bare.starts_with("-") ? did_you_mean(bare, known) : fmt::format("see hysteron {} --help", parsed.verb.name));
}

/// The parser begins with the option: "--record: 1 required TEXT missing".
[[noreturn]] void fail_without_value(const ParsedVerb* parsed, const std::string& told) {
  const std::string option = told.substr(0, told.find(':'));
  if (parsed != nullptr)
    for (const auto& spec : parsed->verb.options)
      if (spec.name == option && !spec.placeholder.empty())
        fail("bad_command_line", option, "its value is missing or given twice",
             fmt::format("write {}={}; see hysteron {} --help", option, spec.placeholder, parsed->verb.name));
  fail("bad_command_line", parsed == nullptr ? "hysteron" : parsed->verb.name, told,
       fmt::format("see hysteron {}--help", parsed == nullptr ? "" : parsed->verb.name + " "));
}

void check_verb_name(const std::vector<std::string>& words, const std::deque<ParsedVerb>& verbs) {
  const auto first = std::find_if(words.begin(), words.end(), [](const std::string& w) { return !w.starts_with("-"); });
  if (first == words.end() || first != words.begin()) return;
  std::vector<std::string> names;
  for (const auto& parsed : verbs) names.push_back(parsed.verb.name);
  if (std::find(names.begin(), names.end(), *first) == names.end())
    fail("unknown_verb", *first, fmt::format("hysteron has no verb \"{}\"", *first),
         did_you_mean(*first, names) + " \"hysteron --help\" lists all verbs.");
}

}  // namespace

const std::vector<CommonOption>& common_options() {
  static const std::vector<CommonOption> list{
      {{"--quiet", "", "print no more than the result"}},
      {{"--json", "", "print the answer as one JSON object, for programs; failures, too (docs/programs.md)"}},
      {{"--progress", "FORM", "tell how far it is as \"text\" (default, on a terminal) or \"json\", a line per event"},
       {"text", "json"}},
      {{"--errors", "FORM", "print failures as \"text\" (default) or \"json\""}, {"text", "json"}}};
  return list;
}

const char* overview_of_program() {
  return "hysteron compares a model with recordings, names the physical effect that is missing,\n"
         "adds it to the diagram, fits it, and shows the error falling on other recordings.";
}

const char* first_steps() {
  return "The way through:\n"
         "  hysteron new --from lab.csv -o stage/                           a starter diagram from a recording\n"
         "  hysteron compare stage/diagram.json --data stage/dataset.json   how far off is the model, and where\n"
         "  hysteron discover stage/diagram.json --data stage/dataset.json  what is missing: found, added, fitted\n\n"
         "\"hysteron VERB --help\" teaches each verb.\n"
         "Exit codes: 0 done, 1 the answer to a yes-or-no question is no, 2 the input is wrong,\n"
         "            3 the numerics failed, 130 interrupted.";
}

const char* version_of_program() { return HYSTERON_VERSION; }

AskedVerb read_words(const std::vector<std::string>& words) {
  CLI::App app{overview_of_program(), "hysteron"};
  app.footer(first_steps());
  app.set_version_flag("--version", "hysteron " HYSTERON_VERSION);
  app.get_formatter()->column_width(26);
  app.require_subcommand(0, 1);
  std::deque<ParsedVerb> verbs;
  for (const auto make : verb_functions()) {
    ParsedVerb& parsed = verbs.emplace_back(ParsedVerb{make(), nullptr, {}, {}});
    add_verb_to(app, parsed, !words.empty() && words[0] == parsed.verb.name);
  }

  if (words.empty()) {
    return {std::nullopt, {}, app.help(), exit_code::bad_input};
  }
  check_verb_name(words, verbs);

  const auto chosen = [&]() -> const ParsedVerb* {
    for (const auto& parsed : verbs)
      if (app.got_subcommand(parsed.app)) return &parsed;
    return nullptr;
  };
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::CallForHelp&) {
    return {std::nullopt, {}, chosen() ? chosen()->app->help("hysteron") : app.help(), exit_code::done};
  } catch (const CLI::CallForVersion&) {
    return {std::nullopt, {}, fmt::format("hysteron {}\n", HYSTERON_VERSION), exit_code::done};
  } catch (const CLI::ExtrasError&) {
    if (chosen()) fail_unexpected(*chosen(), chosen()->app->remaining(true));
    fail("bad_command_line", words.front(), "was not expected here", "see hysteron --help");
  } catch (const CLI::ArgumentMismatch& error) {
    fail_without_value(chosen(), error.what());
  } catch (const CLI::ParseError& error) {
    const std::string verb = chosen() ? chosen()->verb.name + " " : "";
    fail("bad_command_line", verb.empty() ? "hysteron" : chosen()->verb.name, error.what(),
         fmt::format("see hysteron {}--help", verb));
  }
  if (!chosen()) fail("bad_command_line", "hysteron", "no verb was given", "see hysteron --help");
  return {chosen()->verb, arguments_of(*chosen()), "", exit_code::done};
}

}  // namespace hysteron
