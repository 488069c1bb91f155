#include "app/cli/publish.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/cli/interrupt.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "report/page/report.h"

namespace hysteron {
namespace {

/// Writes, unless Ctrl-C or `stop` comes before anything is replaced. Who was interrupted before and keeps what was
/// found by then is not stopped by the first Ctrl-C to come.
template <class Action>
void write_in_order(const std::string& folder, const std::function<bool()>& stop, const Action& action) {
  const DeferInterrupts until_in_place(true);
  const int enough = interrupts() + (interrupted() ? 2 : 1);
  const StopScope scope([&stop, enough] { return interrupts() >= enough || (stop && stop()); });
  try {
    action();
  } catch (const Stopped&) {
    throw Interrupted(fmt::format("interrupted; nothing was written into {}", folder));
  }
}

FolderLock::Waiting say_who_writes(const std::string& folder, const Watch& watch) {
  constexpr int too_short_to_be_said = 10;  // calls, of which there are twenty a second
  return [folder, say = watch.note, calls = 0](const std::string& holder) mutable {
    if (++calls == too_short_to_be_said) say(fmt::format("waiting for {}, which writes into {}", holder, folder));
  };
}

}  // namespace

std::string place_in(const Answer& answer, const std::string& name) {
  const bool slash = answer.folder.size() > 1 && answer.folder.back() == '/';
  return answer.folder + (slash ? "" : "/") + name;
}

std::shared_ptr<HeldFolder> hold_folder(const std::string& folder, const Watch& watch) {
  return std::make_shared<HeldFolder>(folder, say_who_writes(folder, watch));
}

void publish_folder(const Answer& answer, const Watch& watch, const std::function<bool()>& stop) {
  const std::string page = report_html(answer.document);
  write_in_order(answer.folder, stop, [&] {
    if (answer.held && answer.held->staged)
      finish_result(*answer.held->staged, answer.folder, answer.document, page);
    else
      write_result(answer.folder, answer.document, page, say_who_writes(answer.folder, watch));
  });
}

void publish_files(const Answer& answer) {
  std::error_code code;
  std::vector<std::string> made;
  try {
    for (const auto& file : answer.files) {
      if (file.in_place) continue;
      const bool is_new = !std::filesystem::exists(file.path, code);
      write_file(file.path, file.content);
      if (is_new) made.push_back(file.path);
    }
  } catch (...) {
    for (const auto& file : made) std::filesystem::remove(file, code);
    throw;
  }
}

}  // namespace hysteron
