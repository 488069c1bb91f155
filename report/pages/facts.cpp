// Decides how a verb says its facts for result.json: numbers, texts, lists and named members, as a plain value.
#include "report/pages/facts.h"

#include <nlohmann/json.hpp>

namespace hysteron {
namespace {

nlohmann::json json_of(const Facts& facts) {
  struct Visitor {
    nlohmann::json operator()(std::monostate) const { return nullptr; }
    nlohmann::json operator()(bool value) const { return value; }
    nlohmann::json operator()(long long value) const { return value; }
    nlohmann::json operator()(double value) const { return value; }
    nlohmann::json operator()(const std::string& text) const { return text; }
    nlohmann::json operator()(const Facts::List& list) const {
      auto array = nlohmann::json::array();
      for (const auto& item : list) array.push_back(json_of(item));
      return array;
    }
    nlohmann::json operator()(const Facts::Members& members) const {
      auto object = nlohmann::json::object();
      for (const auto& member : members) object[member.name] = json_of(member.value);
      return object;
    }
  };
  return std::visit(Visitor{}, facts.content);
}

}  // namespace

Facts::Facts(const std::optional<double>& value) {
  if (value) content = *value;
}
Facts::Facts(const std::vector<std::string>& texts) : content(List(texts.begin(), texts.end())) {}
Facts::Facts(const std::vector<double>& numbers) : content(List(numbers.begin(), numbers.end())) {}
Facts::Facts(List list) : content(std::move(list)) {}
Facts::Facts(Members members) : content(std::move(members)) {}
Facts Facts::object(Members members) { return Facts(std::move(members)); }

void Facts::set(const std::string& name, Facts value) {
  if (!std::holds_alternative<Members>(content)) content = Members{};
  auto& members = std::get<Members>(content);
  for (auto& member : members)
    if (member.name == name) {
      member.value = std::move(value);
      return;
    }
  members.push_back({name, std::move(value)});
}

std::shared_ptr<nlohmann::json> to_json(const Facts& facts) { return std::make_shared<nlohmann::json>(json_of(facts)); }

std::string json_text(const Facts& facts) { return to_json(facts)->dump(2); }

}  // namespace hysteron
