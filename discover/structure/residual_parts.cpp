// Decides what generic structures are sought in. See residual_parts.h.
#include "discover/structure/residual_parts.h"

#include <algorithm>
#include <limits>

namespace hysteron {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

ResidualParts::ResidualParts(const Evidence& evidence, const Prediction& prediction, int output)
    : model_(evidence.model()), output_(output) {
  Prediction with_zeros = prediction;
  add_zeros(model_, evidence.judge(), with_zeros);
  const auto& noise = evidence.noise().outputs[static_cast<std::size_t>(output_)];
  white_ = noise.white;
  std::vector<int> recordings;
  for (const int r : evidence.recordings()) {
    if (model_.measured(r, output_).size() < 16) continue;
    recordings.push_back(r);
    ResidualPart p;
    p.recording = r;
    p.train = model_.recording(r).role == Role::train;
    p.t = model_.times(r);
    p.e = residual_rows(model_, with_zeros, r, output_);
    if (model_.main_input() >= 0) p.drive = model_.input(r, model_.main_input());
    filters_.emplace_back(p.e.size(), noise.white, noise.one_over_f, model_.zero_per_recording(output_));
    parts_.push_back(std::move(p));
    parts_.back().w = whitened(parts_.back(), parts_.back().e);
    before_.of(parts_.back().train) += parts_.back().w.squaredNorm();
    floor_.of(parts_.back().train) += static_cast<double>(parts_.back().w.size());
  }
  read_levels(recordings, with_zeros);
  take_off_gain_and_offset();
}

void ResidualParts::read_levels(const std::vector<int>& recordings, const Prediction& with_zeros) {
  const Program& program = model_.program();
  const auto add = [&](const std::string& name, const Unit& unit, const std::function<Rows(int)>& rows_of) {
    Level level{name, unit, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    std::vector<Rows> of_parts;
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      of_parts.push_back(rows_of(recordings[i]));
      if (of_parts.back().size() != parts_[i].e.size()) return;  // not recorded everywhere
      const auto [low, high] = std::minmax_element(of_parts.back().begin(), of_parts.back().end());
      level.lowest = std::min(level.lowest, *low);
      level.highest = std::max(level.highest, *high);
    }
    if (!(level.span() > 0)) return;
    levels_.push_back(level);
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i].levels.push_back(std::move(of_parts[i]));
  };
  add(model_.outputs()[static_cast<std::size_t>(output_)], model_.output_unit(output_),
      [&](int r) { return with_zeros.y[static_cast<std::size_t>(r)][static_cast<std::size_t>(output_)]; });
  for (std::size_t k = 0; k < program.input_names.size(); ++k)
    add(program.input_names[k], program.input_units[k], [&](int r) { return model_.input(r, static_cast<int>(k)); });
  if (recordings.empty()) return;
  // What was recorded besides, a temperature say. A value that stands still in a recording is a note, not a level.
  const auto& first = model_.recording(recordings.front());
  for (const auto& [name, unit] : first.units) {
    const auto known = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (name == "t" || known(program.input_names) || known(program.output_names)) continue;
    add(name, unit, [&, name = name](int r) {
      const Recording& recording = model_.recording(r);
      const auto found = recording.columns.find(name);
      if (found == recording.columns.end()) return Rows{};
      const Rows rows = recording.judged(found->second);
      const auto [low, high] = std::minmax_element(rows.begin(), rows.end());
      return rows.empty() || *low == *high ? Rows{} : rows;
    });
  }
}

// A free zero takes the mean away. Of a constant only rounding would be left, and weights found from that could be
// anything.
Vector ResidualParts::whitened(const ResidualPart& part, const Rows& rows) const {
  const Whitener& filter = filters_[index(part)];
  Vector w(static_cast<Eigen::Index>(filter.size()));
  if (!model_.zero_per_recording(output_)) {
    filter.apply(rows, w.data());
    return w;
  }
  Rows about_mean = rows;
  const double first = rows.empty() ? 0 : rows.front();  // of a constant the mean of differences is zero exactly
  double mean = 0;
  for (double& v : about_mean) mean += (v -= first) / static_cast<double>(rows.size());
  for (double& v : about_mean) v -= mean;
  filter.apply(about_mean, w.data());
  return w;
}

Rows ResidualParts::whitened_in_time(const ResidualPart& part) const {
  // A coefficient that is free per recording is not among the whitened ones: it is zero.
  const std::size_t rows = part.e.size();
  Rows row(rows, 0.0);
  std::copy_n(part.w.data(), part.w.size(), row.begin() + static_cast<std::ptrdiff_t>(rows) - part.w.size());
  inverse_cosine_transform(row);
  return row;
}

Matrix ResidualParts::column_matrix(const ResidualPart& part, const Columns& columns) const {
  const auto rows = columns(part);
  Matrix a(part.w.size(), static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) a.col(static_cast<Eigen::Index>(k)) = whitened(part, rows[k]);
  return a;
}

bool ResidualParts::has_train() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const ResidualPart& p) { return p.train; });
}

ResidualParts::WhitenedColumns ResidualParts::whitened(const Columns& columns) const {
  WhitenedColumns all;
  for (const auto& p : parts_) all.push_back(column_matrix(p, columns));
  return all;
}

Vector ResidualParts::solve_on_train(const WhitenedColumns& columns) const {
  Matrix normal;
  Vector right;
  for (const auto& p : parts_) {
    if (!p.train) continue;
    const Matrix& a = columns[index(p)];
    if (normal.size() == 0) {
      normal = Matrix::Zero(a.cols(), a.cols());
      right = Vector::Zero(a.cols());
    }
    normal += a.transpose() * a;
    right += a.transpose() * p.w;
  }
  // Scaled, so that columns of different size do not decide the rank.
  const Vector scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  return scale.asDiagonal() * scaled.completeOrthogonalDecomposition().solve(Vector(scale.asDiagonal() * right));
}

ByRole ResidualParts::judged(const Columns& columns, const WhitenedColumns& fixed) const {
  if (!has_train()) return {};
  WhitenedColumns all = whitened(columns);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    Matrix both(all[i].rows(), fixed[i].cols() + all[i].cols());
    both << fixed[i], all[i];
    all[i] = std::move(both);
  }
  const Vector c = solve_on_train(all);
  ByRole fall;
  for (const auto& p : parts_) fall.of(p.train) += p.w.squaredNorm() - (p.w - all[index(p)] * c).squaredNorm();
  return fall;
}

double ResidualParts::own_fall(const ResidualPart& part, const Columns& columns) const {
  const Matrix a = column_matrix(part, columns);
  const Vector x = a.householderQr().solve(part.w);
  return part.w.squaredNorm() - (part.w - a * x).squaredNorm();
}

/// A wrong gain or zero is a known effect, and would let every structure look good.
void ResidualParts::take_off_gain_and_offset() {
  if (!has_train() || levels_.empty()) return;
  const Vector c = solve_on_train(whitened([](const ResidualPart& p) {
    return std::vector<Rows>{Rows(p.e.size(), 1.0), p.levels.front()};
  }));
  for (auto& p : parts_) {
    for (std::size_t k = 0; k < p.e.size(); ++k) p.e[k] -= c[0] + c[1] * p.levels.front()[k];
    if (model_.zero_per_recording(output_)) {
      // What a gain that is off makes of a zero, and far from zero that is most of it, the zero takes.
      const double zero = filters_[index(p)].zero_of(p.e);
      for (double& e : p.e) e -= zero;
    }
    p.w = whitened(p, p.e);
    beyond_.of(p.train) += p.w.squaredNorm();
  }
}

}  // namespace hysteron
