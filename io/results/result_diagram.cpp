#include "io/results/result_diagram.h"

#include <filesystem>

#include "io/diagram/diagram_file.h"
#include "io/files/project_path.h"

namespace hysteron {

namespace fs = std::filesystem;

std::string name_in_folder(const std::string& written) { return fs::path(written).filename().string(); }

std::string text_in_folder(const Diagram& diagram, const std::string& folder, const std::string& name,
                           const NestedDiagrams& nested) {
  const std::string target = (fs::path(folder) / name).string();
  Diagram moved = moved_diagram(diagram, target);
  for (const auto& [written, content] : nested) {
    const std::string elsewhere = moved_path(written, diagram.file, target);
    for (auto& [block, node] : moved.blocks) {
      if (node.file == elsewhere) node.file = name_in_folder(written);
      for (auto& [candidate, body] : node.from)
        if (body.file == elsewhere) body.file = name_in_folder(written);
    }
  }
  return diagram_text(moved);
}

}  // namespace hysteron
