// Do 95 % intervals hold the truth? 100 draws of true parameters and noise per model, white and 1/f noise. The starts
// are the same for all draws and know nothing of them. The band 90 ... 99 % is what is promised; over the 300 and more
// intervals of a model chance moves the share by 1.3 % (standard deviation), so only a wrong interval leaves it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "fit/estimate/fit.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

enum class Colour { white, pink_noise };

/// 1/f noise of rms one as a sum of relaxing processes, each four times slower than the one before: made differently
/// from the filter that whitens it.
std::vector<double> pink_noise(std::size_t rows, lab::Noise& random) {
  std::vector<double> sum(rows, 0.0);
  int processes = 0;
  for (double slow = 1; slow < 2 * static_cast<double>(rows); slow *= 4, ++processes) {
    const double keep = std::exp(-1 / slow), kick = std::sqrt(1 - keep * keep);
    double x = random();
    for (double& y : sum) y += x = keep * x + kick * random();
  }
  double squares = 0;
  for (const double y : sum) squares += y * y;
  for (double& y : sum) y *= std::sqrt(static_cast<double>(rows) / squares);
  return sum;
}

struct Drawn {
  std::string path;
  double start, lower, upper;  ///< SI; bounds of the fit
  double from, to;             ///< SI; truth is drawn between
  bool log_scale = false;
};

struct Experiment {
  Diagram diagram;
  std::vector<Drawn> parameters;
  lab::Signal input;
  std::map<std::string, lab::Signal> side;  ///< further inputs, K
  double step = 1e-3;                       ///< [s]
  std::size_t rows = 2000;
  double noise = 10e-9;  ///< white rms [m]
};

struct Held {
  int intervals = 0, inside = 0, undetermined = 0, at_bound = 0;
};

/// One draw: truth, recording, fit; counts into `held` by parameter.
void draw_and_fit(const Experiment& e, const ProgramPointer& program, Colour colour, unsigned seed,
                  std::map<std::string, Held>& held) {
  lab::Noise random(seed);
  std::vector<ParameterValue> truth;
  std::vector<FreeParameter> free;
  for (const auto& d : e.parameters) {
    const int parameter = parameter_index(*program, d.path);
    truth.push_back({parameter, d.from + random.uniform() * (d.to - d.from)});
    FreeParameter f;
    f.parameter = parameter;
    f.start = d.start;
    f.lower = d.lower;
    f.upper = d.upper;
    f.log_scale = d.log_scale;
    free.push_back(f);
  }
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  data.notes["y"].noise.white = e.noise;
  const double share = colour == Colour::white ? 0 : 0.5;
  data.notes["y"].noise.one_over_f = share;
  data.recordings = {lab::recording("train", Role::train, e.step, e.rows, e.input)};
  for (const auto& [name, signal] : e.side) {
    data.notes[name].to = name;
    auto& r = data.recordings[0];
    for (const double t : r.t) r.columns[name].push_back(signal(t));
    r.units[name] = parse_unit("K");
  }
  lab::measure(data, program, e.noise, seed + 1000, truth);
  const auto pink = pink_noise(e.rows, random);
  auto& y = data.recordings[0].columns["y"];
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += share * e.noise * pink[i];
  DataModel model(program, lab::shared(data));
  FitOptions options;
  options.starts = 12;  // from nowhere: two time constants can fall into each other's place
  const auto result = fit(model, noise_before_fit(model), free, options);
  ASSERT_TRUE(result.ok) << result.error;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto& estimate = result.estimates[i];
    auto& h = held[estimate.path];
    if (!estimate.determined) ++h.undetermined;
    if (estimate.at_lower || estimate.at_upper) ++h.at_bound;
    if (!estimate.low95) continue;
    ++h.intervals;
    if (*estimate.low95 <= truth[i].value && truth[i].value <= *estimate.high95) ++h.inside;
  }
}

void expect_honest(const Experiment& e, Colour colour, int draws = 100) {
  const auto program = compile(e.diagram, lab::registry());
  std::map<std::string, Held> held;
  for (int i = 0; i < draws; ++i) draw_and_fit(e, program, colour, 100 + static_cast<unsigned>(i), held);
  int intervals = 0, inside = 0;
  for (const auto& [path, h] : held) {
    intervals += h.intervals;
    inside += h.inside;
    fmt::print("  {:24} {:3} of {:3} intervals hold the truth, {} undetermined, {} at a bound\n", path, h.inside,
               h.intervals, h.undetermined, h.at_bound);
  }
  fmt::print("  together {:.1f} %\n", 100.0 * inside / std::max(1, intervals));
  EXPECT_GE(intervals, draws);  // intervals are given, not withheld
  EXPECT_GE(inside, 0.90 * intervals);
  EXPECT_LE(inside, 0.99 * intervals);
}

double sweep(double t) { return 4 - 4 * std::cos(2 * std::numbers::pi * (0.5 * t + 1.1 * t * t)) * std::exp(-0.3 * t); }
double thesis_sine(double t) { return 3 - 3 * std::cos(2 * std::numbers::pi * 5 * t); }
double staircase(double t) { return 2.0 * std::floor(std::fmod(t * 3.1, 5.0)) + (t > 1 ? -1.5 : 0); }

Experiment prandtl_ishlinskii() {
  Experiment e;
  e.diagram = lab::diagram("core");
  auto& core = lab::add(e.diagram, "core", "prandtl_ishlinskii", "u");
  NumberList thresholds, weights;
  for (int i = 0; i < 6; ++i) {
    thresholds.push_back({static_cast<double>(i), "V"});
    weights.push_back({i == 0 ? 1.0 : 0.1, "um/V"});
    e.parameters.push_back({fmt::format("core.weights[{}]", i), i == 0 ? 1e-6 : .1e-6, -1e-5, 1e-5,
                            i == 0 ? .7e-6 : .05e-6, i == 0 ? 1.2e-6 : .3e-6});
  }
  core.parameters["thresholds"] = thresholds;
  core.parameters["weights"] = weights;
  e.input = sweep;
  return e;
}

Experiment bouc_wen() {
  Experiment e;
  e.diagram = lab::diagram("core");
  auto& core = lab::add(e.diagram, "core", "bouc_wen", "u");
  core.parameters["alpha"] = "1 um/V";
  core.parameters["beta"] = "0.5 1/V";
  core.parameters["gamma"] = "0 1/V";
  core.parameters["d_p"] = "1 um/V";
  e.parameters = {{"core.alpha", 1e-6, 0, 3e-6, .4e-6, .8e-6},
                  {"core.beta", .5, 0, 3, .15, .35},
                  {"core.gamma", 0, -1.5, 1.5, -.05, .05},
                  {"core.d_p", 1e-6, 0, 5e-6, 1.2e-6, 1.8e-6}};
  e.input = thesis_sine;
  e.step = 2e-4;
  e.noise = 20e-9;
  return e;
}

/// On loops up to `reach` [V]: the thesis' 6 V leave saturation, shape and field of the material hardly determined.
Experiment jiles_atherton(double reach) {
  Experiment e;
  e.diagram = lab::diagram("core");
  auto& core = lab::add(e.diagram, "core", "jiles_atherton", "u");
  core.parameters["p_s"] = "50 um";
  core.parameters["a"] = "40 V";
  core.parameters["alpha"] = "0.1 V/um";
  core.parameters["k"] = "4 V";
  core.parameters["c"] = 0.6;
  e.parameters = {{"core.p_s", 50e-6, 5e-6, 500e-6, 45e-6, 60e-6},
                  {"core.a", 40, 5, 400, 40, 55},
                  {"core.alpha", .1e6, 0, .5e6, .05e6, .25e6},
                  {"core.k", 4, .5, 20, 3, 5},
                  {"core.c", .6, .05, .95, .5, .75}};
  e.input = [reach](double t) { return reach / 2 * (1 - std::cos(2 * std::numbers::pi * 5 * t)) * (t < .2 ? 1 : .6); };
  e.step = 2e-4;
  e.noise = 10e-9;
  return e;
}

/// Sweeps of the drive while the temperature goes up and down by 40 K.
Experiment tapi() {
  Experiment e;
  e.diagram = lab::diagram("core");
  e.diagram.inputs["temperature"].unit = "K";
  auto& core = e.diagram.blocks["core"];
  core.type = "tapi";
  core.in = {{"u", "u"}, {"temperature", "temperature"}};
  NumberList thresholds, weights;
  for (int i = 0; i < 4; ++i) {
    thresholds.push_back({2.0 * i, "V"});
    weights.push_back({i == 0 ? 1.0 : 0.1, "um/V"});
    e.parameters.push_back({fmt::format("core.weights[{}]", i), i == 0 ? 1e-6 : .1e-6, -1e-5, 1e-5,
                            i == 0 ? .7e-6 : .05e-6, i == 0 ? 1.2e-6 : .3e-6});
  }
  core.parameters["thresholds"] = thresholds;
  core.parameters["weights"] = weights;
  core.parameters["p_s"] = "60 V";
  core.parameters["t_c"] = "600 K";
  core.parameters["beta"] = 0.4;
  core.parameters["a"] = "0.1 V/K";
  e.parameters.push_back({"core.p_s", 60, 5, 500, 40, 60});
  e.parameters.push_back({"core.a", .1, .01, 1, .06, .12});
  e.input = [](double t) { return 8 - 8 * std::cos(2 * std::numbers::pi * (1 * t + 1.1 * t * t)); };
  e.side["temperature"] = [](double t) { return 310 + 20 * std::sin(2 * std::numbers::pi * .9 * t); };
  return e;
}

Experiment creep() {
  Experiment e;
  e.diagram = lab::diagram("g");
  auto& creep = lab::add(e.diagram, "creep", "creep", "u");
  creep.parameters["amounts"] = NumberList{{.01, {}}, {.01, {}}};
  creep.parameters["times"] = NumberList{{.1, "s"}, {2, "s"}};
  lab::add(e.diagram, "g", "gain", "creep").parameters["gain"] = "1 um/V";
  e.parameters = {{"creep.amounts[0]", .01, 0, 1, .02, .05},
                  {"creep.amounts[1]", .01, 0, 1, .02, .05},
                  {"creep.times[0]", .1, .01, 1, .04, .2, true},
                  {"creep.times[1]", 2, .5, 50, 1.5, 4, true},
                  {"g.gain", 1e-6, 0, 1e-5, .8e-6, 1.2e-6}};
  e.input = staircase;
  e.step = 5e-3;
  return e;
}

Experiment plant() {
  Experiment e;
  e.diagram = lab::diagram("stage.position");
  lab::add(e.diagram, "force", "gain", "u").parameters["gain"] = "1 N/V";
  auto& stage = lab::add(e.diagram, "stage", "mass_spring_damper", "force");
  stage.parameters["mass"] = "1 kg";
  stage.parameters["stiffness"] = "100 kN/m";
  stage.parameters["damping"] = "100 N s/m";
  e.parameters = {{"stage.mass", 1, .1, 10, .7, 1.3, true},
                  {"stage.stiffness", 1e5, 1e4, 1e6, .8e5, 1.2e5, true},
                  {"stage.damping", 100, 1, 1e4, 30, 150, true}};
  e.input = [](double t) { return std::sin(2 * std::numbers::pi * (5 + 40 * t) * t); };
  e.noise = 100e-9;
  return e;
}

struct Case {
  std::string name;
  Experiment (*make)();
  Colour colour;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class LongCoverage : public testing::TestWithParam<Case> {};
TEST_P(LongCoverage, NineteenOfTwentyIntervalsHoldTheTruth) { expect_honest(GetParam().make(), GetParam().colour); }

Experiment large_jiles_atherton() { return jiles_atherton(100); }
// The model is too curved here for intervals from a linearization: profiles take over.
Experiment small_jiles_atherton() { return jiles_atherton(6); }

INSTANTIATE_TEST_SUITE_P(
    Models, LongCoverage,
    testing::Values(Case{"PrandtlIshlinskii", prandtl_ishlinskii, Colour::white},
                    Case{"PrandtlIshlinskiiOneOverF", prandtl_ishlinskii, Colour::pink_noise},
                    Case{"BoucWen", bouc_wen, Colour::white}, Case{"BoucWenOneOverF", bouc_wen, Colour::pink_noise},
                    Case{"JilesAtherton", large_jiles_atherton, Colour::white},
                    Case{"JilesAthertonOneOverF", large_jiles_atherton, Colour::pink_noise},
                    Case{"JilesAthertonOnASmallLoop", small_jiles_atherton, Colour::white},
                    Case{"Tapi", tapi, Colour::white}, Case{"TapiOneOverF", tapi, Colour::pink_noise},
                    Case{"Creep", creep, Colour::white}, Case{"CreepOneOverF", creep, Colour::pink_noise},
                    Case{"Plant", plant, Colour::white}, Case{"PlantOneOverF", plant, Colour::pink_noise}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace hysteron
