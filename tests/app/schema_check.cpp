#include "tests/app/schema_check.h"

#include "tests/app/source_files.h"
#include "tests/io/schema_validator.h"

namespace hysteron::schema {

std::string refuses(const std::string& name, const std::string& json_text) {
  const std::string text = sources::text_of(std::string(HYSTERON_SOURCE_DIR) + "/schema/" + name + ".schema.json");
  if (text.empty()) return "the schema is not there";
  return SchemaValidator(text).refuses(json_text);
}

}  // namespace hysteron::schema
