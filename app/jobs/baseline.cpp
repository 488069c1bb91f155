#include "app/jobs/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/diagram/error.h"
#include "fit/signals/features.h"
#include "io/files/atomic_file.h"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr double alike = 1e-6;  ///< of the span: above the integrators' own error, below what a figure shows

/// Last of all that is kept: a folder without it is none.
void write_outcomes(const fs::path& folder, const std::map<std::string, std::string>& outcomes) {
  const nlohmann::ordered_json all{{"format", 1}, {"outcomes", outcomes}};
  write_file((folder / "baseline.json").string(), all.dump(2) + "\n");
}

void keep(const fs::path& folder, const std::vector<ClaimOutcome>& claims, const std::vector<CsvTable>& traces) {
  std::error_code code;
  fs::create_directories(folder / "traces", code);
  if (code)
    fail("cannot_write", folder.string(), "the folder cannot be made: " + code.message(),
         "name another with --baseline");
  for (const auto& table : traces) write_csv((folder / "traces" / table.file).string(), table);
  write_outcomes(folder, [&] {
    std::map<std::string, std::string> outcomes;
    for (const auto& c : claims) outcomes[c.claim.id] = c.outcome;
    return outcomes;
  }());
}

std::map<std::string, std::string> outcomes_in(const fs::path& file) {
  try {
    return nlohmann::json::parse(read_file(file.string())).at("outcomes").get<std::map<std::string, std::string>>();
  } catch (const nlohmann::json::exception& e) {
    fail("bad_baseline", file.string(), fmt::format("the file is damaged: {}", e.what()),
         "take the folder away and keep a new one");
  }
}

/// "" if both say the same; else where and by how much.
std::string difference(const CsvTable& before, const CsvTable& now) {
  if (before.columns.size() != now.columns.size() || before.rows() != now.rows())
    return fmt::format("{}: {} rows, before {}", now.file, now.rows(), before.rows());
  for (std::size_t k = 0; k < now.columns.size(); ++k) {
    const auto& a = before.columns[k].values;
    const auto& b = now.columns[k].values;
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    const double span = std::max(features::stroke(a), features::largest_size(a) * 1e-6);
    if (most > alike * span)
      return fmt::format("{}: {} differs by up to {:.3g} {} ({:.2g} of its span)", now.file, now.columns[k].name, most,
                         now.columns[k].unit.text, most / span);
  }
  return "";
}

}  // namespace

BaselineAnswer hold_against(const std::string& folder, const std::vector<ClaimOutcome>& claims,
                            const std::vector<CsvTable>& traces, bool everything) {
  BaselineAnswer answer;
  const fs::path root(folder);
  if (!fs::exists(root / "baseline.json")) {
    keep(root, claims, traces);
    answer.kept = true;
    return answer;
  }
  auto before = outcomes_in(root / "baseline.json");
  const auto held = [](const std::string& outcome) { return outcome == "agrees" || outcome == "calibrated"; };
  for (const auto& c : claims) {
    const auto found = before.find(c.claim.id);
    if (found == before.end()) {
      answer.added.push_back(c.claim.id);
      before[c.claim.id] = c.outcome;
      continue;
    }
    if (held(found->second) && !c.holds()) answer.worse.push_back(c.claim.id);
    if (!held(found->second) && c.holds()) answer.better.push_back(c.claim.id);
  }
  for (const auto& table : traces) {
    const fs::path file = root / "traces" / table.file;
    if (!fs::exists(file)) {
      write_csv(file.string(), table);
      answer.added.push_back(table.file);
      continue;
    }
    const std::string text = difference(read_csv(file.string()), table);
    if (!text.empty()) answer.changed.push_back(text);
  }
  for (const auto& [id, outcome] : before)
    if (everything && held(outcome) &&
        std::none_of(claims.begin(), claims.end(), [&, &name = id](const auto& c) { return c.claim.id == name; }))
      answer.worse.push_back(id);
  if (!answer.added.empty()) write_outcomes(root, before);
  return answer;
}

}  // namespace hysteron
