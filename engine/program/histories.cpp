#include "engine/program/histories.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/breakpoints.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

// The cubic through two points and their slopes is wrong by a multiple of s^2 (1 - s)^2 where the fourth derivative
// does not change, and by one of s^2 (1 - s)^2 (s - 1/2) where that passes zero: these two looks see both, nearly at
// their largest.
constexpr double first_look = 0.3, second_look = 0.7;
// A jump between two looks is narrowed down to a millionth of a millionth of the step and then left.
constexpr int most_depth = 31;

void push(History& h, double t, double u, double rate) {
  // At a corner the point stands twice, with the rates of both sides.
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  if (!h.t.empty() && h.t.back() == t && h.u.back() == u && same(h.rate.back(), rate)) return;
  h.t.push_back(t);
  h.u.push_back(u);
  h.rate.push_back(rate);
}

double rate_of(const Program& program, const Work& work, int signal) {
  return program.has_rate[at(signal)] ? work.rate[at(signal)] : std::numeric_limits<double>::quiet_NaN();
}

/// The cubic through a and b (a straight line where a slope is unknown) at the time t.
double on_curve(double ta, double ua, double ra, double tb, double ub, double rb, double t) {
  const double h = tb - ta, s = (t - ta) / h, rise = ub - ua;
  if (std::isnan(ra) || std::isnan(rb)) return ua + s * rise;
  const double b = 3 * rise - (2 * ra + rb) * h, c = (ra + rb) * h - 2 * rise;
  return ua + s * (ra * h + s * (b + s * c));
}

}  // namespace

void remember_signals(const Program& program, Run& run, const Work& work, double t) {
  for (std::size_t block = 0; block < program.blocks.size(); ++block) {
    const BlockInstance& b = program.blocks[block];
    if (b.history_index < 0) continue;
    History& h = run.histories[at(b.history_index)];
    const int signal = b.source[0];
    if (h.t.empty()) h.before = work.y[at(signal)];
    push(h, t, work.y[at(signal)], rate_of(program, work, signal));
    if (b.kernel->reach_back) steps::forget(h, t, b.kernel->reach_back(view_of(program, run, static_cast<int>(block))));
  }
}

bool rest_histories(const Program& program, Run& run, Work& work, double t, const double* x) {
  bool changed = program.n_histories > 0, any = false;
  // One behind the other each may be the first to know its value.
  for (int round = 0; changed && round < program.n_histories; ++round) {
    changed = false;
    evaluate_values(program, run, work, t, x);
    for (const BlockInstance& b : program.blocks) {
      if (b.history_index < 0) continue;
      History& h = run.histories[at(b.history_index)];
      const double u = work.y[at(b.source[0])];
      if (!h.t.empty() || h.before == u) continue;
      h.before = u;
      changed = any = true;
    }
  }
  return any;
}

Histories::Histories(const Program& program, std::vector<double> sizes, double tolerance)
    : program_(program), tolerance_(tolerance), x_(at(std::max(1, program.n_x))) {
  for (const auto& b : program.blocks)
    if (b.history_index >= 0) watched_.push_back({b.history_index, b.source[0], sizes[at(b.source[0])]});
}

void Histories::look(const Run& run, Work& work, double t, Point& into) {
  (*states_)(t, x_);
  evaluate_derivatives(program_, run, work, t, x_.data());
  evaluate_memory_rates(program_, run, work, t, x_.data());
  evaluate_values(program_, run, work, t, x_.data());
  throw_if_unsolved(program_, work, t);
  into.t = t;
  into.u.clear();
  into.rate.clear();
  for (const auto& w : watched_) {
    into.u.push_back(work.y[at(w.signal)]);
    into.rate.push_back(rate_of(program_, work, w.signal));
  }
}

bool Histories::between(const Point& a, const Point& p, const Point& b) const {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const double curve = on_curve(a.t, a.u[i], a.rate[i], b.t, b.u[i], b.rate[i], p.t);
    const double size = std::max({watched_[i].size, std::abs(a.u[i]), std::abs(b.u[i]), std::abs(p.u[i])});
    if (std::abs(curve - p.u[i]) > tolerance_ * size) return false;
  }
  return true;
}

void Histories::keep(Run& run, const Point& p) const {
  for (std::size_t i = 0; i < watched_.size(); ++i)
    push(run.histories[at(watched_[i].history)], p.t, p.u[i], p.rate[i]);
}

void Histories::refine(Run& run, Work& work, const Point& a, const Point& b, int depth) {
  if (depth == most_depth || b.t - a.t <= 4 * same_instant(b.t)) return;
  Point p, q;
  look(run, work, a.t + first_look * (b.t - a.t), p);
  look(run, work, a.t + second_look * (b.t - a.t), q);
  if (between(a, p, b) && between(a, q, b)) return;
  refine(run, work, a, p, depth + 1);
  keep(run, p);
  refine(run, work, p, q, depth + 1);
  keep(run, q);
  refine(run, work, q, b, depth + 1);
}

void Histories::fill(Run& run, Work& work, double from, double to,
                     const std::function<void(double t, std::vector<double>& x)>& states) {
  states_ = &states;
  Point a, b;
  look(run, work, from, a);
  look(run, work, to, b);
  refine(run, work, a, b, 0);
}

}  // namespace hysteron
