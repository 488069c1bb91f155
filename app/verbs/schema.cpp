// The verb schema: writes the JSON Schemas of the files that hysteron reads and writes, from the declarations.
// Does not decide what they say (io/results/schema.cpp).
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "app/cli/load.h"
#include "app/cli/verb.h"
#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"
#include "io/files/atomic_file.h"
#include "io/jobs/claims_file.h"
#include "io/jobs/job_file.h"

namespace hysteron {
namespace {

constexpr char schema_help[] =
    "Writes the JSON Schemas by which an editor completes and checks diagrams, data sets, jobs and results.\n"
    "They are made from the same declarations that \"hysteron check\" uses.\n\n"
    "Examples:\n"
    "  hysteron schema -o schema/\n\n"
    "Writes diagram, dataset, job, claims, result and effect (.schema.json); a file\n"
    "names its schema with \"$schema\": \"../schema/diagram.schema.json\".\n"
    "Exit codes: 0 done, 2 the folder cannot be written.";

int schema(const Arguments& arguments) {
  const std::filesystem::path folder = arguments.text("-o", "schema");
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code)
    fail("cannot_write", folder.string(), "the folder cannot be made: " + code.message(),
         "name another with -o FOLDER");
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file((folder / name).string(), text);
    fmt::print("{}\n", (folder / name).string());
  };
  write("diagram.schema.json", diagram_schema(registry()));
  write("dataset.schema.json", dataset_schema());
  write("job.schema.json", job_schema());
  write("claims.schema.json", claims_schema());
  write("result.schema.json", result_schema());
  write("effect.schema.json", effect_schema(registry()));
  return exit_code::done;
}

}  // namespace

Verb schema_verb() {
  return {"schema",
          "write the JSON Schemas of diagrams, data sets, jobs, effects and results",
          schema_help,
          {{"-o", "FOLDER", "where they go; default: schema", false, false}},
          schema};
}

}  // namespace hysteron
