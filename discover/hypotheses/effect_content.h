// Decides what an effect file says of its effect in numbers, and what follows from them at one place: the laws that are
// tried there, why it cannot be seen there, and what is told of its values.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "discover/hypotheses/effect_quantity.h"
#include "engine/diagram/diagram.h"

namespace hysteron {

/// One free number as the file says it; "times[0]" is an element of the parameter "times".
struct EffectFreeNumber {
  std::string path;
  std::string program_path{};  ///< "tau[0]" where the block that reads the number "tau" takes a list
  EffectQuantity start;
  std::optional<EffectQuantity> lower{}, upper{}, usual_lower{}, usual_upper{};
  std::vector<EffectQuantity> scan{};
  std::optional<EffectQuantity> scan_from{}, scan_to{};
  double per_decade = 3;
  bool log_scale = false, per_recording = false;
};

/// What recordings must have so that the effect can be seen in them.
struct EffectNeeds {
  std::string text;
  std::optional<EffectQuantity> range{}, hold{}, side_range{};
  int reversals = 0, recordings = 0;
  bool changes_sign = false;
};

/// What laws(), unseen() and summary() of the effect work with.
struct EffectContent {
  std::string file, law_name, says;
  std::shared_ptr<const Diagram> diagram;
  std::vector<EffectFreeNumber> free;
  std::vector<std::pair<std::string, EffectQuantity>> fixed;
  EffectNeeds needs;
};

/// "times[0]" -> {"times", 0}; "tau" -> {"tau", -1}; an index of -2 is none that a list could have.
std::pair<std::string, int> list_and_index(const std::string& path);

/// The law with the values at which its fit begins there [SI].
Law law_of(const EffectContent& content, const Excitation& at);

/// Why recordings with this excitation do not show the effect; "" = they do, or there are none yet.
std::string why_unseen(const EffectContent& content, const Excitation& at);

/// "says" of the file with `values` [SI] of the law's free numbers, each in the unit of its start.
std::string summary_of(const EffectContent& content, const Law& law, const std::vector<double>& values,
                       const Excitation& at);

}  // namespace hysteron
