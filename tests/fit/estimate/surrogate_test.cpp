// The surrogate actuator is what SPEC 2.5 says, and the fits of chapter 2 reach on it what an independent least-squares
// program reached.
#include "tests/fit/surrogate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "fit/estimate/fit.h"
#include "io/jobs/job_file.h"
#include "io/jobs/runs_job.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

class SurrogateGolden : public testing::TestWithParam<const char*> {};
TEST_P(SurrogateGolden, TraceIsReproduced) {
  const std::string name = std::string("s1_forward_") + GetParam();
  HYSTERON_NEEDS_GOLDEN(name);
  const auto trace = golden::read(name);
  const Traces traces = surrogate::open_loop(GetParam(), trace.at("t [s]"));
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    ASSERT_NEAR(traces.values[0][k], trace.at("u [V]")[k], 1e-9) << "row " << k;
    ASSERT_NEAR(1e6 * traces.values[1][k], trace.at("y_h [um]")[k], 1e-8) << "row " << k;
    ASSERT_NEAR(1e6 * traces.values[2][k], trace.at("y [um]")[k], 1e-6) << "row " << k;
  }
}
INSTANTIATE_TEST_SUITE_P(Traces, SurrogateGolden, testing::Values("sine", "triangle"),
                         [](const auto& made) { return std::string(made.param); });

TEST(Surrogate, EveryDiagramAndJobBesideItCanBeReadAndCompiled) {
  int diagrams = 0, fits = 0, figures = 0;
  for (const char* chapter : {"chapter1", "chapter2", "chapter3", "chapter5"}) {
    const std::string folder = std::string(HYSTERON_SOURCE_DIR) + "/diagrams/" + chapter;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string file = entry.path().string();
      if (entry.path().extension() != ".json" || file.find("dataset") != std::string::npos) continue;
      const std::string does = what_a_job_does(file);
      if (does == "runs") {
        EXPECT_NO_THROW(read_runs_job(file)) << file;
        ++figures;
      } else if (does == "fit") {
        const FitJob job = read_fit_job(file);
        EXPECT_TRUE(std::filesystem::exists(job.diagram)) << file;
        EXPECT_TRUE(std::filesystem::exists(job.data)) << file;
        ++fits;
      } else {
        EXPECT_NO_THROW(compile(read_diagram(file), lab::registry())) << file;
        ++diagrams;
      }
    }
  }
  EXPECT_GE(diagrams, 9);
  EXPECT_GE(fits, 2);
  EXPECT_GE(figures, 40);
}

TEST(Surrogate, SteadyLoopHasTheStrokeAndTheAreaOfItsDescription) {
  // SPEC 2.5: stroke 6.68493 um, area 3.91815 um V, largest y - u 0.939 um, y zero at the bottom. 2000 rows a cycle:
  // the top of a parabola between two rows is missed by (pi/2000)^2/2 of 3.3 um, 4e-6.
  const DataSet data = surrogate::steady_loop();
  const auto& u = data.recordings[0].columns.at("u");
  const auto& y = data.recordings[0].columns.at("y");
  const std::size_t first = data.recordings[0].first, last = first + 1999;
  const auto [low, high] = std::minmax_element(y.begin() + first, y.begin() + last);
  double area = 0, above = 0;
  for (std::size_t k = first; k < last; ++k) {
    area -= (u[k + 1] - u[k]) * (y[k] + y[k + 1]) / 2;
    above = std::max(above, 1e6 * (y[k] - y[first]) - u[k]);
  }
  EXPECT_NEAR(1e6 * (*high - *low), 6.68493, 1.5e-5);
  EXPECT_NEAR(1e6 * area, 3.91815, 2e-5);
  EXPECT_NEAR(above, 0.939, 6e-4);
}

TEST(Surrogate, S1bRelaxesLess) {
  // The relaxation lets the stroke fall: share a of it follows with 5 ms. At 5 Hz |1/(1 + j w tau)| - 1 = -1.2 % of the
  // share: S1 about 0.2 % below the static loop, S1b a third of that.
  std::vector<double> instants;
  for (int k = 0; k <= 2000; ++k) instants.push_back(1.0 + 1e-4 * k);
  const auto stroke = [](const std::vector<double>& y) {
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    return *high - *low;
  };
  const Traces one = surrogate::open_loop("sine", instants),
               other = surrogate::open_loop("sine", instants, "s1b_open_loop.json");
  const double lost = stroke(one.values[1]) - stroke(one.values[2]);
  const double lost_b = stroke(other.values[1]) - stroke(other.values[2]);
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(lost_b / lost, 0.05 / 0.16, 0.05);
}

TEST(Surrogate, T1ReproducesItsGoldenTracesAtEveryTemperature) {
  HYSTERON_NEEDS_GOLDEN("t1_plant_forward");
  const auto trace = golden::read("t1_plant_forward");
  Diagram d = read_diagram(std::string(HYSTERON_SOURCE_DIR) + "/diagrams/chapter5/t1_staircase.json");
  const auto program = compile(d, lab::registry());
  SimulateOptions options;
  options.instants = trace.at("t [s]");
  options.until = options.instants.back();
  for (const int celsius : {22, 30, 40, 50, 60, 70}) {
    hysteron::Run run = start(*program);
    set_parameter(*program, run, "oven.value", celsius + 273.15);
    prepare(*program, run);
    const Traces traces = simulate(*program, run, options);
    const auto& y = trace.at("y T=" + std::to_string(celsius) + " [um]");
    for (std::size_t k = 0; k < y.size(); ++k)  // ten digits of y up to 9.4 um and of the weights
      ASSERT_NEAR(1e6 * traces.values[2][k], y[k], 2e-9) << celsius << " degC, row " << k;
  }
}

/// Sum of squares over five cycles [um^2], the zero of the recording found by least squares.
double fitness(const FitResult& r) { return 5 * 1e12 * r.chi2 * 10e-9 * 10e-9; }

Diagram one_block(const std::string& type, const std::vector<std::pair<std::string, Value>>& parameters) {
  Diagram d = lab::diagram("model");
  auto& node = lab::add(d, "model", type, "u");
  for (const auto& [name, value] : parameters) node.parameters[name] = value;
  return d;
}

FitResult fitted(const Diagram& d, const std::vector<std::string>& names, std::vector<std::pair<double, double>> bounds,
                 const DataSet& data = surrogate::steady_loop()) {
  const auto program = compile(d, lab::registry());
  DataModel model(program, lab::shared(data));
  auto free = free_parameters(*program, names);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    free[i].lower = bounds[i].first;
    free[i].upper = bounds[i].second;
  }
  FitOptions options;
  options.intervals = false;
  options.max_iterations = 200;
  options.refine = 1;
  return fit(model, noise_before_fit(model), free, options);
}

// SPEC 2.5 gives S with the loop's bottom as its zero: 7.70 (Bouc-Wen), 4.87 (Jiles-Atherton), 12.96
// (Prandtl-Ishlinskii, by slopes), least squares from the table values. With the zero found by least squares too it is
// lower, R-02: 7.65 and 4.22. Three digits are given; a descent that stops in the flat valley may be some thousandths
// above.
TEST(SurrogateFits, BoucWenReachesTheFitnessOfIndependentLeastSquares) {
  const auto r = fitted(
      one_block("bouc_wen",
                {{"alpha", "0.6187 um/V"}, {"beta", "0.2418 1/V"}, {"gamma", "0.0237 1/V"}, {"d_p", "1.6126 um/V"}}),
      {"model.alpha", "model.beta", "model.gamma", "model.d_p"}, {{0, 5e-6}, {0, 2}, {-1, 1}, {0, 5e-6}});
  ASSERT_TRUE(r.ok) << r.error;
  EXPECT_NEAR(fitness(r), 7.65, 0.01 + 0.005);
}

TEST(SurrogateFits, JilesAthertonReachesTheFitnessOfIndependentLeastSquares) {
  const auto r = fitted(
      one_block(
          "jiles_atherton",
          {{"p_s", "55.9973 um"}, {"a", "48.5843 V"}, {"alpha", "0.2512 V/um"}, {"k", "3.8892 V"}, {"c", 0.6929}}),
      {"model.p_s", "model.a", "model.alpha", "model.k", "model.c"},
      {{1e-6, 100e-6}, {1, 100}, {0.005e6, 0.5e6}, {0.01, 10}, {0.001, 0.999}});
  ASSERT_TRUE(r.ok) << r.error;
  EXPECT_NEAR(fitness(r), 4.22, 0.01 + 0.005);
}

TEST(SurrogateFits, PrandtlIshlinskiiByLeastSquaresIsBetterThanBySlopes) {
  // SPEC 2.5 reads the weights off the rising branch: 12.96 (slopes_method_test.cpp). Least squares also care for the
  // falling one.
  NumberList thresholds, weights;
  for (int i = 0; i < 10; ++i) {
    thresholds.push_back({0.6 * i, "V"});
    weights.push_back({i == 0 ? 0.7 : 0.05, "um/V"});
  }
  DataSet data = surrogate::steady_loop(1);
  auto& r = data.recordings[0];
  data.notes["y"].zero_per_recording = false;
  const double bottom = r.columns["y"][r.first];
  for (double& y : r.columns["y"]) y -= bottom;
  const auto found = fitted(one_block("prandtl_ishlinskii", {{"thresholds", thresholds}, {"weights", weights}}),
                            {"model.weights"}, {}, data);
  ASSERT_TRUE(found.ok) << found.error;
  EXPECT_LT(fitness(found), 0.6 * 12.96);
}

}  // namespace
}  // namespace hysteron
