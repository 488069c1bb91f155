// A page is made of requests of the man macros: groff_man(7). A help text is paragraphs, and lines that begin with
// blanks, which are shown as they stand.
#include "app/manual/manual_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include "app/cli/words.h"

namespace hysteron {
namespace {

/// A text that troff shows as it stands, in a line that begins no request.
std::string escaped(std::string_view text) {
  std::string roff;
  if (text.starts_with('.') || text.starts_with('\'')) roff = "\\&";
  for (const char c : text) {
    if (c == '\\')
      roff += "\\e";
    else if (c == '-')
      roff += "\\-";
    else
      roff += c;
  }
  return roff;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

std::string head(const std::string& name, const std::string& summary) {
  return fmt::format(".TH {} 1 \"\" \"hysteron {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", escaped(upper(name)),
                     escaped(version_of_program()), escaped(name), escaped(summary));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Words that a page has a section for, and how far they reach in the line that begins with them.
struct Heading {
  std::string_view words, section;
};
constexpr Heading headings[] = {{"Examples:", "EXAMPLES"}, {"Example:", "EXAMPLES"}, {"Exit codes:", "EXIT STATUS"}};

/// A help text; what stands behind "Examples:" and "Exit codes:" goes into sections of its own.
std::string described(const std::string& help) {
  std::string roff = ".SH DESCRIPTION\n";
  bool as_it_stands = false, in_examples = false;
  const auto shown = [&](bool now) {
    if (now != as_it_stands) roff += now ? ".PP\n.nf\n" : ".fi\n";
    as_it_stands = now;
  };
  for (std::string line : lines_of(help)) {
    for (const auto& heading : headings)
      if (line.starts_with(heading.words)) {
        shown(false);
        roff += fmt::format(".SH {}\n", heading.section);
        in_examples = heading.section == "EXAMPLES";
        line.erase(0, std::min(line.find_first_not_of(' ', heading.words.size()), line.size()));
      }
    if (line.starts_with("  ")) {
      shown(true);
      roff += escaped(line) + "\n";
    } else if (line.empty()) {
      shown(false);
      if (!roff.ends_with(".PP\n")) roff += ".PP\n";
    } else {
      shown(false);
      if (in_examples && roff.ends_with(".PP\n")) {  // what follows the examples is told, not shown
        roff.replace(roff.size() - 4, 4, ".SH NOTES\n");
        in_examples = false;
      }
      roff += escaped(line) + "\n";
    }
  }
  shown(false);
  return roff;
}

std::string option_text(const OptionSpec& spec) {
  const std::string value = spec.placeholder.empty() ? "" : " \\fI" + escaped(spec.placeholder) + "\\fR";
  const std::string often = spec.repeated && !spec.several ? " May be given several times." : "";
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}.{}\n", escaped(spec.name), value, escaped(spec.meaning), often);
}

std::string options_text(const std::vector<OptionSpec>& specs) {
  std::string roff;
  for (const auto& spec : specs) roff += option_text(spec);
  for (const auto& common : common_options()) roff += option_text(common.spec);
  return roff;
}

std::string synopsis(const Verb& verb) {
  std::string roff = fmt::format(".SH SYNOPSIS\n.B hysteron {}\n", escaped(verb.name));
  for (const auto& spec : verb.options) {
    const bool is_option = spec.name.starts_with("-");
    if (is_option && !spec.required) continue;
    std::string word = is_option ? fmt::format("\\fB{}\\fR \\fI{}\\fR", escaped(spec.name), escaped(spec.placeholder))
                                 : fmt::format("\\fI{}\\fR", escaped(spec.placeholder));
    if (spec.repeated && !spec.several) word += " ...";
    roff += (spec.required ? word : "[" + word + "]") + "\n";
  }
  return roff + "[\\fIoptions\\fR]\n";
}

}  // namespace

std::string manual_page(const Verb& verb) {
  return head("hysteron-" + verb.name, verb.summary) + synopsis(verb) + described(verb.help) + ".SH OPTIONS\n" +
         options_text(verb.options) + ".SH SEE ALSO\n.BR hysteron (1)\n";
}

std::string manual_page_of_program() {
  std::string roff = head("hysteron", "find out what a model of a machine lacks, from recordings of the machine");
  roff +=
      ".SH SYNOPSIS\n.B hysteron\n\\fIverb\\fR [\\fIoptions\\fR]\n.PP\n.B hysteron\n\\fIverb\\fR \\fB\\-\\-help\\fR\n";
  roff += described(std::string(overview_of_program()) + "\n\n" + first_steps());
  std::string verbs = ".SH VERBS\nEach has a page of its own.\n", others;
  for (const auto make : verb_functions()) {
    const Verb verb = make();
    verbs += fmt::format(".TP\n.BR hysteron\\-{} (1)\n{}\n", escaped(verb.name), escaped(verb.summary));
    others += fmt::format("{}.BR hysteron\\-{} (1)", others.empty() ? "" : ",\n", escaped(verb.name));
  }
  roff += verbs + ".SH OPTIONS\nWhat every verb takes besides its own:\n";
  for (const auto& common : common_options()) roff += option_text(common.spec);
  return roff + ".SH SEE ALSO\n" + others + "\n";
}

}  // namespace hysteron
