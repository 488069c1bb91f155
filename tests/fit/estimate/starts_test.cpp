// Recordings that do not begin where the model is started: found in nonlinear models too, and told where nobody said
// so.
#include "fit/estimate/starts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/estimate/beginning.h"
#include "fit/estimate/fit.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

/// A mass of 1 kg on a spring that hardens, 4 N s/m of damping: 20 rad/s for small motion, so that a start has decayed
/// to a hundredth after some 2.3 s.
Diagram hard_spring() {
  Diagram d = lab::diagram("stage.position");
  auto& force = lab::add(d, "force", "gain", "u");
  force.parameters["gain"] = "10 N/V";
  auto& stage = lab::add(d, "stage", "mass_on_stiffening_spring", "force");
  stage.parameters["mass"] = "1 kg";
  stage.parameters["stiffness"] = "400 N/m";
  stage.parameters["damping"] = "4 N s/m";
  stage.parameters["stiffening"] = "4e5 N/m^3";
  return d;
}

/// The same by hand, from this position [m] and velocity [m/s]: classical Runge-Kutta, forty steps to a row.
std::vector<double> by_hand(const Recording& r, double position, double velocity, double stiffness) {
  double x = position, v = velocity;
  std::vector<double> y{x};
  for (std::size_t i = 1; i < r.t.size(); ++i) {
    const double h = (r.t[i] - r.t[i - 1]) / 40;
    const auto force = [&](double s) {
      const double u0 = r.columns.at("u")[i - 1], u1 = r.columns.at("u")[i];
      return 10 * (u0 + (u1 - u0) * s / 40);
    };
    const auto rate = [&](double at, double p, double w) {
      return force(at) - 4 * w - stiffness * p - 4e5 * p * p * p;
    };
    for (int k = 0; k < 40; ++k) {
      const double a1 = rate(k, x, v), v1 = v;
      const double a2 = rate(k + 0.5, x + h / 2 * v1, v + h / 2 * a1), v2 = v + h / 2 * a1;
      const double a3 = rate(k + 0.5, x + h / 2 * v2, v + h / 2 * a2), v3 = v + h / 2 * a2;
      const double a4 = rate(k + 1, x + h * v3, v + h * a3), v4 = v + h * a3;
      x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    y.push_back(x);
  }
  return y;
}

constexpr double noise = 2e-6;  // [m], of some mm

DataSet recorded(double position, double velocity, double stiffness = 400) {
  DataSet data;
  data.notes["y"].noise.white = noise;
  lab::Noise random(5);
  for (const Role role : {Role::train, Role::validate}) {
    const double f = role == Role::train ? 1.1 : 0.7;
    auto r = lab::recording(to_text(role), role, 0.01, 2000,
                            [f](double t) { return 0.2 * std::sin(2 * std::numbers::pi * f * t); });
    r.units["y"] = parse_unit("mm");
    r.columns["y"] = by_hand(r, role == Role::train ? position : 0, role == Role::train ? velocity : 0, stiffness);
    for (double& y : r.columns["y"]) y += noise * random();
    data.recordings.push_back(std::move(r));
  }
  return data;
}

void start_free(Recording& r) {
  r.at_rest = false;
  r.initial_per_recording = true;
}

TEST(Starts, AreFoundBehindANonlinearLawBesideItsParameters) {
  // 20 mm, where the spring is 1.4 times as hard as at zero: a linear guess is off by a third of the period.
  DataSet data = recorded(0.02, -0.1);
  start_free(data.recordings[0]);
  const auto program = compile(hard_spring(), lab::registry());
  DataModel model(program, lab::shared(data));
  ASSERT_EQ(model.free_initial_states().size(), 2U);
  EXPECT_TRUE(model.starts_are_searched());
  auto free = free_parameters(*program, {"stage.stiffness", "stage.damping"});
  ASSERT_EQ(free.size(), 2U);
  free[0].start = 380;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok) << r.error;
  // 2000 rows of 2 um on mm of motion know a stiffness to some 1e-4: four standard deviations of what the fit says.
  for (const auto& e : r.estimates) {
    const double truth = e.path == "stage.stiffness" ? 400 : 4;
    EXPECT_NEAR(e.used, truth, 4 * e.sigma.value_or(0) + 1e-4 * truth) << e.path;
  }
  EXPECT_NEAR(r.after.find(0)->rms[0], noise, 0.1 * noise) << "2000 rows know an rms to 1.6 %";
  const auto& start = model.start_of(0);
  ASSERT_EQ(start.size(), 2U);
  const auto& names = model.free_initial_states();
  const std::size_t position = names[0].find("position") != std::string::npos ? 0 : 1;
  EXPECT_NEAR(start[position], 0.02, 1e-5) << "rest is at zero; some rows of 2 um know it to a micrometre";
  EXPECT_NEAR(start[1 - position], -0.1, 5e-4);
}

/// A speed that 2/s and dry friction of 6 rad/s^2 bring to rest: from w0 it is (w0 + 3) exp(-2 t) - 3, and then 0.
Diagram braked_shaft() {
  Diagram d = lab::diagram("speed");
  lab::add(d, "push", "gain", "u").parameters["gain"] = "1 rad/s^2/V";
  auto& net = lab::add(d, "net", "sum", "push");
  net.in.push_back({"", "bearing"});
  net.parameters["signs"] = "+-";
  lab::add(d, "speed", "integrator_with_friction", "net").parameters["level"] = "6 rad/s^2";
  lab::add(d, "bearing", "gain", "speed").parameters["gain"] = "2 1/s";
  return d;
}

constexpr double noise_of_speed = 1e-3;  // [rad/s]

DataSet braked(double w0) {
  DataSet data;
  data.notes["y"].noise.white = noise_of_speed;
  lab::Noise random(11);
  auto r = lab::recording("coast", Role::train, 0.01, 200, [](double) { return 0.0; });
  r.units["y"] = parse_unit("rad/s");
  r.columns["y"].clear();
  for (const double t : r.t)
    r.columns["y"].push_back(std::copysign(std::max(0.0, (std::abs(w0) + 3) * std::exp(-2 * t) - 3), w0) +
                             noise_of_speed * random());
  data.recordings.push_back(std::move(r));
  return data;
}

TEST(Starts, OfWhatSlidesBeginSlidingRowByRowAndByTheIntegrator) {
  for (const double w0 : {5.0, -5.0})
    for (const bool by_cvode : {false, true}) {
      DataSet data = braked(w0);
      data.recordings[0].at_rest = false;
      const auto program = compile(braked_shaft(), lab::registry());
      data.recordings[0].initial_values[program->state_names.front()] = w0;
      DataModel model(program, lab::shared(data), {.force_cvode = by_cvode});
      EXPECT_EQ(model.why_not_exact().empty(), !by_cvode) << model.why_not_exact();
      const std::vector<int> recordings{0};
      const Prediction predicted = model.predict({}, recordings);
      ASSERT_TRUE(predicted.ok) << predicted.error;
      const auto& y = predicted.y[0][0];
      const auto& t = data.recordings[0].t;
      for (std::size_t k = 0; k < t.size(); ++k)  // the integrator's 1e-6 of 5 rad/s
        EXPECT_NEAR(y[k], std::copysign(std::max(0.0, 8 * std::exp(-2 * t[k]) - 3), w0), 1e-5) << t[k];
    }
}

TEST(Starts, OfWhatSlidesAreFoundBesideItsFriction) {
  DataSet data = braked(-5);
  start_free(data.recordings[0]);
  const auto program = compile(braked_shaft(), lab::registry());
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"speed.level", "bearing.gain"});
  ASSERT_EQ(free.size(), 2U);
  for (auto& f : free) f.start *= 1.3;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok) << r.error;
  for (const auto& e : r.estimates) {  // 50 rows before it stops: 1e-3/sqrt(50) of 5, and the slope by half of that
    const double truth = e.path == "speed.level" ? 6 : 2;
    EXPECT_NEAR(e.used, truth, 4 * e.sigma.value_or(0) + 1e-4 * truth) << e.path;
  }
  EXPECT_NEAR(r.after.find(0)->rms[0], noise_of_speed, 0.15 * noise_of_speed) << "200 rows know an rms to 5 %";
}

TEST(Starts, OfARecordingAtRestStayThere) {
  const DataSet data = recorded(0.02, 0);
  const auto program = compile(hard_spring(), lab::registry());
  DataModel model(program, lab::shared(data));
  const int both[] = {0, 1};
  EXPECT_FALSE(improve_starts(model, Judge(model, noise_before_fit(model)), {}, both));
  EXPECT_TRUE(model.start_of(0).empty());
}

/// A drive of 2 mm/s/V with a lag of 50 ms that moves a carriage: an integrator holds still for no input but 0 V.
Diagram carriage() {
  Diagram d = lab::diagram("carriage");
  lab::add(d, "amplifier", "gain", "u").parameters["gain"] = "2 mm/s/V";
  lab::add(d, "servo", "lag", "amplifier").parameters["times"] = "50 ms";
  lab::add(d, "carriage", "integrator", "servo");
  return d;
}

/// Driven by 1 V cos(2 t/s) from the first row on, from this place [m] with this velocity [m/s] of the servo.
DataSet carriage_under_way(double place, double velocity) {
  DataSet data;
  data.notes["y"].noise.white = noise;
  lab::Noise random(6);
  constexpr double tau = 0.05, w = 2, gain = 2e-3;
  auto r = lab::recording("train", Role::train, 0.01, 1000, [](double t) { return std::cos(w * t); });
  for (std::size_t i = 0; i < r.t.size(); ++i) {
    // tau v' + v = gain cos(w t): v = a cos(w t) + b sin(w t) + c exp(-t/tau), integrated.
    const double t = r.t[i], a = gain / (1 + w * w * tau * tau), b = a * w * tau, c = velocity - a;
    r.columns["y"][i] = place + a / w * std::sin(w * t) + b / w * (1 - std::cos(w * t)) +
                        c * tau * (1 - std::exp(-t / tau)) + noise * random();
  }
  data.recordings.push_back(std::move(r));
  return data;
}

TEST(Starts, AreFoundWhereNoEquilibriumIs) {
  DataSet data = carriage_under_way(4e-3, -1e-3);
  start_free(data.recordings[0]);
  const auto program = compile(carriage(), lab::registry());
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, {"amplifier.gain"});
  ASSERT_EQ(free.size(), 1U);
  free[0].start = 2.1e-3;
  const auto r = fit(model, noise_before_fit(model), free);
  ASSERT_TRUE(r.ok) << r.error;
  // Inputs are straight between rows: a gain of 1 - w^2 h^2/12 = 1 - 3e-5.
  EXPECT_NEAR(r.estimates[0].used, 2e-3, 4 * r.estimates[0].sigma.value_or(0) + 1e-4 * 2e-3);
  EXPECT_NEAR(r.after.find(0)->rms[0], noise, 0.1 * noise) << "1000 rows know an rms to 2 %";
}

/// The same with a motor of 2e6 rad/s/V in front of a screw of 1e-9 m/rad: rates of states ten decades apart.
Diagram carriage_on_a_screw() {
  Diagram d = lab::diagram("carriage");
  lab::add(d, "amplifier", "gain", "u").parameters["gain"] = "2e6 rad/s/V";
  lab::add(d, "servo", "lag", "amplifier").parameters["times"] = "50 ms";
  lab::add(d, "screw", "gain", "servo").parameters["gain"] = "1e-9 m/rad";
  lab::add(d, "carriage", "integrator", "screw");
  return d;
}

TEST(Starts, OfAnIntegratorAtRestThatCannotRestIsSteadyMotion) {
  // Nobody says how it begins: the servo stands where 1 V holds it, and the carriage moves on from zero.
  const DataSet data = carriage_under_way(0, 2e-3);
  for (const Diagram& d : {carriage(), carriage_on_a_screw()}) {
    DataModel model(compile(d, lab::registry()), lab::shared(data));
    const int all[] = {0};
    const auto prediction = model.predict({}, all);
    ASSERT_TRUE(prediction.ok) << prediction.error;
    double largest = 0;
    for (std::size_t i = 0; i < data.recordings[0].t.size(); ++i)
      largest = std::max(largest, std::abs(prediction.y[0][0][i] - data.recordings[0].columns.at("y")[i]));
    EXPECT_LT(largest, 5 * noise) << "1000 rows of noise; a servo at half its velocity is 50 um off";
  }
}

std::vector<Beginning> told(const DataSet& data) {
  const auto program = compile(hard_spring(), lab::registry());
  DataModel model(program, lab::shared(data));
  const int both[] = {0, 1};
  return begin_elsewhere(model, noise_before_fit(model), model.predict({}, both), {}, both);
}

TEST(Beginnings, OfARecordingThatStillSwingsAreTold) {
  const DataSet data = recorded(0.001, 0);
  const auto found = told(data);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].recording, 0);
  // exp(-2 t) falls to a hundredth after 2.3 s; the answer of the velocity begins at zero and is told by its own top.
  EXPECT_NEAR(found[0].lasts, 2.3, 0.4);
  // 1 mm, decaying: 1/sqrt(2) for the swing, sqrt(1/(2 * 2 * 2.3)) for the decay over 2.3 s.
  EXPECT_NEAR(found[0].rms, 1e-3 * std::sqrt(0.5 / (4 * 2.3)), 0.3e-4);
  const auto program = compile(hard_spring(), lab::registry());
  const std::string text = to_text(DataModel(program, lab::shared(data)), found[0]);
  EXPECT_NE(text.find("train does not begin at rest"), std::string::npos) << text;
  EXPECT_NE(text.find("per_recording"), std::string::npos) << text;
}

TEST(Beginnings, AtRestAreNotToldNorWhereTheModelIsWrongThroughout) {
  EXPECT_TRUE(told(recorded(0, 0)).empty());
  EXPECT_TRUE(told(recorded(0, 0, 440)).empty()) << "a spring that is a tenth too soft is wrong in every window";
}

TEST(Beginnings, ThatTheDataSetLeavesOpenAreNotTold) {
  DataSet data = recorded(0.001, 0);
  start_free(data.recordings[0]);
  EXPECT_TRUE(told(data).empty());
}

}  // namespace
}  // namespace hysteron
