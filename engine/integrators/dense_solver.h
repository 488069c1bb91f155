// Decides how CVODES solves its Newton equations where the matrix is dense: LU with row exchanges, as SUNDIALS does,
// with loops of their own for small systems, where SUNDIALS' general ones took a tenth of a simulation.
#pragma once

#include <sundials/sundials_linearsolver.h>

namespace hysteron {

/// A solver for n x n SUNDenseMatrix, which it factorizes in place. A singular matrix is a recoverable failure.
SUNLinearSolver make_dense_solver(sunindextype n, SUNContext context);

}  // namespace hysteron
