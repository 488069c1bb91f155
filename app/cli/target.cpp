#include "app/cli/target.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "engine/diagram/error.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

/// Is `file` one of the nested diagrams that `diagram` is made of?
bool is_part(const std::string& file, const Diagram& diagram) {
  const auto is_it = [&](const Node& node) {
    std::error_code none;
    return node.nested && (fs::equivalent(file, node.nested->file, none) || is_part(file, *node.nested));
  };
  return std::any_of(diagram.blocks.begin(), diagram.blocks.end(), [&](const auto& block) {
    const auto& from = block.second.from;
    return is_it(block.second) ||
           std::any_of(from.begin(), from.end(), [&](const auto& candidate) { return is_it(candidate.second); });
  });
}

}  // namespace

void need_ending(const std::string& option, const std::string& file, const std::vector<std::string>& endings,
                 const std::string& what) {
  if (std::any_of(endings.begin(), endings.end(), [&](const auto& ending) { return file.ends_with(ending); })) return;
  fail("bad_command_line", option,
       endings.size() == 1 ? fmt::format("\"{}\" does not end in {}", file, endings.front())
                           : fmt::format("\"{}\" ends neither in {}", file, fmt::join(endings, " nor in ")),
       "name " + what);
}

void make_folder(const std::string& folder, const std::string& cure) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) fail("cannot_write", folder, "the folder cannot be made: " + code.message(), cure);
}

void check_diagram_target(const std::string& option, const std::string& file, const Diagram& diagram) {
  std::error_code none;
  const auto status = fs::status(file, none);
  if (fs::exists(status) && !fs::is_regular_file(status)) return;  // a terminal, a pipe; a folder is refused by write
  if (fs::exists(status) && !is_diagram_file(file))
    fail("file_in_use", option, fmt::format("{} is there and holds no diagram, so it is not written over", file),
         "name another file, e.g. next.json, or remove this one");
  if (fs::exists(status) && is_part(file, diagram))
    fail("file_in_use", option, fmt::format("{} is a part of the diagram that is read", file),
         "name another file, e.g. next.json");
  need_ending(option, file, {".json"}, "a JSON file, e.g. next.json");
}

}  // namespace hysteron
