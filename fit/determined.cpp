#include "fit/determined.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// A change of one column's parameter in units of its size: ln for log scale, else relative.
double relative(const Sensitive& s, double change) {
  if (s.log_scale) return change;
  return s.size > 0 ? change / s.size : change;
}

/// Null vectors with as few members as possible: the null space in reduced echelon form.
std::vector<Vector> sparse_basis(Matrix null) {
  std::vector<Vector> list;
  Matrix rows = null.transpose();
  std::vector<Eigen::Index> pivots;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    Eigen::Index r = 0, c = 0;
    rows.bottomRows(rows.rows() - i).cwiseAbs().maxCoeff(&r, &c);
    rows.row(i).swap(rows.row(i + r));
    if (rows(i, c) == 0) break;
    rows.row(i) /= rows(i, c);
    for (Eigen::Index k = 0; k < rows.rows(); ++k)
      if (k != i) rows.row(k) -= rows(k, c) * rows.row(i);
    pivots.push_back(c);
  }
  for (std::size_t i = 0; i < pivots.size(); ++i) list.emplace_back(rows.row(static_cast<Eigen::Index>(i)).transpose());
  return list;
}

std::string sentence_for(const std::vector<std::string>& paths, const std::vector<double>& direction) {
  if (paths.size() == 1) return fmt::format("{} changes nothing in these recordings: no value", paths.front());
  std::vector<std::string> moves;
  for (std::size_t i = 0; i < paths.size(); ++i)
    moves.push_back(fmt::format("{} by {:+.2g} %", paths[i], direction[i]));
  return fmt::format("only a combination of {} is determined: changing {} leaves the fit as it is; no value for either",
                     fmt::join(paths, ", "), fmt::join(moves, " and "));
}

class Analysis {
 public:
  Analysis(const NormalForm& jacobian, const std::vector<Sensitive>& columns, FitResult& result)
      : n_(jacobian.n),
        r_(Eigen::Map<const Matrix>(jacobian.r.data(), n_, n_)),
        columns_(columns),
        result_(result),
        length_(Vector::Ones(n_)),
        dropped_(static_cast<std::size_t>(n_), false) {
    for (int j = 0; j < n_; ++j) length_[j] = r_.col(j).norm();
  }

  /// Columns that leave no trace at all.
  void drop_silent() {
    const double largest = n_ > 0 ? length_.maxCoeff() : 0;
    for (int j = 0; j < n_; ++j) {
      const auto& s = columns_[static_cast<std::size_t>(j)];
      const double effect = length_[j] * (s.log_scale ? 1.0 : s.size > 0 ? s.size : 1.0);  // of a change by 100 %
      if (length_[j] == 0 || !(effect > 1e-9) || length_[j] < 1e-300 * largest) name({j}, {1.0});
    }
  }

  /// Directions whose singular value is not distinguishable from zero.
  void drop_combinations(double tolerance) {
    const auto kept = remaining();
    if (kept.size() < 2) return;
    const auto svd = decompose(kept);
    const Vector& s = svd.singularValues();
    int null = 0;
    for (Eigen::Index k = 0; k < s.size(); ++k)
      if (s[k] < tolerance * s[0]) ++null;
    if (null > 0) name_all(kept, svd.matrixV().rightCols(null));
  }

  /// Nearly parallel columns whose difference is lost in the noise: every member could double or vanish.
  void drop_lost_in_noise() {
    for (int guard = 0; guard < n_; ++guard) {
      const auto kept = remaining();
      if (kept.size() < 2) return;
      const auto svd = decompose(kept);
      const auto last = svd.singularValues().size() - 1;
      const double s = svd.singularValues()[last];
      if (!(s < 0.03 * svd.singularValues()[0])) return;
      const Vector v = svd.matrixV().col(last);
      const double largest = v.cwiseAbs().maxCoeff();
      bool all = true;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const double part = v[static_cast<Eigen::Index>(i)];
        if (std::abs(part) < 0.2 * largest) continue;
        const auto& column = columns_[static_cast<std::size_t>(kept[i])];
        all = all && std::abs(relative(column, std::sqrt(result_.s2) / s * part / length_[kept[i]])) > 1;
      }
      if (!all) return;
      name_all(kept, svd.matrixV().rightCols(1), 0.2);
    }
  }

  void intervals(double quantile) {
    auto kept = remaining();
    // An interval that reaches over all that the bounds allow says nothing: such a parameter has no value either.
    for (bool again = true; again;) {
      again = false;
      const Matrix covariance = covariance_of(kept);
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const auto& s = columns_[static_cast<std::size_t>(kept[i])];
        const double half = quantile * std::sqrt(covariance(k, k));
        const bool lost = s.log_scale ? half > std::log(1000.0) : half > s.upper - s.lower;
        if (!lost && std::isfinite(half)) continue;
        name({kept[i]}, {1.0}, "the noise hides");
        kept = remaining();
        again = true;
        break;
      }
      if (!again) write(kept, covariance, quantile);
    }
  }

 private:
  std::vector<int> remaining() const {
    std::vector<int> list;
    for (int j = 0; j < n_; ++j)
      if (!dropped_[static_cast<std::size_t>(j)]) list.push_back(j);
    return list;
  }

  Matrix scaled(const std::vector<int>& kept) const {
    Matrix a = r_(Eigen::all, kept);
    for (std::size_t i = 0; i < kept.size(); ++i) a.col(static_cast<Eigen::Index>(i)) /= length_[kept[i]];
    return a;
  }
  Eigen::JacobiSVD<Matrix> decompose(const std::vector<int>& kept) const {
    return Eigen::JacobiSVD<Matrix>(scaled(kept), Eigen::ComputeThinV);
  }

  void name_all(const std::vector<int>& kept, const Matrix& null, double threshold = 0.02) {
    for (const Vector& v : sparse_basis(null)) {
      const double largest = v.cwiseAbs().maxCoeff();
      std::vector<int> members;
      std::vector<double> change;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const double part = v[static_cast<Eigen::Index>(i)];
        if (std::abs(part) < threshold * largest) continue;
        members.push_back(kept[i]);
        change.push_back(relative(columns_[static_cast<std::size_t>(kept[i])], part / length_[kept[i]]));
      }
      double most = 0;
      for (const double c : change) most = std::max(most, std::abs(c));
      for (double& c : change) c /= most > 0 ? most : 1;
      name(members, change);
    }
  }

  void name(const std::vector<int>& members, const std::vector<double>& direction, const std::string& why = "") {
    Undetermined u;
    for (const int j : members) {
      auto& estimate = result_.estimates[static_cast<std::size_t>(columns_[static_cast<std::size_t>(j)].estimate)];
      u.paths.push_back(estimate.path);
      estimate.determined = false;
      estimate.value.reset();
      dropped_[static_cast<std::size_t>(j)] = true;
    }
    u.direction = direction;
    u.sentence = why.empty()
                     ? sentence_for(u.paths, direction)
                     : fmt::format("{} {}: its interval is wider than its bounds; no value", why, u.paths.front());
    result_.undetermined.push_back(std::move(u));
  }

  /// s2 (J'J)^-1 of the columns kept, in their own (perhaps logarithmic) units.
  Matrix covariance_of(const std::vector<int>& kept) const {
    const auto m = static_cast<Eigen::Index>(kept.size());
    if (m == 0) return {};
    const Eigen::HouseholderQR<Matrix> qr(scaled(kept));
    const Matrix triangle = qr.matrixQR().topRows(m).triangularView<Eigen::Upper>();
    const Matrix inverse = triangle.triangularView<Eigen::Upper>().solve(Matrix::Identity(m, m));
    Matrix covariance = result_.s2 * inverse * inverse.transpose();
    for (Eigen::Index i = 0; i < m; ++i)
      for (Eigen::Index j = 0; j < m; ++j)
        covariance(i, j) /= length_[kept[static_cast<std::size_t>(i)]] * length_[kept[static_cast<std::size_t>(j)]];
    return covariance;
  }

  void write(const std::vector<int>& kept, const Matrix& covariance, double quantile) {
    const std::size_t m = kept.size();
    result_.correlation.assign(m * m, 0.0);
    for (std::size_t i = 0; i < m; ++i) {
      const auto& s = columns_[static_cast<std::size_t>(kept[i])];
      auto& e = result_.estimates[static_cast<std::size_t>(s.estimate)];
      const auto k = static_cast<Eigen::Index>(i);
      const double sigma = std::sqrt(covariance(k, k)), half = quantile * sigma;
      e.sigma = s.log_scale ? sigma * s.value : sigma;
      e.low95 = std::max(e.lower, s.log_scale ? s.value * std::exp(-half) : s.value - half);
      e.high95 = std::min(e.upper, s.log_scale ? s.value * std::exp(half) : s.value + half);
      result_.correlated.push_back(s.estimate);
      for (std::size_t j = 0; j < m; ++j) {
        const auto l = static_cast<Eigen::Index>(j);
        result_.correlation[i * m + j] = covariance(k, l) / std::sqrt(covariance(k, k) * covariance(l, l));
      }
    }
    result_.n_parameters = static_cast<int>(m);
  }

  int n_;
  Matrix r_;
  const std::vector<Sensitive>& columns_;
  FitResult& result_;
  Vector length_;
  std::vector<bool> dropped_;
};

}  // namespace

void judge_parameters(const NormalForm& jacobian, const std::vector<Sensitive>& columns, bool exact,
                      FitResult& result) {
  Analysis analysis(jacobian, columns, result);
  analysis.drop_silent();
  analysis.drop_combinations(exact ? 1e-6 : 1e-3);
  analysis.drop_lost_in_noise();
  analysis.intervals(student_975(std::max(1.0, result.n - static_cast<double>(columns.size()))));
}

double student_975(double f) {
  constexpr double z = 1.959963984540054;
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, z9 = z7 * z * z;
  return z + (z3 + z) / (4 * f) + (5 * z5 + 16 * z3 + 3 * z) / (96 * f * f) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * f * f * f) +
         (79 * z9 + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / (92160 * f * f * f * f);
}

}  // namespace hysteron
