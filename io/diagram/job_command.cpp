#include "io/diagram/job_command.h"

#include <filesystem>

#include "io/files/shell_word.h"

namespace hysteron {

std::string job_command(const std::string& what, const std::string& file) {
  if (what != "runs") return "hysteron " + what + " " + shell_word(file);
  // A job of runs is called by its name, in a folder that has claims and parts of it beside.
  const std::filesystem::path path(file);
  const std::string folder = path.parent_path().string();
  return "hysteron reproduce " + shell_word(path.stem().string()) + " --from " +
         shell_word(folder.empty() ? "." : folder);
}

}  // namespace hysteron
