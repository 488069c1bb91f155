// Numbers taken row by row are those of whole traces, for any number of samples at once.
#include "fit/study/reducers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "fit/numerics/draws.h"
#include "fit/signals/features.h"

namespace hysteron {
namespace {

constexpr long rows = 400;
constexpr int samples = 21;

std::vector<double> instants() {
  std::vector<double> t;
  for (long k = 0; k < rows; ++k) t.push_back(0.5 + 0.01 * static_cast<double>(k));
  return t;
}

/// Signal 0: a drive; 1: a loop over it, noisy, with an offset; 2: a step response.
double signal(int s, int sample, long k) {
  const double u = 3 + 3 * std::sin(0.031 * static_cast<double>(k) * (1 + 0.1 * sample));
  const double noise =
      draws::uniform(5, static_cast<std::uint64_t>(sample * 4 + s), static_cast<std::uint64_t>(k)) - 0.5;
  if (s == 0) return u;
  if (s == 1) return 100 - 2 * u + 0.3 * std::cos(0.031 * static_cast<double>(k)) + 0.01 * noise;
  const double x = 0.02 * static_cast<double>(k);
  return (sample % 2 == 0 ? 1 : -1) * (1 - std::exp(-x) * std::cos(5 * x)) + 0.001 * noise;
}

std::vector<TraceFeature> every_feature() {
  std::vector<TraceFeature> list;
  std::vector<double> column;
  for (long k = 0; k < rows; ++k) column.push_back(0.25 * std::sin(0.1 * static_cast<double>(k)));
  for (std::size_t take = 0; take < trace_takes().size(); ++take)
    for (const auto& [first, last] : {std::pair<long, long>{0, rows}, {37, 38}, {100, 301}})
      for (int variant = 0; variant < 4; ++variant) {
        TraceFeature f;
        f.take = static_cast<Take>(take);
        f.signal = variant == 3 ? 2 : 1;
        f.first = first;
        f.last = last;
        f.at = 0.5 + 0.01 * (static_cast<double>(first) + 0.3) - (variant == 2 ? 9 : 0);
        if (variant == 1) f.minus = 2;
        if (variant == 1) f.rezero = true;
        if (variant == 2) f.less = column;
        if (f.take == Take::area) f.over = variant == 3 ? 1 : 0;
        list.push_back(f);
      }
  return list;
}

/// From the whole trace.
double expected(TraceFeature f, int sample) {
  if (f.take == Take::at) f.first = 0, f.last = rows;
  std::vector<double> x, y, t;
  const auto all = instants();
  for (long k = f.first; k < f.last; ++k) {
    double v = signal(f.signal, sample, k);
    if (f.minus >= 0) v -= signal(f.minus, sample, k);
    if (!f.less.empty()) v -= f.less[static_cast<std::size_t>(k)];
    y.push_back(v);
    t.push_back(all[static_cast<std::size_t>(k)]);
    if (f.over >= 0) x.push_back(signal(f.over, sample, k));
  }
  const double zero = y.front();
  if (f.rezero)
    for (auto& v : y) v -= zero;
  switch (f.take) {
    case Take::at:
      return features::value_at(t, y, f.at);
    case Take::first:
      return y.front();
    case Take::last:
      return y.back();
    case Take::min:
      return features::smallest(y);
    case Take::max:
      return features::largest(y);
    case Take::stroke:
      return features::stroke(y);
    case Take::mean:
      return features::mean(y);
    case Take::rms:
      return features::rms(y);
    case Take::deviation:
      return features::deviation(y);
    case Take::max_abs:
      return features::largest_size(y);
    case Take::sum_squares:
      return features::sum_of_squares(y);
    case Take::area:
      return features::loop_area(x, y);
    case Take::remanence:
      return features::remanence(y);
    case Take::overshoot:
      return features::overshoot(y);
  }
  return 0;
}

/// values[feature][sample], with so many samples at once. `spoiled`: this sample is not finite in this row.
std::vector<std::vector<double>> reduced(const std::vector<TraceFeature>& list, int lanes, int spoiled = -1,
                                         long spoiled_row = 0) {
  Reducers reducers(list, instants(), lanes);
  std::vector<std::vector<double>> all(list.size(), std::vector<double>(samples));
  const auto width = static_cast<std::size_t>(lanes);
  std::vector<double> row(3 * width), values(list.size() * width);
  for (int begin = 0; begin < samples; begin += lanes) {
    for (long k = 0; k < rows; ++k) {
      for (int s = 0; s < 3; ++s)
        for (int l = 0; l < lanes; ++l) {
          const int sample = std::min(begin + l, samples - 1);
          row[static_cast<std::size_t>(s) * width + static_cast<std::size_t>(l)] =
              sample == spoiled && k == spoiled_row ? std::numeric_limits<double>::infinity() : signal(s, sample, k);
        }
      reducers.row(k, row.data());
    }
    reducers.values(values.data());
    for (std::size_t f = 0; f < list.size(); ++f)
      for (int l = 0; l < lanes && begin + l < samples; ++l)
        all[f][static_cast<std::size_t>(begin + l)] = values[f * width + static_cast<std::size_t>(l)];
  }
  return all;
}

TEST(Reducers, TakeTheSameNumbersAsFromWholeTraces) {
  const auto list = every_feature();
  const auto found = reduced(list, 1);
  for (std::size_t f = 0; f < list.size(); ++f)
    for (int sample = 0; sample < samples; ++sample) {
      const double right = expected(list[f], sample), got = found[f][static_cast<std::size_t>(sample)];
      // The same operations in the same order, but for the deviation: one pass in place of two, so that rounding of
      // some hundred rows of numbers near 100 remains.
      if (list[f].take == Take::deviation)
        EXPECT_NEAR(got, right, 1e-12) << f;
      else
        EXPECT_EQ(got, right) << trace_takes()[static_cast<std::size_t>(list[f].take)] << " " << f << " sample "
                              << sample;
    }
}

TEST(Reducers, GiveTheSameBitsForAnyNumberOfSamplesAtOnce) {
  const auto list = every_feature();
  const auto one = reduced(list, 1);
  for (const int lanes : {2, 3, 8, 16, samples}) {
    const auto several = reduced(list, lanes);
    for (std::size_t f = 0; f < list.size(); ++f)
      EXPECT_EQ(std::memcmp(one[f].data(), several[f].data(), samples * sizeof(double)), 0) << f << " in " << lanes;
  }
}

TEST(Reducers, ATraceThatIsNotFiniteGivesNoNumberAndSpoilsNoOther) {
  const auto list = every_feature();
  const auto right = reduced(list, 8), found = reduced(list, 8, 5, 120);
  for (std::size_t f = 0; f < list.size(); ++f) {
    if (list[f].take == Take::at) continue;  // of two rows alone, none of them spoiled
    const bool inside = list[f].first <= 120 && 120 < list[f].last;
    EXPECT_EQ(std::isnan(found[f][5]), inside) << f;
    for (const std::size_t other : {4U, 6U, 13U}) EXPECT_EQ(found[f][other], right[f][other]);
  }
}

}  // namespace
}  // namespace hysteron
