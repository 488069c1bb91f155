// The runs of a job that linearize: gain and phase over frequency, and what is read off them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/cli/load.h"
#include "app/jobs/job_runs.h"
#include "app/jobs/job_values.h"
#include "engine/analysis/small_motions.h"
#include "engine/diagram/error.h"
#include "engine/events/rest.h"
#include "engine/simulate/simulate.h"
#include "fit/signals/features.h"

namespace hysteron {
namespace {

using std::numbers::pi;

/// What the closed loop makes of a loop gain: where L, T and S are -3 dB, and the largest |T| and |S|.
void add_closed_loop(RunResult& r, const ClosedLoop& c) {
  const Unit hertz = parse_unit("Hz");
  const auto hz = [&](const char* name, const std::optional<double>& w) {
    if (w) r.numbers.emplace_back(name, Quantity{*w / (2 * pi), hertz, true});
  };
  hz("open_3db", c.open_half);
  hz("closed_3db", c.closed_half);
  hz("sensitivity_3db", c.sensitivity_half);
  hz("closed_peak_at", c.closed.at);
  r.numbers.emplace_back("closed_peak", Quantity{c.closed.magnitude, Unit{}, true});
  r.numbers.emplace_back("sensitivity_peak", Quantity{c.sensitivity.magnitude, Unit{}, true});
}

/// Of an unstable loop no dead time, no bandwidth and nothing of the closed loop.
void add_margins(RunResult& r, const SmallMotions& m) {
  const Unit hertz = parse_unit("Hz"), degree = parse_unit("deg");
  const auto hz = [&](const char* name, double w) {
    r.numbers.emplace_back(name, Quantity{w / (2 * pi), hertz, true});
  };
  if (m.margins->phase_margin) {
    hz("crossover", m.margins->phase_margin_at);
    r.numbers.emplace_back("phase_margin", Quantity{*m.margins->phase_margin, degree, true});
  }
  if (const auto limit = m.margins->gain_margin()) {
    r.numbers.emplace_back("gain_margin", Quantity{limit->factor, Unit{}, true});
    if (std::isfinite(limit->at)) hz("gain_margin_at", limit->at);
  }
  if (m.closed_loop) add_closed_loop(r, *m.closed_loop);
}

/// Gain and phase over frequency, and what is read off them.
RunResult bode_result(const Program& program, const LinearizeOptions& wanted, const SmallMotions& m) {
  const Unit from = without_offset(program.signals[static_cast<std::size_t>(wanted.from.front())].unit);
  const Unit to = without_offset(program.signals[static_cast<std::size_t>(wanted.to.front())].unit);
  const Unit ratio = quotient(to, from), hertz = parse_unit("Hz"), degree = parse_unit("deg");
  const Bode& b = m.bode;
  RunResult r;
  std::vector<double> f;
  for (const double w : b.w) f.push_back(w / (2 * pi));
  r.columns = {
      {"f", "f", hertz, std::move(f)}, {"gain", "gain", ratio, b.magnitude}, {"phase", "phase", degree, b.phase}};
  const auto hz = [&](const char* name, double w) {
    r.numbers.emplace_back(name, Quantity{w / (2 * pi), hertz, true});
  };
  const bool at_rest =
      std::none_of(m.poles.begin(), m.poles.end(), [&](auto p) { return p == (m.sampled ? 1.0 : 0.0); });
  r.numbers.emplace_back("dc_gain", Quantity{at_rest ? std::abs(m.response(0)) : b.magnitude.front(), ratio, true});
  r.numbers.emplace_back("peak", Quantity{features::largest(b.magnitude), ratio, true});
  const PoleCount& judged = m.closed ? *m.closed : m.count;
  if (judged.outside == 0 && !judged.endless)
    if (const auto width = bandwidth(m.response, b)) hz("bandwidth", *width);
  if (m.margins) add_margins(r, m);
  std::vector<std::complex<double>> modes;
  for (const auto& p : m.poles) {
    const auto s = m.sampled ? std::log(p) / m.sampled->period : p;
    if (s.imag() >= 0 && s != 0.0) modes.push_back(s);
  }
  std::sort(modes.begin(), modes.end(), [](auto p, auto q) { return std::abs(p) < std::abs(q); });
  for (std::size_t i = 0; i < modes.size(); ++i) {
    hz(fmt::format("frequency{}", i + 1).c_str(), std::abs(modes[i]));
    r.numbers.emplace_back(fmt::format("damping{}", i + 1),
                           Quantity{-modes[i].real() / std::abs(modes[i]), Unit{}, true});
  }
  return r;
}

}  // namespace

RunResult JobRunner::linearized(const RunWish& run) {
  const auto compiled = program_of(run);
  const Diagram& diagram = compiled.first;
  const ProgramPointer& program = compiled.second;
  const auto signal = [&](const WrittenText& name) {
    return at(name.pointer, [&] { return named_signal(*program, diagram, name.text); });
  };
  LinearizeOptions wanted_of;
  wanted_of.from = {signal(run.from)};
  wanted_of.to = {signal(run.to)};
  for (const auto& name : run.open) wanted_of.open.push_back(signal(name));
  Run point = started(run, *program);
  const auto zero = std::make_shared<const Series>(Series{{0.0}, {0.0}, Between::linear});
  for (const auto& input : program->input_names) bind_input(*program, point, input, zero);
  if (run.at) {
    SimulateOptions settings = simulate_options(*program);
    settings.until = seconds(*run.at);
    settings.instants = {settings.until};
    if (settings.method == Method::automatic || settings.method == Method::exact) settings.method = Method::bdf;
    point = *simulate(*program, std::move(point), settings).end;
  } else {
    settle_at_rest(*program, point, 0);
  }
  const auto& from = program->signals[static_cast<std::size_t>(wanted_of.from.front())];
  const auto& to = program->signals[static_cast<std::size_t>(wanted_of.to.front())];
  const bool loop = !wanted_of.open.empty() && from.unit.dimension == to.unit.dimension;
  return bode_result(*program, wanted_of, small_motions(*program, point, wanted_of, loop));
}

}  // namespace hysteron
