// What the integrator's files share: SUNDIALS' objects as owned values, the problem as its C functions see it, and what
// a stepper has to offer (integrator_cvodes.cpp, integrator_arkode.cpp). Includes SUNDIALS: only integrator*.cpp
// include this.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <exception>
#include <memory>
#include <type_traits>
#include <vector>

#include "engine/integrators/integrator.h"

namespace hysteron {

inline constexpr int error_failures_allowed = 30;  ///< of the error test, in one step

static_assert(std::is_same_v<realtype, double>);

template <auto Destroy>
struct DestroyWith {
  template <class T>
  void operator()(T* p) const {
    Destroy(p);
  }
};
inline void free_context(SUNContext c) { SUNContext_Free(&c); }
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, DestroyWith<&free_context>>;
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, DestroyWith<&N_VDestroy>>;

/// For set-up calls, which fail only if memory runs out or we misuse them.
void expect(int flag, const char* call);
void expect(const void* made, const char* call);
template <class T>
T* made(T* p, const char* call) {
  expect(p, call);
  return p;
}

class Stepper;

/// The problem, and what its functions leave behind for the caller of a step.
struct InitialValueProblem {
  OdeSystem system;
  IntegratorOptions options;
  Context context;
  std::vector<double> values;     // x, then the columns of dx/dp: where a step leaves them
  std::vector<double> tolerance;  // absolute, per entry of values
  Vector x;                       // looks at the states in `values`
  Stepper* stepper = nullptr;
  std::exception_ptr thrown;
  std::string message;  // the last that SUNDIALS wrote
  long indicator_evaluations = 0;

  int states() const { return system.states; }
  int parameters() const { return system.parameters; }
  double parameter_size(int k) const;
  /// A vector of our operations that looks at `data`.
  Vector view(double* data, sunindextype length) const;

  static InitialValueProblem& of(void* user) { return *static_cast<InitialValueProblem*>(user); }
  /// Runs f, a function of the user's: false becomes 1 (a smaller step may help), an exception is kept and becomes -1.
  template <class F>
  int guarded(F f) {
    if (thrown) return -1;  // whoever ignores that gets nothing else
    try {
      return f() ? 0 : 1;
    } catch (...) {
      thrown = std::current_exception();
      return -1;
    }
  }

  // SUNDIALS calls these; `user` is the InitialValueProblem.
  static int derivative(realtype t, N_Vector x, N_Vector dx, void* user);
  static int indicators(realtype t, N_Vector x, realtype* g, void* user);
  static int weights(N_Vector x, N_Vector w, void* user);
  static void keep_message(int, const char*, const char*, char* text, void* user);
};

/// One formula at work on a problem. Flags are SUNDIALS': negative = failed.
class Stepper {
 public:
  struct Step {
    int flag = 0;
    double t = 0;
    Integrator::Outcome outcome = Integrator::Outcome::step;
  };

  virtual ~Stepper() = default;
  virtual const char* library() const = 0;
  /// Starts, or starts again, from InitialValueProblem::values.
  virtual void start(double t) = 0;
  /// Leaves x and sensitivities in InitialValueProblem::values.
  virtual Step step(double stop) = 0;
  virtual bool fired(int root) const = 0;
  /// Column 0 is x, column k + 1 the sensitivity to parameter k.
  virtual int interpolate(double t, int column, double* into) = 0;
  virtual double next_step() const = 0;
  virtual int order() const = 0;
  /// Weights and estimated local errors of the states in the last step tried; false = none has been.
  virtual bool local_errors(N_Vector weights, N_Vector errors) const = 0;
  /// Everything but restarts and the evaluations of indicators, since construction.
  virtual Integrator::Counters counters() const = 0;
};

std::unique_ptr<Stepper> make_cvodes_stepper(InitialValueProblem& problem);
std::unique_ptr<Stepper> make_arkode_stepper(InitialValueProblem& problem);

}  // namespace hysteron
