#include "studio/job_words.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"

namespace hysteron::studio {
namespace {

using nlohmann::json;

/// Those that say where results go and in which form: the studio gives them. All others are the user's.
const std::vector<std::string> own_options{"-o",      "--json",  "--errors", "--progress", "--quiet",
                                           "--allow", "--write", "--slurm",  "--effects",  "--from"};

const JobVerb& verb_of(const std::string& name, const std::vector<JobVerb>& verbs) {
  std::vector<std::string> names;
  for (const auto& verb : verbs) {
    if (verb.name == name) return verb;
    names.push_back(verb.name);
  }
  fail("unknown_verb", name, "no job does \"" + name + "\"", did_you_mean(name, names));
}

std::string text_of(const json& value, const std::string& option) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  fail("bad_command_line", option, "its value is no text", "write it as in a terminal, e.g. \"1 s\"");
}

/// A name of a file that no option could be taken for.
std::string file_word(const std::string& name, const OpenFolder& folder, WordPaths paths) {
  const std::string file = folder.file(name);
  return paths == WordPaths::absolute ? file : "./" + folder.name_of(file);
}

void add_option(std::vector<std::string>& words, const JobVerb::Option& option, const json& value,
                const OpenFolder& folder, WordPaths paths) {
  if (option.is_flag) {
    if (value.is_boolean() && value.get<bool>()) words.push_back(option.name);
    return;
  }
  const json values = value.is_array() ? value : json::array({value});
  if (values.size() > 1 && !option.is_repeated)
    fail("bad_command_line", option.name, "it is given several times", "give it once");
  for (const auto& one : values) {
    const std::string text = text_of(one, option.name);
    words.push_back(option.name + "=" + (option.name == "--data" ? file_word(text, folder, paths) : text));
  }
}

}  // namespace

std::vector<std::string> option_words(const json& options, const JobVerb& verb, const OpenFolder& folder,
                                      WordPaths paths) {
  std::vector<std::string> words, known;
  for (const auto& option : verb.options)
    if (std::find(own_options.begin(), own_options.end(), option.name) == own_options.end())
      known.push_back(option.name);
  for (const auto& [name, value] : options.items()) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      fail("bad_command_line", name, "hysteron " + verb.name + " has no such option here", did_you_mean(name, known));
    for (const auto& option : verb.options)
      if (option.name == name) add_option(words, option, value, folder, paths);
  }
  return words;
}

std::vector<std::string> job_words(const json& asked, const std::vector<JobVerb>& verbs, const OpenFolder& folder,
                                   WordPaths paths) {
  const JobVerb& verb = verb_of(asked.value("verb", ""), verbs);
  std::vector<std::string> words{verb.name, file_word(asked.value("diagram", ""), folder, paths)};
  if (asked.contains("other")) words.push_back(file_word(asked.value("other", ""), folder, paths));
  const auto others = option_words(asked.value("options", json::object()), verb, folder, paths);
  words.insert(words.end(), others.begin(), others.end());
  return words;
}

}  // namespace hysteron::studio
