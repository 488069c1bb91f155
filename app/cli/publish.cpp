// Decides how a verb ends: its folder of results is written, and what matters is printed, the report's place last.
// Does not decide what was found.
#include "app/cli/publish.h"

#include <fmt/format.h>

#include "app/cli/interrupt.h"
#include "app/cli/terminal.h"
#include "report/page/report.h"

namespace hysteron {
namespace {

void print_answer(const Arguments& arguments, const std::string& folder, const Document& document,
                  const std::vector<std::string>& said_here_only) {
  if (!document.headline.empty()) fmt::print("{}", wrapped(document.headline));
  if (!arguments.quiet()) {
    for (const auto& sentence : document.sentences) fmt::print("{}", wrapped(sentence, 2));
    for (const auto& warning : document.warnings) fmt::print("{}", wrapped("note: " + warning, 2));
    for (const auto& line : said_here_only) fmt::print("{}", wrapped(line, 2));
  }
  fmt::print("{}: {}/report.html\n", document.verdict.empty() ? "report" : document.verdict,
             folder.size() > 1 && folder.back() == '/' ? folder.substr(0, folder.size() - 1) : folder);
}

}  // namespace

void write_results(const std::string& folder, const Document& document) {
  const std::string page = report_html(document);
  const DeferInterrupts until_in_place(true);
  write_result(folder, document, page);
}

void publish(const Arguments& arguments, const std::string& folder, const Document& document,
             const std::vector<std::string>& said_here_only) {
  write_results(folder, document);
  print_answer(arguments, folder, document, said_here_only);
}

void publish_into(const Arguments& arguments, const std::string& folder, const Document& document,
                  const std::vector<std::string>& said_here_only) {
  const std::string page = report_html(document);
  const DeferInterrupts until_in_place(true);
  add_result(folder, document, page);
  print_answer(arguments, folder, document, said_here_only);
}

}  // namespace hysteron
