// Decides how rows are added to a triangular factor: Householder reflections that leave the triangle's zeros alone, a
// panel of rows at a time, so that a tall matrix is never copied as a whole. Internal to fit/.
#pragma once

#include <cstddef>

namespace hysteron {

/// R'R + P'P = (new R)'(new R): r is n x n, upper triangular, column by column; panel is rows x n, column by column,
/// and is destroyed. Golub, Van Loan, Matrix Computations, 12.5. The numbers are the same on every processor.
void add_to_triangle(double* r, std::size_t n, double* panel, std::size_t rows);

}  // namespace hysteron
