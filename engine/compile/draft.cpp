#include "engine/compile/draft.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_set>

#include "engine/compile/compile.h"
#include "engine/compile/lengths.h"
#include "engine/compile/scalarize_vectors.h"
#include "engine/compile/unused.h"

namespace hysteron {
namespace {

/// What somebody who goes on writing will see to.
bool is_unfinished(const Problem& p) {
  return p.code == "missing_connection" || p.code == "empty_diagram" || p.code.starts_with("unused_");
}

/// "/blocks/a/gain" speaks of "/blocks/a", and not of "/blocks/ab".
bool speaks_of(const std::string& path, const std::string& place) {
  return path.starts_with(place) && (path.size() == place.size() || path[place.size()] == '/');
}

class Draft {
 public:
  Draft(const Diagram& diagram, const Registry& registry) : written_(diagram), registry_(registry) {}

  DraftProgram compile() {
    while (!compiled() && repaired_) repaired_ = false;
    for (const auto& p : problems_.list()) (is_unfinished(p) ? result_.warnings : result_.problems).push_back(p);
    return std::move(result_);
  }

 private:
  /// One attempt; false where something was wrong: what it was is then left out of the next one.
  bool compiled() {
    const std::size_t before = gaps_.size();
    WiredDiagram wired = wire_draft(diagram(), registry_, gaps_, problems_);
    result_.left_out = wired.left_out;
    repaired_ = gaps_.size() > before;
    if (repaired_ || wired.blocks.empty()) return false;
    places_.clear();
    for (const auto& block : wired.blocks)
      if (!block.origin.empty()) places_.insert(block.origin);
    take_out_bounds(wired.parameters);
    try {
      infer_lengths(wired);
      result_.program = compile_graph(scalarize_vectors(std::move(wired), registry_), diagram());
      return true;
    } catch (const Error& error) {
      for (const auto& p : error.problems) take(p);
      return false;
    }
  }

  void take(const Problem& p) {
    if (!comes_of_gaps(p)) problems_.add(p.code, p.path, p.what, p.cure);
    if (speaks_of(p.path, "/simulate"))
      leave_out_setting(p.path);
    else if (constexpr std::string_view of_parameter = "/parameters/"; p.path.starts_with(of_parameter))
      repaired_ = wrong_bounds_.insert(p.path.substr(of_parameter.size())).second || repaired_;
    else
      leave_out_block(p.path);
  }

  /// "/simulate/guess/a", where block "a" is left out, or perhaps the loop that "a" would stand in.
  bool comes_of_gaps(const Problem& p) const {
    if (!speaks_of(p.path, "/simulate")) return false;
    if (p.code == "unused_guess") return !gaps_.left_out.empty();
    const auto& blocks = result_.left_out;
    return std::any_of(blocks.begin(), blocks.end(), [&](const std::string& block) {
      return head_of_wire(p.path.substr(p.path.rfind('/') + 1)) == head_of_wire(block);
    });
  }

  const Diagram& diagram() const { return without_settings_ ? *without_settings_ : written_; }

  void leave_out_setting(const std::string& path) {
    if (!without_settings_) without_settings_.emplace(written_);
    auto& simulate = without_settings_->simulate;
    const auto leave_out = [&](const char* name, auto& setting) {
      if (!speaks_of(path, std::string("/simulate/") + name)) return;
      repaired_ = wrong_settings_.insert(name).second || repaired_;
      setting = {};
    };
    leave_out("loops", simulate.loops);
    leave_out("guess", simulate.guess);
    leave_out("past", simulate.past);
    leave_out("memory", simulate.memory);
  }

  void take_out_bounds(Ordered<GraphParameter>& parameters) {
    for (auto& [path, parameter] : parameters) {
      const auto is_meant = [&](const std::string& wrong) {  // "kp", "kp/bounds", "weights[2]"
        return wrong.starts_with(parameter.path) && wrong.substr(parameter.path.size()).find_first_not_of("/[") != 0;
      };
      if (std::none_of(wrong_bounds_.begin(), wrong_bounds_.end(), is_meant)) continue;
      DiagramParameter& without = boundless_.emplace_back(*parameter.given);
      without.lower.reset();
      without.upper.reset();
      parameter.given = &without;
    }
  }

  /// The innermost block that stands there: "/blocks/a" for "/blocks/a/gain", not for "/blocks/ab".
  void leave_out_block(std::string path) {
    while (!path.empty() && !places_.contains(path)) {
      const auto slash = path.rfind('/');
      path.resize(slash == std::string::npos ? 0 : slash);
    }
    if (!path.empty() && gaps_.left_out.insert(path).second) repaired_ = true;
  }

  const Diagram& written_;
  std::optional<Diagram> without_settings_{};  // those that are wrong; a large diagram is copied for these alone
  const Registry& registry_;
  Gaps gaps_{};
  Problems problems_{};
  std::unordered_set<std::string> places_{};  // of the blocks of the attempt
  std::set<std::string> wrong_settings_{};
  std::set<std::string> wrong_bounds_{};  // of these parameters
  std::deque<DiagramParameter> boundless_{};
  bool repaired_ = false;
  DraftProgram result_{};
};

}  // namespace

DraftProgram compile_draft(const Diagram& diagram, const Registry& registry) {
  return Draft(diagram, registry).compile();
}

}  // namespace hysteron
