#include "engine/integrators/dense_solver.h"

#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cmath>

namespace hysteron {
namespace {

/// Sizes with loops of their own and the first ones without.
class DenseSolver : public testing::TestWithParam<int> {
 protected:
  DenseSolver() {
    SUNContext_Create(nullptr, &context_);
    const sunindextype n = GetParam();
    matrix = SUNDenseMatrix(n, n, context_);
    x = N_VNew_Serial(n, context_);
    b = N_VNew_Serial(n, context_);
    solver = make_dense_solver(n, context_);
  }
  ~DenseSolver() override {
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    N_VDestroy(x);
    N_VDestroy(b);
    SUNContext_Free(&context_);
  }
  double& a(int row, int column) const { return SM_ELEMENT_D(matrix, row, column); }
  /// b = A x for x = 1, -2, 3, ...; then x is forgotten.
  void ask_for_known_solution() const {
    for (int i = 0; i < GetParam(); ++i) {
      NV_Ith_S(b, i) = 0;
      for (int j = 0; j < GetParam(); ++j) NV_Ith_S(b, i) += a(i, j) * solution(j);
    }
    N_VConst(0, x);
  }
  static double solution(int j) { return j % 2 == 0 ? j + 1 : -j - 1; }

  SUNMatrix matrix = nullptr;
  N_Vector x = nullptr, b = nullptr;
  SUNLinearSolver solver = nullptr;

 private:
  SUNContext context_ = nullptr;
};
INSTANTIATE_TEST_SUITE_P(Sizes, DenseSolver, testing::Values(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 25));

TEST_P(DenseSolver, FindsAKnownSolution) {
  const int n = GetParam();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a(i, j) = std::sin(1.0 + 3 * i + 7 * j * j) + (i == j ? 3 : 0);
  ask_for_known_solution();
  ASSERT_EQ(SUNLinSolSetup(solver, matrix), 0);
  ASSERT_EQ(SUNLinSolSolve(solver, matrix, x, b, 0), 0);
  for (int i = 0; i < n; ++i) EXPECT_NEAR(NV_Ith_S(x, i), solution(i), 1e-10);  // rounding times condition, below 1e4
}

TEST_P(DenseSolver, ExchangesRowsWhereTheDiagonalIsZero) {
  // A shift by one row: every pivot has to be fetched from below.
  const int n = GetParam();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a(i, j) = i == (j + 1) % n ? 2 : 0;
  ask_for_known_solution();
  ASSERT_EQ(SUNLinSolSetup(solver, matrix), 0);
  ASSERT_EQ(SUNLinSolSolve(solver, matrix, b, b, 0), 0) << "the solution may replace the right-hand side";
  for (int i = 0; i < n; ++i) EXPECT_EQ(NV_Ith_S(b, i), solution(i));
}

TEST_P(DenseSolver, ASingularMatrixIsARecoverableFailure) {
  SUNMatZero(matrix);
  EXPECT_GT(SUNLinSolSetup(solver, matrix), 0);
  for (int i = 0; i < GetParam(); ++i) a(i, i) = NAN;
  EXPECT_GT(SUNLinSolSetup(solver, matrix), 0);
}

}  // namespace
}  // namespace hysteron
