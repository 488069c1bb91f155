// Decides whether a file satisfies a schema that the project ships, by an independent validator.
#include "tests/app/schema_check.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace hysteron::schema {

std::string refuses(const std::string& name, const std::string& json_text) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  std::ifstream file(std::string(HYSTERON_SOURCE_DIR) + "/schema/" + name + ".schema.json");
  const auto schema_json = nlohmann::json::parse(file, nullptr, false);
  const auto json = nlohmann::json::parse(json_text, nullptr, false);
  if (schema_json.is_discarded()) return "the schema is not there, or is no JSON";
  if (json.is_discarded()) return "this is no JSON";
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(Adapter(schema_json), schema);
  valijson::ValidationResults results;
  valijson::Validator validator;
  if (validator.validate(schema, Adapter(json), &results)) return "";
  std::string all = "refused";
  for (const auto& error : results) {
    all += "\n";
    for (const auto& step : error.context) all += step;
    all += ": " + error.description;
  }
  return all;
}

}  // namespace hysteron::schema
