#include "engine/simulate/forward_sensitivities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "engine/events/enabled.h"

namespace hysteron {
namespace {

// Of the parameter: the error of the difference is the square of it, rounding the inverse.
constexpr double relative_step = 1e-5;

/// Largest difference between corners and between sampling instants that the two runs would have.
bool shifts_instants(const Program& program, const Run& up, const Run& down) {
  for (int b = 0; b < static_cast<int>(program.blocks.size()); ++b) {
    const auto& block = program.blocks[at(b)];
    if (block.kernel->next_breakpoint != nullptr && block.series_index < 0) {
      auto one = view_of(program, up, b), other = view_of(program, down, b);
      one.t = other.t = one.branch = other.branch = up.t;
      const double a = block.kernel->next_breakpoint(one), c = block.kernel->next_breakpoint(other);
      if (a != c && !(std::isinf(a) && std::isinf(c))) return true;
    }
    if (block.hit_index < 0) continue;
    for (const char* name : {"period", "offset"}) {
      const auto i = at(block.kernel->declaration.parameter_index(name));
      const auto slot = at(block.p_begin + block.p_at[i]);
      if (up.p[slot] != down.p[slot]) return true;
    }
  }
  return false;
}

/// What is sampled where it is switched or triggered follows no slope: its instants are chosen by signals.
void refuse_switched_samples(const Program& program) {
  for (const auto& block : program.blocks) {
    if (block.enabling < 0 || (block.hit_index < 0 && !runs_at_edges(program, block))) continue;
    const std::string& path = program.enablings[at(block.enabling)].path;
    fail("no_slope", path,
         fmt::format("\"{}\" is sampled inside of \"{}\", which does not always run: there are no slopes through it",
                     block.path, path),
         "leave the slopes out (differences of runs tell them), or take the sampled blocks out of it");
  }
}

/// A signal that jumps does not tell how much later it would.
void refuse_jump_that_enables(const Program& program, int block, int parameter) {
  const auto& path = program.parameters[at(parameter)].path;
  for (const auto& enabling : program.enablings)
    if (const auto& signal = program.signals[at(program.blocks[at(block)].source.front())];
        enabling.block == block && signal.smoothness != Smoothness::smooth)
      fail("no_slope", enabling.path,
           fmt::format("\"{}\" enables \"{}\" by a jump, whose instant hangs on \"{}\": there is no slope with respect "
                       "to it",
                       signal.path, enabling.path, path),
           "enable it by a signal that crosses 1/2 smoothly (an expression in place of a comparator), or leave the "
           "parameter out");
}

}  // namespace

ForwardSensitivities::ForwardSensitivities(const Program& program, const Run& run, std::vector<int> parameters)
    : program_(program) {
  refuse_switched_samples(program);
  for (const int index : parameters) {
    const ParameterInfo& info = program.parameters[at(index)];
    const double value = run.p[at(info.slots.front())];
    const double unit = std::abs(info.unit.difference_to_si(1));
    PerturbedRun twin{
        index, relative_step * (value != 0 ? std::abs(value) : unit), {run, nullptr, run.x}, {run, nullptr, run.x}};
    set_parameter(program, twin.up.run, info, value + twin.h);
    set_parameter(program, twin.down.run, info, value - twin.h);
    twin.up.work = std::make_unique<Work>(program);
    twin.down.work = std::make_unique<Work>(program);
    if (shifts_instants(program, twin.up.run, twin.down.run))
      fail("no_slope", info.path,
           fmt::format("\"{}\" shifts the instants of corners or samples: signals jump there, so they have no slope "
                       "with respect to it",
                       info.path),
           "leave it out, or find it by trying values (a scan)");
    sensitivities_of_.push_back(std::move(twin));
  }
}

std::vector<double> ForwardSensitivities::parameter_sizes() const {
  std::vector<double> sizes;
  for (const auto& twin : sensitivities_of_) sizes.push_back(twin.h / relative_step);
  return sizes;
}

std::vector<ForwardSensitivities::Pair> ForwardSensitivities::pairs(const Run& run) {
  start(run, [](Run&) {});
  std::vector<Pair> list;
  for (const auto& twin : sensitivities_of_) list.push_back({twin.up.run, twin.down.run, twin.h});
  return list;
}

std::vector<double> ForwardSensitivities::start(const Run& run, const std::function<void(Run&)>& settle) {
  std::vector<double> s;
  for (auto& twin : sensitivities_of_) {
    for (Side* side : {&twin.up, &twin.down}) {
      // The declared start of the changed parameter, in place of the declared start that the run had.
      Run declared = run, moved = side->run;
      reset(program_, declared);
      reset(program_, moved);
      for (std::size_t i = 0; i < moved.x.size(); ++i)
        side->run.x[i] = run.x[i] == declared.x[i] ? moved.x[i] : run.x[i];
      for (std::size_t i = 0; i < moved.m.size(); ++i)
        side->run.m[i] = run.m[i] == declared.m[i] ? moved.m[i] : run.m[i];
      settle(side->run);
    }
    for (std::size_t i = 0; i < run.x.size(); ++i) s.push_back((twin.up.run.x[i] - twin.down.run.x[i]) / (2 * twin.h));
  }
  return s;
}

/// What a twin shares with the run at any time.
void ForwardSensitivities::follow(const Run& run, Side& side) {
  side.run.branch = run.branch;
  std::copy(run.mode.begin(), run.mode.end(), side.run.mode.begin());
  side.run.sides = run.sides;
}

void ForwardSensitivities::place(PerturbedRun& twin, std::span<const double> x, std::span<const double> s) {
  for (std::size_t i = 0; i < twin.up.x.size(); ++i) {
    twin.up.x[i] = x[i] + twin.h * s[i];
    twin.down.x[i] = x[i] - twin.h * s[i];
  }
}

bool ForwardSensitivities::derivative(const Run& run, double t, const double* x, const double* const* s,
                                      double* const* ds) {
  const auto n = at(program_.n_x);
  double sum = 0;  // of zeros: not zero if one of them is not finite
  for (std::size_t k = 0; k < sensitivities_of_.size(); ++k) {
    PerturbedRun& twin = sensitivities_of_[k];
    if (n == 0) {
      ds[k][0] = 0;
      continue;
    }
    place(twin, {x, n}, {s[k], n});
    for (Side* side : {&twin.up, &twin.down}) {
      follow(run, *side);
      evaluate_derivatives(program_, side->run, *side->work, t, side->x.data());
    }
    for (std::size_t i = 0; i < n; ++i)
      sum += 0 * (ds[k][i] = (twin.up.work->dx[i] - twin.down.work->dx[i]) / (2 * twin.h));
  }
  return sum == 0;
}

void ForwardSensitivities::accept(const Run& run, double t, std::span<const double> x, std::span<const double> s) {
  const auto n = at(program_.n_x);
  for (std::size_t k = 0; k < sensitivities_of_.size(); ++k) {
    place(sensitivities_of_[k], x, s.subspan(k * n, n));
    for (Side* side : {&sensitivities_of_[k].up, &sensitivities_of_[k].down}) {
      follow(run, *side);
      hysteron::accept(program_, side->run, *side->work, t, side->x.data());
    }
  }
}

void ForwardSensitivities::outputs(const Run& run, double t, std::span<const double> x, std::span<const double> s,
                                   std::span<const int> signals, std::vector<std::vector<double>>& out) {
  const auto n = at(program_.n_x);
  out.resize(sensitivities_of_.size());
  for (std::size_t k = 0; k < sensitivities_of_.size(); ++k) {
    PerturbedRun& twin = sensitivities_of_[k];
    place(twin, x, s.subspan(k * n, n));
    for (Side* side : {&twin.up, &twin.down}) {
      follow(run, *side);
      evaluate_values(program_, side->run, *side->work, t, side->x.data());
    }
    out[k].clear();
    for (const int signal : signals)
      out[k].push_back((twin.up.work->y[at(signal)] - twin.down.work->y[at(signal)]) / (2 * twin.h));
  }
}

void ForwardSensitivities::cross(Events& events, const Run& run, double t, std::span<const double> x,
                                 std::span<double> s) {
  const auto n = at(program_.n_x);
  for (std::size_t k = 0; k < sensitivities_of_.size(); ++k) {
    PerturbedRun& twin = sensitivities_of_[k];
    place(twin, x, s.subspan(k * n, n));
    bool moved = false;
    for (Side* side : {&twin.up, &twin.down}) {
      follow(run, *side);
      side->run.hits = run.hits;
      moved |= events.cross(side->run, *side->work, t, side->x);
    }
    if (!moved) continue;
    for (std::size_t i = 0; i < n; ++i) s[k * n + i] = (twin.up.x[i] - twin.down.x[i]) / (2 * twin.h);
  }
}

void ForwardSensitivities::change_modes(Events& events, const Run& run, double t, std::span<const double> x,
                                        std::span<double> s, std::span<const ModeChange> changes, double step) {
  const auto n = at(program_.n_x);
  const int guard = changes.front().modal;
  std::vector<double> flow(n), there(n);
  for (std::size_t k = 0; k < sensitivities_of_.size(); ++k) {
    PerturbedRun& twin = sensitivities_of_[k];
    place(twin, x, s.subspan(k * n, n));
    double along_parameter = 0, along_time = 0;
    std::fill(flow.begin(), flow.end(), 0.0);
    for (Side* side : {&twin.up, &twin.down}) {
      follow(run, *side);
      const double sign = side == &twin.up ? 1 : -1;
      evaluate_guards(program_, side->run, *side->work, t, side->x.data());
      along_parameter += sign * side->work->guard[at(guard)] / (2 * twin.h);
      for (std::size_t i = 0; i < n; ++i) flow[i] += side->work->dx[i] / 2;
    }
    for (const double sign : {1.0, -1.0}) {
      for (std::size_t i = 0; i < n; ++i) there[i] = x[i] + sign * step * flow[i];
      evaluate_guards(program_, twin.up.run, *twin.up.work, t + sign * step, there.data());
      along_time += sign * twin.up.work->guard[at(guard)] / (2 * step);
    }
    if (along_parameter != 0) refuse_jump_that_enables(program_, changes.front().block, twin.parameter);
    // Where the parameter does not move the guard, the instant is not its own.
    const double later = along_parameter != 0 ? -along_parameter / along_time : 0;
    if (!std::isfinite(later))
      fail_numerics(
          "grazing", program_.blocks[at(changes.front().block)].path,
          fmt::format("the guard of \"{}\" does not fall at t = {:.9g} s, it only touches zero: there is no "
                      "slope with respect to \"{}\"",
                      program_.blocks[at(changes.front().block)].path, t, program_.parameters[at(twin.parameter)].path),
          "move the parameters away from where the event just happens");
    for (std::size_t i = 0; i < n; ++i) there[i] = s[k * n + i] + flow[i] * later;
    place(twin, x, there);
    std::fill(flow.begin(), flow.end(), 0.0);
    for (Side* side : {&twin.up, &twin.down}) {
      events.apply(side->run, *side->work, t, side->x, changes);
      evaluate_derivatives(program_, side->run, *side->work, t, side->x.data());
      for (std::size_t i = 0; i < n; ++i) flow[i] += side->work->dx[i] / 2;
    }
    for (std::size_t i = 0; i < n; ++i) s[k * n + i] = (twin.up.x[i] - twin.down.x[i]) / (2 * twin.h) - flow[i] * later;
  }
}

}  // namespace hysteron
