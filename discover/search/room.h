// Decides how many further names a search may still take, where steps are told anew and names may leave again.
#pragma once

#include <algorithm>

namespace hysteron {

/// Counts steps, for effects that stand on several axes may be one name; a name that leaves gives its place back.
class Room {
 public:
  /// `names` stand of `most`; ends after so many turns whatever leaves.
  Room(int names, int most, int turns) : names_(names), taken_(names), most_(most), turns_(turns) {}
  /// Before each turn, with the names that stand by now: may one more be sought?
  bool left(int names) {
    taken_ -= std::max(0, names_ - names);
    names_ = names;
    return taken_ < most_ && turns_ > 0;
  }
  /// A turn is over in which something was claimed: a name, or only more of those that stand.
  void took_a_name() { ++taken_, --turns_; }
  void took_no_name() { --turns_; }

 private:
  int names_, taken_, most_, turns_;
};

}  // namespace hysteron
