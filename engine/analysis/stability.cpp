#include "engine/analysis/stability.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "engine/analysis/margins.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

using std::numbers::pi;
using Number = std::complex<double>;
using ComplexMatrix = Eigen::MatrixXcd;

constexpr double hair = 1e-9;         // of the slowest rate: what counts as on the axis
constexpr double largest_turn = 0.5;  // of log g in one step, as its slope at both ends says
constexpr double agreement = 0.3;     // [rad] between that and what the values say
constexpr long steps_allowed = 4'000'000;
constexpr int homotopy_halvings = 40;
constexpr int phase_trials = 4000;      // of dead times that do not divide each other
constexpr double integer_enough = 0.1;  // of a turn: more is no count

ComplexMatrix matrix(const std::vector<double>& numbers, Eigen::Index rows, Eigen::Index columns) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(numbers.data(), rows, columns).cast<Number>();
}

/// x' = A x + B w, v = C x + G w with dead times alone: describing functions are taken in.
struct Delayed {
  ComplexMatrix a, b, c, g;
  std::vector<double> delays;
};

/// `turned`: share of the phase of the describing functions.
Delayed delayed(const LinearModel& m, double turned) {
  const auto n = static_cast<Eigen::Index>(m.states), k = static_cast<Eigen::Index>(m.delays.size());
  const ComplexMatrix a = matrix(m.a, n, n), b = matrix(m.b_delayed, n, k), c = matrix(m.to_delays, k, n),
                      g = matrix(m.between_delays, k, k);
  std::vector<int> late, now;
  for (std::size_t i = 0; i < m.delays.size(); ++i) (m.factors[i] == 1.0 ? late : now).push_back(static_cast<int>(i));
  Delayed result;
  for (const int i : late) result.delays.push_back(m.delays[static_cast<std::size_t>(i)]);
  if (now.empty()) return {a, b, c, g, std::move(result.delays)};
  const auto count = static_cast<Eigen::Index>(now.size());
  ComplexMatrix f = ComplexMatrix::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Number factor = m.factors[static_cast<std::size_t>(now[static_cast<std::size_t>(i)])];
    f(i, i) = std::polar(std::abs(factor), turned * std::arg(factor));
  }
  // w = F (C_n x + G_nn w + G_nl w_l)
  const ComplexMatrix own = (ComplexMatrix::Identity(count, count) - f * g(now, now)).partialPivLu().solve(f);
  const ComplexMatrix from_x = own * c(now, Eigen::all), from_late = own * g(now, late);
  result.a = a + b(Eigen::all, now) * from_x;
  result.b = b(Eigen::all, late) + b(Eigen::all, now) * from_late;
  result.c = c(late, Eigen::all) + g(late, now) * from_x;
  result.g = g(late, late) + g(late, now) * from_late;
  return result;
}

std::vector<Number> values_of(const ComplexMatrix& a) {
  if (a.rows() == 0) return {};
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(a, false);
  return {solver.eigenvalues().data(), solver.eigenvalues().data() + a.rows()};
}

/// Largest spectral radius of G diag(exp(j phases)): whether the parts that never fall with the frequency die out,
/// whatever the dead times are to each other (Hale, Verduyn Lunel, Introduction to Functional Differential Equations,
/// 1993, chapter 9).
double worst_radius(const ComplexMatrix& g) {
  const auto radius = [](const ComplexMatrix& m) {
    double most = 0;
    for (const auto& value : values_of(m)) most = std::max(most, std::abs(value));
    return most;
  };
  if (g.isZero(0)) return 0;
  const double bound = radius(g.cwiseAbs().cast<Number>());  // reached where signs allow it
  if (g.rows() == 1 || bound < 1) return bound;
  std::mt19937_64 random(1);  // the same trials every time
  std::uniform_real_distribution<double> phase(0, 2 * pi);
  double most = radius(g);
  ComplexMatrix turned = g;
  for (int trial = 0; trial < phase_trials && most < 1; ++trial) {
    for (Eigen::Index i = 0; i < g.cols(); ++i) turned.col(i) = g.col(i) * std::polar(1.0, phase(random));
    most = std::max(most, radius(turned));
  }
  return most;
}

class Count {
 public:
  explicit Count(const LinearModel& model) : model_(model), d_(delayed(model, 1)), poles_(values_of(d_.a)) {
    double slowest = std::numeric_limits<double>::infinity(), fastest = 0;
    const auto rate = [&](double r) {
      slowest = std::min(slowest, r);
      fastest = std::max(fastest, r);
    };
    for (const auto& p : poles_)
      if (std::abs(p) > std::numeric_limits<double>::epsilon() * d_.a.norm()) rate(std::abs(p));
    for (const double delay : d_.delays)
      if (delay > 0) rate(1 / delay), longest_ = std::max(longest_, delay);
    if (fastest == 0) slowest = fastest = 1;
    unit_ = slowest;
    for (const auto& p : poles_) shifts_.push_back(std::abs(p) + unit_);
    until_ = last_turn();
  }

  /// Zeros right of the line Re s = sigma.
  int operator()(double sigma) {
    const double turn = homotopy(sigma) + along(sigma) + tail(sigma);
    const double zeros = -turn / pi;
    if (std::abs(zeros - std::round(zeros)) > integer_enough)
      fail_numerics("not_counted", "",
                    fmt::format("the count of unstable poles came out as {:.3f}, no whole number", zeros),
                    "take dead times and time constants that lie closer together, or simulate the diagram instead");
    return static_cast<int>(std::lround(zeros));
  }
  double unit() const { return unit_; }

 private:
  struct Point {
    double w = 0;
    Number value, slope;  ///< log g but for whole turns; d log g / dw
  };

  static Number log_of(const Eigen::PartialPivLU<ComplexMatrix>& lu) {
    Number sum = lu.permutationP().determinant() < 0 ? Number(0, pi) : Number(0, 0);
    for (Eigen::Index i = 0; i < lu.rows(); ++i) sum += std::log(lu.matrixLU()(i, i));
    return sum;
  }

  Point at(const Delayed& d, double sigma, double w) const {
    const Number s(sigma, w);
    const Eigen::Index n = d.a.rows(), k = d.g.rows();
    ComplexMatrix m(n + k, n + k), slope = ComplexMatrix::Zero(n + k, n + k);
    m.topLeftCorner(n, n) = -d.a;
    m.bottomLeftCorner(k, n) = -d.c;
    m.topLeftCorner(n, n).diagonal().array() += s;
    slope.topLeftCorner(n, n).setIdentity();
    for (Eigen::Index i = 0; i < k; ++i) {
      const double delay = d.delays[static_cast<std::size_t>(i)];
      const Number e = std::exp(-s * delay);
      m.col(n + i) << -d.b.col(i) * e, -d.g.col(i) * e;
      slope.col(n + i) = -delay * m.col(n + i);
      m(n + i, n + i) += 1.0;
    }
    Point point{w, 0, 0};
    const Number j(0, 1);
    const auto add = [&](const ComplexMatrix& of, const ComplexMatrix& derivative, double sign) {
      const Eigen::PartialPivLU<ComplexMatrix> lu(of);
      point.value += sign * log_of(lu);
      point.slope += sign * j * (lu.inverse().transpose().cwiseProduct(derivative)).sum();
    };
    if (n + k > 0) add(m, slope, 1);
    if (k > 0 && !d.g.isZero(0)) {
      ComplexMatrix far = m.bottomRightCorner(k, k), far_slope = slope.bottomRightCorner(k, k);
      add(far, far_slope, -1);
    }
    for (const double q : shifts_) {
      point.value -= std::log(s + q);
      point.slope -= j / (s + q);
    }
    return point;
  }
  Point at(double sigma, double w) const { return at(d_, sigma, w); }

  static double turn_between(const Point& a, const Point& b) {
    return std::remainder(b.value.imag() - a.value.imag(), 2 * pi);
  }

  /// At w = 0, from real describing functions to those with their phase.
  double homotopy(double sigma) const {
    const bool turns = std::any_of(model_.factors.begin(), model_.factors.end(), [](auto f) { return f.imag() != 0; });
    if (!turns) return 0;
    double total = 0, from = 0, step = 1.0 / 16;
    Point a = at(delayed(model_, 0), sigma, 0);
    for (int halvings = 0; from < 1;) {
      const double to = std::min(1.0, from + step);
      const Point b = at(delayed(model_, to), sigma, 0);
      if (std::abs(turn_between(a, b)) > agreement && halvings < homotopy_halvings) {
        step /= 2;
        ++halvings;
        continue;
      }
      total += turn_between(a, b);
      from = to;
      a = b;
    }
    return total;
  }

  /// Along the line up to until_.
  double along(double sigma) const {
    if (until_ <= 0) return 0;
    double total = 0;
    Point a = at(sigma, 0);
    double step = std::min(until_, unit_ / 10);
    for (long i = 0; a.w < until_; ++i) {
      if (i == steps_allowed)
        fail_numerics("not_counted", "",
                      fmt::format("unstable poles were counted up to {:.3g} rad/s of {:.3g}", a.w, until_),
                      "leave out a dead time that is far longer than everything else, or simulate the diagram instead");
      const double allowed = largest_turn / std::max(std::abs(a.slope), std::numeric_limits<double>::min());
      step = std::min({step, allowed, until_ - a.w});
      const bool no_shorter = a.w + step / 2 <= a.w;
      const Point b = at(sigma, a.w + step);
      const double expected = (a.slope.imag() + b.slope.imag()) / 2 * step;
      const bool fine = std::abs(b.slope) * step <= largest_turn &&
                        std::abs(std::remainder(turn_between(a, b) - expected, 2 * pi)) <= agreement;
      if (!fine && !no_shorter) {
        step /= 2;
        continue;
      }
      total += turn_between(a, b);
      a = b;
      step *= 2;
    }
    return total;
  }

  /// From until_ on: of the states in closed form, of the dead times what is left of their turn.
  double tail(double sigma) const {
    const auto rest = [&](Number p) {  // how far s - p still turns
      const double across = sigma - p.real(), up = until_ - p.imag();
      const double left = pi / 2 - std::atan(up / std::abs(across));
      return across >= 0 ? (across == 0 ? 0.0 : left) : -left;
    };
    double total = 0;
    for (const auto& p : poles_) total += rest(p);
    for (const double q : shifts_) total -= rest(-q);
    if (d_.g.rows() == 0) return total;
    return total - std::arg(quotient(Number(sigma, until_)));
  }

  ComplexMatrix through(Number s) const {  // C (s - A)^-1 B
    ComplexMatrix resolvent = -d_.a;
    resolvent.diagonal().array() += s;
    return d_.c * resolvent.partialPivLu().solve(d_.b);
  }

  /// det(1 - Gamma E) / det(1 - G E)
  Number quotient(Number s) const {
    const Eigen::Index k = d_.g.rows();
    ComplexMatrix e = ComplexMatrix::Zero(k, k);
    for (Eigen::Index i = 0; i < k; ++i) e(i, i) = std::exp(-s * d_.delays[static_cast<std::size_t>(i)]);
    const ComplexMatrix far = ComplexMatrix::Identity(k, k) - d_.g * e;
    const ComplexMatrix all = far - (d_.a.rows() > 0 ? through(s) : ComplexMatrix::Zero(k, k)) * e;
    return all.determinant() / far.determinant();
  }

  /// The frequency behind which the dead times do not turn the quotient any more.
  double last_turn() const {
    const Eigen::Index k = d_.g.rows();
    if (k == 0 || d_.a.rows() == 0) return 0;
    const Eigen::MatrixXd far = d_.g.cwiseAbs();
    const Eigen::MatrixXd inverse = (Eigen::MatrixXd::Identity(k, k) - far).inverse();
    const double bound = inverse.minCoeff() >= 0 ? inverse.rowwise().sum().maxCoeff() : 10;
    const double allowed = std::min(0.5, 1.0 / static_cast<double>(k)) / bound;
    const auto turns = [&](double w) { return through(Number(0, w)).cwiseAbs().rowwise().sum().maxCoeff() > allowed; };
    const auto w = frequencies(poles_, longest_, 50);
    double last = 0;
    for (std::size_t i = 0; i < w.size(); ++i)
      if (turns(w[i])) last = i + 1 < w.size() ? w[i + 1] : 2 * w[i];
    if (last > w.back())
      while (turns(last)) last *= 2;
    return last > 0 ? last : w.front();
  }

  const LinearModel& model_;
  Delayed d_;
  std::vector<Number> poles_;
  std::vector<double> shifts_;  // of s, so that g tends to 1
  double unit_ = 1, longest_ = 0, until_ = 0;
};

/// States in like sizes: the characteristic function does not change, its rounding does.
LinearModel balanced(LinearModel m) {
  const auto n = static_cast<std::size_t>(m.states), k = m.delays.size();
  const auto f = balancing(m.a, m.states);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) m.a[i * n + j] *= f[j] / f[i];
    for (std::size_t q = 0; q < k; ++q) {
      m.to_delays[q * n + i] *= f[i];
      m.b_delayed[i * k + q] /= f[i];
    }
  }
  return m;
}

}  // namespace

PoleCount unstable_poles(const LinearModel& model) {
  if (model.delays.empty()) return right_of_the_axis(eigenvalues(model.a, model.states));
  const LinearModel own = balanced(model);
  PoleCount result;
  if (worst_radius(delayed(own, 1).g) >= 1) {
    result.endless = true;
    return result;
  }
  Count count(own);
  const double beside = hair * count.unit();
  result.outside = count(beside);
  result.on_the_limit = count(-beside) - result.outside;
  return result;
}

PoleCount unstable_when_closed(const LinearModel& loop, double gain) { return unstable_poles(loop.closed(gain)); }

}  // namespace hysteron
