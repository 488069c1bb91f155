// Decides which parameters a fit may change, and which of them are found by linear least squares: proved from the
// program. Does not fit.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

struct FreeParameter {
  int parameter = -1;           ///< index into Program::parameters
  double start = 0;             ///< [SI]
  double lower = 0, upper = 0;  ///< [SI], may be infinite
  bool log_scale = false;       ///< searched in ln(value); value and bounds > 0
  std::vector<double>
      scan{};          ///< [SI] values tried before the local search (the best two are refined); empty = start only
  int recording = -1;  ///< its value is that of this recording alone; -1: one value for all
  /// [SI] what is known beforehand: 95 % of a normal distribution (of the logarithm where the scale is logarithmic).
  std::optional<std::pair<double, double>> prior{};
};

/// The free parameters of a diagram, and those named in `extra` ("kp", "core.weights" = all its elements,
/// "core.weights[2]"). Positive parameters whose lower bound is > 0, or that span more than two decades between
/// positive bounds, get a log scale, as do declared-positive ones that are not linear. Throws Error
/// "unknown_parameter".
std::vector<FreeParameter> free_parameters(const Program& program, const std::vector<std::string>& extra = {});

/// One free parameter by path with start and bounds from the program.
FreeParameter free_parameter(const Program& program, const std::string& path);

/// For each parameter: is the vector of all measured outputs jointly affine in it and in all others marked true?
/// Rules (each one necessary): declared linear at every slot; every block from there to a measured output is declared
/// linear; no block of one is downstream of a block of the other unless the downstream one is an offset (its
/// coefficient does not depend on the block's input). Among the sets allowed the one with most parameters is taken.
std::vector<bool> jointly_affine(const Program& program, const std::vector<int>& parameters,
                                 const std::vector<int>& output_signals);

}  // namespace hysteron
