// The chain of W3 as somebody writes it who knows CVODE and KLU: one loop for the right-hand side, the Jacobian's
// columns written once (it is constant), stock vectors.
#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "benchmarks/workloads.h"

namespace hysteron::benchmarks {
namespace {

constexpr double row = 1e-3, until = 1;  // [s]
constexpr double omega = 2 * std::numbers::pi * 5;

struct Chain {
  int n = 0;
  std::vector<double> tau;
  std::vector<int> column_begin, entry_row;
  std::vector<double> entry;
};

Chain chain_of(int n) {
  Chain chain{n, {}, {0}, {}, {}};
  std::vector<std::map<int, double>> columns(static_cast<std::size_t>(n));
  const auto add = [&](int to, int from, double slope) {
    columns[static_cast<std::size_t>(from)][to] += slope / chain.tau[static_cast<std::size_t>(to)];
  };
  for (int i = 0; i < n; ++i) {
    chain.tau.push_back(chain_time_constant(i));
    add(i, i, -1);
    if (i > 0) add(i, i - 1, 1);
    if (i + 1 < n) add(i, i + 1, -0.5);
    if (i % 10 == 0) add(i, n - 1 - i, -0.2);
  }
  for (const auto& column : columns) {
    for (const auto& [to, slope] : column) {
      chain.entry_row.push_back(to);
      chain.entry.push_back(slope);
    }
    chain.column_begin.push_back(static_cast<int>(chain.entry.size()));
  }
  return chain;
}

int right_hand_side(realtype t, N_Vector state, N_Vector rates, void* data) {
  const auto& chain = *static_cast<const Chain*>(data);
  const double* x = N_VGetArrayPointer(state);
  double* dx = N_VGetArrayPointer(rates);
  const double drive = std::sin(omega * t);
  const int n = chain.n;
  for (int i = 0; i < n; ++i) {
    double in = 0;
    if (i > 0) in += x[i - 1];
    if (i + 1 < n) in -= 0.5 * x[i + 1];
    if (i % 10 == 0) in += drive - 0.2 * x[n - 1 - i];
    dx[i] = (in - x[i]) / chain.tau[static_cast<std::size_t>(i)];
  }
  return 0;
}

int jacobian(realtype, N_Vector, N_Vector, SUNMatrix matrix, void* data, N_Vector, N_Vector, N_Vector) {
  const auto& chain = *static_cast<const Chain*>(data);
  std::copy(chain.column_begin.begin(), chain.column_begin.end(), SUNSparseMatrix_IndexPointers(matrix));
  std::copy(chain.entry_row.begin(), chain.entry_row.end(), SUNSparseMatrix_IndexValues(matrix));
  std::copy(chain.entry.begin(), chain.entry.end(), SUNSparseMatrix_Data(matrix));
  return 0;
}

void check(int flag) {
  if (flag < 0) throw std::runtime_error("CVODE failed");
}

}  // namespace

double chain_time_constant(int lag) {
  const double place = 0.6180339887498949 * lag;
  return 1e-3 * std::pow(1000, place - std::floor(place));
}

std::vector<std::vector<double>> chain_by_hand(int lags, double relative_tolerance, double absolute_tolerance) {
  auto chain = chain_of(lags);
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context));
  N_Vector x = N_VNew_Serial(lags, context);
  N_VConst(0.0, x);
  SUNMatrix matrix = SUNSparseMatrix(lags, lags, static_cast<sunindextype>(chain.entry.size()), CSC_MAT, context);
  SUNLinearSolver solver = SUNLinSol_KLU(x, matrix, context);
  void* memory = CVodeCreate(CV_BDF, context);
  check(CVodeInit(memory, right_hand_side, 0, x));
  check(CVodeSetUserData(memory, &chain));
  check(CVodeSStolerances(memory, relative_tolerance, absolute_tolerance));
  check(CVodeSetLinearSolver(memory, solver, matrix));
  check(CVodeSetJacFn(memory, jacobian));
  check(CVodeSetMaxNumSteps(memory, 1'000'000));
  const auto rows = static_cast<int>(std::lround(until / row));
  std::vector<std::vector<double>> result(3);
  double t = 0;
  for (int k = 0; k <= rows; ++k) {
    if (k > 0) check(CVode(memory, k * row, x, &t, CV_NORMAL));
    const double* v = N_VGetArrayPointer(x);
    result[0].push_back(v[0]);
    result[1].push_back(v[lags / 2]);
    result[2].push_back(v[lags - 1]);
  }
  CVodeFree(&memory);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(x);
  SUNContext_Free(&context);
  return result;
}

}  // namespace hysteron::benchmarks
