// Bodies on springs that bend or remember: rows are advanced as the integrator does.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fit/model/model.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

/// A guide of 400 Hz beside elements that hold back a tenth of the force, in rows of 1/40 s: 60 radians each, in which
/// its ringing dies away.
Diagram stage_beside_elements_in(const std::string& type) {
  Diagram d = lab::diagram("y");
  lab::add(d, "force", "gain", "u").parameters["gain"] = "1 N/V";
  auto& mass = lab::add(d, "mass", type, "force");
  mass.parameters["mass"] = "1 kg";
  mass.parameters["damping"] = "1000 N*s/m";
  mass.parameters["stiffness"] = "6.3e6 N/m";
  mass.parameters["contact_stiffness"] = NumberList{{2e6, "N/m"}, {9e5, "N/m"}};
  mass.parameters["slip_distance"] = NumberList{{0.1, "um"}, {0.3, "um"}};
  lab::add(d, "y", "gain", "mass.position").parameters["gain"] = "1";
  return d;
}
ProgramPointer stage_beside_elements(const std::string& type, double excess = 0, const std::string& contact_time = "") {
  Diagram d = stage_beside_elements_in(type);
  auto& mass = *d.blocks.find("mass");
  mass.parameters["excess"] = excess;
  mass.parameters["stribeck_velocity"] = "5 um/s";  // of up to 10 um/s
  if (!contact_time.empty()) mass.parameters["contact_time"] = contact_time;
  return compile(d, lab::registry());
}

/// Rows of `step` seconds are advanced exactly, and as BDF does. Steps of one simulation of the second recording.
long expect_the_integrator(const ProgramPointer& program, double step, std::size_t rows) {
  DataSet data = lab::swings(step, rows);
  lab::measure(data, program, 0, 22);
  DataModelOptions options;
  options.relative_tolerance = 1e-9;
  DataModel model(program, lab::shared(data), options);
  const std::vector<int> both{0, 1};
  EXPECT_TRUE(model.predict({}, both).ok) << step;
  EXPECT_EQ(model.why_not_exact(), "") << step;
  EXPECT_LT(model.cross_check({}, both)[0], 5e-6) << step;  // 1e-6 of the span was asked for
  return model.steps(1);
}

TEST(DataModel, ElementsThatHoldLessWhileTheySlideFastAgreeWithTheIntegrator) {
  // Two and a half radians in a row, and a quarter of one.
  for (const std::string type : {"mass_with_presliding", "mass_on_hysteretic_spring"})
    for (const double step : {1e-3, 1e-4}) expect_the_integrator(stage_beside_elements(type, 0.5), step, 1500);
}

TEST(DataModel, AContactThatIsDampedAgreesWithTheIntegrator) {
  // As much damping as three tenths of the guide's own while it sticks.
  for (const double step : {1e-3, 1e-4})
    expect_the_integrator(stage_beside_elements("mass_with_presliding", 0.5, "0.1 ms"), step, 1500);
}

TEST(DataModel, WhatRemembersBesideWhatBendsAndAFluidAgreesWithTheIntegrator) {
  // A tenth more force at the travel of 1 um, three tenths more one way, and as much drag at 5 mm/s as the damper's
  // tenth part: each alone would be seen.
  for (const std::string type : {"mass_with_presliding", "mass_on_hysteretic_spring"})
    for (const double step : {1e-3, 1e-4}) {
      Diagram d = stage_beside_elements_in(type);
      auto& mass = *d.blocks.find("mass");
      mass.parameters["stiffening"] = "6.3e17 N/m^3";
      mass.parameters["quadratic"] = "1.9e12 N/m^2";
      mass.parameters["quintic"] = "1e29 N/m^5";
      mass.parameters["drag"] = "2e7 N*s^2/m^2";
      expect_the_integrator(compile(d, lab::registry()), step, 1500);
    }
}

/// The same guide on a spring that remembers, unevenly over its travel of 1 um.
Diagram stage_on_a_spring_of_plays() {
  Diagram d = lab::diagram("y");
  lab::add(d, "force", "gain", "u").parameters["gain"] = "1 N/V";
  auto& mass = lab::add(d, "mass", "mass_on_spring_of_plays", "force");
  mass.parameters["mass"] = "1 kg";
  mass.parameters["damping"] = "1000 N*s/m";
  mass.parameters["stiffness"] = "6.3e6 N/m";
  mass.parameters["thresholds"] = NumberList{{0.03, "um"}, {0.2, "um"}};
  mass.parameters["at_lower"] = NumberList{{1e5, "N/m"}, {9e5, "N/m"}};
  mass.parameters["in_middle"] = NumberList{{8e5, "N/m"}, {1e5, "N/m"}};
  mass.parameters["at_upper"] = NumberList{{2e5, "N/m"}, {0, "N/m"}};
  mass.parameters["lower"] = "-0.5 um";
  mass.parameters["upper"] = "0.5 um";
  lab::add(d, "y", "gain", "mass.position").parameters["gain"] = "1";
  return d;
}

TEST(DataModel, ASpringOfPlaysAgreesWithTheIntegrator) {
  for (const double step : {1 / 40.0, 1e-3, 1e-4})
    expect_the_integrator(compile(stage_on_a_spring_of_plays(), lab::registry()), step, 800);
}

TEST(DataModel, ASpringOfPlaysThatStiffensAgreesWithTheIntegrator) {
  Diagram d = stage_on_a_spring_of_plays();
  d.blocks.find("mass")->parameters["stiffening"] = "6.3e17 N/m^3";  // a tenth more at 1 um
  for (const double step : {1 / 40.0, 1e-3, 1e-4}) expect_the_integrator(compile(d, lab::registry()), step, 800);
}

TEST(DataModel, ABoucWenSpringAgreesWithTheIntegrator) {
  Diagram d = lab::diagram("y");
  lab::add(d, "force", "gain", "u").parameters["gain"] = "1 N/V";
  auto& mass = lab::add(d, "mass", "mass_on_bouc_wen_spring", "force");
  mass.parameters["mass"] = "1 kg";
  mass.parameters["damping"] = "1000 N*s/m";
  mass.parameters["stiffness"] = "6.3e6 N/m";
  mass.parameters["hysteretic_share"] = "0.4";
  mass.parameters["beta"] = "4 1/um";
  mass.parameters["gamma"] = "-5 1/um";
  lab::add(d, "y", "gain", "mass.position").parameters["gain"] = "1";
  const auto program = compile(d, lab::registry());
  // In slower rows it rings between them, and every small loop leaves something behind: those are integrated.
  for (const double step : {1e-3, 1e-4}) expect_the_integrator(program, step, 800);
}

TEST(DataModel, SlowRowsOfAGuideNeedNoStepsOfItsResonance) {
  for (const std::string type : {"mass_with_presliding", "mass_on_hysteretic_spring"}) {
    const long steps = expect_the_integrator(stage_beside_elements(type), 1 / 40.0, 400);
    EXPECT_LT(steps, 20 * 400) << type << ": Runge-Kutta alone has no answer from less than 22 steps a row";
  }
}

TEST(DataModel, AResonanceOnABentSpringAgreesWithTheIntegrator) {
  // At 6 V the spring pulls 1 - 0.3 + 0.72 + 0.13 times as much as a straight one.
  Diagram d = lab::diagram("y");
  auto& ring = lab::add(d, "ring", "duffing", "u");
  ring.parameters["frequency"] = "400 Hz";
  ring.parameters["damping"] = 0.2;
  ring.parameters["stiffening"] = "0.02 1/V^2";
  ring.parameters["quadratic"] = "-0.05 1/V";
  ring.parameters["quintic"] = "1e-4 1/V^4";
  lab::add(d, "y", "gain", "ring").parameters["gain"] = "1 um/V";
  for (const double step : {1e-3, 1e-4}) expect_the_integrator(compile(d, lab::registry()), step, 800);
}

}  // namespace
}  // namespace hysteron
