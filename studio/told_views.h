// Decides what of a view the page is told, which may know most of it already.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hysteron::studio {

/// The last few views that pages were told, so that the next one can be told as its difference from one of them.
class ToldViews {
 public:
  ToldViews();

  /// {"id", "view"}; or, where the view `had` is still known and the difference is shorter than the view,
  /// {"id", "of": had, "patch"}: operations of RFC 6902 that make the new view of that one. Ids of an earlier server
  /// are known to no other one.
  std::string tell(nlohmann::ordered_json view, const std::string& had);

 private:
  using View = std::shared_ptr<const nlohmann::ordered_json>;
  struct Told {
    std::string id;
    View view;
  };
  View known(const std::string& id);
  std::string keep(const View& view);

  const std::string series_;
  std::mutex mutex_;
  int count_ = 0;
  std::deque<Told> told_;  ///< the newest first
};

}  // namespace hysteron::studio
