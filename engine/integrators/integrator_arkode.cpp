// Dormand-Prince 5(4) (J. Comput. Appl. Math. 6 (1980) 19-26) by ARKODE's ERKStep. ARKODE computes the stages, the
// error and the next step; what surrounds a step is here, because ARKODE's own
//   - interpolation is of order three, or evaluates dx/dt anew for every output: here three evaluations make a
//     polynomial of degree five for a whole step, and only if somebody asks inside it;
//   - roots would be those of that interpolation;
//   - restart forgets the stop time or estimates a first step: here the errors of the last step and of
//     the first one behind the last restart say what to try;
//   - refusal of a smaller step where dx/dt is not finite ends the run: here such a stage is made to fail the error
//     test.
// Sensitivities are further states: they stand behind x in one vector.
#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "engine/integrators/integrator_parts.h"
#include "engine/integrators/root_bracket.h"

namespace hysteron {
namespace {

// As for CVODES: behind a corner of an input the first step may be far too long.
// ARKODE's own, for what it would do if it were not restarted.
constexpr double safety = 0.96, largest_growth = 20;
// Stands for a dx/dt that is not finite: no error estimate with it passes, and its squares stay finite.
constexpr double impossible = 1e100;

void free_arkode(void* memory) { ERKStepFree(&memory); }
using ArkodeMemory = std::unique_ptr<void, DestroyWith<&free_arkode>>;

/// A step from (t0, y0) over h as a polynomial: y(theta) for theta = (t - t0)/h in [0, 1].
/// From values and slopes at the ends and a slope at 1/3 follows degree four, whose values give slopes at 1/3 and 2/3
/// good enough for degree five (Shampine, Math. Comput. 46 (1986) 135-150).
struct Dense {
  bool ready = false;
  bool refused = false;  // no slopes inside the step: degree three has to do
  double t0 = 0, h = 0;
  Vector y0, y1, f0, fa, fb, f1;  // slopes per second at theta = 0, 1/3, 2/3, 1

  // Weights of y1 - y0 and of h times each slope.
  struct Weights {
    double difference = 0, at_0 = 0, at_a = 0, at_b = 0, at_1 = 0;
  };
  static Weights cubic(double s) {
    return {.difference = s * s * (3 - 2 * s), .at_0 = s * (1 - s) * (1 - s), .at_1 = s * s * (s - 1)};
  }
  static Weights quartic(double s) {
    // Slope: the parabola through those at 0, 1/3, 1 plus a multiple of s(s - 1/3)(s - 1), whose integral is w.
    const double s2 = s * s, s3 = s2 * s, w = s2 * s2 / 4 - 4 * s3 / 9 + s2 / 6;
    return {.difference = -36 * w,
            .at_0 = s3 - 2 * s2 + s,
            .at_a = -1.5 * s3 + 2.25 * s2 + 27 * w,
            .at_1 = 0.5 * s3 - 0.25 * s2 + 9 * w};
  }
  static Weights quintic(double s) {
    // Slope: the cubic through those at 0, 1/3, 2/3, 1 plus a multiple of s(s - 1/3)(s - 2/3)(s - 1).
    const double s2 = s * s, s3 = s2 * s, s4 = s2 * s2, w = s4 * s / 5 - s4 / 2 + 11 * s3 / 27 - s2 / 9;
    return {.difference = -270 * w,
            .at_0 = -1.125 * s4 + 3 * s3 - 2.75 * s2 + s + 33.75 * w,
            .at_a = 3.375 * s4 - 7.5 * s3 + 4.5 * s2 + 101.25 * w,
            .at_b = -3.375 * s4 + 6 * s3 - 2.25 * s2 + 101.25 * w,
            .at_1 = 1.125 * s4 - 1.5 * s3 + 0.5 * s2 + 33.75 * w};
  }
  Weights at(double t) const {
    const double s = (t - t0) / h;
    return refused ? cubic(s) : quintic(s);
  }
  void value(const Weights& w, sunindextype begin, sunindextype end, double* into) const {
    const double *a = NV_DATA_S(y0), *b = NV_DATA_S(y1), *k0 = NV_DATA_S(f0), *ka = NV_DATA_S(fa), *kb = NV_DATA_S(fb),
                 *k1 = NV_DATA_S(f1);
    for (sunindextype i = begin; i < end; ++i)
      into[i - begin] =
          a[i] + w.difference * (b[i] - a[i]) + h * (w.at_0 * k0[i] + w.at_a * ka[i] + w.at_b * kb[i] + w.at_1 * k1[i]);
  }
};

class ArkodeStepper : public Stepper {
 public:
  explicit ArkodeStepper(InitialValueProblem& problem);

  const char* library() const override { return "ARKODE"; }
  void start(double t) override;
  Step step(double stop) override;
  bool fired(int root) const override { return fired_[static_cast<std::size_t>(root)] != 0; }
  int interpolate(double t, int column, double* into) override;
  double next_step() const override;
  int order() const override { return 5; }
  bool local_errors(N_Vector weights, N_Vector errors) const override;
  Integrator::Counters counters() const override;

 private:
  static int derivative(realtype t, N_Vector y, N_Vector dy, void* user);
  int evaluate(double t, const double* y, double* dy);
  int evaluate_at(double theta, const Dense::Weights& weights, Vector& slope);
  int make_dense();
  int indicators(double t, const double* y, std::vector<double>& g);
  bool falls(const std::vector<double>& g) const;
  int locate(Step& done);
  void restart(double t);
  void learn_step();
  sunindextype size() const { return static_cast<sunindextype>(p_.values.size()); }

  InitialValueProblem& p_;
  Vector all_;  // x and sensitivities
  Vector weights_, errors_;
  std::vector<double> trial_;
  std::vector<const double*> s_;  // arguments of sensitivity_derivative
  std::vector<double*> ds_;
  Dense dense_;
  std::vector<double> g_before_, g_after_;
  std::vector<char> fired_;
  double began_ = 0, reached_ = 0;  // the last step of ARKODE; a root may have cut it
  double longest_last_ = 0;         // what the last step could have been [s]
  double longest_first_ = 0;        // what the first one behind the last restart could have been [s]
  bool first_ = true;               // nothing known yet of the first one
  bool g_known_ = false, at_root_ = false;
  long sensitivity_evaluations_ = 0, dense_evaluations_ = 0;
  ArkodeMemory arkode_;  // last: goes first
};

ArkodeStepper::ArkodeStepper(InitialValueProblem& problem) : p_(problem) {
  p_.stepper = this;
  all_ = p_.view(p_.values.data(), size());
  weights_.reset(made(N_VClone(all_.get()), "N_VClone"));
  errors_.reset(made(N_VClone(all_.get()), "N_VClone"));
  trial_ = p_.values;
  for (Vector* v : {&dense_.y0, &dense_.y1, &dense_.f0, &dense_.fa, &dense_.fb, &dense_.f1})
    v->reset(made(N_VClone(all_.get()), "N_VClone"));
  s_.resize(static_cast<std::size_t>(p_.parameters()));
  ds_.resize(s_.size());
  const auto roots = static_cast<std::size_t>(p_.system.roots);
  g_before_.assign(roots, 0.0);
  g_after_ = g_before_;
  fired_.assign(roots, 0);
}

int ArkodeStepper::evaluate(double t, const double* y, double* dy) {
  return p_.guarded([&] {
    if (!p_.system.derivative(t, y, dy)) return false;
    if (s_.empty()) return true;
    for (std::size_t k = 0; k < s_.size(); ++k) {
      const auto offset = (k + 1) * static_cast<std::size_t>(p_.states());
      s_[k] = y + offset;
      ds_[k] = dy + offset;
    }
    ++sensitivity_evaluations_;
    return p_.system.sensitivity_derivative(t, y, s_.data(), ds_.data());
  });
}

int ArkodeStepper::derivative(realtype t, N_Vector y, N_Vector dy, void* user) {
  auto& self = static_cast<ArkodeStepper&>(*InitialValueProblem::of(user).stepper);
  const int flag = self.evaluate(t, NV_DATA_S(y), NV_DATA_S(dy));
  if (flag > 0) std::fill_n(NV_DATA_S(dy), NV_LENGTH_S(dy), impossible);
  return std::min(flag, 0);
}

void ArkodeStepper::start(double t) {
  if (arkode_) return restart(t);
  arkode_.reset(made(ERKStepCreate(&derivative, t, all_.get(), p_.context.get()), "ERKStepCreate"));
  void* memory = arkode_.get();
  expect(ERKStepSetErrHandlerFn(memory, &InitialValueProblem::keep_message, &p_), "ERKStepSetErrHandlerFn");
  expect(ERKStepSetUserData(memory, &p_), "ERKStepSetUserData");
  expect(ERKStepWFtolerances(memory, &InitialValueProblem::weights), "ERKStepWFtolerances");
  expect(ERKStepSetTableNum(memory, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
  expect(ERKStepSetInterpolantDegree(memory, 3), "ERKStepSetInterpolantDegree");
  expect(ERKStepSetMaxErrTestFails(memory, error_failures_allowed), "ERKStepSetMaxErrTestFails");
  expect(ERKStepSetMaxHnilWarns(memory, -1), "ERKStepSetMaxHnilWarns");
  if (p_.options.max_step > 0) expect(ERKStepSetMaxStep(memory, p_.options.max_step), "ERKStepSetMaxStep");
  began_ = reached_ = t;
}

void ArkodeStepper::restart(double t) {
  expect(ERKStepReset(arkode_.get(), t, all_.get()), "ERKStepReset");
  expect(ERKStepSetInitStep(arkode_.get(), std::min(longest_last_, longest_first_)), "ERKStepSetInitStep");
  began_ = reached_ = t;
  dense_.ready = g_known_ = at_root_ = false;
  first_ = true;
}

/// What the error of the step just done says of the longest one: ARKODE forgets its own answer where a stop is near.
/// Of a step that a stop made very short, or that began the run, it only says "far more".
void ArkodeStepper::learn_step() {
  ERKStepGetErrWeights(arkode_.get(), weights_.get());
  ERKStepGetEstLocalErrors(arkode_.get(), errors_.get());
  const double error = std::max(N_VWrmsNorm(errors_.get(), weights_.get()), 1e-10);
  const double growth = safety * std::pow(error, -0.2);
  const bool far_more = growth >= largest_growth;
  const double longest = (reached_ - began_) * std::min(growth, largest_growth);
  longest_last_ = far_more ? std::max(longest_last_, longest) : longest;
  if (!first_) return;
  longest_first_ = far_more ? std::max(longest_first_, longest) : longest;
  first_ = far_more;
}

Stepper::Step ArkodeStepper::step(double stop) {
  Step done;
  if (at_root_) {  // goes on from the root, whose indicators have fallen already
    restart(reached_);
    g_known_ = true;
  }
  if (!g_known_ && !g_before_.empty()) {
    done.flag = indicators(reached_, p_.values.data(), g_before_);
    if (done.flag < 0) return done;
    g_known_ = true;
  }
  void* memory = arkode_.get();
  expect(ERKStepSetStopTime(memory, stop), "ERKStepSetStopTime");
  dense_.ready = false;
  done.flag = ERKStepEvolve(memory, stop, all_.get(), &done.t, ARK_ONE_STEP);
  if (done.flag < 0) return done;
  began_ = reached_;
  reached_ = done.t;
  if (done.flag == ARK_TSTOP_RETURN) done.outcome = Integrator::Outcome::stop;
  learn_step();
  if (!g_before_.empty()) done.flag = locate(done);
  return done;
}

int ArkodeStepper::indicators(double t, const double* y, std::vector<double>& g) {
  ++p_.indicator_evaluations;
  return p_.guarded([&] {
    p_.system.indicators(t, y, g.data());
    return true;
  });
}

bool ArkodeStepper::falls(const std::vector<double>& g) const {
  for (std::size_t i = 0; i < g.size(); ++i)
    if (g_before_[i] > 0 && g[i] <= 0) return true;
  return false;
}

/// Looks for the first root of the step just done.
int ArkodeStepper::locate(Step& done) {
  if (const int flag = indicators(reached_, p_.values.data(), g_after_); flag < 0) return flag;
  if (!falls(g_after_)) {
    std::swap(g_before_, g_after_);
    return 0;
  }
  if (const int flag = make_dense(); flag < 0) return flag;
  WatchedValues a{began_, g_before_}, b{reached_, g_after_};  // allocates: roots are rare
  const auto look = [&](double t, std::vector<double>& g) {
    dense_.value(dense_.at(t), 0, size(), trial_.data());
    return indicators(t, trial_.data(), g);
  };
  if (const int flag = first_root(a, b, root_width(began_, reached_), look); flag < 0) return flag;
  for (std::size_t i = 0; i < fired_.size(); ++i) fired_[i] = g_before_[i] > 0 && b.g[i] <= 0;
  if (b.t < reached_) dense_.value(dense_.at(b.t), 0, size(), p_.values.data());
  g_before_ = b.g;
  reached_ = done.t = b.t;
  done.outcome = Integrator::Outcome::root;
  at_root_ = true;
  return 0;
}

int ArkodeStepper::evaluate_at(double theta, const Dense::Weights& weights, Vector& slope) {
  dense_.value(weights, 0, size(), trial_.data());
  ++dense_evaluations_;
  return evaluate(dense_.t0 + theta * dense_.h, trial_.data(), NV_DATA_S(slope));
}

int ArkodeStepper::make_dense() {
  if (dense_.ready) return 0;
  auto& d = dense_;
  d.t0 = began_;
  d.h = reached_ - began_;
  for (const auto& [t, k, into] :
       {std::tuple{began_, 0, &d.y0}, {began_, 1, &d.f0}, {reached_, 0, &d.y1}, {reached_, 1, &d.f1}})
    if (const int flag = ERKStepGetDky(arkode_.get(), t, k, into->get()); flag != 0) return flag;
  N_VConst(0, d.fa.get());
  N_VConst(0, d.fb.get());
  const double a = 1.0 / 3, b = 2.0 / 3;
  int flag = evaluate_at(a, Dense::cubic(a), d.fa);
  if (flag == 0) flag = evaluate_at(b, Dense::quartic(b), d.fb);
  if (flag == 0) flag = evaluate_at(a, Dense::quartic(a), d.fa);  // replaces the slope that the quartic came from
  if (flag < 0) return flag;
  d.refused = flag > 0;
  d.ready = true;
  return 0;
}

int ArkodeStepper::interpolate(double t, int column, double* into) {
  if (const int flag = make_dense(); flag != 0) return flag;
  const auto begin = sunindextype{column} * p_.states();
  dense_.value(dense_.at(t), begin, begin + p_.states(), into);
  return 0;
}

double ArkodeStepper::next_step() const {
  double step = 0;
  ERKStepGetCurrentStep(arkode_.get(), &step);
  return step;
}

bool ArkodeStepper::local_errors(N_Vector weights, N_Vector errors) const {
  long attempts = 0;
  ERKStepGetNumStepAttempts(arkode_.get(), &attempts);
  if (attempts == 0) return false;
  if (ERKStepGetErrWeights(arkode_.get(), weights_.get()) != ARK_SUCCESS) return false;
  if (ERKStepGetEstLocalErrors(arkode_.get(), errors_.get()) != ARK_SUCCESS) return false;
  std::copy_n(NV_DATA_S(weights_), p_.states(), NV_DATA_S(weights));
  std::copy_n(NV_DATA_S(errors_), p_.states(), NV_DATA_S(errors));
  return true;
}

Integrator::Counters ArkodeStepper::counters() const {
  Integrator::Counters c;
  if (!arkode_) return c;
  ERKStepGetNumSteps(arkode_.get(), &c.steps);
  ERKStepGetNumRhsEvals(arkode_.get(), &c.evaluations);
  ERKStepGetNumErrTestFails(arkode_.get(), &c.rejected);
  c.evaluations += dense_evaluations_;
  c.sensitivity_evaluations = sensitivity_evaluations_;
  return c;
}

}  // namespace

std::unique_ptr<Stepper> make_arkode_stepper(InitialValueProblem& problem) {
  return std::make_unique<ArkodeStepper>(problem);
}

}  // namespace hysteron
