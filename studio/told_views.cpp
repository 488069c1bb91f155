#include "studio/told_views.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "studio/guard.h"

namespace hysteron::studio {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_kept =
    4;  // one per page, and most people have one or two: a view of 1000 blocks takes 10 MB
constexpr std::size_t long_patch = 1U << 17U;  // [B]: a shorter one is told without a look at how long the view is

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

ToldViews::ToldViews() : series_(new_token()) {}

ToldViews::View ToldViews::known(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(told_.begin(), told_.end(), [&](const Told& told) { return told.id == id; });
  return found == told_.end() ? nullptr : found->view;
}

std::string ToldViews::keep(const View& view) {
  const std::lock_guard lock(mutex_);
  told_.push_front({series_ + "/" + std::to_string(++count_), view});
  if (told_.size() > most_kept) told_.pop_back();
  return told_.front().id;
}

std::string ToldViews::tell(Json view, const std::string& had) {
  const View before = known(had), now = std::make_shared<const Json>(std::move(view));
  const std::string id = keep(now);
  std::string patch;
  if (before) {
    patch = text_of({{"id", id}, {"of", had}, {"patch", Json::diff(*before, *now)}});
    if (patch.size() < long_patch) return patch;
  }
  std::string whole = text_of({{"id", id}, {"view", *now}});
  return before && patch.size() < whole.size() ? patch : whole;
}

}  // namespace hysteron::studio
