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

void rewrite(const Arguments& arguments, const Diagram& diagram, const NestedDiagrams& nested) {
  if (!arguments.has("-o")) {
    if (!arguments.quiet()) fmt::print("nothing was written; -o FILE.json writes it\n");
    return;
  }
  const std::string file = arguments.text("-o");
  std::error_code code;
  for (const auto& [written, content] : nested)
    if (fs::exists(place_of(diagram, written), code))
      fail("file_there", place_of(diagram, written),
           "the changed nested diagram would go here, and there is a file already", "remove or rename that file");
  for (const auto& [written, content] : nested) write_diagram(place_of(diagram, written), content);
  write_diagram(file, diagram);
  for (const auto& [written, content] : nested) fmt::print("wrote {}\n", place_of(diagram, written));
  fmt::print("wrote {}\n", file);
}

}  // namespace hysteron
