#include "app/cli/answer_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/cli/publish.h"
#include "app/cli/shape.h"
#include "io/json/schema_text.h"
#include "io/results/result_manifest.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> files_of(const Answer& answer) {
  std::vector<std::string> files;
  if (!answer.folder.empty())
    for (const auto& name : files_of_result(answer.document)) files.push_back(place_in(answer, name));
  for (const auto& file : answer.files) files.push_back(file.path);
  return files;
}

std::vector<std::string> warnings_of(const Answer& answer, const std::vector<std::string>& notes) {
  std::vector<std::string> all = notes;
  for (const auto* list : {&answer.document.warnings, &answer.warnings})
    all.insert(all.end(), list->begin(), list->end());
  return all;
}

}  // namespace

std::string answer_json(const Verb& verb, const Answer& answer, const std::vector<std::string>& notes) {
  Json root{{"verb", verb.name}, {"exit_code", answer.exit_code}};
  if (!answer.folder.empty()) {
    root["headline"] = answer.document.headline;
    if (!answer.document.verdict.empty()) root["verdict"] = answer.document.verdict;
    root["folder"] = answer.folder;
    root["result"] = place_in(answer, result_file);
  }
  const Json own = in_order(answer.facts);
  if (own.is_object()) root.update(own);
  if (own.is_null() && answer.document.facts) root["facts"] = *answer.document.facts;
  root["warnings"] = warnings_of(answer, notes);
  root["files"] = files_of(answer);
  // A file name or a column may hold bytes that are no UTF-8.
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string answer_schema(const Verb& verb) {
  const std::string meaning = fmt::format("What \"hysteron {} --json\" prints: {}.", verb.name, verb.summary);
  std::vector<shape::Member> members{{"verb", Facts::object({{"const", verb.name}})},
                                     {"exit_code", shape::whole("as the program ends with it")}};
  for (auto& member : verb.shape()) members.push_back(std::move(member));
  members.push_back({"warnings", shape::texts("what must not be overlooked")});
  members.push_back({"files", shape::texts("what was written")});
  return schema_text("answer of hysteron " + verb.name, shape::object(meaning, members));
}

std::string schema_text(const std::string& title, const Facts& shape) {
  Json json{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  json.update(in_order(shape));
  return schema::to_text(json);
}

std::string answer_schema_name(const Verb& verb) { return verb.name + ".answer.schema.json"; }

}  // namespace hysteron
