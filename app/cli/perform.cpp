#include "app/cli/perform.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <mutex>
#include <optional>

#include "app/cli/answer.h"
#include "app/cli/answer_json.h"
#include "app/cli/interrupt.h"
#include "app/cli/progress_line.h"
#include "app/cli/publish.h"
#include "app/cli/terminal.h"
#include "app/cli/watch.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

ProgressLine::Form form_of(const Arguments& arguments) {
  if (arguments.text("--progress") == "json") return ProgressLine::Form::json;
  return !arguments.quiet() && isatty(STDERR_FILENO) == 1 ? ProgressLine::Form::terminal : ProgressLine::Form::silent;
}

/// What a verb says while it works, and when it may be ended.
struct Watched {
  explicit Watched(const Arguments& arguments) : line(form_of(arguments)), quiet(arguments.quiet()) {
    watch.show = [this](double fraction, const std::string& what) { line.show(fraction, what); };
    watch.note = [this](const std::string& what) {
      const std::lock_guard lock(mutex);
      notes.push_back(what);
      if (!quiet) line.say("note: " + what);
    };
    watch.stop = interrupted;
    watch.keep = [this] {
      if (!deferred) deferred.emplace();
    };
  }

  Watch watch;
  ProgressLine line;
  bool quiet;
  std::mutex mutex;
  std::vector<std::string> notes;
  std::optional<DeferInterrupts> deferred;
};

/// Headline, sentences, warnings, what is said here only, and where report.html lies. Where there is a verdict much
/// stands between: there the headline comes last, where a reader of a terminal looks.
std::string document_text(const Answer& answer, bool quiet) {
  const Document& document = answer.document;
  const std::string headline = document.headline.empty() ? "" : wrapped(document.headline);
  std::string text = document.verdict.empty() ? headline : "";
  if (!quiet) {
    for (const auto& sentence : document.sentences) text += wrapped(sentence, 2);
    for (const auto& warning : document.warnings) text += wrapped("note: " + warning, 2);
    for (const auto& line : answer.asides) text += wrapped(line, 2);
  }
  text += fmt::format("report: {}\n", place_in(answer, "report.html"));
  return document.verdict.empty() ? text : text + headline;
}

/// What is in place is told when it is: a failure comes behind what was said before it.
void put_in_place(const Answer& answer, const Watch& watch, bool quiet, bool told) {
  const auto tell = [told](const std::string& text) {
    if (told && !text.empty()) fmt::print("{}", text);
  };
  tell(answer.text);
  if (!answer.folder.empty()) {
    publish_folder(answer, watch);
    tell(document_text(answer, quiet));
  }
  publish_files(answer);
  tell(answer.closing);
}

/// Nothing is told, and the watch ends it, unless it has ended the verb, which kept what it had found.
void put_in_place_silently(const Answer& answer, const Watch& watch) {
  const auto stop = [&] { return answer.interrupted.empty() && watch.stop(); };
  if (!answer.folder.empty()) publish_folder(answer, watch, stop);
  publish_files(answer);
}

}  // namespace

int perform(const Verb& verb, const Arguments& arguments) {
  Watched watched(arguments);
  try {
    const Answer answer = verb.act(arguments, watched.watch);
    watched.line.clear();
    put_in_place(answer, watched.watch, arguments.quiet(), !arguments.json());
    if (arguments.json()) fmt::print("{}", answer_json(verb, answer, watched.notes));
    watched.line.end(answer.interrupted.empty());
    if (!answer.interrupted.empty()) fmt::print(stderr, "{}\n", answer.interrupted);
    return answer.exit_code;
  } catch (const ErrorBehindText& error) {
    watched.line.clear();
    if (!arguments.json()) fmt::print("{}", error.text());
    throw;
  }
}

Performed perform_silently(const Verb& verb, const Arguments& arguments, Watch watch) {
  Performed performed;
  std::mutex mutex;
  watch.note = [&, told = watch.note](const std::string& what) {
    const std::lock_guard lock(mutex);
    performed.notes.push_back(what);
    told(what);
  };
  // A verb that has something to keep looks by itself whether it is to end, and is not ended while it tells.
  std::atomic<bool> keeps{false};
  watch.keep = [&, told = watch.keep] {
    keeps = true;
    told();
  };
  {
    const StopScope until_stopped([&] { return !keeps && watch.stop(); });
    performed.answer = verb.act(arguments, watch);
  }
  Answer& answer = performed.answer;
  if (!arguments.has("-o") && answer.held == nullptr) answer.folder.clear();
  put_in_place_silently(answer, watch);
  return performed;
}

}  // namespace hysteron
