// Decides how a verb is carried out for another program: watched through a function of C, its answer as JSON, its
// traces as columns.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/cli/answer_json.h"
#include "app/cli/words.h"
#include "app/study/study_slurm.h"
#include "interop/c/asked.h"
#include "interop/c/handles.h"
#include "report/page/figure_file.h"
#include "report/pages/numbers.h"

namespace hysteron::interop {
namespace {

using Json = nlohmann::ordered_json;

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

/// What starts the program again, which a library does not know: it has been loaded by another one.
void need_work_for_a_library(const Verb& verb, const Arguments& arguments) {
  if (verb.name == "studio")
    fail("bad_call", verb.name, "serves a page, for which it starts the program itself again and again",
         "start it as a program: hysteron studio");
  if (verb.name == "study" && wants_slurm(arguments))
    fail(
        "bad_call", "--slurm", "hands jobs to a cluster, each of which starts the program itself",
        "start it as a program (hysteron study ... --slurm), or compute here: leave --slurm and what belongs to it out");
}

std::unique_ptr<hy_result> carry_out(const std::vector<std::string>& words, Asked& asked) {
  auto result = std::make_unique<hy_result>();
  const AskedVerb reading = read_words(words);
  if (!reading.verb) {
    result->json = Json{{"verb", words.front()}, {"exit_code", reading.exit_code}, {"text", reading.text}}.dump();
    return result;
  }
  need_work_for_a_library(*reading.verb, reading.arguments);
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
