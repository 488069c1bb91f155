#include "tests/io/schema_validator.h"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace hysteron {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

struct SchemaValidator::Content {
  explicit Content(const std::string& text) : json(nlohmann::json::parse(text)) {
    valijson::SchemaParser().populateSchema(Adapter(json), schema);
  }
  nlohmann::json json;
  valijson::Schema schema;
};

SchemaValidator::SchemaValidator(const std::string& schema) : content_(std::make_unique<Content>(schema)) {}
SchemaValidator::~SchemaValidator() = default;

std::string SchemaValidator::refuses(const std::string& text) const {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return "refused: this is no JSON";
  valijson::ValidationResults results;
  if (valijson::Validator().validate(content_->schema, Adapter(json), &results)) return "";
  std::string all = "refused";
  for (const auto& error : results) {
    all += "\n";
    for (const auto& step : error.context) all += step;
    all += ": " + error.description;
  }
  return all;
}

}  // namespace hysteron
