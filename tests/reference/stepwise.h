// Decides what laws share whose output hangs on a whole number that changes at instants only, and on edges.
#pragma once

#include <string>

#include "tests/reference/law.h"

namespace reference {

/// Between instants the number is what it was at the last one.
class Stepwise : public Law {
 public:
  long branch(const Point& p) const override { return now(p); }
  int roughness() const override { return 0; }
  void keep(const Point& p) override {
    if (p.free) kept = now(p);
  }

 protected:
  virtual long now(const Point& p) const = 0;
  long at(const Point& p) const { return p.free ? now(p) : kept; }

 private:
  long kept = 0;
};

inline bool is_true(double signal) { return signal > 0.5; }

/// When something becomes true, or false, or either. What is true at the start makes no edge there.
class Edges {
 public:
  explicit Edges(std::string which_) : which(std::move(which_)) {}
  bool at(bool is) const {
    return known && is != was && (which == "either" || is == (which == "rising" || which == "while_on"));
  }
  void take(bool is) {
    was = is;
    known = true;
  }
  bool is_known() const { return known; }
  bool was_true() const { return was; }

 private:
  std::string which;
  bool was = false, known = false;
};

}  // namespace reference
