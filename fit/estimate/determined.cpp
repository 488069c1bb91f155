#include "fit/estimate/determined.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/name_list.h"
#include "fit/numerics/dense.h"

namespace hysteron {
namespace {

using Vector = std::vector<double>;

double largest_of(const Vector& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

/// A change of one column's parameter in units of its size: ln for log scale, else relative.
double relative(const Sensitive& s, double change) {
  if (s.log_scale) return change;
  return s.size > 0 ? change / s.size : change;
}

/// Null vectors with as few members as possible: the null space (columns `first` .. of v) in reduced echelon form.
std::vector<Vector> sparse_basis(const Dense& v, std::size_t first) {
  std::vector<Vector> rows;
  for (std::size_t j = first; j < v.cols; ++j) rows.emplace_back(v.col(j), v.col(j) + v.rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::size_t r = i, c = 0;
    for (std::size_t k = i; k < rows.size(); ++k)
      for (std::size_t j = 0; j < v.rows; ++j)
        if (std::abs(rows[k][j]) > std::abs(rows[r][c])) r = k, c = j;
    std::swap(rows[i], rows[r]);
    const double pivot = rows[i][c];
    for (double& x : rows[i]) x /= pivot;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k == i) continue;
      const double f = rows[k][c];
      for (std::size_t j = 0; j < v.rows; ++j) rows[k][j] -= f * rows[i][j];
    }
  }
  return rows;
}

std::string sentence_for(const std::vector<std::string>& paths, const std::vector<double>& direction) {
  if (paths.size() == 1) return fmt::format("{} has no influence in these recordings: no value", paths.front());
  std::vector<std::string> moves;
  for (std::size_t i = 0; i < paths.size(); ++i)
    moves.push_back(fmt::format("{} by {:+.2g} %", paths[i], direction[i]));
  return fmt::format("only a combination of {} is determined: changing {} leaves the fit as it is; no value for either",
                     name_list(paths), fmt::join(moves, " and "));
}

class Analysis {
 public:
  Analysis(const NormalForm& jacobian, const std::vector<Sensitive>& columns, FitResult& result,
           const NormalForm* coloured)
      : n_(static_cast<std::size_t>(jacobian.n)),
        columns_(columns),
        result_(result),
        coloured_(coloured),
        scaled_(n_, n_),
        length_(n_),
        dropped_(n_, false) {
    for (std::size_t j = 0; j < n_; ++j) {
      const double* column = jacobian.r.data() + j * n_;
      length_[j] = length(column, n_);
      for (std::size_t i = 0; i < n_; ++i) scaled_(i, j) = length_[j] > 0 ? column[i] / length_[j] : 0;
    }
  }

  /// Columns that leave no trace at all: not even a change by 100 % can be seen.
  void drop_silent() {
    const double largest = largest_of(length_);
    for (std::size_t j = 0; j < n_; ++j) {
      const auto& s = columns_[j];
      const double effect = length_[j] * (s.log_scale ? 1.0 : s.size > 0 ? s.size : 1.0);
      if (length_[j] == 0 || !(effect > 1e-9) || length_[j] < 1e-300 * largest) name({j}, {1.0});
    }
  }

  /// Directions whose singular value is not distinguishable from zero.
  void drop_combinations(double tolerance) {
    const auto kept = remaining();
    if (kept.size() < 2) return;
    const auto svd = singular_values(part(kept));
    std::size_t rank = 0;
    while (rank < svd.s.size() && svd.s[rank] >= tolerance * svd.s[0]) ++rank;
    if (rank < kept.size()) name_all(kept, sparse_basis(svd.v, rank), 0.02);
  }

  /// Nearly parallel columns whose difference is lost in the noise: every member could double or vanish.
  void drop_lost_in_noise() {
    for (std::size_t guard = 0; guard < n_; ++guard) {
      const auto kept = remaining();
      if (kept.size() < 2) return;
      const auto svd = singular_values(part(kept));
      const std::size_t last = kept.size() - 1;
      if (!(svd.s[last] < 0.03 * svd.s[0])) return;
      const Vector v(svd.v.col(last), svd.v.col(last) + kept.size());
      const double largest = largest_of(v);
      bool all = true;
      for (std::size_t i = 0; i < kept.size(); ++i)
        if (std::abs(v[i]) >= 0.2 * largest)
          all = all && std::abs(relative(columns_[kept[i]],
                                         std::sqrt(result_.s2) / svd.s[last] * v[i] / length_[kept[i]])) > 1;
      if (!all) return;
      name_all(kept, {v}, 0.2);
    }
  }

  void intervals(double quantile) {
    auto kept = remaining();
    // An interval that reaches over all that the bounds allow says nothing: such a parameter has no value either.
    for (bool again = true; again;) {
      again = false;
      const Dense covariance = covariance_of(kept);
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const auto& s = columns_[kept[i]];
        const double half = quantile * std::sqrt(covariance(i, i));
        const bool lost = s.log_scale ? half > std::log(1000.0) : half > s.upper - s.lower;
        if (!lost && std::isfinite(half)) continue;
        name({kept[i]}, {1.0}, "the noise hides");
        kept = remaining();
        again = true;
        break;
      }
      if (again) continue;
      write(kept, covariance, quantile);
      name_loose(kept, quantile);
    }
  }

 private:
  std::vector<std::size_t> remaining() const {
    std::vector<std::size_t> list;
    for (std::size_t j = 0; j < n_; ++j)
      if (!dropped_[j]) list.push_back(j);
    return list;
  }

  Dense part(const std::vector<std::size_t>& kept) const {
    Dense a(n_, kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k) std::copy(scaled_.col(kept[k]), scaled_.col(kept[k]) + n_, a.col(k));
    return a;
  }

  void name_all(const std::vector<std::size_t>& kept, const std::vector<Vector>& null, double threshold) {
    for (const Vector& v : null) {
      const double largest = largest_of(v);
      std::vector<std::size_t> members;
      Vector change;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        if (std::abs(v[i]) < threshold * largest) continue;
        members.push_back(kept[i]);
        change.push_back(relative(columns_[kept[i]], v[i] / length_[kept[i]]));
      }
      const double most = largest_of(change);
      for (double& c : change) c /= most > 0 ? most : 1;
      name(members, change);
    }
  }

  void name(const std::vector<std::size_t>& members, const std::vector<double>& direction,
            const std::string& why = "") {
    Undetermined u;
    for (const std::size_t j : members) {
      auto& estimate = result_.estimates[static_cast<std::size_t>(columns_[j].estimate)];
      u.paths.push_back(estimate.path);
      estimate.determined = false;
      estimate.value.reset();
      dropped_[j] = true;
    }
    u.direction = direction;
    u.sentence = why.empty()
                     ? sentence_for(u.paths, direction)
                     : fmt::format("{} {}: its interval is wider than its bounds; no value", why, u.paths.front());
    result_.undetermined.push_back(std::move(u));
  }

  /// s2 (J'J)^-1 of the columns kept, in their own (perhaps logarithmic) units.
  Dense covariance_of(const std::vector<std::size_t>& kept) const {
    const std::size_t m = kept.size();
    Dense triangle = part(kept);
    triangularize(triangle);
    const Dense inverse = inverse_of_triangle(triangle);
    Dense covariance(m, m);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < m; ++k) sum += inverse(i, k) * inverse(j, k);
        covariance(i, j) = sum;
      }
    if (coloured_ == nullptr) {
      for (double& c : covariance.a) c *= result_.s2;
    } else {
      Dense moved(n_, m);  // V^1/2 J (J'J)^-1, but for a rotation
      for (std::size_t j = 0; j < m; ++j)
        for (std::size_t k = 0; k < m; ++k) {
          const double* column = coloured_->r.data() + kept[k] * n_;
          const double f = covariance(k, j) / length_[kept[k]];
          for (std::size_t i = 0; i < n_; ++i) moved(i, j) += f * column[i];
        }
      for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < m; ++j) covariance(i, j) = dot(moved.col(i), moved.col(j), n_);
    }
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j) covariance(i, j) /= length_[kept[i]] * length_[kept[j]];
    return covariance;
  }

  /// The combination that the data determine least, where it can move far and its members hang together.
  void name_loose(const std::vector<std::size_t>& kept, double quantile) {
    constexpr double far = 0.1, together = 0.95, member = 0.2;  // relative change; correlation; share of the largest
    const std::size_t m = kept.size();
    if (m < 2 || coloured_ != nullptr) return;
    const auto svd = singular_values(part(kept));
    Vector change(m);
    for (std::size_t i = 0; i < m; ++i)
      change[i] = relative(columns_[kept[i]],
                           quantile * std::sqrt(result_.s2) / svd.s[m - 1] * svd.v(i, m - 1) / length_[kept[i]]);
    const double largest = largest_of(change);
    if (!(largest > far)) return;
    std::vector<std::string> paths, moves;
    bool hang_together = false;
    for (std::size_t i = 0; i < m; ++i) {
      if (std::abs(change[i]) < member * largest) continue;
      for (std::size_t j = 0; j < i; ++j)
        hang_together = hang_together || (std::abs(change[j]) >= member * largest &&
                                          std::abs(result_.correlation[i * m + j]) > together);
      paths.push_back(result_.estimates[static_cast<std::size_t>(columns_[kept[i]].estimate)].path);
      moves.push_back(fmt::format("{:+.2g} %", 100 * change[i]));
    }
    if (hang_together)
      result_.remarks.push_back(fmt::format("{} are strongly correlated: changed together by {} they fit as well",
                                            fmt::join(paths, ", "), fmt::join(moves, ", ")));
  }

  void write(const std::vector<std::size_t>& kept, const Dense& covariance, double quantile) {
    const std::size_t m = kept.size();
    result_.correlation.assign(m * m, 0.0);
    for (std::size_t i = 0; i < m; ++i) {
      const auto& s = columns_[kept[i]];
      auto& e = result_.estimates[static_cast<std::size_t>(s.estimate)];
      const double sigma = std::sqrt(covariance(i, i)), half = quantile * sigma;
      e.sigma = s.log_scale ? sigma * s.value : sigma;
      e.s2 = coloured_ == nullptr && result_.s2 > 0 ? result_.s2 : 1;
      e.low95 = std::max(e.lower, s.log_scale ? s.value * std::exp(-half) : s.value - half);
      e.high95 = std::min(e.upper, s.log_scale ? s.value * std::exp(half) : s.value + half);
      result_.correlated.push_back(s.estimate);
      for (std::size_t j = 0; j < m; ++j)
        result_.correlation[i * m + j] = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
    }
    result_.n_parameters = static_cast<int>(m);
  }

  std::size_t n_;
  const std::vector<Sensitive>& columns_;
  FitResult& result_;
  const NormalForm* coloured_;
  Dense scaled_;  ///< columns of length one
  Vector length_;
  std::vector<bool> dropped_;
};

}  // namespace

void judge_parameters(const NormalForm& jacobian, const std::vector<Sensitive>& columns, bool exact, FitResult& result,
                      const NormalForm* coloured) {
  Analysis analysis(jacobian, columns, result, coloured);
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
