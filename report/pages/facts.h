// Decides how a verb says its facts for result.json: numbers, texts, lists and named members, as a plain value.
// Does not decide how JSON looks; keeps the costly JSON header out of the verbs.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hysteron {

struct FactMember;

struct Facts {
  using List = std::vector<Facts>;
  using Members = std::vector<FactMember>;
  std::variant<std::monostate, bool, long long, double, std::string, List, Members> content{};

  Facts() = default;
  Facts(bool value) : content(value) {}                          // NOLINT: implicit, so that facts read like JSON
  Facts(int value) : content(static_cast<long long>(value)) {}   // NOLINT
  Facts(long value) : content(static_cast<long long>(value)) {}  // NOLINT
  Facts(std::size_t value) : content(static_cast<long long>(value)) {}  // NOLINT
  Facts(double value) : content(value) {}                               // NOLINT
  Facts(const char* text) : content(std::string(text)) {}               // NOLINT
  Facts(std::string text) : content(std::move(text)) {}                 // NOLINT
  Facts(const std::optional<double>& value);                            // NOLINT: absent = null
  Facts(const std::vector<std::string>& texts);                         // NOLINT
  Facts(const std::vector<double>& numbers);                            // NOLINT
  Facts(List list);                                                     // NOLINT
  Facts(Members members);                                               // NOLINT
  static Facts object(Members members);

  /// Adds or replaces a member (nothing yet: becomes an object).
  void set(const std::string& name, Facts value);
};

struct FactMember {
  std::string name;
  Facts value;
};

/// For Document::facts.
std::shared_ptr<nlohmann::json> to_json(const Facts& facts);
/// Members in the order in which they were said.
nlohmann::ordered_json in_order(const Facts& facts);

}  // namespace hysteron
