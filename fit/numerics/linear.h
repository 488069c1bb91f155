// Decides how linear least squares with bounds is solved: min |A x - b| with lower <= x <= upper (active set, exact).
// Does not know where A comes from.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

/// A tall problem, compressed: |A x - b|^2 = |R x - d|^2 + rest. Rows may be added block by block (recording by
/// recording).
struct NormalForm {
  int n = 0;
  std::vector<double> r;  ///< n x n, column by column, upper triangular
  std::vector<double> d;  ///< n
  double rest = 0;        ///< squared length of what no x can change

  explicit NormalForm(int unknowns = 0);
  /// Adds rows: `a` column by column (rows x n), `b` (rows). Householder, no squaring of the condition.
  void add(std::span<const double> a, std::span<const double> b);
};

enum class Bound : signed char { lower = -1, inside = 0, upper = 1 };

struct LinearSolution {
  std::vector<double> x;
  std::vector<Bound> bound;  ///< which bound holds x back
  double squared_error = 0;  ///< |A x - b|^2
  int rank = 0;              ///< of the columns not held at a bound
  int iterations = 0;
  bool converged = true;
};

/// Active set method (Lawson and Hanson 1974, ch. 23; Stark and Parker, Comput. Stat. 10 (1995) 129) on the compressed
/// problem. Columns that depend on others (rank deficiency): the solution nearest to `near` in units of the columns'
/// lengths is taken. `near` empty = 0.
LinearSolution solve_bounded(const NormalForm& problem, std::span<const double> lower, std::span<const double> upper,
                             std::span<const double> near = {});

}  // namespace hysteron
