// BDF and Adams by CVODES, with forward sensitivities by its staggered corrector (Feehery, Tolsma, Barton, Appl. Numer.
// Math. 25 (1997) 41-54). Rules:
//   - the Newton matrix I - gamma J is put together here from the Jacobian's entries: dense, or sparse with KLU where
//   the
//     matrix is large and at most a third of it is filled; without a Jacobian CVODES takes differences, dense;
//   - a restart keeps every allocation and the sparse solver's ordering.
#include <cvodes/cvodes.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <stdexcept>

#include "engine/integrators/dense_solver.h"
#include "engine/integrators/integrator_parts.h"

namespace hysteron {
namespace {

// Behind a corner of an input the first step may be ten thousand times too long, and each failure divides it by ten at
// most.
// Up to ten states the dense solver's own loops are faster than KLU (a tenth of a chain of ten lags); for chains of 11
// to 30 they are equal, and KLU wins behind. With more than a third of the matrix filled it does not.
constexpr int smallest_sparse = 11;
constexpr double largest_filling = 1.0 / 3;

void free_cvodes(void* memory) { CVodeFree(&memory); }
using CvodesMemory = std::unique_ptr<void, DestroyWith<&free_cvodes>>;
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, DestroyWith<&SUNMatDestroy>>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, DestroyWith<&SUNLinSolFree>>;
using NonlinearSolver = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, DestroyWith<&SUNNonlinSolFree>>;

/// Where the entries of J and the ones of I go in the data of a matrix.
struct Layout {
  std::vector<sunindextype> entry;     // per entry of the pattern: index into the matrix's data
  std::vector<sunindextype> diagonal;  // per state
};

class CvodesStepper : public Stepper {
 public:
  explicit CvodesStepper(InitialValueProblem& problem);

  const char* library() const override { return "CVODES"; }
  void start(double t) override;
  Step step(double stop) override;
  bool fired(int root) const override { return found_[static_cast<std::size_t>(root)] != 0; }
  int interpolate(double t, int column, double* into) override;
  double next_step() const override;
  int order() const override;
  bool local_errors(N_Vector weights, N_Vector errors) const override;
  Integrator::Counters counters() const override;

 private:
  static CvodesStepper& of(void* user) { return static_cast<CvodesStepper&>(*InitialValueProblem::of(user).stepper); }
  static int newton_matrix(realtype t, N_Vector x, N_Vector, SUNMatrix a, booleantype old_is_good, booleantype* renewed,
                           realtype gamma, void* user, N_Vector, N_Vector, N_Vector);
  static int sensitivities(int count, realtype t, N_Vector x, N_Vector, N_Vector* s, N_Vector* ds, void* user, N_Vector,
                           N_Vector);
  bool implicit() const { return p_.options.formula == Formula::bdf; }
  bool worth_sparse() const;
  void make_newton();
  void make_dense();
  void make_sparse();
  void make_fixed_point();
  void make_roots();
  void make_sensitivities();
  void first_start(double t);
  Integrator::Counters of_this_part() const;

  InitialValueProblem& p_;
  Matrix matrix_;
  LinearSolver linear_solver_;
  NonlinearSolver fixed_point_, fixed_point_of_sensitivities_;
  Layout layout_;
  std::vector<double> jacobian_;  // its entries when it was computed last
  double* matrix_data_ = nullptr;
  sunindextype matrix_size_ = 0;
  std::vector<Vector> columns_;   // views of the sensitivities in InitialValueProblem::values
  std::vector<N_Vector> column_;  // the same, as CVODES wants them
  std::vector<const double*> s_;  // arguments of sensitivity_derivative
  std::vector<double*> ds_;
  Vector elsewhere_;  // a view that is pointed at where results are wanted
  std::vector<int> found_;
  Integrator::Counters before_;  // of the parts of the run before the last restart
  CvodesMemory cvodes_;          // last: goes first
};

CvodesStepper::CvodesStepper(InitialValueProblem& problem) : p_(problem) {
  p_.stepper = this;
  elsewhere_ = p_.view(p_.values.data(), p_.states());
  found_.assign(static_cast<std::size_t>(p_.system.roots), 0);
}

int CvodesStepper::newton_matrix(realtype t, N_Vector x, N_Vector, SUNMatrix, booleantype old_is_good,
                                 booleantype* renewed, realtype gamma, void* user, N_Vector, N_Vector, N_Vector) {
  CvodesStepper& self = of(user);
  *renewed = old_is_good ? SUNFALSE : SUNTRUE;
  if (!old_is_good) {
    const int flag = self.p_.guarded([&] { return self.p_.system.jacobian(t, NV_DATA_S(x), self.jacobian_.data()); });
    if (flag != 0) return flag;
  }
  double* a = self.matrix_data_;
  std::fill(a, a + self.matrix_size_, 0.0);
  for (std::size_t k = 0; k < self.jacobian_.size(); ++k) a[self.layout_.entry[k]] = -gamma * self.jacobian_[k];
  for (const auto d : self.layout_.diagonal) a[d] += 1;
  return 0;
}

int CvodesStepper::sensitivities(int count, realtype t, N_Vector x, N_Vector, N_Vector* s, N_Vector* ds, void* user,
                                 N_Vector, N_Vector) {
  CvodesStepper& self = of(user);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    self.s_[k] = NV_DATA_S(s[k]);
    self.ds_[k] = NV_DATA_S(ds[k]);
  }
  return self.p_.guarded(
      [&] { return self.p_.system.sensitivity_derivative(t, NV_DATA_S(x), self.s_.data(), self.ds_.data()); });
}

bool CvodesStepper::worth_sparse() const {
  const auto n = static_cast<double>(p_.states());
  return p_.system.jacobian && !p_.system.pattern.empty() && p_.states() >= smallest_sparse &&
         static_cast<double>(p_.system.pattern.row.size()) <= largest_filling * n * n;
}

void CvodesStepper::make_dense() {
  const int n = p_.states();
  matrix_.reset(made(SUNDenseMatrix(n, n, p_.context.get()), "SUNDenseMatrix"));
  matrix_data_ = SUNDenseMatrix_Data(matrix_.get());
  matrix_size_ = SUNDenseMatrix_LData(matrix_.get());
  const auto& pattern = p_.system.pattern;
  for (int column = 0; column < n; ++column) {
    layout_.diagonal.push_back(sunindextype{n} * column + column);
    if (pattern.empty())
      for (int row = 0; row < n; ++row) layout_.entry.push_back(sunindextype{n} * column + row);
    else
      for (int k = pattern.column_begin[static_cast<std::size_t>(column)];
           k < pattern.column_begin[static_cast<std::size_t>(column) + 1]; ++k)
        layout_.entry.push_back(sunindextype{n} * column + pattern.row[static_cast<std::size_t>(k)]);
  }
  linear_solver_.reset(made(make_dense_solver(n, p_.context.get()), "make_dense_solver"));
}

/// The pattern with the diagonal in it, which I - gamma J fills in any case.
void CvodesStepper::make_sparse() {
  const int n = p_.states();
  const auto& pattern = p_.system.pattern;
  matrix_.reset(
      made(SUNSparseMatrix(n, n, static_cast<sunindextype>(pattern.row.size()) + n, CSC_MAT, p_.context.get()),
           "SUNSparseMatrix"));
  matrix_data_ = SUNSparseMatrix_Data(matrix_.get());
  auto* begin = SUNSparseMatrix_IndexPointers(matrix_.get());
  auto* row = SUNSparseMatrix_IndexValues(matrix_.get());
  sunindextype next = 0;
  for (int column = 0; column < n; ++column) {
    begin[column] = next;
    bool diagonal = false;
    const auto put_diagonal = [&] {
      diagonal = true;
      layout_.diagonal.push_back(next);
      row[next++] = column;
    };
    for (int k = pattern.column_begin[static_cast<std::size_t>(column)];
         k < pattern.column_begin[static_cast<std::size_t>(column) + 1]; ++k) {
      const int r = pattern.row[static_cast<std::size_t>(k)];
      if (r >= column && !diagonal) put_diagonal();
      layout_.entry.push_back(r == column ? layout_.diagonal.back() : next);
      if (r != column) row[next++] = r;
    }
    if (!diagonal) put_diagonal();
  }
  begin[n] = matrix_size_ = next;
  linear_solver_.reset(made(SUNLinSol_KLU(p_.x.get(), matrix_.get(), p_.context.get()), "SUNLinSol_KLU"));
  // Would order the unknowns anew at every restart.
  linear_solver_->ops->initialize = [](SUNLinearSolver) { return 0; };
}

void CvodesStepper::make_newton() {
  if (worth_sparse())
    make_sparse();
  else
    make_dense();
  expect(CVodeSetLinearSolver(cvodes_.get(), linear_solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
  if (!p_.system.jacobian) return;
  jacobian_.assign(layout_.entry.size(), 0.0);
  expect(CVodeSetLinSysFn(cvodes_.get(), &newton_matrix), "CVodeSetLinSysFn");
}

void CvodesStepper::make_fixed_point() {
  fixed_point_.reset(made(SUNNonlinSol_FixedPoint(p_.x.get(), 0, p_.context.get()), "SUNNonlinSol_FixedPoint"));
  expect(CVodeSetNonlinearSolver(cvodes_.get(), fixed_point_.get()), "CVodeSetNonlinearSolver");
}

void CvodesStepper::make_roots() {
  if (p_.system.roots == 0) return;
  expect(CVodeRootInit(cvodes_.get(), p_.system.roots, &InitialValueProblem::indicators), "CVodeRootInit");
  std::vector<int> falling(found_.size(), -1);
  expect(CVodeSetRootDirection(cvodes_.get(), falling.data()), "CVodeSetRootDirection");
  expect(CVodeSetNoInactiveRootWarn(cvodes_.get()), "CVodeSetNoInactiveRootWarn");
}

void CvodesStepper::make_sensitivities() {
  const int count = p_.parameters();
  if (count == 0) return;
  std::vector<double> sizes;
  for (int k = 0; k < count; ++k) {
    columns_.push_back(p_.view(p_.values.data() + sunindextype{k + 1} * p_.states(), p_.states()));
    column_.push_back(columns_.back().get());
    sizes.push_back(p_.parameter_size(k));
  }
  s_.resize(column_.size());
  ds_.resize(column_.size());
  void* memory = cvodes_.get();
  expect(CVodeSensInit(memory, count, CV_STAGGERED, &sensitivities, column_.data()), "CVodeSensInit");
  expect(CVodeSetSensParams(memory, nullptr, sizes.data(), nullptr), "CVodeSetSensParams");
  expect(CVodeSensEEtolerances(memory), "CVodeSensEEtolerances");
  expect(CVodeSetSensErrCon(memory, SUNTRUE), "CVodeSetSensErrCon");
  if (implicit()) return;
  fixed_point_of_sensitivities_.reset(
      made(SUNNonlinSol_FixedPointSens(count, p_.x.get(), 0, p_.context.get()), "SUNNonlinSol_FixedPointSens"));
  expect(CVodeSetNonlinearSolverSensStg(memory, fixed_point_of_sensitivities_.get()), "CVodeSetNonlinearSolverSensStg");
}

void CvodesStepper::first_start(double t) {
  cvodes_.reset(made(CVodeCreate(implicit() ? CV_BDF : CV_ADAMS, p_.context.get()), "CVodeCreate"));
  void* memory = cvodes_.get();
  expect(CVodeSetErrHandlerFn(memory, &InitialValueProblem::keep_message, &p_), "CVodeSetErrHandlerFn");
  expect(CVodeInit(memory, &InitialValueProblem::derivative, t, p_.x.get()), "CVodeInit");
  expect(CVodeSetUserData(memory, &p_), "CVodeSetUserData");
  expect(CVodeWFtolerances(memory, &InitialValueProblem::weights), "CVodeWFtolerances");
  if (p_.options.max_step > 0) expect(CVodeSetMaxStep(memory, p_.options.max_step), "CVodeSetMaxStep");
  expect(CVodeSetMaxErrTestFails(memory, error_failures_allowed), "CVodeSetMaxErrTestFails");
  if (implicit())
    make_newton();
  else
    make_fixed_point();
  make_roots();
  make_sensitivities();
}

void CvodesStepper::start(double t) {
  if (!cvodes_) return first_start(t);
  before_ = counters();
  expect(CVodeReInit(cvodes_.get(), t, p_.x.get()), "CVodeReInit");
  if (!column_.empty()) expect(CVodeSensReInit(cvodes_.get(), CV_STAGGERED, column_.data()), "CVodeSensReInit");
}

Stepper::Step CvodesStepper::step(double stop) {
  void* memory = cvodes_.get();
  expect(CVodeSetStopTime(memory, stop), "CVodeSetStopTime");
  Step done;
  done.flag = CVode(memory, stop, p_.x.get(), &done.t, CV_ONE_STEP);
  if (done.flag < 0) return done;
  if (done.flag == CV_TSTOP_RETURN) done.outcome = Integrator::Outcome::stop;
  if (done.flag == CV_ROOT_RETURN) {
    done.outcome = Integrator::Outcome::root;
    expect(CVodeGetRootInfo(memory, found_.data()), "CVodeGetRootInfo");
  }
  double same_t = 0;
  if (!column_.empty()) expect(CVodeGetSens(memory, &same_t, column_.data()), "CVodeGetSens");
  return done;
}

int CvodesStepper::interpolate(double t, int column, double* into) {
  NV_DATA_S(elsewhere_.get()) = into;
  return column == 0 ? CVodeGetDky(cvodes_.get(), t, 0, elsewhere_.get())
                     : CVodeGetSensDky1(cvodes_.get(), t, 0, column - 1, elsewhere_.get());
}

double CvodesStepper::next_step() const {
  double step = 0;
  CVodeGetCurrentStep(cvodes_.get(), &step);
  return step;
}

int CvodesStepper::order() const {
  int order = 0;
  CVodeGetCurrentOrder(cvodes_.get(), &order);
  return order;
}

bool CvodesStepper::local_errors(N_Vector weights, N_Vector errors) const {
  const auto c = counters();
  return c.steps + c.rejected > 0 && CVodeGetErrWeights(cvodes_.get(), weights) == CV_SUCCESS &&
         CVodeGetEstLocalErrors(cvodes_.get(), errors) == CV_SUCCESS;
}

Integrator::Counters CvodesStepper::of_this_part() const {
  Integrator::Counters c;
  void* memory = cvodes_.get();
  if (!memory) return c;
  long error_failures = 0, step_failures = 0, for_jacobian = 0;
  CVodeGetNumSteps(memory, &c.steps);
  CVodeGetNumRhsEvals(memory, &c.evaluations);
  CVodeGetNumErrTestFails(memory, &error_failures);
  CVodeGetNumStepSolveFails(memory, &step_failures);
  c.rejected = error_failures + step_failures;
  if (implicit()) {
    CVodeGetNumJacEvals(memory, &c.jacobians);
    CVodeGetNumLinRhsEvals(memory, &for_jacobian);
    CVodeGetNumLinSolvSetups(memory, &c.factorizations);
    c.evaluations += for_jacobian;
  }
  if (!column_.empty()) {
    CVodeGetSensNumRhsEvals(memory, &c.sensitivity_evaluations);
    CVodeGetSensNumErrTestFails(memory, &error_failures);
    CVodeGetNumStepSensSolveFails(memory, &step_failures);
    c.rejected += error_failures + step_failures;
  }
  return c;
}

Integrator::Counters CvodesStepper::counters() const {
  auto c = of_this_part();
  c.steps += before_.steps;
  c.rejected += before_.rejected;
  c.evaluations += before_.evaluations;
  c.sensitivity_evaluations += before_.sensitivity_evaluations;
  c.jacobians += before_.jacobians;
  c.factorizations += before_.factorizations;
  return c;
}

}  // namespace

std::unique_ptr<Stepper> make_cvodes_stepper(InitialValueProblem& problem) {
  return std::make_unique<CvodesStepper>(problem);
}

}  // namespace hysteron
