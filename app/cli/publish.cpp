// Decides how a verb ends: its folder of results is written, and what matters is printed, the report's place last.
// Does not decide what was found.
#include "app/cli/publish.h"

#include <fmt/format.h>

#include "app/cli/interrupt.h"
#include "app/cli/terminal.h"
#include "engine/diagram/stop.h"
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

/// Writes, unless Ctrl-C comes before anything is replaced. Who was interrupted before and keeps what was found by
/// then is not stopped by the first Ctrl-C to come.
template <class Action>
void write_in_order(const std::string& folder, const Action& action) {
  const DeferInterrupts until_in_place(true);
  const int enough = interrupts() + (interrupted() ? 2 : 1);
  const StopScope scope([enough] { return interrupts() >= enough; });
  try {
    action();
  } catch (const Stopped&) {
    throw Interrupted(fmt::format("interrupted; nothing was written into {}", folder));
  }
}

}  // namespace

FolderLock::Waiting say_who_writes(const std::string& folder) {
  constexpr int too_short_to_be_said = 10;  // calls, of which there are twenty a second
  return [folder, calls = 0](const std::string& holder) mutable {
    if (++calls == too_short_to_be_said) fmt::print(stderr, "waiting for {}, which writes into {}\n", holder, folder);
  };
}

void write_results(const std::string& folder, const Document& document) {
  const std::string page = report_html(document);
  write_in_order(folder, [&] { write_result(folder, document, page, say_who_writes(folder)); });
}

void publish(const Arguments& arguments, const std::string& folder, const Document& document,
             const std::vector<std::string>& said_here_only) {
  write_results(folder, document);
  print_answer(arguments, folder, document, said_here_only);
}

void publish_staged(const Arguments& arguments, StagedResults& staged, const std::string& folder,
                    const Document& document, const std::vector<std::string>& said_here_only) {
  const std::string page = report_html(document);
  write_in_order(folder, [&] { finish_result(staged, folder, document, page); });
  print_answer(arguments, folder, document, said_here_only);
}

}  // namespace hysteron
