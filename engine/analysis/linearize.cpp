#include "engine/analysis/linearize.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/diagram/index.h"
#include "engine/program/steps.h"

namespace hysteron {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MapOf = Eigen::Map<const Matrix>;
using Complex = Eigen::MatrixXcd;

constexpr double zero_pole = 1e-10;  // of the largest entry of A

/// One evaluation of the program in slopes, with signals moved along directions.
class Slopes {
 public:
  Slopes(const Program& program, const Run& run, const LinearizeOptions& options)
      : program_(program), run_(run), options_(options), work_(program), x_(at(program.n_x)) {
    for (std::size_t b = 0; b < program.blocks.size(); ++b)
      if (program.blocks[b].history_index >= 0) delays_.push_back(static_cast<int>(b));
    for (const int s : options.open) work_.injections.push_back({s, -1, -1, true});
    for (const int s : options.from) {
      const auto open = std::find(options.open.begin(), options.open.end(), s) != options.open.end();
      auto found =
          std::find_if(work_.injections.begin(), work_.injections.end(), [&](const auto& i) { return i.signal == s; });
      if (found == work_.injections.end()) found = work_.injections.insert(work_.injections.end(), {s, -1, -1, open});
      injected_.push_back(static_cast<int>(found - work_.injections.begin()));
    }
    for (const int b : delays_) {
      injected_.push_back(static_cast<int>(work_.injections.size()));
      work_.injections.push_back({program.blocks[at(b)].y_begin, -1, -1, true});
    }
  }

  const std::vector<int>& delays() const { return delays_; }

  /// Columns: states, then values of the injected signals (from, then delays), then their rates.
  int columns() const { return program_.n_x + 2 * static_cast<int>(injected_.size()); }

  /// Rows: derivatives of the states, outputs, inputs of the dead times.
  Matrix operator()() {
    const int rows = program_.n_x + static_cast<int>(options_.to.size() + delays_.size());
    Matrix result = Matrix::Zero(rows, columns());
    work_.refresh(run_);
    for (int first = 0; first < columns(); first += Jet::directions) {
      seed(first);
      // Values once more behind the derivatives: these only evaluate what they need.
      evaluate_derivatives(program_, run_, work_, run_.t, x_.data());
      evaluate_values(program_, run_, work_, run_.t, x_.data());
      for (int k = 0; k < Jet::directions && first + k < columns(); ++k) {
        int row = 0;
        for (const Jet& dx : work_.dx) result(row++, first + k) = dx.slope[k];
        for (const int s : options_.to) result(row++, first + k) = work_.y[at(s)].slope[k];
        for (const int b : delays_)
          result(row++, first + k) = work_.y[at(program_.blocks[at(b)].source.front())].slope[k];
      }
    }
    return result;
  }

 private:
  void seed(int first) {
    for (std::size_t j = 0; j < x_.size(); ++j) {
      x_[j] = Jet(run_.x[j]);
      const int k = static_cast<int>(j) - first;
      if (k >= 0 && k < Jet::directions) x_[j].slope[k] = 1;
    }
    const int n = program_.n_x, m = static_cast<int>(injected_.size());
    const auto inside = [&](int column) {
      const int k = column - first;
      return k >= 0 && k < Jet::directions ? k : -1;
    };
    for (int i = 0; i < m; ++i) {
      auto& injection = work_.injections[at(injected_[at(i)])];
      injection.value_direction = inside(n + i);
      injection.rate_direction = inside(n + m + i);
    }
  }

  const Program& program_;
  const Run& run_;
  const LinearizeOptions& options_;
  JetWork work_;
  std::vector<Jet> x_;
  std::vector<int> delays_, injected_;
};

void refuse_sampled(const Program& program, const LinearizeOptions& options) {
  for (const int block : program.sampled_blocks) {
    const auto& b = program.blocks[at(block)];
    const bool opened = std::any_of(options.open.begin(), options.open.end(),
                                    [&](int s) { return program.signals[at(s)].block == block; });
    bool on_the_way = false;
    for (const int from : options.from) {
      const auto reached = program.downstream_of(program.signals[at(from)].block);
      on_the_way = on_the_way || reached[at(block)];
    }
    const auto further = program.downstream_of(block);
    const bool arrives = std::any_of(options.to.begin(), options.to.end(),
                                     [&](int s) { return further[at(program.signals[at(s)].block)]; });
    if (on_the_way && arrives && !opened)
      fail("not_linear", b.path,
           fmt::format("{} \"{}\" is sampled: what passes it moves at its instants only, which no linear system in "
                       "continuous time describes",
                       b.kernel->declaration.type, b.path),
           fmt::format("open the loop there (--open {}) to see the continuous part, or choose a continuous controller",
                       b.path));
  }
}

std::vector<double> numbers(const Matrix& m) { return {m.data(), m.data() + m.size()}; }

}  // namespace

LinearModel linearize(const Program& program, const Run& run, const LinearizeOptions& options) {
  refuse_sampled(program, options);
  Slopes slopes(program, run, options);
  const Matrix s = slopes();
  const int n = program.n_x, m = static_cast<int>(options.from.size()), p = static_cast<int>(options.to.size());
  const int k = static_cast<int>(slopes.delays().size()), all = m + k;
  // x' = A x + B u + R u' with R from laws that are driven by rates. z = x - R u has no u' any more:
  // z' = A z + (B + A R) u, y = C z + (D + C R) u.
  const Matrix a = s.topLeftCorner(n, n), r = s.block(0, n + all, n, all);
  const Matrix b = s.block(0, n, n, all) + a * r;
  const Matrix c = s.bottomLeftCorner(p + k, n);
  const Matrix d = s.block(n, n, p + k, all) + c * r;
  LinearModel model;
  model.states = n;
  model.inputs = m;
  model.outputs = p;
  model.state_names = program.state_names;
  model.a = numbers(a);
  model.b = numbers(b.leftCols(m));
  model.b_delayed = numbers(b.rightCols(k));
  model.c = numbers(c.topRows(p));
  model.d = numbers(d.topLeftCorner(p, m));
  model.d_delayed = numbers(d.topRightCorner(p, k));
  model.to_delays = numbers(c.bottomRows(k));
  model.to_delays_from_inputs = numbers(d.bottomLeftCorner(k, m));
  model.between_delays = numbers(d.bottomRightCorner(k, k));
  for (const int block : slopes.delays())
    model.delays.push_back(program.blocks[at(block)].kernel->reach_back(view_of(program, run, block)));
  return model;
}

std::vector<std::complex<double>> LinearModel::poles() const {
  if (states == 0) return {};
  const Eigen::MatrixXd matrix = MapOf(a.data(), states, states);
  const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
  std::vector<std::complex<double>> list(values.data(), values.data() + values.size());
  // Poles at zero come out of the rounding as far from it as the root of it (two integrators in a row).
  for (auto& p : list)
    if (std::abs(p) < zero_pole * matrix.cwiseAbs().maxCoeff()) p = 0;
  std::stable_sort(list.begin(), list.end(),
                   [](auto x, auto y) { return x.real() != y.real() ? x.real() > y.real() : x.imag() > y.imag(); });
  return list;
}

std::vector<std::complex<double>> LinearModel::response(double w) const {
  const int k = static_cast<int>(delays.size()), all = inputs + k, rows = outputs + k;
  Complex b_all(states, all), c_all(rows, states), g(rows, all);
  b_all << MapOf(b.data(), states, inputs).cast<std::complex<double>>(),
      MapOf(b_delayed.data(), states, k).cast<std::complex<double>>();
  c_all << MapOf(c.data(), outputs, states).cast<std::complex<double>>(),
      MapOf(to_delays.data(), k, states).cast<std::complex<double>>();
  g.topLeftCorner(outputs, inputs) = MapOf(d.data(), outputs, inputs).cast<std::complex<double>>();
  g.topRightCorner(outputs, k) = MapOf(d_delayed.data(), outputs, k).cast<std::complex<double>>();
  g.bottomLeftCorner(k, inputs) = MapOf(to_delays_from_inputs.data(), k, inputs).cast<std::complex<double>>();
  g.bottomRightCorner(k, k) = MapOf(between_delays.data(), k, k).cast<std::complex<double>>();
  if (states > 0) {
    Complex resolvent = -MapOf(a.data(), states, states).cast<std::complex<double>>();
    resolvent.diagonal().array() += std::complex<double>(0, w);
    g += c_all * resolvent.partialPivLu().solve(b_all);
  }
  Complex y = g.topLeftCorner(outputs, inputs);
  if (k > 0) {
    // w = T v with T = diag(exp(-j w delay)): y = G11 u + G12 T (1 - G22 T)^-1 G21 u.
    Complex t = Complex::Zero(k, k);
    for (int i = 0; i < k; ++i) t(i, i) = std::polar(1.0, -w * delays[at(i)]);
    const Complex loop = Complex::Identity(k, k) - g.bottomRightCorner(k, k) * t;
    y += g.topRightCorner(outputs, k) * t * loop.partialPivLu().solve(g.bottomLeftCorner(k, inputs));
  }
  std::vector<std::complex<double>> list;
  for (int i = 0; i < outputs; ++i)
    for (int j = 0; j < inputs; ++j) list.push_back(y(i, j));
  return list;
}

}  // namespace hysteron
