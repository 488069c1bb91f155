// Decides how a verb says its facts for result.json: numbers, texts, lists and named members, as a plain value.
#include "report/pages/facts.h"

#include <nlohmann/json.hpp>
#include <string_view>
#include <unordered_set>

namespace hysteron {
namespace {

template <class Json>
Json json_of(const Facts& facts);

template <class Json>
struct Visitor {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(bool value) const { return value; }
  Json operator()(long long value) const { return value; }
  Json operator()(double value) const { return value; }
  Json operator()(const std::string& text) const { return text; }
  Json operator()(const Facts::List& list) const {
    auto array = Json::array();
    for (const auto& item : list) array.push_back(json_of<Json>(item));
    return array;
  }
  Json operator()(const Facts::Members& members) const {
    auto object = Json::object();
    auto& list = object.template get_ref<typename Json::object_t&>();
    if constexpr (requires { list.emplace_back(std::string(), Json()); }) {
      // In order: nlohmann would look through all members before each new one, and copy all of them as they grow.
      std::unordered_set<std::string_view> names;
      list.reserve(members.size());
      for (const auto& member : members)
        if (names.insert(member.name).second)
          list.emplace_back(member.name, json_of<Json>(member.value));
        else
          object[member.name] = json_of<Json>(member.value);
    } else {
      for (const auto& member : members) object[member.name] = json_of<Json>(member.value);
    }
    return object;
  }
};

template <class Json>
Json json_of(const Facts& facts) {
  return std::visit(Visitor<Json>{}, facts.content);
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

std::shared_ptr<nlohmann::json> to_json(const Facts& facts) {
  return std::make_shared<nlohmann::json>(json_of<nlohmann::json>(facts));
}

nlohmann::ordered_json in_order(const Facts& facts) { return json_of<nlohmann::ordered_json>(facts); }

}  // namespace hysteron
