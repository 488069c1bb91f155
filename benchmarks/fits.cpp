// Fits against programs written by hand: the same data, the same optimum, CPU time as a multiple. What is compared with
// SciPy is run from fits.py, which calls this program with one workload after the other.
//
//   hysteron_fits bouc-wen            by hand and hysteron, interleaved; 100 random starts
//   hysteron_fits write FOLDER        u and y of the other two as raw doubles
//   hysteron_fits operators|creep     hysteron's CPU seconds, runs, rms [um]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "benchmarks/bouc_wen_fit_by_hand.h"
#include "benchmarks/diagrams.h"
#include "fit/estimate/fit.h"

namespace hysteron::benchmarks {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Normal deviates by Box and Muller, the same on every machine.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  double uniform() { return (static_cast<double>(next() >> 11) + 0.5) / 9007199254740992.0; }
  double operator()() {
    const double u = uniform(), v = uniform();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
  }

 private:
  std::uint64_t next() {  // splitmix64
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

using Rows = std::vector<double>;

struct Data {
  double step = 0;         ///< [s]
  std::vector<Rows> u, y;  ///< [recording] V, um
  double noise = 0;        ///< rms [um]
};

std::shared_ptr<const DataSet> data_set(const Data& data) {
  DataSet set;
  set.notes["u"].to = "u";
  set.notes["y"].to = "y";
  set.notes["y"].noise.white = data.noise * um;
  set.notes["y"].noise.one_over_f = 0.0;
  for (std::size_t r = 0; r < data.u.size(); ++r) {
    Recording recording;
    recording.name = recording.file = fmt::format("{:02}", r + 1);
    recording.columns["u"] = data.u[r];
    recording.columns["y"] = scaled(data.y[r], um);
    recording.units["u"] = parse_unit("V");
    recording.units["y"] = parse_unit("um");
    for (std::size_t k = 0; k < data.u[r].size(); ++k) recording.t.push_back(static_cast<double>(k) * data.step);
    recording.last = data.u[r].size();
    set.recordings.push_back(std::move(recording));
  }
  return std::make_shared<const DataSet>(std::move(set));
}

Diagram diagram_from_u() {
  Diagram d;
  d.inputs["u"].unit = "V";
  return d;
}

double rms_um(const FitResult& result, double rows, double noise) { return noise * std::sqrt(result.chi2 / rows); }

// --- Bouc-Wen, WORKLOADS W5

constexpr std::array<double, 4> truth{.6187, .2418, .0237, 1.6126};  // um/V, 1/V, 1/V, um/V
constexpr std::array<double, 4> poor{.05, 2, .5, 3};
constexpr std::array<double, 4> low{0, 0, -1.5, 0};
constexpr std::array<double, 4> high{3, 3, 1.5, 5};
constexpr std::array<double, 4> size{um, 1, 1, um};  // SI of one
constexpr std::array<const char*, 4> names{"core.alpha", "core.beta", "core.gamma", "core.d_p"};

Data bouc_wen_data() {
  Data data;
  data.step = 2e-4;
  data.noise = .02;
  data.u.resize(1);
  for (int k = 0; k < 2000; ++k) data.u[0].push_back(3 - 3 * std::cos(2 * std::numbers::pi * 5 * k * data.step));
  data.y = {bouc_wen_by_hand(data.u[0], truth)};
  Noise noise(5);
  for (double& y : data.y[0]) y += data.noise * noise();
  return data;
}

ProgramPointer bouc_wen_program() {
  Diagram d = diagram_from_u();
  d.blocks["core"] =
      node("bouc_wen", {{"alpha", "1 um/V"}, {"beta", "1 1/V"}, {"gamma", "0 1/V"}, {"d_p", "1 um/V"}}, {"u"});
  d.outputs["y"] = "core";
  return compiled(d);
}

struct Fitted {
  std::array<double, 4> p{};
  double rms = 0;  ///< [um]
  double seconds = 0;
  long runs = 0;
};

Fitted bouc_wen_in_hysteron(DataModel& model, const NoiseModel& noise, const std::array<double, 4>& start,
                            const FitOptions& options) {
  std::vector<FreeParameter> free;
  for (std::size_t i = 0; i < 4; ++i) {
    FreeParameter f;
    f.parameter = parameter_index(model.program(), names[i]);
    f.start = start[i] * size[i];
    f.lower = low[i] * size[i];
    f.upper = high[i] * size[i];
    free.push_back(f);
  }
  const double begin = cpu_seconds();
  const auto result = fit(model, noise, free, options);
  Fitted f;
  f.seconds = cpu_seconds() - begin;
  f.runs = result.runs;
  if (!result.ok) return f;
  for (std::size_t i = 0; i < 4; ++i) f.p[i] = result.values[i].value / size[i];
  f.rms = rms_um(result, static_cast<double>(model.measured(0, 0).size()), noise.outputs[0].white / um);
  return f;
}

double median(Rows v) {
  std::sort(v.begin(), v.end());
  return v.empty() ? 0 : v[v.size() / 2];
}

int bouc_wen() {
  const Data data = bouc_wen_data();
  DataModel model(bouc_wen_program(), data_set(data));
  const NoiseModel noise = noise_before_fit(model);
  FitOptions only_search;
  only_search.intervals = false;
  Rows hand, own, with_intervals;
  Fitted own_fit;
  BoucWenFit hand_fit;
  for (int i = 0; i < 15; ++i) {
    const double begin = cpu_seconds();
    for (int k = 0; k < 20; ++k) hand_fit = fit_bouc_wen_by_hand(data.u[0], data.y[0], poor, low, high);
    hand.push_back((cpu_seconds() - begin) / 20);
    own_fit = bouc_wen_in_hysteron(model, noise, poor, only_search);
    own.push_back(own_fit.seconds);
    with_intervals.push_back(bouc_wen_in_hysteron(model, noise, poor, {}).seconds);
  }
  fmt::print("Bouc-Wen, 4 parameters, 2000 samples, start {}\n", fmt::join(poor, ", "));
  fmt::print("  by hand   {:8.3f} ms  {} runs, rms {:.6f} um, {:.6f}\n", 1e3 * median(hand), hand_fit.runs,
             hand_fit.rms, fmt::join(hand_fit.p, " "));
  fmt::print("  hysteron  {:8.3f} ms  {} runs, rms {:.6f} um, {:.6f}\n", 1e3 * median(own), own_fit.runs, own_fit.rms,
             fmt::join(own_fit.p, " "));
  fmt::print("  ratio     {:8.2f}     with intervals {:.2f}\n", median(own) / median(hand),
             median(with_intervals) / median(hand));

  Noise random(99);
  int reached = 0, reached_by_hand = 0;
  Rows seconds;
  for (int i = 0; i < 100; ++i) {
    std::array<double, 4> start{};
    for (std::size_t k = 0; k < 4; ++k) start[k] = low[k] + random.uniform() * (high[k] - low[k]);
    const auto f = bouc_wen_in_hysteron(model, noise, start, only_search);
    seconds.push_back(f.seconds);
    if (f.rms > 0 && f.rms < own_fit.rms * 1.0001) ++reached;
    const auto h = fit_bouc_wen_by_hand(data.u[0], data.y[0], start, low, high);
    if (h.rms < hand_fit.rms * 1.0001) ++reached_by_hand;
  }
  fmt::print("  100 random starts in the box: {} reach it (by hand {}), median {:.3f} ms, longest {:.3f} ms\n", reached,
             reached_by_hand, 1e3 * median(seconds), 1e3 * *std::max_element(seconds.begin(), seconds.end()));
  return 0;
}

// --- 80 play operators on 100 000 samples

constexpr int operators = 80;

double weight_of(int i) { return i == 0 ? .75 : i % 5 == 0 ? 0 : .0015 * (10 + i % 7); }  // um/V; some are not there

Data operator_data() {
  Data data;
  data.step = 1e-4;
  data.noise = .01;
  data.u.resize(1);
  data.y.resize(1);
  std::array<double, operators> w{};
  Noise noise(7);
  for (int k = 0; k < 100'000; ++k) {
    const double t = k * data.step;
    const double u =
        3 * (1 - std::cos(2 * std::numbers::pi * 5 * t)) * (.6 + .4 * std::cos(2 * std::numbers::pi * .3 * t));
    double y = 0;
    for (int i = 0; i < operators; ++i) {
      const double r = .075 * i;
      auto& wi = w[static_cast<std::size_t>(i)];
      wi = std::max(u - r, std::min(u, wi));
      y += weight_of(i) * wi;
    }
    data.u[0].push_back(u);
    data.y[0].push_back(y + data.noise * noise());
  }
  return data;
}

ProgramPointer operator_program() {
  NumberList thresholds, weights;
  for (int i = 0; i < operators; ++i) {
    thresholds.push_back({.075 * i, "V"});
    weights.push_back({.01, "um/V"});
  }
  Diagram d = diagram_from_u();
  d.blocks["core"] = node("prandtl_ishlinskii", {{"thresholds", thresholds}, {"weights", weights}}, {"u"});
  d.outputs["y"] = "core";
  return compiled(d);
}

// --- creep and plant, 12 recordings

constexpr std::size_t creep_rows = 20'000;
constexpr std::array<double, 8> times{.01, .03, .1, .3, 1, 3, 10, 30};  // s
constexpr std::array<double, 8> amounts{.01, .008, .012, .01, .015, .01, .012, .02};

ProgramPointer creep_program() {
  NumberList amounts_list, times_list;
  for (std::size_t i = 0; i < times.size(); ++i) {
    amounts_list.push_back({.005, {}});
    times_list.push_back({times[i], "s"});
  }
  Diagram d = diagram_from_u();
  d.blocks["creep"] = node("creep", {{"amounts", amounts_list}, {"times", times_list}}, {"u"});
  d.blocks["plant"] =
      node("mass_spring_damper", {{"mass", "1 kg"}, {"stiffness", "80 kN/m"}, {"damping", "100 N s/m"}}, {"force"});
  d.blocks["force"] = node("gain", {{"gain", "1 N/V"}}, {"creep"});
  d.outputs["y"] = "plant.position";
  return compiled(d);
}

constexpr double creep_step = 1e-3;              // [s]
constexpr double stiffness = 1e5, damping = 60;  // N/m, N s/m; mass 1 kg

/// Inputs of 12 kinds: staircases, ramps and sines with holds.
Data creep_inputs() {
  Data data;
  data.step = creep_step;
  data.noise = .005;
  Noise random(11);
  for (int r = 0; r < 12; ++r) {
    Rows u;
    double level = 0, from = 0;
    const double hold = .5 + .4 * r;
    for (std::size_t k = 0; k < creep_rows; ++k) {
      const double t = static_cast<double>(k) * creep_step;
      if (k % static_cast<std::size_t>(hold / creep_step) == 0) {
        from = level;
        level = 10 * random.uniform();
      }
      const double in_hold = std::fmod(t, hold);
      u.push_back(from + (level - from) * std::min(1.0, in_hold / .02) + (r % 3 == 0 ? std::sin(2 * t) : 0));
    }
    data.u.push_back(std::move(u));
    data.y.emplace_back(creep_rows, 0.0);
  }
  return data;
}

Data creep_data(const ProgramPointer& program) {
  Data data = creep_inputs();
  DataModel model(program, data_set(data));
  std::vector<ParameterValue> values{{parameter_index(*program, "plant.stiffness"), stiffness},
                                     {parameter_index(*program, "plant.damping"), damping}};
  for (std::size_t i = 0; i < amounts.size(); ++i)
    values.push_back({parameter_index(*program, fmt::format("creep.amounts[{}]", i)), amounts[i]});
  std::vector<int> all;
  for (int r = 0; r < model.n_recordings(); ++r) all.push_back(r);
  const auto said = model.predict(values, all);
  Noise noise(13);
  for (std::size_t r = 0; r < data.y.size(); ++r)
    for (std::size_t k = 0; k < creep_rows; ++k) data.y[r][k] = said.y[r][0][k] / um + data.noise * noise();
  return data;
}

/// One fit of the free parameters; prints what fits.py reads.
int timed_fit(const ProgramPointer& program, const Data& data, const std::vector<FreeParameter>& free) {
  DataModelOptions one_core;
  one_core.threads = 1;
  DataModel model(program, data_set(data), one_core);
  const NoiseModel noise = noise_before_fit(model);
  const double begin = cpu_seconds();
  const auto result = fit(model, noise, free, {});
  const double seconds = cpu_seconds() - begin;
  if (!result.ok) {
    fmt::print(stderr, "{}\n", result.error);
    return 3;
  }
  double rows = 0;
  for (const auto& y : data.y) rows += static_cast<double>(y.size());
  fmt::print("{:.6f} {} {:.8f}\n", seconds, result.runs, rms_um(result, rows, data.noise));
  return 0;
}

int fit_operators() {
  const auto program = operator_program();
  auto free = free_parameters(*program, {"core.weights"});
  for (auto& f : free) f.lower = 0;
  return timed_fit(program, operator_data(), free);
}

int fit_creep() {
  const auto program = creep_program();
  return timed_fit(program, creep_data(program),
                   free_parameters(*program, {"creep.amounts", "plant.stiffness", "plant.damping"}));
}

void write(const std::filesystem::path& file, const std::vector<Rows>& recordings) {
  std::ofstream out(file, std::ios::binary);
  for (const auto& rows : recordings)
    out.write(reinterpret_cast<const char*>(rows.data()), static_cast<std::streamsize>(rows.size() * sizeof(double)));
}

int write_data(const std::filesystem::path& folder) {
  const auto of_operators = operator_data();
  write(folder / "operators.u", of_operators.u);
  write(folder / "operators.y", of_operators.y);
  const auto of_creep = creep_data(creep_program());
  write(folder / "creep.u", of_creep.u);
  write(folder / "creep.y", of_creep.y);
  return 0;
}

}  // namespace
}  // namespace hysteron::benchmarks

int main(int argc, char** argv) {
  using namespace hysteron::benchmarks;
  const std::string what = argc > 1 ? argv[1] : "";
  try {
    if (what == "bouc-wen") return bouc_wen();
    if (what == "operators") return fit_operators();
    if (what == "creep") return fit_creep();
    if (what == "write" && argc > 2) return write_data(argv[2]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 3;
  }
  fmt::print(stderr, "usage: hysteron_fits bouc-wen | operators | creep | write FOLDER\n");
  return 2;
}
