#include "engine/analysis/describing_function.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "engine/analysis/linearize.h"
#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

using std::numbers::pi;
constexpr int points = 1 << 15;       // of one period: a jump of the output is placed to half of one
constexpr int periods = 4;            // the last one counts
constexpr double no_phase = 1e-9;     // of the whole: rounding
constexpr int modes_at_a_point = 16;  // that may follow each other

/// "" or why the block has no describing function.
std::string reason_against(const BlockInstance& b) {
  if (b.n_u != 1) return fmt::format("has {} inputs, a describing function has one", b.n_u);
  if (b.sizes.history) return "is a dead time, which is exact at every amplitude";
  if (b.sizes.sampled_states > 0 || (b.sizes.states > 0 && !b.kernel->declaration.is_rate_independent))
    return "answers each frequency differently: its describing function is no number";
  return "";
}

/// One block alone, carried along the sine.
class Alone {
 public:
  Alone(const Program& program, const Run& run, int block, double centre, double amplitude)
      : b_(program.blocks[at(block)]),
        view_(view_of(program, run, block)),
        centre_(centre),
        amplitude_(amplitude),
        x_(run.x.begin() + b_.x_begin, run.x.begin() + b_.x_begin + b_.sizes.states),
        m_(run.m.begin() + b_.m_begin, run.m.begin() + b_.m_begin + b_.sizes.memory),
        next_m_(m_),
        y_(at(b_.sizes.outputs)),
        k_(4, std::vector<double>(x_.size())) {}

  const std::vector<double>& outputs() const { return y_; }

  void go_to(double from, double to) {
    if (!x_.empty()) move_states(from, to);
    set(to, x_.data());
    follow_modes();
    View<double> v = view_;
    if (!m_.empty()) {
      v.m = m_.data();
      v.out = next_m_.data();
      b_.kernel->advance(v);
      m_ = next_m_;
      v.m = m_.data();
    }
    v.out = y_.data();
    b_.kernel->output(v);
  }

 private:
  /// Rates are those of a jump (path.h): laws that are homogeneous in them only where they are high are meant so.
  void set(double angle, const double* x) {
    u_ = centre_ + amplitude_ * std::sin(angle);
    du_ = amplitude_ * std::cos(angle) / jump_duration;
    view_.u = &u_;
    view_.du = &du_;
    view_.x = x;
  }

  void move_states(double from, double to) {  // classical Runge-Kutta
    const double h = to - from;
    std::vector<double> trial = x_;
    for (int stage = 0; stage < 4; ++stage) {
      const double share = stage == 0 ? 0 : stage == 3 ? 1 : 0.5;
      if (stage > 0)
        for (std::size_t i = 0; i < x_.size(); ++i) trial[i] = x_[i] + share * h * k_[at(stage - 1)][i];
      set(from + share * h, trial.data());
      View<double> v = view_;
      v.out = k_[at(stage)].data();
      b_.kernel->derivative(v);
      for (auto& k : k_[at(stage)]) k *= jump_duration;
    }
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += h / 6 * (k_[0][i] + 2 * k_[1][i] + 2 * k_[2][i] + k_[3][i]);
  }

  void follow_modes() {
    if (!b_.kernel->has_modes()) return;
    for (int i = 0; i < modes_at_a_point; ++i) {
      double guard = 0;
      View<double> v = view_;
      v.out = &guard;
      b_.kernel->guard(v);
      if (guard > 0) return;
      view_.mode_before = view_.mode;
      view_.mode = b_.kernel->next_mode(v);
      if (b_.kernel->reset == nullptr) continue;
      View<double> after = view_;
      std::vector<double> states(x_.size());
      after.out = states.data();
      b_.kernel->reset(after);
      x_ = states;
      view_.x = x_.data();
    }
  }

  const BlockInstance& b_;
  View<double> view_;
  double centre_, amplitude_, u_ = 0, du_ = 0;
  std::vector<double> x_, m_, next_m_, y_;
  std::vector<std::vector<double>> k_;
};

}  // namespace

bool has_describing_function(const Program& program, int block) {
  return reason_against(program.blocks[at(block)]).empty();
}

std::vector<std::complex<double>> describing_function(const Program& program, const Run& run, int block, double centre,
                                                      double amplitude) {
  const BlockInstance& b = program.blocks[at(block)];
  if (const std::string reason = reason_against(b); !reason.empty())
    fail("no_describing_function", b.path, fmt::format("{} \"{}\" {}", b.kernel->declaration.type, b.path, reason),
         "leave it out: --at takes an operating point where it passes something on");
  Alone alone(program, run, block, centre, amplitude);
  std::vector<std::complex<double>> factors(at(b.sizes.outputs));
  // Points lie symmetrically to the reversals, so that a curve without memory gets no phase.
  const auto angle = [](int i) { return 2 * pi * (i + 0.5) / points; };
  double before = 0;
  for (int i = 0; i < periods * points; ++i) {
    const double now = angle(i);
    alone.go_to(before, now);
    before = now;
    if (i < (periods - 1) * points) continue;
    const double in_period = angle(i % points);
    const std::complex<double> wave(std::sin(in_period), std::cos(in_period));
    for (std::size_t o = 0; o < factors.size(); ++o) factors[o] += 2.0 / points / amplitude * alone.outputs()[o] * wave;
  }
  for (auto& f : factors)
    if (std::abs(f.imag()) <= no_phase * std::abs(f)) f = f.real();
  return factors;
}

}  // namespace hysteron
