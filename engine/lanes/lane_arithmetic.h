// Decides the sums over all lanes that a step of a formula needs, in the widest vectors of the processor.
#pragma once

#include <cstddef>

namespace hysteron {

struct LaneFill {
  double* to;
  double value;
  std::size_t count;
};
/// to[i] = value.
void lane_fill(const LaneFill& a);

struct LaneMove {
  double* to;  ///< may be `from`
  const double *from, *slope;
  double h;  ///< [s]
  std::size_t count;
};
/// to[i] = from[i] + h slope[i].
void lane_move(const LaneMove& a);

struct LaneCombination {
  double* x;
  const double *k1, *k2, *k3, *k4;
  double h;  ///< [s]
  std::size_t count;
};
/// x[i] += h/6 (k1[i] + 2 (k2[i] + k3[i]) + k4[i]): the classical formula of order four.
void lane_combine(const LaneCombination& a);

struct LaneSum {
  double* sum;
  const double* y;
  std::size_t count;
};
/// sum[i] += 0 y[i]: zero as long as every y was finite, not a number for ever behind one that was not.
void lane_watch(const LaneSum& a);

}  // namespace hysteron
