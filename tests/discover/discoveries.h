// What tests of discovery share: the blocks and the effects, and what to print of a discovery that went wrong.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "blocks/register_all.h"
#include "discover/effects/all.h"
#include "discover/selection/discover.h"

namespace hysteron::testing {

class Discoveries : public ::testing::Test {
 protected:
  /// One step; `only`: these effects, all if empty.
  Discovery diagnosed(const Diagram& d, const DataSet& data, std::vector<std::string> only = {},
                      DiscoverOptions options = {}) {
    options.only = std::move(only);
    return diagnose(d, data, registry, effects, options);
  }
  /// All steps.
  Discovery discovered(const Diagram& d, const DataSet& data, std::vector<std::string> only,
                       DiscoverOptions options = {}) {
    options.only = std::move(only);
    return discover(d, data, registry, effects, options);
  }
  /// What the diagram does not leave free is exact.
  static DiscoverOptions exact() {
    DiscoverOptions options;
    options.numbers_are_exact = true;
    return options;
  }
  /// Everything that was tried and refused, for a failure.
  static std::string tried(const Discovery& d) {
    std::string text = d.headline;
    for (const auto& c : d.candidates)
      text += "\n  " + std::to_string(c.step) + " " + c.effect + " at " + c.place + ", " + c.law + ": " + c.summary +
              "; fall " + std::to_string(c.fall_validate) + ", " + c.reason;
    for (const auto& r : d.refused) text += "\n  refused " + r.effect + ": " + r.reason;
    return text;
  }
  static std::string winner(const Discovery& d) { return d.steps.empty() ? "" : d.steps.front().winner.effect; }
  /// Value [SI] of a parameter of the first winner, by the end of its path.
  static double value(const Discovery& d, const std::string& path) {
    for (const auto& f : d.steps.front().winner.found)
      if (f.estimate.path.ends_with("." + path)) return f.estimate.used;
    return std::nan("");
  }
  Registry registry = all_blocks();
  Effects effects = all_effects();
};

}  // namespace hysteron::testing
