#include "engine/analysis/linearize.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/analysis/wired_slopes.h"
#include "engine/diagram/index.h"
#include "engine/program/reach.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MapOf = Eigen::Map<const RowMatrix>;
using Complex = Eigen::MatrixXcd;

std::vector<double> numbers(const RowMatrix& m) { return {m.data(), m.data() + m.size()}; }

/// Rows of the signals.
RowMatrix rows_of(const Eigen::MatrixXd& m, const std::vector<int>& signals) {
  RowMatrix rows(static_cast<Eigen::Index>(signals.size()), m.cols());
  for (std::size_t i = 0; i < signals.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = m.row(signals[i]);
  return rows;
}

/// The numbers of a model as matrices.
struct Parts {
  explicit Parts(const LinearModel& from)
      : n(from.states),
        m(from.inputs),
        p(from.outputs),
        k(static_cast<int>(from.delays.size())),
        a(MapOf(from.a.data(), n, n)),
        b(n, m + k),
        c(p + k, n),
        d(p + k, m + k) {
    b << MapOf(from.b.data(), n, m), MapOf(from.b_delayed.data(), n, k);
    c << MapOf(from.c.data(), p, n), MapOf(from.to_delays.data(), k, n);
    d.topLeftCorner(p, m) = MapOf(from.d.data(), p, m);
    d.topRightCorner(p, k) = MapOf(from.d_delayed.data(), p, k);
    d.bottomLeftCorner(k, m) = MapOf(from.to_delays_from_inputs.data(), k, m);
    d.bottomRightCorner(k, k) = MapOf(from.between_delays.data(), k, k);
  }
  /// Everything but names, delays and factors.
  LinearModel model() const {
    LinearModel model;
    model.states = n;
    model.inputs = m;
    model.outputs = p;
    model.a = numbers(a);
    model.b = numbers(b.leftCols(m));
    model.b_delayed = numbers(b.rightCols(k));
    model.c = numbers(c.topRows(p));
    model.to_delays = numbers(c.bottomRows(k));
    model.d = numbers(d.topLeftCorner(p, m));
    model.d_delayed = numbers(d.topRightCorner(p, k));
    model.to_delays_from_inputs = numbers(d.bottomLeftCorner(k, m));
    model.between_delays = numbers(d.bottomRightCorner(k, k));
    return model;
  }
  int n, m, p, k;
  RowMatrix a, b, c, d;
};

void sort_poles(std::vector<std::complex<double>>& list) {
  std::stable_sort(list.begin(), list.end(),
                   [](auto x, auto y) { return x.real() != y.real() ? x.real() > y.real() : x.imag() > y.imag(); });
}

/// Numbers s at which left - s right is singular, as quotients alpha / beta, those with |beta| > `least`. A pair is
/// that of a block of two rows [s11 s12; s21 s22] against diag(a, b): the eigenvalues of [s11 b, s12 a; s21 b, s22 a]
/// over ab. (Eigen::GeneralizedEigenSolver does the same, and brings eigenvectors: twenty seconds of every build.)
std::vector<std::complex<double>> quotients(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right, double least) {
  Eigen::RealQZ<Eigen::MatrixXd> pair(left.rows());
  pair.compute(left, right, false);
  const Eigen::MatrixXd &s = pair.matrixS(), &t = pair.matrixT();
  std::vector<std::complex<double>> list;
  const auto add = [&](std::complex<double> alpha, double beta) {
    if (std::abs(beta) > least) list.push_back(alpha / beta);
  };
  for (Eigen::Index i = 0; i < s.rows(); ++i) {
    if (i + 1 == s.rows() || s(i + 1, i) == 0) {
      add(s(i, i), t(i, i));
      continue;
    }
    const double a = t(i, i), b = t(i + 1, i + 1), beta = a * b;
    const double p = 0.5 * (s(i, i) * b - s(i + 1, i + 1) * a);
    const double z = std::sqrt(std::abs(p * p + s(i + 1, i) * b * (s(i, i + 1) * a)));
    const std::complex<double> alpha(s(i + 1, i + 1) * a + p, beta > 0 ? z : -z);
    add(std::conj(alpha), beta);
    add(alpha, beta);
    ++i;
  }
  return list;
}

/// The first sampled block between inputs and outputs, or -1.
int sampled_on_the_way(const Program& program, const WiredSlopes& flattened, const Flow& flow) {
  if (program.sampled_blocks.empty()) return -1;
  const auto between = flattened.between(flow);
  int held = flattened.states() + flattened.sampled_states(), state = flattened.states();
  for (const int b : program.sampled_blocks) {
    const auto& sizes = program.blocks[at(b)].sizes;
    for (int i = 0; i < sizes.sampled_states; ++i)
      if (between[at(state + i)]) return b;
    for (int i = 0; i < sizes.outputs; ++i)
      if (between[at(held + i)]) return b;
    state += sizes.sampled_states;
    held += sizes.outputs;
  }
  return -1;
}

}  // namespace

bool is_sampled(const Program& program, const Run& run, const LinearizeOptions& options) {
  const WiredSlopes flattened(program, run, options);
  return sampled_on_the_way(program, flattened, flattened.flow()) >= 0;
}

std::vector<int> blocks_that_cut(const Program& program, const Run& run, const LinearizeOptions& options) {
  return WiredSlopes(program, run, options).cuts();
}

LinearModel linearize(const Program& program, const Run& run, const LinearizeOptions& options) {
  const WiredSlopes flattened(program, run, options);
  const Flow flow = flattened.flow();
  if (const int block = sampled_on_the_way(program, flattened, flow); block >= 0) {
    const auto& b = program.blocks[at(block)];
    fail("not_linear", b.path,
         fmt::format("{} \"{}\" is sampled: what passes it moves at its instants only, which no linear system in "
                     "continuous time describes",
                     b.kernel->declaration.type, b.path),
         fmt::format("open the loop there (--open {}) to see the continuous part, or choose a continuous controller",
                     b.path));
  }
  const int h = flattened.held(), m = flattened.inputs(), k = static_cast<int>(flattened.channels().size());
  std::vector<int> sources;
  for (const auto& channel : flattened.channels()) sources.push_back(channel.source);
  LinearModel model;
  model.states = program.n_x;
  model.inputs = m;
  model.outputs = static_cast<int>(options.to.size());
  model.state_names = program.state_names;
  model.a = numbers(flow.a);
  model.b = numbers(flow.b.middleCols(h, m));
  model.b_delayed = numbers(flow.b.rightCols(k));
  model.c = numbers(rows_of(flow.seen_z, options.to));
  const RowMatrix d = rows_of(flow.seen_w, options.to), into = rows_of(flow.seen_w, sources);
  model.d = numbers(d.middleCols(h, m));
  model.d_delayed = numbers(d.rightCols(k));
  model.to_delays = numbers(rows_of(flow.seen_z, sources));
  model.to_delays_from_inputs = numbers(into.middleCols(h, m));
  model.between_delays = numbers(into.rightCols(k));
  for (const auto& channel : flattened.channels()) {
    model.delays.push_back(channel.delay);
    model.factors.push_back(channel.factor);
  }
  return model;
}

std::vector<std::complex<double>> LinearModel::poles() const {
  std::vector<std::complex<double>> list;
  // A double pole at zero comes out of the rounding as far from it as the root of it (two integrators in a row).
  for (const auto& e : eigenvalues(a, states)) list.push_back(std::abs(e.value) <= e.error ? 0.0 : e.value);
  sort_poles(list);
  return list;
}

std::vector<std::complex<double>> LinearModel::zeros() const {
  if (inputs != 1 || outputs != 1 || !delays.empty()) return {};
  const LinearModel own = on_the_way();
  const Parts parts(own);
  const int n = own.states;
  if (n == 0) return {};
  // Where [A - s, B; C, D] is singular. Infinite ones come out as quotients by what rounding left of zero.
  Eigen::MatrixXd pencil(n + 1, n + 1), mass = Eigen::MatrixXd::Zero(n + 1, n + 1);
  pencil << parts.a, parts.b, parts.c, parts.d;
  mass.topLeftCorner(n, n).setIdentity();
  const double largest_b = std::max(parts.b.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const double largest_c = std::max(parts.c.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const double size = std::max(1.0, parts.a.cwiseAbs().maxCoeff());
  pencil.rightCols(1) *= size / largest_b;
  pencil.bottomRows(1) *= size / largest_c;
  constexpr double infinite = 1e-10;  // of the mass matrix
  std::vector<std::complex<double>> list = quotients(pencil, mass, infinite);
  sort_poles(list);
  return list;
}

LinearModel LinearModel::on_the_way() const {
  const Parts all(*this);
  Reach reach(all.n + all.k);
  for (int i = 0; i < all.n + all.k; ++i) {
    const bool state = i < all.n;
    for (int j = 0; j < all.n; ++j)
      if ((state ? all.a(i, j) : all.c(all.p + i - all.n, j)) != 0) reach.add(j, i);
    for (int j = 0; j < all.m + all.k; ++j) {
      if ((state ? all.b(i, j) : all.d(all.p + i - all.n, j)) == 0) continue;
      if (j < all.m)
        reach.enters(i);
      else
        reach.add(all.n + j - all.m, i);
    }
  }
  for (int o = 0; o < all.p; ++o) {
    for (int j = 0; j < all.n; ++j)
      if (all.c(o, j) != 0) reach.leaves(j);
    for (int j = 0; j < all.k; ++j)
      if (all.d(o, all.m + j) != 0) reach.leaves(all.n + j);
  }
  const auto between = reach.between();
  std::vector<int> states_kept, into, out_of;  // rows and columns: states; inputs and channels; outputs and channels
  for (int j = 0; j < all.m; ++j) into.push_back(j);
  for (int o = 0; o < all.p; ++o) out_of.push_back(o);
  LinearModel kept;
  for (int i = 0; i < all.n + all.k; ++i) {
    if (!between[at(i)]) continue;
    if (i < all.n) {
      states_kept.push_back(i);
      if (!state_names.empty()) kept.state_names.push_back(state_names[at(i)]);
      continue;
    }
    into.push_back(all.m + i - all.n);
    out_of.push_back(all.p + i - all.n);
    kept.delays.push_back(delays[at(i - all.n)]);
    kept.factors.push_back(factors[at(i - all.n)]);
  }
  Parts parts = all;
  parts.n = static_cast<int>(states_kept.size());
  parts.k = static_cast<int>(kept.delays.size());
  parts.a = all.a(states_kept, states_kept);
  parts.b = all.b(states_kept, into);
  parts.c = all.c(out_of, states_kept);
  parts.d = all.d(out_of, into);
  LinearModel result = parts.model();
  result.state_names = std::move(kept.state_names);
  result.delays = std::move(kept.delays);
  result.factors = std::move(kept.factors);
  return result;
}

LinearModel LinearModel::closed(double gain) const {
  const Parts open(*this);
  const double left = 1 + gain * open.d(0, 0);
  if (left == 0)
    fail("not_linear", "", "the loop's gain is -1 at infinite frequency: closed, it has no answer",
         "put a block with a state into the loop (a lag: the amplifier's or the sensor's dynamics)");
  // u = -gain (C x + D_w w) / (1 + gain D)
  Parts parts = open;
  parts.m = parts.p = 0;
  const RowMatrix into = open.b.leftCols(1) * (-gain / left), across = open.d.block(1, 0, open.k, 1) * (-gain / left);
  parts.a = open.a + into * open.c.topRows(1);
  parts.b = open.b.rightCols(open.k) + into * open.d.topRightCorner(1, open.k);
  parts.c = open.c.bottomRows(open.k) + across * open.c.topRows(1);
  parts.d = open.d.bottomRightCorner(open.k, open.k) + across * open.d.topRightCorner(1, open.k);
  LinearModel result = parts.model();
  result.state_names = state_names;
  result.delays = delays;
  result.factors = factors;
  return result;
}

std::vector<std::complex<double>> LinearModel::response(double w) const {
  const Parts parts(*this);
  Complex g = parts.d.cast<std::complex<double>>();
  if (states > 0) {
    Complex resolvent = -parts.a.cast<std::complex<double>>();
    resolvent.diagonal().array() += std::complex<double>(0, w);
    g += parts.c.cast<std::complex<double>>() * resolvent.partialPivLu().solve(parts.b.cast<std::complex<double>>());
  }
  const int k = parts.k;
  Complex y = g.topLeftCorner(outputs, inputs);
  if (k > 0) {
    // w = T v with T = diag(factor exp(-j w delay)): y = G11 u + G12 T (1 - G22 T)^-1 G21 u.
    Complex t = Complex::Zero(k, k);
    for (int i = 0; i < k; ++i) t(i, i) = factors[at(i)] * std::polar(1.0, -w * delays[at(i)]);
    const Complex loop = Complex::Identity(k, k) - g.bottomRightCorner(k, k) * t;
    y += g.topRightCorner(outputs, k) * t * loop.partialPivLu().solve(g.bottomLeftCorner(k, inputs));
  }
  std::vector<std::complex<double>> list;
  for (int i = 0; i < outputs; ++i)
    for (int j = 0; j < inputs; ++j) list.push_back(y(i, j));
  return list;
}

}  // namespace hysteron
