#include "discover/structure/structure_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>

#include "discover/structure/residual_parts.h"
#include "discover/structure/structure_breaks.h"
#include "discover/structure/structure_lines.h"

namespace hysteron {
namespace {

constexpr int numbers_of_a_frequency = 3, numbers_of_an_instant = 2;
constexpr Eigen::Index most_columns = 1000;

/// What is multiplied by numbers that are found: the same in all parts, or one in each.
struct PartColumns {
  std::vector<Rows> common, own;
};

/// A line that a recording cannot show, faster than its rows or slower than the recording, is not there.
bool shows(const ResidualPart& p, double period) {
  const double step = p.duration() / static_cast<double>(p.t.size() - 1);
  return period >= step / 0.45 && period <= p.duration();
}

/// One column for each stretch between jumps.
std::vector<Rows> between_jumps(const Structure& s, const ResidualPart& p, const std::string& recording) {
  std::vector<double> behind;
  for (const auto& [name, list] : s.intervals)
    if (name == recording)
      for (const auto& [before, after] : list) behind.push_back(after);
  std::vector<Rows> columns(behind.size() + 1, Rows(p.t.size(), 0.0));
  for (std::size_t k = 0; k < p.t.size(); ++k) {
    const auto past = std::upper_bound(behind.begin(), behind.end(), p.t[k]) - behind.begin();
    columns[static_cast<std::size_t>(past)][k] = 1;
  }
  return columns;
}

std::size_t level_of(const Structure& s, const ResidualParts& parts) {
  std::size_t level = 0;
  while (level < parts.levels().size() && parts.levels()[level].name != s.variable) ++level;
  return level;
}

PartColumns columns_of(const Structure& s, const ResidualParts& parts, const ResidualPart& p, bool with_gain) {
  PartColumns columns;
  const std::size_t level = level_of(s, parts);
  const bool is_over_a_level = level < parts.levels().size();
  if (s.kind == "line_in_time" && shows(p, s.period))
    columns.own = wave(p.t, p.t.front(), 2 * std::numbers::pi / s.period);
  if (s.kind == "line_in_level" && is_over_a_level)
    for (const int harmonic : {1, 2})
      for (auto& c : wave(p.levels[level], parts.levels()[level].lowest, harmonic * 2 * std::numbers::pi / s.period))
        columns.common.push_back(std::move(c));
  if (s.kind == "kink_at_level" && is_over_a_level) columns.common = step_and_slope(p.levels[level], s.threshold);
  if (s.kind == "jumps") columns.own = between_jumps(s, p, parts.model().recording(p.recording).name);
  if (with_gain && !parts.levels().empty()) {
    columns.common.emplace_back(p.e.size(), 1.0);
    columns.common.push_back(p.levels.front());
  }
  return columns;
}

/// Least squares of all parts together: normal equations, for columns are few and rows many.
class Squares {
 public:
  Squares(const std::vector<Rows>& rows, const std::vector<Rows>& weights, bool zeros_are_free)
      : rows_(rows), weights_(weights), zeros_are_free_(zeros_are_free) {}

  void add(PartColumns columns) {
    const std::size_t part = matrices_.size();
    const auto n = static_cast<Eigen::Index>(rows_[part].size());
    std::vector<Rows> list = std::move(columns.common);
    common_ = std::max(common_, static_cast<Eigen::Index>(list.size()));
    own_begin_.push_back(own_);
    own_ += static_cast<Eigen::Index>(columns.own.size());
    for (auto& c : columns.own) list.push_back(std::move(c));
    Eigen::MatrixXd a(n, static_cast<Eigen::Index>(list.size()));
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (zeros_are_free_) take_mean_off(list[k], weights_[part]);
      a.col(static_cast<Eigen::Index>(k)) = Eigen::Map<const Eigen::VectorXd>(list[k].data(), n);
    }
    matrices_.push_back(std::move(a));
  }

  Eigen::Index columns() const { return common_ + own_; }

  std::vector<Rows> left() const {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns(), columns());
    Eigen::VectorXd right = Eigen::VectorXd::Zero(columns());
    for (std::size_t p = 0; p < matrices_.size(); ++p) {
      const Eigen::MatrixXd weighted = weights(p).asDiagonal() * matrices_[p];
      const Eigen::MatrixXd squares = matrices_[p].transpose() * weighted;
      const Eigen::VectorXd products = weighted.transpose() * y(p);
      for (Eigen::Index i = 0; i < squares.rows(); ++i) {
        right(place(p, i)) += products(i);
        for (Eigen::Index k = 0; k < squares.cols(); ++k) normal(place(p, i), place(p, k)) += squares(i, k);
      }
    }
    // Scaled, so that columns of different size do not decide the rank.
    const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    const Eigen::VectorXd c = scale.asDiagonal() * scaled.completeOrthogonalDecomposition().solve(
                                                       Eigen::VectorXd(scale.asDiagonal() * right));
    std::vector<Rows> all;
    for (std::size_t p = 0; p < matrices_.size(); ++p) {
      Eigen::VectorXd own(matrices_[p].cols());
      for (Eigen::Index i = 0; i < own.size(); ++i) own(i) = c(place(p, i));
      const Eigen::VectorXd e = y(p) - matrices_[p] * own;
      all.emplace_back(e.data(), e.data() + e.size());
      if (zeros_are_free_) take_mean_off(all.back(), weights_[p]);
    }
    return all;
  }

 private:
  static void take_mean_off(Rows& rows, const Rows& weights) {
    double sum = 0, all = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) sum += weights[k] * rows[k], all += weights[k];
    for (double& v : rows) v -= all > 0 ? sum / all : 0;
  }
  Eigen::Map<const Eigen::VectorXd> y(std::size_t part) const {
    return {rows_[part].data(), static_cast<Eigen::Index>(rows_[part].size())};
  }
  Eigen::Map<const Eigen::VectorXd> weights(std::size_t part) const {
    return {weights_[part].data(), static_cast<Eigen::Index>(weights_[part].size())};
  }
  Eigen::Index place(std::size_t part, Eigen::Index column) const {
    return column < common_ ? column : column + own_begin_[part];
  }

  const std::vector<Rows>&rows_, &weights_;
  const bool zeros_are_free_;
  std::vector<Eigen::MatrixXd> matrices_;
  std::vector<Eigen::Index> own_begin_;
  Eigen::Index common_ = 0, own_ = 0;
};

/// Beside its columns.
int numbers_of_its_place(const Structure& s) {
  if (s.kind == "line_in_time" || s.kind == "line_in_level") return numbers_of_a_frequency;
  if (s.kind == "kink_at_level") return numbers_of_an_instant;
  std::size_t jumps = 0;
  for (const auto& [name, list] : s.intervals) jumps += list.size();
  return numbers_of_an_instant * static_cast<int>(jumps);
}

}  // namespace

StructureFit fit_structure(const Structure& structure, const ResidualParts& parts, const std::vector<Rows>& rows,
                           const std::vector<Rows>& weights, bool with_gain) {
  if (!structure.explains()) return {rows, 0};
  int output = 0;
  while (parts.model().outputs()[static_cast<std::size_t>(output)] != structure.output) ++output;
  Squares squares(rows, weights, parts.model().zero_per_recording(output));
  for (const auto& p : parts.list()) squares.add(columns_of(structure, parts, p, with_gain));
  if (squares.columns() == 0 || squares.columns() > most_columns) return {rows, 0};
  return {squares.left(), static_cast<int>(squares.columns()) + numbers_of_its_place(structure)};
}

}  // namespace hysteron
