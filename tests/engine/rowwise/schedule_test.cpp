// Points of a run and the values of its inputs there: where they are those of the caller, and where they are laid out
// anew; both ways give the same numbers.
#include "engine/rowwise/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

std::vector<double> uneven(int n) {
  std::vector<double> t;
  for (int k = 0; k < n; ++k) t.push_back(0.001 * (k + 0.3 * std::sin(5.0 * k)));
  return t;
}

SeriesPointer wave(const std::vector<double>& t, Between between = Between::linear) {
  std::vector<double> v;
  for (const double s : t) v.push_back(std::cos(31 * s) - 0.2 * std::sin(83 * s));
  return std::make_shared<const Series>(Series{t, v, between});
}

Schedule::Instants shared(std::vector<double> t) { return std::make_shared<const std::vector<double>>(std::move(t)); }

std::vector<double> listed(std::span<const double> numbers) { return {numbers.begin(), numbers.end()}; }

TEST(Schedule, InstantsThatAreTheSamplesAreNotCopied) {
  const auto instants = shared(uneven(101));
  const auto input = wave(*instants);
  const Schedule schedule(instants, {input});
  EXPECT_EQ(schedule.t.data(), instants->data());
  EXPECT_EQ(schedule.values[0].data(), input->v.data());
  EXPECT_TRUE(schedule.one_to_one);
}

TEST(Schedule, SamplesBetweenTheInstantsArePointsToo) {
  // Every second sample is an instant: the points are those of all of them, and the numbers are the same to the last
  // bit, whether they are taken over or laid out.
  const auto samples = uneven(101);
  std::vector<double> every_second;
  for (std::size_t i = 0; i < samples.size(); i += 2) every_second.push_back(samples[i]);
  const auto input = wave(samples);
  const Schedule taken(shared(samples), {input}), laid_out(shared(every_second), {input});
  EXPECT_EQ(listed(laid_out.t), samples);
  EXPECT_EQ(listed(laid_out.values[0]), listed(taken.values[0]));
  EXPECT_EQ(laid_out.h, taken.h);
  EXPECT_EQ(laid_out.kind, taken.kind);
  EXPECT_EQ(laid_out.lengths, taken.lengths);
  EXPECT_EQ(laid_out.start_branch, taken.start_branch);
  EXPECT_FALSE(laid_out.one_to_one);
  for (std::size_t i = 0; i < every_second.size(); ++i) EXPECT_EQ(laid_out.point_of(i), 2 * i);
}

TEST(Schedule, BetweenSamplesInputsMoveInStraightLines) {
  const auto input = std::make_shared<const Series>(Series{{0, 2}, {1, 5}, Between::linear});
  const Schedule schedule(shared({0, 0.5, 1, 2, 3}), {input});
  // 1 + 2 t, exact in binary; behind the last sample it stays.
  EXPECT_EQ(listed(schedule.values[0]), (std::vector<double>{1, 2, 3, 5, 5}));
  EXPECT_EQ(schedule.h, (std::vector<double>{0, 0.5, 0.5, 1, 1}));
  EXPECT_EQ(schedule.kind, (std::vector<int>{-1, 0, 0, 1, 1}));
}

TEST(Schedule, InstantsThatRoundingAloneTellsApartAreOnePoint) {
  const double again = std::nextafter(0.2, 1);
  const auto instants = shared({0, 0.1, 0.2, again, 0.3});
  const Schedule schedule(instants, {wave({0, 1})});
  EXPECT_EQ(listed(schedule.t), (std::vector<double>{0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(schedule.point_of(3), 2U);
  EXPECT_EQ(schedule.point_of(4), 3U);
}

TEST(Schedule, AHeldInputJumpsAtAPointOfItsOwn) {
  const auto instants = shared({0, 1, 2});
  const auto input = std::make_shared<const Series>(Series{*instants, {3, 4, 4}, Between::hold});
  const Schedule schedule(instants, {input});
  EXPECT_EQ(listed(schedule.t), (std::vector<double>{0, 1, 1, 2}));
  EXPECT_EQ(listed(schedule.values[0]), (std::vector<double>{3, 3, 4, 4}));
  EXPECT_EQ(schedule.h, (std::vector<double>{0, 1, 0, 1}));
  EXPECT_EQ(schedule.point_of(1), 2U);
}

}  // namespace
}  // namespace hysteron
