#include "io/diagram/layout_file.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "io/json/json_reader.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

constexpr double farthest = 100000;  // steps; beyond it nothing was put there by hand

bool is_step(double value) { return value == std::round(value) && std::abs(value) <= farthest; }

}  // namespace

std::string layout_file_of(const std::string& diagram_file) {
  std::filesystem::path file(diagram_file);
  return file.replace_extension(".layout.json").string();
}

BlockPlaces read_layout(const std::string& diagram_file) {
  const std::string file = layout_file_of(diagram_file);
  BlockPlaces places;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return places;
  JsonFile json(file);
  const JsonPlace root = json.root();
  if (root.expect_object(R"({"format": 1, "blocks": {"motor": [12, 4]}})")) {
    check_format(root, "layout");
    root.only({"format", "blocks"});
    const auto blocks = root.find("blocks");
    if (blocks && blocks->expect_object(R"({"motor": [12, 4]})"))
      for (const auto& [name, place] : blocks->members()) {
        const auto steps = place.is_array() ? place.elements() : std::vector<JsonPlace>{};
        const bool are_numbers = steps.size() == 2 && steps[0].is_number() && steps[1].is_number();
        const auto x = are_numbers ? steps[0].number() : std::nullopt;
        const auto y = are_numbers ? steps[1].number() : std::nullopt;
        if (x && y && is_step(*x) && is_step(*y))
          places[name] = {static_cast<int>(*x), static_cast<int>(*y)};
        else
          place.add_wrong_type("two whole numbers, steps to the right and down, such as [12, 4]");
      }
  }
  json.throw_if_any();
  return places;
}

std::string layout_text(const BlockPlaces& places) {
  std::string text = "{\n  \"format\": 1,\n  \"blocks\": {";
  const char* before = "\n";
  for (const auto& [name, at] : places) {
    text += fmt::format("{}    {}: [{}, {}]", before, json_quoted(name), at[0], at[1]);
    before = ",\n";
  }
  return text + (places.empty() ? "}\n}\n" : "\n  }\n}\n");
}

}  // namespace hysteron
