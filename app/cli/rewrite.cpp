// Decides how a changed diagram reaches the disk: with the nested diagrams that changed, or only as text.
// Does not change diagrams.
#include "app/cli/rewrite.h"

#include <fmt/format.h>

#include <filesystem>

#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

/// Where a nested diagram goes: its name is relative to the diagram as it was read.
std::string place_of(const Diagram& diagram, const std::string& written) {
  return (fs::path(diagram.file).parent_path() / written).lexically_normal().string();
}

}  // namespace

WrittenFile diagram_file(const std::string& file, const Diagram& diagram) {
  return {file, diagram_text(moved_diagram(diagram, file))};
}

void rewrite(Answer& answer, const Arguments& arguments, const Diagram& diagram, const NestedDiagrams& nested) {
  if (!arguments.has("-o")) {
    if (!arguments.quiet()) answer.text += "nothing was written; -o FILE.json writes it\n";
    return;
  }
  std::error_code code;
  for (const auto& [written, content] : nested) {
    const std::string file = place_of(diagram, written);
    behind(answer.text, [&, &there = file] {
      if (fs::exists(there, code))
        fail("file_there", there, "the changed nested diagram would go here, and there is a file already",
             "remove or rename that file");
    });
    answer.files.push_back(diagram_file(file, content));
  }
  answer.files.push_back(diagram_file(arguments.text("-o"), diagram));
  for (const auto& file : answer.files) answer.closing += fmt::format("wrote {}\n", file.path);
}

}  // namespace hysteron
