// Decides what comes out with an effect and without it under one standard signal. See trial.h.
#include "discover/demonstration/trial.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "discover/placement/add.h"
#include "discover/placement/excitation.h"
#include "engine/diagram/error.h"
#include "engine/program/parameter_values.h"
#include "engine/simulate/simulate.h"

namespace hysteron {
namespace {

/// A difference of one per cent is the least that can be seen in a picture.
constexpr double visible = 0.01;

}  // namespace

double span_of(const std::vector<double>& v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return v.empty() ? 0 : *high - *low;
}

std::vector<double> minus(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

DemoRun::DemoRun(const Effect& effect, const DemoRig& demo_rig, const Stimulus& stimulus, const Registry& registry)
    : demo_rig_(demo_rig), stimulus_(stimulus) {
  at_ = circumstances_at(demo_rig.diagram, registry, recorded(stimulus, demo_rig), demo_rig.place);
  law_ = effect.laws(at_).front();
  Added added = add_effect(demo_rig.diagram, registry, effect, law_, demo_rig.place);
  paths_ = added.free;
  on_ = compile(added.diagram, registry);
  added.diagram.blocks.find(added.name)->choose = "off";
  off_ = compile(added.diagram, registry);
  const int rows = static_cast<int>(std::lround(stimulus.length / stimulus.row));
  for (int k = 0; k <= rows; ++k) rows_.push_back(stimulus.length * k / rows);
  plain_ = without(rows_);
  for (const auto& p : law_.free) values_.push_back(p.start);
}

bool DemoRun::find_values() {
  if (shows(values_)) return true;
  for (const double part : {0.75, 0.5, 0.25, 1.0, 0.0}) {
    std::vector<double> values = values_;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (const auto& scan = law_.free[i].scan; !scan.empty())
        values[i] = scan[static_cast<std::size_t>(std::lround(part * static_cast<double>(scan.size() - 1)))];
    if (shows(values)) return values_ = values, true;
  }
  return find_amplitudes();
}

double DemoRun::share_with(const std::vector<double>& values) const {
  try {
    refuse_impossible(values);
    double most = 0;
    for (const double d : minus(response(*on_, rows_, values), plain_)) most = std::abs(d) <= most ? most : std::abs(d);
    return most / span_of(plain_);
  } catch (const Error&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// Throws Error where the block would refuse a value in a file.
void DemoRun::refuse_impossible(const std::vector<double>& values) const {
  Run run = start(*on_);
  std::vector<int> parameters;
  for (const auto& path : paths_)
    parameters.push_back(static_cast<int>(on_->find_parameter(path) - on_->parameters.data()));
  set_parameters(*on_, run, parameters, values, RefusedValues::end_the_run);
}

std::vector<double> DemoRun::response(const Program& program, const std::vector<double>& t,
                                      const std::vector<double>& values) const {
  Run run = start(program);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) set_parameter(program, run, paths_[i], values[i]);
  prepare(program, run);
  reset(program, run);
  bind_input(program, run, "in", std::make_shared<const Series>(stimulus_.in));
  if (!demo_rig_.side.empty()) bind_input(program, run, demo_rig_.side, std::make_shared<const Series>(stimulus_.side));
  SimulateOptions options;
  options.until = t.back();
  options.instants = t;
  options.signals = {program.output_signals.front()};
  options.at_rest = true;  // as a recording begins where nothing else is said of it
  return simulate(program, run, options).values.front();
}

bool DemoRun::shows(const std::vector<double>& values) const {
  const double most = largest(minus(response(*on_, rows_, values), plain_));
  return std::isfinite(most) && most >= visible * span_of(plain_);
}

/// What starts at zero is an amplitude: such that it makes a tenth of the signal. What starts at one is a factor: the
/// largest that is usual.
bool DemoRun::find_amplitudes() {
  std::vector<double> values = values_;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] == 0) values[i] = std::min(1.0, law_.free[i].upper);
  const double most = largest(minus(response(*on_, rows_, values), plain_));
  if (!std::isfinite(most) || !(most > 0)) return false;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values_[i] == 0)
      values[i] *= 0.1 * span_of(plain_) / most;
    else if (values_[i] == 1 && std::isfinite(law_.free[i].plausible_upper))
      values[i] = law_.free[i].plausible_upper;
  if (!shows(values)) return false;
  values_ = values;
  return true;
}

}  // namespace hysteron
