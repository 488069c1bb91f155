// Decides whether a text satisfies a JSON Schema (draft-07), by an independent validator (valijson).
#pragma once

#include <memory>
#include <string>

namespace hysteron {

class SchemaValidator {
 public:
  /// Throws what the JSON parser throws where `schema` is no JSON, std::runtime_error where it is no schema.
  explicit SchemaValidator(const std::string& schema);
  ~SchemaValidator();
  SchemaValidator(const SchemaValidator&) = delete;
  SchemaValidator& operator=(const SchemaValidator&) = delete;

  /// "" where the text is valid, else "refused" and a line for each place at which it is not.
  std::string refuses(const std::string& text) const;

 private:
  struct Content;
  const std::unique_ptr<Content> content_;
};

}  // namespace hysteron
