// Decides how what some columns can explain is taken out of others, when the triangle of their least-squares problem is
// known already: by its normal equations, twice. No basis is made. Internal to fit/.
#pragma once

#include <span>
#include <vector>

#include "fit/numerics/dense.h"

namespace hysteron {

class ColumnSpan {
 public:
  /// `triangle`: R of R'R = C'C (NormalForm::r). A column that those before it explain to `tolerance` is left out.
  /// The columns must outlive this.
  ColumnSpan(const Dense& columns, std::span<const double> triangle, double tolerance);

  /// x - C (C'C)^-1 C' x for each x; returns (C'C)^-1 C' x, per column of C, zero for those left out. The second time
  /// corrects what rounding left in the first: the error falls with the square of the columns' condition times rounding
  /// ("corrected seminormal equations", Bjorck, Linear Algebra Appl. 88/89 (1987) 31-48).
  std::vector<std::vector<double>> clear(std::span<double* const> list) const;

 private:
  void solve(std::vector<double>& right_side) const;

  const Dense& columns_;
  std::vector<std::size_t> kept_;
  std::vector<double> length_;  ///< of those
  Dense triangle_;              ///< of those, scaled to length one
};

}  // namespace hysteron
