// The runs of a job that linearize: gain and phase over frequency, and what is read off them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/cli/load.h"
#include "app/jobs/job_runs.h"
#include "app/jobs/job_values.h"
#include "engine/analysis/linearize.h"
#include "engine/analysis/margins.h"
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

/// Gain and phase over frequency, and what is read off them.
RunResult bode_result(const Program& program, const LinearizeOptions& wanted, const LinearModel& model,
                      const Response& response, const Bode& b) {
  const Unit from = without_offset(program.signals[static_cast<std::size_t>(wanted.from.front())].unit);
  const Unit to = without_offset(program.signals[static_cast<std::size_t>(wanted.to.front())].unit);
  const Unit ratio = quotient(to, from), hertz = parse_unit("Hz"), degree = parse_unit("deg");
  RunResult r;
  std::vector<double> f;
  for (const double w : b.w) f.push_back(w / (2 * pi));
  r.columns = {
      {"f", "f", hertz, std::move(f)}, {"gain", "gain", ratio, b.magnitude}, {"phase", "phase", degree, b.phase}};
  const auto hz = [&](const char* name, double w) {
    r.numbers.emplace_back(name, Quantity{w / (2 * pi), hertz, true});
  };
  const auto poles = model.poles();
  const bool at_rest = std::none_of(poles.begin(), poles.end(), [](auto p) { return p == 0.0; });
  r.numbers.emplace_back("dc_gain", Quantity{at_rest ? std::abs(response(0)) : b.magnitude.front(), ratio, true});
  r.numbers.emplace_back("peak", Quantity{features::largest(b.magnitude), ratio, true});
  if (const auto width = bandwidth(response, b)) hz("bandwidth", *width);
  const Margins m = margins(response, b);
  if (m.phase_margin) {
    hz("crossover", m.phase_margin_at);
    r.numbers.emplace_back("phase_margin", Quantity{*m.phase_margin, degree, true});
  }
  if (m.gain_margin) {
    r.numbers.emplace_back("gain_margin", Quantity{*m.gain_margin, Unit{}, true});
    hz("gain_margin_at", m.gain_margin_at);
  }
  if (!wanted.open.empty() && from.dimension == to.dimension) add_closed_loop(r, closed_loop(response, b));
  std::vector<std::complex<double>> modes;
  for (const auto& p : poles)
    if (p.imag() >= 0 && p != 0.0) modes.push_back(p);
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
  const ProgramPointer program = program_of(run);
  const auto signal = [&](const WrittenText& name) {
    return at(name.pointer, [&] { return named_signal(*program, name.text); });
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
  const LinearModel model = linearize(*program, point, wanted_of);
  const Response response = [&](double w) { return model.response(w).front(); };
  const auto poles = model.poles();
  double longest = 0;
  for (const double delay : model.delays) longest = std::max(longest, delay);
  const Bode b = bode(response, frequencies(poles, longest));
  return bode_result(*program, wanted_of, model, response, b);
}

}  // namespace hysteron
