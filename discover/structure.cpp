// Decides which generic structure stands out in a residual. See structure.h.
//
// Each structure is fitted by linear least squares on whitened columns: lines in time with a phase of their own in
// every recording, lines and kinks in a level with one shape for all, fitted on train and judged on validate. Levels
// are those of the simulated output: the measured one contains the noise, which would then explain itself.
#include "discover/structure.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "discover/investigation.h"
#include "fit/branches.h"

namespace hysteron {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// What is looked at of one recording.
struct Part {
  int recording = 0;
  bool train = false;
  Rows t, e, y, u;  ///< e: residual less the best common gain and offset
  Vector w;         ///< e, whitened
};

class Search {
 public:
  Search(const Evidence& evidence, const Prediction& prediction, int output)
      : evidence_(evidence), model_(evidence.model()), output_(output), input_(evidence.model().main_input()) {
    Prediction with_zeros = prediction;
    add_zeros(model_, evidence_.judge(), with_zeros);
    const auto& noise = evidence_.noise().outputs[static_cast<std::size_t>(output_)];
    white_ = noise.white;
    for (const int r : evidence_.recordings()) {
      if (model_.measured(r, output_).size() < 16) continue;
      Part p;
      p.recording = r;
      p.train = model_.recording(r).role == Role::train;
      p.t = model_.times(r);
      p.y = with_zeros.y[static_cast<std::size_t>(r)][static_cast<std::size_t>(output_)];
      p.e = residual_rows(model_, with_zeros, r, output_);
      if (input_ >= 0) p.u = model_.input(r, input_);
      filters_.emplace_back(p.e.size(), noise.white, noise.one_over_f, model_.zero_per_recording(output_));
      p.w = whitened(filters_.back(), p.e);
      before_ += p.train ? 0 : p.w.squaredNorm();
      parts_.push_back(std::move(p));
      floor_ += parts_.back().train ? 0 : static_cast<double>(parts_.back().w.size());
    }
    take_off_gain_and_offset();
  }

  std::optional<Structure> best() {
    if (parts_.empty() || beyond_ <= 0) return std::nullopt;
    line_in_time();
    line_in_level();
    for (const bool of_input : {true, false}) kink(of_input);
    jumps();
    if (!best_ || best_->fall_validate <= 0) return std::nullopt;
    best_->output = model_.outputs()[static_cast<std::size_t>(output_)];
    best_->beyond_calibration = beyond_;
    // Where a gain and an offset leave hardly more than noise, there is nothing that a structure could hold.
    const double excess = beyond_ > rules::floor_gate * floor_ ? beyond_ - floor_ : before_ - floor_;
    best_->share_removed = excess > 0 ? std::min(1.0, best_->fall_validate / excess) : 0;
    best_->sentence = sentence(*best_);
    return best_;
  }

 private:
  static Vector whitened(const Whitener& filter, const Rows& rows) {
    Vector w(static_cast<Eigen::Index>(filter.size()));
    filter.apply(rows, w.data());
    return w;
  }

  /// Least squares of the whitened residuals of some parts on columns made by `columns`.
  Vector solve(const std::vector<const Part*>& parts,
               const std::function<std::vector<Rows>(const Part&)>& columns) const {
    Matrix normal;
    Vector right;
    for (const Part* p : parts) {
      const Matrix a = column_matrix(*p, columns);
      if (normal.size() == 0) {
        normal = Matrix::Zero(a.cols(), a.cols());
        right = Vector::Zero(a.cols());
      }
      normal += a.transpose() * a;
      right += a.transpose() * p->w;
    }
    // Scaled, so that columns of different size do not decide the rank.
    const Vector scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Matrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    return scale.asDiagonal() * scaled.completeOrthogonalDecomposition().solve(Vector(scale.asDiagonal() * right));
  }
  Matrix column_matrix(const Part& p, const std::function<std::vector<Rows>(const Part&)>& columns) const {
    const auto rows = columns(p);
    Matrix a(p.w.size(), static_cast<Eigen::Index>(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k)
      a.col(static_cast<Eigen::Index>(k)) = whitened(filters_[index(p)], rows[k]);
    return a;
  }
  std::size_t index(const Part& p) const { return static_cast<std::size_t>(&p - parts_.data()); }

  std::vector<const Part*> train() const {
    std::vector<const Part*> list;
    for (const auto& p : parts_)
      if (p.train) list.push_back(&p);
    return list;
  }

  /// A wrong gain or zero is a known effect, and would let every structure look good.
  void take_off_gain_and_offset() {
    const auto columns = [](const Part& p) { return std::vector<Rows>{Rows(p.y.size(), 1.0), p.y}; };
    if (train().empty()) return;
    const Vector c = solve(train(), columns);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& p = parts_[i];
      for (std::size_t k = 0; k < p.e.size(); ++k) p.e[k] -= c[0] + c[1] * p.y[k];
      p.w = whitened(filters_[i], p.e);
      beyond_ += p.train ? 0 : p.w.squaredNorm();
    }
  }

  void offer(Structure s, double fall) {
    s.fall_validate = fall;
    if (!best_ || fall > best_->fall_validate) best_ = std::move(s);
  }

  /// Fall on validate of a shape fitted on train.
  double judged(const std::function<std::vector<Rows>(const Part&)>& columns) const {
    if (train().empty()) return 0;
    const Vector c = solve(train(), columns);
    double fall = 0;
    for (const auto& p : parts_)
      if (!p.train) fall += p.w.squaredNorm() - (p.w - column_matrix(p, columns) * c).squaredNorm();
    return fall;
  }

  // --- a line in time: interference
  // -----------------------------------------------------------------------------------

  double line_fall(double f, bool validate_only) const {
    double fall = 0;
    for (const auto& p : parts_) {
      if (validate_only && p.train) continue;
      const double step = (p.t.back() - p.t.front()) / static_cast<double>(p.t.size() - 1);
      if (f * step > 0.45 || f * (p.t.back() - p.t.front()) < 2) continue;
      const auto columns = [f](const Part& q) {
        Rows c(q.t.size()), s(q.t.size());
        for (std::size_t k = 0; k < q.t.size(); ++k) {
          const double phase = 2 * std::numbers::pi * f * (q.t[k] - q.t.front());
          c[k] = std::cos(phase);
          s[k] = std::sin(phase);
        }
        return std::vector<Rows>{c, s};
      };
      const Matrix a = column_matrix(p, columns);
      const Vector x = a.householderQr().solve(p.w);
      fall += p.w.squaredNorm() - (p.w - a * x).squaredNorm();
    }
    return fall;
  }

  void line_in_time() {
    // Candidates: the strongest cosine coefficients of each recording; a line in one of them is tried in all.
    std::vector<double> candidates;
    for (const auto& p : parts_) {
      std::vector<std::size_t> order(static_cast<std::size_t>(p.w.size()));
      for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
      const std::size_t keep = std::min<std::size_t>(4, order.size());
      std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(keep), order.end(),
                        [&](std::size_t a, std::size_t b) {
                          return std::abs(p.w[static_cast<Eigen::Index>(a)]) >
                                 std::abs(p.w[static_cast<Eigen::Index>(b)]);
                        });
      for (std::size_t k = 0; k < keep; ++k)
        if (order[k] >= 4) candidates.push_back(static_cast<double>(order[k]) / (2 * (p.t.back() - p.t.front())));
    }
    double best_f = 0;
    double best_fall = 0;
    for (const double f : candidates)
      if (const double fall = line_fall(f, false); fall > best_fall) best_f = f, best_fall = fall;
    if (best_f <= 0) return;
    for (double width = 0.02; width > 1e-5; width /= 3)
      for (const int k : {-2, -1, 1, 2}) {
        const double f = best_f * (1 + k * width / 2);
        if (const double fall = line_fall(f, false); fall > best_fall) best_f = f, best_fall = fall;
      }
    Structure s;
    s.kind = "line_in_time";
    s.variable = "t";
    s.period = 1 / best_f;
    s.unit = parse_unit("s");
    // Amplitude and phase of each validation recording are its own: two numbers per recording are paid for.
    offer(s,
          line_fall(best_f, true) - 4.0 * static_cast<double>(std::count_if(parts_.begin(), parts_.end(),
                                                                            [](const Part& p) { return !p.train; })));
  }

  // --- a line in level: fringes, gear teeth
  // ----------------------------------------------------------------------------

  static std::pair<double, double> range(const std::vector<Part>& parts, bool of_input) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto& p : parts) {
      const auto& x = of_input ? p.u : p.y;
      if (x.empty()) return {0, 0};
      const auto [a, b] = std::minmax_element(x.begin(), x.end());
      low = std::min(low, *a);
      high = std::max(high, *b);
    }
    return {low, high};
  }

  /// Squared amplitude of a ripple with wave number k in the residual over the level, train recordings only.
  double ripple_power(double k, double low) const {
    double c = 0, s = 0, n = 0;
    for (const Part* p : train())
      for (std::size_t i = 0; i < p->y.size(); ++i) {
        c += p->e[i] * std::cos(k * (p->y[i] - low));
        s += p->e[i] * std::sin(k * (p->y[i] - low));
        n += 1;
      }
    return n > 0 ? (c * c + s * s) / n : 0;
  }

  void line_in_level() {
    const auto [low, high] = range(parts_, false);
    const double span = high - low;
    if (!(span > 0)) return;
    const auto fall = [&](double lines) {
      const double k = 2 * std::numbers::pi * lines / span;
      return judged([&, k, low_ = low](const Part& p) {
        Rows c(p.y.size()), s(p.y.size());
        for (std::size_t i = 0; i < p.y.size(); ++i) {
          c[i] = std::cos(k * (p.y[i] - low_));
          s[i] = std::sin(k * (p.y[i] - low_));
        }
        return std::vector<Rows>{c, s};
      });
    };
    // Screened on plain rows, where a trial costs a tenth; the best few are judged whitened.
    std::vector<std::pair<double, double>> screened;
    for (double lines = 3; lines <= 130; lines += 0.5)
      screened.emplace_back(ripple_power(2 * std::numbers::pi * lines / span, low), lines);
    std::partial_sort(screened.begin(), screened.begin() + 6, screened.end(), std::greater<>());
    double best_lines = 0;
    double best_fall = 0;
    for (std::size_t k = 0; k < 6; ++k)
      if (const double f = fall(screened[k].second); f > best_fall) best_lines = screened[k].second, best_fall = f;
    if (best_lines <= 0) return;
    for (double width = 0.25; width > 0.01; width /= 2)
      for (const int k : {-1, 1})
        if (const double f = fall(best_lines + k * width); f > best_fall) best_lines += k * width, best_fall = f;
    Structure s;
    s.kind = "line_in_level";
    s.variable = model_.outputs()[static_cast<std::size_t>(output_)];
    s.period = span / best_lines;
    s.unit = model_.program().signals[static_cast<std::size_t>(model_.output_signal(output_))].unit;
    offer(s, best_fall);
  }

  // --- a kink or step at a level
  // --------------------------------------------------------------------------------------

  void kink(bool of_input) {
    if (of_input && input_ < 0) return;
    const auto [low, high] = range(parts_, of_input);
    if (!(high > low)) return;
    double best_level = 0;
    double best_fall = 0;
    const auto fall_at = [&](double level) {
      return judged([&](const Part& p) {
        const auto& x = of_input ? p.u : p.y;
        Rows step(x.size()), slope(x.size());
        for (std::size_t k = 0; k < x.size(); ++k) {
          step[k] = x[k] > level ? 1.0 : 0.0;
          slope[k] = std::max(x[k] - level, 0.0);
        }
        return std::vector<Rows>{Rows(x.size(), 1.0), x, step, slope};
      });
    };
    const double width = (high - low) / 40;
    for (int i = 2; i < 39; ++i)
      if (const double fall = fall_at(low + i * width); fall > best_fall)
        best_level = low + i * width, best_fall = fall;
    // A step of many times the noise is placed to a row: half a division off, it explains half of itself.
    for (double w = width / 2; best_fall > 0 && w > width / 200; w /= 2)
      for (const int side : {-1, 1})
        if (const double fall = fall_at(best_level + side * w); fall > best_fall) {
          best_level += side * w;
          best_fall = fall;
          break;
        }
    if (best_fall <= 0) return;
    Structure s;
    s.kind = "kink_at_level";
    s.variable = of_input ? model_.program().input_names[static_cast<std::size_t>(input_)]
                          : model_.outputs()[static_cast<std::size_t>(output_)];
    s.threshold = best_level;
    s.has_threshold = true;
    s.unit = of_input ? model_.program().input_units[static_cast<std::size_t>(input_)]
                      : model_.program().signals[static_cast<std::size_t>(model_.output_signal(output_))].unit;
    offer(s, best_fall);
  }

  // --- jumps
  // ----------------------------------------------------------------------------------------------------------

  /// Rows behind which the residual jumps: by more than six times the noise, alone among its neighbours, and not with
  /// u.
  std::vector<std::size_t> jumps_of(const Part& p) const {
    const std::size_t n = p.e.size();
    double u_span = 0;
    if (!p.u.empty()) {
      const auto [a, b] = std::minmax_element(p.u.begin(), p.u.end());
      u_span = *b - *a;
    }
    std::vector<std::size_t> found;
    for (std::size_t k = 1; k < n; ++k) {
      const double d = std::abs(p.e[k] - p.e[k - 1]);
      if (d < 6 * white_) continue;
      bool moved = false;
      for (std::size_t j = k > 1 ? k - 1 : 1; j <= std::min(k + 1, n - 1) && u_span > 0; ++j)
        moved = moved || std::abs(p.u[j] - p.u[j - 1]) > 0.1 * u_span;
      if (moved) continue;
      std::vector<double> around;
      for (std::size_t j = k > 6 ? k - 6 : 1; j <= std::min(k + 6, n - 1); ++j)
        if (j != k) around.push_back(std::abs(p.e[j] - p.e[j - 1]));
      std::nth_element(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2), around.end());
      if (d > 4 * around[around.size() / 2]) found.push_back(k);
    }
    if (found.size() * 10 > n) found.clear();  // that many are no jumps but a rough residual
    return found;
  }

  void jumps() {
    Structure s;
    s.kind = "jumps";
    s.variable = "t";
    s.unit = parse_unit("s");
    double fall = 0;
    std::vector<double> at_y, at_u;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Part& p = parts_[i];
      const auto at = jumps_of(p);
      if (at.empty()) continue;
      std::vector<std::pair<double, double>> intervals;
      for (const std::size_t k : at) {
        intervals.emplace_back(p.t[k - 1], p.t[k]);
        at_y.push_back(p.y[k]);
        if (!p.u.empty()) at_u.push_back(p.u[k]);
      }
      s.intervals.emplace_back(model_.recording(p.recording).name, std::move(intervals));
      if (p.train) continue;
      Rows left = p.e;
      std::size_t begin = 0;
      for (std::size_t j = 0; j <= at.size(); ++j) {
        const std::size_t end = j < at.size() ? at[j] : left.size();
        double mean = 0;
        for (std::size_t k = begin; k < end; ++k) mean += left[k];
        mean /= static_cast<double>(end - begin);
        for (std::size_t k = begin; k < end; ++k) left[k] -= mean;
        begin = end;
      }
      // Each jump is paid for by its place and its height.
      fall += p.w.squaredNorm() - whitened(filters_[i], left).squaredNorm() -
              2 * std::log(static_cast<double>(left.size())) * static_cast<double>(at.size());
    }
    if (s.intervals.empty()) return;
    share_one_level(s, at_y, false);
    share_one_level(s, at_u, true);
    offer(s, fall);
  }

  /// Jumps that all happen at one level belong to that level: a threshold.
  void share_one_level(Structure& s, std::vector<double> at, bool of_input) const {
    if (at.size() < 4) return;
    std::sort(at.begin(), at.end());
    const auto [low, high] = range(parts_, of_input);
    if (at[at.size() * 3 / 4] - at[at.size() / 4] > 0.03 * (high - low)) return;
    s.threshold = at[at.size() / 2];
    s.has_threshold = true;
    s.variable = of_input ? model_.program().input_names[static_cast<std::size_t>(input_)]
                          : model_.outputs()[static_cast<std::size_t>(output_)];
    s.unit = of_input ? model_.program().input_units[static_cast<std::size_t>(input_)]
                      : model_.program().signals[static_cast<std::size_t>(model_.output_signal(output_))].unit;
  }

  std::string sentence(const Structure& s) const {
    const std::string share =
        fmt::format("{:.0f} % of what stands above the noise on validation recordings", 100 * s.share_removed);
    if (s.kind == "line_in_time")
      return fmt::format("a line at {:.4g} Hz in the residual of {} holds {}", 1 / s.period, s.output, share);
    if (s.kind == "line_in_level")
      return fmt::format("a ripple over {} with period {:.4g} {} holds {}", s.variable,
                         s.unit.difference_from_si(s.period), s.unit.text, share);
    if (s.kind == "kink_at_level")
      return fmt::format("a kink at {} = {:.4g} {} holds {}", s.variable, s.unit.from_si(s.threshold), s.unit.text,
                         share);
    std::size_t n = 0;
    for (const auto& [name, list] : s.intervals) n += list.size();
    if (s.has_threshold)
      return fmt::format("{} jumps of the residual of {}, all at {} = {:.4g} {}, hold {}", n, s.output, s.variable,
                         s.unit.from_si(s.threshold), s.unit.text, share);
    return fmt::format("{} jumps of the residual of {} in {} recordings, at no common level, hold {}", n, s.output,
                       s.intervals.size(), share);
  }

  const Evidence& evidence_;
  const DataModel& model_;
  int output_;
  int input_;
  double white_ = 0;
  std::vector<Whitener> filters_;
  std::vector<Part> parts_;
  double before_ = 0, beyond_ = 0, floor_ = 0;  ///< chi2 on validate: as it is, without gain and offset, of noise alone
  std::optional<Structure> best_;
};

}  // namespace

std::optional<Structure> find_structure(const Evidence& evidence, const Prediction& prediction) {
  std::optional<Structure> best;
  for (int o = 0; o < static_cast<int>(evidence.model().outputs().size()); ++o)
    if (auto s = Search(evidence, prediction, o).best(); s && (!best || s->fall_validate > best->fall_validate))
      best = std::move(s);
  return best;
}

}  // namespace hysteron
