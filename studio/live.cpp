#include "studio/live.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "studio/trace_file.h"

namespace hysteron::studio {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr int usual_patience = 1500, most_patience = 30000;  // [ms]

/// The trace that is looked at, else the first.
const CsvTable& shown_of(const VerbAnswer& answer, const std::string& wanted) {
  const auto found =
      std::find_if(answer.traces.begin(), answer.traces.end(), [&](const CsvTable& t) { return t.file == wanted; });
  if (found != answer.traces.end()) return *found;
  if (answer.traces.empty())
    fail("no_traces", "verb", "this verb gives no curves", "drag a number of a diagram that was run or compared");
  return answer.traces.front();
}

/// Those of the columns that are there.
std::vector<std::string> columns_of(const CsvTable& table, const json& asked) {
  std::vector<std::string> columns;
  for (const auto& name : asked.value("columns", std::vector<std::string>{}))
    if (table.find(name) != nullptr) columns.push_back(name);
  return columns;
}

std::string with_head(json head, const std::string& numbers) {
  std::string text = head.dump(-1, ' ', false, json::error_handler_t::replace);
  text.resize((text.size() + sizeof(double) - 1) / sizeof(double) * sizeof(double), ' ');
  const auto length = static_cast<double>(text.size());
  std::string bytes(reinterpret_cast<const char*>(&length), sizeof length);
  return bytes + text + numbers;
}

}  // namespace

std::string Live::answer(const json& asked) {
  const long mine = ++newest_;
  std::vector<std::string> words = job_words(asked, verbs_, folder_, WordPaths::absolute);
  for (const auto& folder : allowed_) words.push_back("--allow=" + folder);
  const std::lock_guard lock(one_);
  const auto until =
      Clock::now() + std::chrono::milliseconds(std::clamp(asked.value("patience", usual_patience), 1, most_patience));
  const VerbAnswer answer = own_.carry_out(words, [&] { return mine != newest_ || Clock::now() > until; });
  const CsvTable& table = shown_of(answer, asked.value("trace", ""));
  const auto columns = columns_of(table, asked);
  json head{{"headline", answer.headline}, {"trace", table.file}, {"rows", table.rows()}};
  head["facts"] = json::parse(answer.json).value("facts", json::object());
  for (const auto& trace : answer.traces) head["traces"].push_back(trace.file);
  head["columns"] = json::array();
  for (const auto& name : columns) head["columns"].push_back({{"name", name}, {"unit", table.find(name)->unit.text}});
  const TraceStretch wanted{asked.value("from", 0.0), asked.value("to", 0.0),
                            static_cast<std::size_t>(std::max(1, asked.value("pixels", 1000)))};
  return with_head(std::move(head), TraceFiles::stretch_of(table, columns, wanted));
}

}  // namespace hysteron::studio
