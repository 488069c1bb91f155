// The verb schema: the JSON Schemas of the files that hysteron reads and writes and of what --json prints, from the
// declarations. Does not decide what they say (io/results/schema.cpp, answer_json.h).
#include "io/results/schema.h"

#include <filesystem>

#include "app/cli/answer.h"
#include "app/cli/answer_json.h"
#include "app/cli/failure.h"
#include "app/cli/load.h"
#include "app/cli/progress_line.h"
#include "app/cli/shape.h"
#include "app/cli/target.h"
#include "io/diagram/diagram_file.h"
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
    "names its schema with \"$schema\": \"../schema/diagram.schema.json\". And what the program says to programs:\n"
    "of each verb what it prints with --json (run.answer.schema.json), failure and progress (docs/programs.md).\n"
    "Exit codes: 0 done, 2 the folder cannot be written.";

Answer schemas(const Arguments& arguments, const Watch&) {
  const std::filesystem::path folder = arguments.text("-o", "schema");
  make_folder(folder.string(), "name another with -o FOLDER");
  Answer answer;
  const auto write = [&](const std::string& name, std::string text) {
    answer.files.push_back({(folder / name).string(), std::move(text)});
    answer.closing += answer.files.back().path + "\n";
  };
  write("diagram.schema.json", diagram_schema(registry()));
  write("dataset.schema.json", dataset_schema());
  write("job.schema.json", job_schema());
  write("claims.schema.json", claims_schema());
  write("result.schema.json", result_schema());
  write("effect.schema.json", effect_schema(registry()));
  write("failure.schema.json", failure_schema());
  write("progress.schema.json", progress_schema());
  for (const auto make : verb_functions())
    if (const Verb verb = make(); verb.shape != nullptr) write(answer_schema_name(verb), answer_schema(verb));
  answer.facts = Facts::object({{"folder", folder.string()}});
  return answer;
}

std::vector<shape::Member> schemas_shape() { return {{"folder", shape::text("where the schemas lie")}}; }

}  // namespace

Verb schema_verb() {
  return {"schema",    "write the JSON Schemas of diagrams, data sets, jobs, effects and results",
          schema_help, {{"-o", "FOLDER", "where they go; default: schema", false, false}},
          schemas,     schemas_shape};
}

}  // namespace hysteron
