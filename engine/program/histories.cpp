#include "engine/program/histories.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/diagram/index.h"
#include "engine/program/breakpoints.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

// The cubic through two points and their slopes is wrong by a multiple of s^2 (1 - s)^2 where the fourth derivative
// does not change, and by one of s^2 (1 - s)^2 (s - 1/2) where that passes zero: these two looks see both, nearly at
// their largest. So does the third look for the cubic through four values, wrong by s (s - 0.3) (s - 0.7) (s - 1)
// there.
constexpr double first_look = 0.3, second_look = 0.7, third_look = 0.12;
// A jump between two looks is narrowed down to a millionth of a millionth of the step and then left.
constexpr int most_depth = 31;
// Of one step: some ten thousand jumps of a fine rounding. A signal that needs more moves at random, or nearly.
constexpr long most_points = 1'000'000;

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

/// The cubic through the values at four times, in the form of Newton.
struct ThroughValues {
  std::array<double, 4> t, u;  // u: divided differences

  ThroughValues(const std::array<double, 4>& times, const std::array<double, 4>& values) : t(times), u(values) {
    for (std::size_t order = 1; order < 4; ++order)
      for (std::size_t k = 3; k >= order; --k) u[k] = (u[k] - u[k - 1]) / (t[k] - t[k - order]);
  }
  double value(double at) const { return u[0] + (at - t[0]) * (u[1] + (at - t[1]) * (u[2] + (at - t[2]) * u[3])); }
  double slope(double at) const {
    const double a = at - t[0], b = at - t[1], c = at - t[2];
    return u[1] + (a + b) * u[2] + (a * b + b * c + c * a) * u[3];
  }
};

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
  for (std::size_t block = 0; block < program.blocks.size(); ++block)
    if (const auto& b = program.blocks[block]; b.history_index >= 0)
      watched_.push_back({static_cast<int>(block), b.history_index, b.source[0], sizes[at(b.source[0])]});
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

bool Histories::is_off(std::size_t i, const Piece& piece, const Point& seen, double curve) const {
  const double size = std::max({watched_[i].size, std::abs(piece.a.u[i]), std::abs(piece.b.u[i]), std::abs(seen.u[i])});
  return std::abs(curve - seen.u[i]) > tolerance_ * size;
}

std::vector<std::size_t> Histories::missed(const Piece& piece) const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const auto curve = [&](double t) {
      const Point &a = piece.a, &b = piece.b;
      return on_curve(a.t, a.u[i], a.rate[i], b.t, b.u[i], b.rate[i], t);
    };
    if (is_off(i, piece, piece.p, curve(piece.p.t)) || is_off(i, piece, piece.q, curve(piece.q.t))) list.push_back(i);
  }
  return list;
}

bool Histories::follow_values(Run& run, Work& work, const Piece& piece, const std::vector<std::size_t>& signals) {
  Point seen;
  look(run, work, piece.a.t + third_look * (piece.b.t - piece.a.t), seen);
  Point a = piece.a, b = piece.b;
  for (const std::size_t i : signals) {
    const ThroughValues curve({a.t, piece.p.t, piece.q.t, b.t}, {a.u[i], piece.p.u[i], piece.q.u[i], b.u[i]});
    if (is_off(i, piece, seen, curve.value(seen.t))) return false;
    a.rate[i] = curve.slope(a.t);
    b.rate[i] = curve.slope(b.t);
  }
  keep(run, a);
  keep(run, b);
  return true;
}

void Histories::keep(Run& run, const Point& p) {
  for (std::size_t i = 0; i < watched_.size(); ++i)
    push(run.histories[at(watched_[i].history)], p.t, p.u[i], p.rate[i]);
}

void Histories::refine(Run& run, Work& work, const Point& a, const Point& b, int depth) {
  if (depth == most_depth || b.t - a.t <= 4 * same_instant(b.t)) return;
  Piece piece{a, {}, {}, b};
  look(run, work, a.t + first_look * (b.t - a.t), piece.p);
  look(run, work, a.t + second_look * (b.t - a.t), piece.q);
  const auto signals = missed(piece);
  if (signals.empty() || follow_values(run, work, piece, signals)) return;
  if ((points_ += 2) > most_points) refuse(watched_[signals.front()], b.t);
  refine(run, work, a, piece.p, depth + 1);
  keep(run, piece.p);
  refine(run, work, piece.p, piece.q, depth + 1);
  keep(run, piece.q);
  refine(run, work, piece.q, b, depth + 1);
}

void Histories::refuse(const Watched& w, double t) const {
  const std::string& block = program_.blocks[at(w.block)].path;
  const std::string& signal = program_.signals[at(w.signal)].path;
  fail_numerics(
      "past_too_fast", block,
      fmt::format("at t = {:.12g} s \"{}\", whose past \"{}\" reads, moves too fast to be remembered: {} points are "
                  "not enough for the step from {:.12g} s to {:.12g} s",
                  t, signal, block, most_points, from_, to_),
      fmt::format("check what makes \"{}\" so fast, where it is not meant to be; put the lag between them that the "
                  "real signal has; or ask for less accuracy (\"relative_tolerance\")",
                  signal));
}

void Histories::fill(Run& run, Work& work, double from, double to,
                     const std::function<void(double t, std::vector<double>& x)>& states) {
  states_ = &states;
  from_ = from;
  to_ = to;
  points_ = 0;
  Point a, b;
  look(run, work, from, a);
  look(run, work, to, b);
  refine(run, work, a, b, 0);
}

}  // namespace hysteron
