// The Bouc-Wen fit of WORKLOADS W5 written by hand: one Runge-Kutta step a sample with forward sensitivities, bounded
// Levenberg-Marquardt. Input in V, output in um, parameters alpha, beta, gamma, d_p.
#pragma once

#include <array>
#include <vector>

namespace hysteron::benchmarks {

std::vector<double> bouc_wen_by_hand(const std::vector<double>& u, const std::array<double, 4>& p);

struct BoucWenFit {
  std::array<double, 4> p{};
  double rms = 0;
  int runs = 0;
};
BoucWenFit fit_bouc_wen_by_hand(const std::vector<double>& u, const std::vector<double>& y,
                                const std::array<double, 4>& start, const std::array<double, 4>& low,
                                const std::array<double, 4>& high);

}  // namespace hysteron::benchmarks
