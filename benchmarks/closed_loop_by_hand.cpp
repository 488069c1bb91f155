// The closed loop of W1 as somebody writes it who knows CVODE and has one problem to solve.
// States: y, y'/w, y''/w^2, y'''/w^3 of the plant, the controller's integral xi [um s], the hysteretic part z [um].
#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "benchmarks/workloads.h"

namespace hysteron::benchmarks {
namespace {

constexpr int n = 6;
constexpr double row = 1e-4;  // [s]
constexpr double kp = 1.207, ki = 7009, alpha = .6187, beta = .2418, gamma_ = .0237, d_p = 1.6126;
constexpr double a0 = 1.822e16, a1 = 4.981e12, a2 = 5.403e8, a3 = 2.813e4, b0 = 1.377e16;
const double w = std::pow(a0, 0.25);
constexpr double omega = 2 * std::numbers::pi * 5;

struct Signals {
  double e, u, rate;
};
Signals signals(double t, const double* x) {
  const double phase = omega * t - std::numbers::pi / 2;
  const double e = 3 + 3 * std::sin(phase) - x[0];
  const double e_rate = 3 * omega * std::cos(phase) - w * x[1];
  return {e, kp * e + ki * x[4], kp * e_rate + ki * e};
}

void derivative(double t, const double* x, double* dx) {
  const auto s = signals(t, x);
  dx[0] = w * x[1];
  dx[1] = w * x[2];
  dx[2] = w * x[3];
  dx[3] = (b0 * (d_p * s.u - x[5]) - a0 * x[0]) / (w * w * w) - a1 / (w * w) * x[1] - a2 / w * x[2] - a3 * x[3];
  dx[4] = s.e;
  dx[5] = alpha * s.rate - beta * std::abs(s.rate) * x[5] - gamma_ * s.rate * std::abs(x[5]);
}

int right_hand_side(realtype t, N_Vector x, N_Vector dx, void*) {
  derivative(t, N_VGetArrayPointer(x), N_VGetArrayPointer(dx));
  return 0;
}

int jacobian(realtype t, N_Vector state, N_Vector, SUNMatrix matrix, void*, N_Vector, N_Vector, N_Vector) {
  const double* x = N_VGetArrayPointer(state);
  const auto s = signals(t, x);
  double** j = SM_COLS_D(matrix);  // j[column][row]
  j[1][0] = j[2][1] = j[3][2] = w;
  const double b = b0 / (w * w * w);
  j[0][3] = -b * d_p * kp - a0 / (w * w * w);
  j[1][3] = -a1 / (w * w);
  j[2][3] = -a2 / w;
  j[3][3] = -a3;
  j[4][3] = b * d_p * ki;
  j[5][3] = -b;
  j[0][4] = -1;
  const double sign = s.rate < 0 ? -1 : 1;
  const double per_rate = alpha - beta * sign * x[5] - gamma_ * std::abs(x[5]);
  j[0][5] = per_rate * -ki;
  j[1][5] = per_rate * -kp * w;
  j[5][5] = -beta * std::abs(s.rate) - gamma_ * s.rate * (x[5] < 0 ? -1 : 1);
  return 0;
}

void check(int flag) {
  if (flag < 0) throw std::runtime_error("CVODE failed");
}

}  // namespace

ClosedLoop closed_loop_by_hand(double until, double relative_tolerance, double absolute_tolerance) {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context));
  N_Vector x = N_VNew_Serial(n, context);
  N_VConst(0.0, x);
  SUNMatrix matrix = SUNDenseMatrix(n, n, context);
  SUNLinearSolver solver = SUNLinSol_Dense(x, matrix, context);
  void* memory = CVodeCreate(CV_BDF, context);
  check(CVodeInit(memory, right_hand_side, 0, x));
  check(CVodeSStolerances(memory, relative_tolerance, absolute_tolerance));
  check(CVodeSetLinearSolver(memory, solver, matrix));
  check(CVodeSetJacFn(memory, jacobian));
  check(CVodeSetMaxNumSteps(memory, 1'000'000));
  ClosedLoop result;
  const auto rows = static_cast<int>(std::lround(until / row));
  result.y.reserve(static_cast<std::size_t>(rows) + 1);
  result.u.reserve(static_cast<std::size_t>(rows) + 1);
  double t = 0;
  for (int k = 0; k <= rows; ++k) {
    if (k > 0) check(CVode(memory, k * row, x, &t, CV_NORMAL));
    const double* v = N_VGetArrayPointer(x);
    result.y.push_back(v[0]);
    result.u.push_back(signals(k * row, v).u);
  }
  CVodeFree(&memory);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(x);
  SUNContext_Free(&context);
  return result;
}

void closed_loop_derivative(double t, const double* x, double* dx) { derivative(t, x, dx); }

ClosedLoop closed_loop_in_fixed_steps(double until, int steps_per_row) {
  ClosedLoop result;
  std::array<double, n> x{}, k1{}, k2{}, k3{}, k4{}, trial{};
  const auto rows = static_cast<int>(std::lround(until / row));
  const double h = row / steps_per_row;
  const auto moved = [&](const std::array<double, n>& k, double step) {
    for (std::size_t i = 0; i < n; ++i) trial[i] = x[i] + step * k[i];
    return trial.data();
  };
  for (int r = 0; r <= rows; ++r) {
    result.y.push_back(x[0]);
    result.u.push_back(signals(r * row, x.data()).u);
    for (int s = 0; s < steps_per_row; ++s) {
      const double t = r * row + s * h;
      derivative(t, x.data(), k1.data());
      derivative(t + h / 2, moved(k1, h / 2), k2.data());
      derivative(t + h / 2, moved(k2, h / 2), k3.data());
      derivative(t + h, moved(k3, h), k4.data());
      for (std::size_t i = 0; i < n; ++i) x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
  }
  return result;
}

}  // namespace hysteron::benchmarks
