// Decides the laws that the lags of an amplifier and of a sensor share: one pole, two poles.
#pragma once

#include <string>
#include <vector>

#include "discover/hypotheses/effect.h"

namespace hysteron::effects {

std::vector<Law> lag_laws(const Excitation& at);
std::string lag_summary(const Law& law, const std::vector<double>& values, const Excitation& at);
/// Why a lag of these time constants is none: slower than all recordings, it integrates. "" = it is one.
std::string lag_without_end(const Law& law, const std::vector<double>& values, const Excitation& at);

}  // namespace hysteron::effects
