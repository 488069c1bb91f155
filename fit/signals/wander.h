// Decides what a line of interference may do in one recording beside being steady: its amplitude and phase wander
// slowly. Does not find lines (interference.h) and does not decide whose they are. Internal to fit/ and discover/.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "fit/signals/turning_line.h"

namespace hysteron {

/// A line and its harmonics: amplitude and phase of each move in straight lines between knots.
struct WanderingLine {
  double frequency = 0;  ///< [Hz]
  int harmonics = 1;     ///< the line itself counts
  bool by_user = false;  ///< in the user's own model: its steady part, too, is found anew in each recording
  bool operator==(const WanderingLine&) const = default;
};

/// [Hz] that the mains of one recording may be off the mean of all: the standard range of the grid of Europe (ENTSO-E).
constexpr double mains_astray = 0.05;

/// What the rows of a recording hold beside all else that is known, and their white noise (rms); empty: not known.
struct ShownLine {
  std::span<const double> rows{};
  double white = 0;
  double astray = mains_astray;  ///< [Hz] that the line may be off here
};

/// All that one such line may be in the rows of one recording, and how it is taken out of them. A knot every two
/// seconds: a mains 8 mHz off its mean frequency turns by a tenth of a radian in that time, which straight lines follow
/// to a few per mille. Fewer where rows are few: at most a twentieth of them are given away, and with them no more of
/// what another effect takes away; none where there are too few for two knots.
/// Where even half as many knots would be too many, one angle turns the line and its harmonics about what the rows show
/// of it (turning_line.h), if that is known and more than noise: a sixth of the rows at most. A line that hardly stands
/// out has a frequency of its own and no more.
/// Rows are cleared before they are whitened: noise is as white as can be about a line, and between knots each row
/// belongs to two of them only, so that hours of a recording cost what its rows cost.
class LineSpan {
 public:
  enum class Part {
    wandering,  ///< what the line may be beside a steady one, which a model that has one keeps
    all
  };
  LineSpan() = default;
  /// `t`: times of the rows [s], rising.
  LineSpan(std::span<const double> t, const WanderingLine& line, const ShownLine& shown = {});

  std::size_t knots() const { return knots_; }  ///< 0: nothing is taken out
  /// Least squares, in place; as many rows as the recording has.
  void take_out(std::span<double> rows, Part part) const;

 private:
  struct Factor;
  bool turns(std::span<const double> t, const WanderingLine& line, const ShownLine& shown);
  void make_factors();
  void make_beside();
  void take_out_turning(std::span<double> rows, Part part) const;

  std::size_t waves_ = 0, knots_ = 0;  ///< waves: a cosine and a sine of each harmonic
  std::vector<double> wave_;           ///< [row][wave]
  std::vector<std::size_t> knot_;      ///< of each row, the one before it
  std::vector<double> beyond_;         ///< of each row, the part of the way to the next one
  std::shared_ptr<const Factor> moving_, steady_;
  std::shared_ptr<const TurningLine> turning_;                      ///< in place of moving_
  std::shared_ptr<const std::vector<std::vector<double>>> beside_;  ///< with it: see make_beside()
};

/// What is no evidence of anything in the rows of one output.
class LeftOut {
 public:
  LeftOut() = default;
  LeftOut(std::shared_ptr<const std::vector<LineSpan>> of_recordings, LineSpan::Part part)
      : lines_(std::move(of_recordings)), part_(part) {}
  bool any() const { return lines_ != nullptr; }
  void take_out(std::size_t recording, std::span<double> rows) const {
    if (any()) (*lines_)[recording].take_out(rows, part_);
  }

 private:
  std::shared_ptr<const std::vector<LineSpan>> lines_;
  LineSpan::Part part_ = LineSpan::Part::wandering;
};

}  // namespace hysteron
