// The parameters of the thesis' Tables 2.1 to 2.3, in V and um.
#pragma once

#include <vector>

#include "models/hysteresis/bouc_wen.h"
#include "models/hysteresis/jiles_atherton.h"

namespace hysteron::thesis {

inline const bouc_wen::Params<double> table_2_1{.alpha = 0.6187, .beta = 0.2418, .gamma = 0.0237, .d_p = 1.6126};
inline const jiles_atherton::Params<double> table_2_2{
    .p_s = 55.9973, .a = 48.5843, .alpha = 0.2512, .k = 3.8892, .c = 0.6929};
/// Table 2.3.
inline const std::vector<double> weights{0.7521, 0.1381, 0.0775, 0.0651, 0.0658,
                                         0.0522, 0.0506, 0.0523, 0.0520, 0.1169};
inline const std::vector<double> thresholds{0, 0.6, 1.2, 1.8, 2.4, 3.0, 3.6, 4.2, 4.8, 5.4};

}  // namespace hysteron::thesis
