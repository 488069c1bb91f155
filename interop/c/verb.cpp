// Decides how a verb is carried out for another program: watched through a function of C, its answer as JSON, its
// traces as columns.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/cli/answer_json.h"
#include "app/cli/words.h"
#include "interop/c/handles.h"
#include "report/page/figure_file.h"
#include "report/pages/numbers.h"

namespace hysteron::interop {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

/// Tells and asks the function of the caller now and then, one thread at a time.
class Asked {
 public:
  Asked(hy_watch told, void* context) : told_(told), context_(context), last_(Clock::now()) {}

  Watch watch() {
    Watch watch;
    if (told_ == nullptr) return watch;
    watch.show = [this](double fraction, const std::string& what) {
      const std::unique_lock lock(mutex_, std::try_to_lock);
      if (!lock) return;
      fraction_ = fraction;
      what_ = what;
      ask();
    };
    watch.stop = [this] {
      if (!stopped_ && due()) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock) ask();
      }
      return stopped_.load();
    };
    return watch;
  }

 private:
  bool due() const { return Clock::now() - last_.load() >= shortest_period; }
  void ask() {
    if (stopped_ || !due()) return;
    stopped_ = told_(context_, fraction_, what_.c_str()) != 0;
    last_ = Clock::now();
  }

  static constexpr std::chrono::milliseconds shortest_period{50};
  hy_watch told_;
  void* context_;
  std::mutex mutex_;
  std::atomic<bool> stopped_{false};
  std::atomic<Clock::time_point> last_;
  double fraction_ = -1;
  std::string what_;
};

Json traces_of(const Document& document) {
  Json list = Json::array();
  for (const auto& trace : document.traces) {
    Json columns = Json::array();
    for (const auto& column : trace.columns)
      columns.push_back({{"name", column.name}, {"unit", unit_text(column.unit)}});
    list.push_back({{"file", trace.file}, {"rows", trace.rows()}, {"columns", columns}});
  }
  return list;
}

/// What --json says, and what stands in files or on the terminal else.
std::string result_json(const Verb& verb, const Performed& performed) {
  const Answer& answer = performed.answer;
  Json json = Json::parse(answer_json(verb, answer, performed.notes));
  if (!answer.document.headline.empty()) json["headline"] = answer.document.headline;
  if (!answer.document.verdict.empty()) json["verdict"] = answer.document.verdict;
  if (answer.document.facts && !json.contains("facts")) json["facts"] = *answer.document.facts;
  json["sentences"] = answer.document.sentences;
  json["text"] = answer.text + answer.closing;
  json["traces"] = traces_of(answer.document);
  json["figures"] = answer.document.answer.size();
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void need_verb_for_programs(const Verb& verb) {
  if (verb.name == "studio")
    fail("bad_call", verb.name, "serves a page, for which it starts the program itself again and again",
         "start it as a program: hysteron studio");
}

std::unique_ptr<hy_result> carry_out(const std::vector<std::string>& words, Asked& asked) {
  auto result = std::make_unique<hy_result>();
  const AskedVerb reading = read_words(words);
  if (!reading.verb) {
    result->json = Json{{"verb", words.front()}, {"exit_code", reading.exit_code}, {"text", reading.text}}.dump();
    return result;
  }
  need_verb_for_programs(*reading.verb);
  Performed performed = perform_silently(*reading.verb, reading.arguments, asked.watch());
  result->json = result_json(*reading.verb, performed);
  result->answer = std::move(performed.answer);
  return result;
}

const CsvColumn* column_of(const hy_result& result, const std::string& trace, const std::string& column) {
  for (const auto& table : result.answer.document.traces)
    if (table.file == trace) return table.find(column);
  return nullptr;
}

}  // namespace
}  // namespace hysteron::interop

using namespace hysteron;

hy_result* hy_verb(const char* verb, int n, const char* const* words, hy_watch watch, void* context, hy_error** error) {
  return interop::guarded<hy_result*>(error, nullptr, [&] {
    interop::need(verb, "verb");
    std::vector<std::string> all{verb};
    for (int i = 0; i < n; ++i) {
      interop::need(words, "words");
      interop::need(words[i], fmt::format("words[{}]", i).c_str());
      all.emplace_back(words[i]);
    }
    interop::Asked asked(watch, context);
    return interop::carry_out(all, asked).release();
  });
}

const char* hy_result_json(const hy_result* result) { return result == nullptr ? "{}" : result->json.c_str(); }

int64_t hy_result_column(const hy_result* result, const char* trace, const char* column, const double** numbers) {
  if (numbers != nullptr) *numbers = nullptr;
  if (result == nullptr || trace == nullptr || column == nullptr || numbers == nullptr) return -1;
  return interop::guarded<int64_t>(nullptr, -1, [&]() -> int64_t {
    const CsvColumn* found = interop::column_of(*result, trace, column);
    if (found == nullptr) return -1;
    *numbers = found->values.data();
    return std::ssize(found->values);
  });
}

const char* hy_result_figure(hy_result* result, int figure) {
  return interop::guarded<const char*>(nullptr, nullptr, [&]() -> const char* {
    if (result == nullptr || figure < 0) return nullptr;
    const auto& figures = result->answer.document.answer;
    const auto place = static_cast<std::size_t>(figure);
    if (place >= figures.size()) return nullptr;
    result->figures.resize(figures.size());
    auto& text = result->figures[place];
    if (text == nullptr) text = std::make_unique<std::string>(figure_file(result->answer.document, figures[place]));
    return text->c_str();
  });
}
