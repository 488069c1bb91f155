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

/// Variance of the noise of each output as one model shows it, where nothing is stated: the geometric mean of scatter
/// and mean square, which are the same where only white noise is left.
std::vector<double> variance_shown(const Evidence& evidence, const LeftSums& left) {
  const std::size_t outputs = evidence.model().outputs().size();
  std::vector<double> squares(outputs), scatters(outputs), rows(outputs), variance(outputs);
  for (const auto& l : left) {
    const auto o = static_cast<std::size_t>(l.output);
    squares[o] += l.all();
    scatters[o] += l.scatter * static_cast<double>(l.rows);
    rows[o] += static_cast<double>(l.rows);
  }
  for (std::size_t o = 0; o < outputs; ++o)
    if (rows[o] > 0) variance[o] = std::sqrt(squares[o] * scatters[o]) / rows[o];
  return variance;
}

}  // namespace

double least_variance(const Evidence& evidence, int output) {
  const auto& noise = evidence.noise().outputs[static_cast<std::size_t>(output)];
  const double least = noise_floor(evidence.model(), output, noise.resolution);
  return least * least;
}

double PieceSums::all() const { return std::accumulate(squares.begin(), squares.end(), 0.0); }

std::vector<LeftRows> left_rows(const Evidence& evidence, Prediction prediction, const NoiseModel& weights) {
  const DataModel& model = evidence.model();
  add_zeros(model, Judge(model, weights), prediction);
  std::vector<LeftRows> list;
  for (const int r : evidence.recordings())
    for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o)
      if (!model.measured(r, o).empty()) {
        Rows rows = residual_rows(model, prediction, r, o);
        evidence.line_of_user(o).take_out(static_cast<std::size_t>(r), rows);
        list.push_back({r, o, std::move(rows)});
      }
  return list;
}

LeftSums left_sums(const std::vector<LeftRows>& left) {
  LeftSums list;
  for (const auto& l : left) {
    PieceSums sums{l.recording, l.output, l.rows.size(), {}, scatter(l.rows), correlation_rows(l.rows)};
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

BlockScore::BlockScore(const Evidence& evidence, const std::vector<LeftSums>& models) {
  LeftSums least = models.front();
  std::vector<double> s2 = variance_shown(evidence, least);
  for (const auto& left : models) {
    const auto shown = variance_shown(evidence, left);
    for (std::size_t o = 0; o < s2.size(); ++o) s2[o] = std::min(s2[o], shown[o]);
    for (std::size_t k = 0; k < least.size(); ++k)
      least[k].correlation = std::min(least[k].correlation, left[k].correlation);
  }
  for (std::size_t o = 0; o < s2.size(); ++o) {
    const auto& noise = evidence.noise().outputs[o];
    if (noise.white_is_stated()) s2[o] = noise.white * noise.white;
    s2[o] = std::max(s2[o], least_variance(evidence, static_cast<int>(o)));
  }
  for (std::size_t k = 0; k < least.size(); ++k) {
    const auto& l = least[k];
    recording_.push_back(l.recording);
    if (l.rows == 0) continue;
    const double tau = l.correlation, rows = static_cast<double>(l.rows);
    const std::size_t pieces = l.squares.size();
    const auto fitting = static_cast<std::size_t>(std::max(1.0, std::floor(rows / (least_block * tau))));
    const std::size_t blocks = blocks_of(pieces, std::min(most_blocks, fitting));
    for (std::size_t b = 0; b < blocks; ++b) {
      Block block{k, b * pieces / blocks, (b + 1) * pieces / blocks, 0, 0, s2[static_cast<std::size_t>(l.output)]};
      const auto row_at = [&](std::size_t piece) { return (piece * l.rows + pieces - 1) / pieces; };
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

std::vector<double> BlockScore::chi2_of(const LeftSums& left) const {
  std::vector<double> chi2(left.size(), 0.0);
  for (const auto& b : blocks_)
    for (std::size_t i = b.first; i < b.last; ++i) chi2[b.of] += left[b.of].squares[i] / b.s2;
  return chi2;
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

bool BlockScore::leaves_little(const LeftSums& left, const LeftSums& before) const {
  constexpr double tenth = 0.1;
  const double now = std::pow(over_noise(left), 2);
  return now - 1 <= tenth * tenth * (std::pow(over_noise(before), 2) - now);
}

// No colour of noise that nobody stated.
NoiseModel BlockScore::weights(const Evidence& evidence, const LeftSums& left) const {
  NoiseModel weights = evidence.noise();
  std::vector<double> rows(weights.outputs.size()), sure(rows);
  for (const auto& b : blocks_) {
    const auto& l = left[b.of];
    const auto o = static_cast<std::size_t>(l.output);
    auto& pieces = weights.outputs[o].pieces;
    pieces.resize(static_cast<std::size_t>(evidence.model().n_recordings()));
    auto& own = pieces[static_cast<std::size_t>(l.recording)];
    own.resize(l.squares.size());
    double rss = 0;
    for (std::size_t i = b.first; i < b.last; ++i) rss += l.squares[i];
    const double variance = (b.s2 + rss / b.rows) * b.rows / b.n;
    for (std::size_t i = b.first; i < b.last; ++i) own[i] = std::sqrt(variance);
    rows[o] += b.rows;
    sure[o] += b.rows / variance;
  }
  for (std::size_t o = 0; o < weights.outputs.size(); ++o) {
    if (!(rows[o] > 0)) continue;
    auto& w = weights.outputs[o];
    w.white = std::sqrt(rows[o] / sure[o]);
    w.one_over_f = 0;
    w.share_is_stated = true;
    w.left_out = evidence.line_of_user(static_cast<int>(o));
  }
  return weights;
}

}  // namespace hysteron
