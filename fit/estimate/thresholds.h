// Decides where the thresholds of a Prandtl-Ishlinskii block lie: placed over the swings of its input, then refined by
// what the recordings ask for. Does not find weights (linear.h, fit.h).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/block/kernel.h"
#include "engine/diagram/diagram.h"
#include "fit/estimate/fit.h"

namespace hysteron {

enum class Placement {
  even,     ///< evenly over the largest swing
  by_swing  ///< at equal shares of the rows: dense where the input turns often
};

/// `count` thresholds, the first 0, increasing, in the unit of the inputs (one list of rows per recording). One-sided
/// operators reach over the whole swing of the input, two-sided ones over half of it. Fewer come back where the input
/// offers fewer different swings; none but 0 where it does not move.
std::vector<double> place_thresholds(std::span<const std::vector<double>> inputs, int count, bool two_sided,
                                     Placement placement);

struct Operators {
  std::vector<double> thresholds, weights;
};

/// Many operators made few: those of no weight are left out, then the two neighbours whose union changes the model
/// least become one, at the mean of their thresholds by weight, until `count` are left (Ward, J. Am. Stat. Assoc. 58
/// (1963) 236). The operator of threshold 0, the linear part, stays. Weights must not be negative.
Operators merge_operators(Operators many, int count);

struct ThresholdFit {
  Diagram diagram;   ///< with the thresholds and weights found
  FitResult result;  ///< of the last fit: weights and thresholds
};

/// Finds `count` thresholds and weights of the block `block` ("core"): placed four times as dense, weights >= 0 by
/// least squares, merged, and thresholds and weights searched together from there. The numbers that the diagram gives
/// decide nothing but units and sides. Throws Error "no_block", "wrong_type", "bad_count"; where nothing can be
/// simulated result.ok is false.
ThresholdFit fit_thresholds(const Diagram& diagram, const Registry& registry,
                            const std::shared_ptr<const DataSet>& data, const std::string& block, int count,
                            Placement placement = Placement::even, const FitOptions& options = {});

}  // namespace hysteron
