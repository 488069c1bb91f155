// Decides how a number of an effect file is meant where it depends on the wire: "0.1 range", "1 row", "5 range/s".
// Does not decide which parameter gets it (effect_file.h).
#pragma once

#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "engine/diagram/units.h"

namespace hysteron {

/// A number times units and words of the circumstances. The words:
///   range  row  recording  hold          size of the signal, time between rows, longest recording, longest hold
///   side_range                           size of the side signal
///   lowest  middle  highest  side_middle levels; they stand alone
class EffectQuantity {
 public:
  EffectQuantity() = default;
  explicit EffectQuantity(double number) : number_(number) {}
  /// Throws Error "bad_value" or "bad_unit" at `path`.
  EffectQuantity(const std::string& text, const std::string& path);

  bool relative() const { return relative_; }  ///< true if a word of the circumstances stands in it
  Unit unit() const;                           ///< of one that is not relative
  Number number(const Excitation& at) const;   ///< as it is written into a diagram
  double si(const Excitation& at) const;

  static std::vector<std::string> words();

 private:
  struct Factor {
    std::string text;  ///< a word or a unit
    bool word = false;
    bool below = false;  ///< behind a "/"
  };
  double number_ = 0;
  std::vector<Factor> factors_;
  bool relative_ = false;
};

}  // namespace hysteron
