#include "discover/selection/block_score.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hysteron {
namespace {

constexpr double uncorrelated = 0.05;
constexpr double least_block = 4;        // correlation times
constexpr std::size_t most_blocks = 16;  // per recording and output

double mean_square(const Rows& rows) {
  double sum = 0;
  for (const double v : rows) sum += v * v;
  return rows.empty() ? 0 : sum / static_cast<double>(rows.size());
}

/// Half the mean square of the change from row to row: of white noise its variance.
double scatter(const Rows& rows) {
  double sum = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) sum += (rows[i] - rows[i - 1]) * (rows[i] - rows[i - 1]);
  return rows.size() < 2 ? 0 : sum / (2 * static_cast<double>(rows.size() - 1));
}

double autocorrelation(const Rows& rows, std::size_t lag, double squares) {
  double sum = 0;
  for (std::size_t i = lag; i < rows.size(); ++i) sum += rows[i] * rows[i - lag];
  return sum / squares;
}

/// The largest number of blocks that pieces can be put together to, at most `wanted`.
std::size_t blocks_of(std::size_t pieces, std::size_t wanted) {
  std::size_t n = std::max<std::size_t>(1, std::min(pieces, wanted));
  while (pieces % n != 0) --n;
  return n;
}

struct PerOutput {
  double squares = 0, scatter = 0, rows = 0;
};

std::vector<PerOutput> per_output(const Evidence& evidence, const std::vector<LeftRows>& left) {
  std::vector<PerOutput> sums(evidence.model().outputs().size());
  for (const auto& l : left) {
    auto& s = sums[static_cast<std::size_t>(l.output)];
    const auto n = static_cast<double>(l.rows.size());
    s.squares += n * mean_square(l.rows);
    s.scatter += n * scatter(l.rows);
    s.rows += n;
  }
  for (auto& s : sums)
    if (s.rows > 0) s.squares /= s.rows, s.scatter /= s.rows;
  return sums;
}

/// No instrument is better than rounding lets it be, and no logarithm is taken of zero [SI squared].
double floor_of(const Evidence& evidence, int output) {
  const auto& noise = evidence.noise().outputs[static_cast<std::size_t>(output)];
  const double least = noise_floor(evidence.model(), output, noise.resolution);
  return least * least;
}

}  // namespace

double PieceSums::all() const { return std::accumulate(squares.begin(), squares.end(), 0.0); }

std::vector<LeftRows> left_rows(const Evidence& evidence, Prediction prediction) {
  const DataModel& model = evidence.model();
  add_zeros(model, evidence.judge(), prediction);
  std::vector<LeftRows> list;
  for (const int r : evidence.recordings())
    for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o)
      if (!model.measured(r, o).empty()) list.push_back({r, o, residual_rows(model, prediction, r, o)});
  return list;
}

LeftSums left_sums(const std::vector<LeftRows>& left) {
  LeftSums list;
  for (const auto& l : left) {
    PieceSums sums{l.recording, l.output, l.rows.size(), {}};
    sums.squares.resize(std::max<std::size_t>(1, std::min(PieceSums::pieces, l.rows.size())));
    for (std::size_t i = 0; i < l.rows.size(); ++i)
      sums.squares[i * sums.squares.size() / l.rows.size()] += l.rows[i] * l.rows[i];
    list.push_back(std::move(sums));
  }
  return list;
}

// Beyond the first lags a correlation that lasts changes slowly: lags grow further apart as they grow, and each stands
// for those about it.
double correlation_rows(const Rows& rows) {
  constexpr std::size_t one_by_one = 32;
  const double squares = mean_square(rows) * static_cast<double>(rows.size());
  if (!(squares > 0)) return 1;
  double tau = 1;
  std::size_t step = 1;
  for (std::size_t lag = 1; lag < rows.size(); lag += step) {
    const double rho = autocorrelation(rows, lag, squares);
    if (rho <= uncorrelated) break;
    tau += 2 * rho * static_cast<double>(step);
    if (lag >= one_by_one * step) step *= 2;
  }
  return tau;
}

BlockScore::BlockScore(const Evidence& evidence, const std::vector<LeftRows>& best) {
  const auto sums = per_output(evidence, best);
  std::vector<double> s2(sums.size());
  for (std::size_t o = 0; o < sums.size(); ++o) {
    const auto& noise = evidence.noise().outputs[o];
    s2[o] = noise.white_is_stated() ? noise.white * noise.white : std::sqrt(sums[o].scatter * sums[o].squares);
    s2[o] = std::max(s2[o], floor_of(evidence, static_cast<int>(o)));
  }
  for (std::size_t k = 0; k < best.size(); ++k) {
    const auto& l = best[k];
    recording_.push_back(l.recording);
    if (l.rows.empty()) continue;
    const double tau = correlation_rows(l.rows), rows = static_cast<double>(l.rows.size());
    const std::size_t pieces = std::min(PieceSums::pieces, l.rows.size());
    const auto fitting = static_cast<std::size_t>(std::max(1.0, std::floor(rows / (least_block * tau))));
    const std::size_t blocks = blocks_of(pieces, std::min(most_blocks, fitting));
    for (std::size_t b = 0; b < blocks; ++b) {
      Block block{k, b * pieces / blocks, (b + 1) * pieces / blocks, 0, 0, s2[static_cast<std::size_t>(l.output)]};
      const auto row_at = [&](std::size_t piece) { return (piece * l.rows.size() + pieces - 1) / pieces; };
      block.rows = static_cast<double>(row_at(block.last) - row_at(block.first));
      block.n = block.rows / tau;
      n_eff_ += block.n;
      blocks_.push_back(block);
    }
  }
}

double BlockScore::fit_of(const LeftSums& left) const { return fit_of(left, -1); }

double BlockScore::fit_of(const LeftSums& left, int recording) const {
  double score = 0;
  for (const auto& b : blocks_) {
    if (recording >= 0 && recording_[b.of] != recording) continue;
    const auto& squares = left[b.of].squares;
    double rss = 0;
    for (std::size_t i = b.first; i < b.last; ++i) rss += squares[i];
    score -= 0.5 * b.n * std::log(b.s2 + rss / b.rows);
  }
  return score;
}

double BlockScore::price(int numbers) const { return 0.5 * numbers * std::log(std::max(n_eff_, 2.0)); }

double BlockScore::n_eff(int recording) const {
  double n = 0;
  for (const auto& b : blocks_)
    if (recording_[b.of] == recording) n += b.n;
  return n;
}

double BlockScore::over_noise(const LeftSums& left) const {
  std::vector<double> squares, rows, s2;
  for (const auto& b : blocks_) {
    const auto o = static_cast<std::size_t>(left[b.of].output);
    if (o >= squares.size()) squares.resize(o + 1), rows.resize(o + 1), s2.resize(o + 1);
    for (std::size_t i = b.first; i < b.last; ++i) squares[o] += left[b.of].squares[i];
    rows[o] += b.rows;
    s2[o] = b.s2;
  }
  double most = 0;
  for (std::size_t o = 0; o < squares.size(); ++o)
    if (rows[o] > 0) most = std::max(most, std::sqrt(squares[o] / rows[o] / s2[o]));
  return most;
}

NoiseModel weights_by(const Evidence& evidence, const std::vector<LeftRows>& left) {
  NoiseModel weights = evidence.noise();
  std::vector<double> squares(weights.outputs.size()), rows(squares), witnesses(squares);
  for (const auto& l : left) {
    if (evidence.model().recording(l.recording).role != Role::train || l.rows.empty()) continue;
    const auto o = static_cast<std::size_t>(l.output);
    squares[o] += mean_square(l.rows) * static_cast<double>(l.rows.size());
    rows[o] += static_cast<double>(l.rows.size());
    witnesses[o] += static_cast<double>(l.rows.size()) / correlation_rows(l.rows);
  }
  for (std::size_t o = 0; o < weights.outputs.size(); ++o) {
    if (!(rows[o] > 0)) continue;
    auto& w = weights.outputs[o];
    const double variance = std::max(squares[o] / rows[o], floor_of(evidence, static_cast<int>(o)));
    w.white = std::sqrt(variance * rows[o] / witnesses[o]);
    w.one_over_f = 0;
    w.share_is_stated = true;
    w.left_out = {};
  }
  return weights;
}

}  // namespace hysteron
