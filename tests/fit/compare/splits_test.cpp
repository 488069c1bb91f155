#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/compare/compare.h"
#include "tests/fit/lab.h"

namespace hysteron {
namespace {

struct Case {
  Rows t, u, residual;
};

Case triangle_case() {
  Case c;
  lab::Noise random(4);
  for (int i = 0; i < 400; ++i) {
    const int phase = i % 200;
    c.t.push_back(0.01 * i);
    c.u.push_back(phase < 100 ? 0.01 * phase : 2 - 0.01 * phase);
    c.residual.push_back((phase < 100 ? 0.1 : 1.0) * random());
  }
  return c;
}

const Split& split(const std::vector<Split>& list, const std::string& variable) {
  for (const auto& s : list)
    if (s.variable == variable) return s;
  throw std::runtime_error("no split by " + variable);
}

TEST(Splits, SharesOfErrorAndOfRowsAddUpToOneInEverySplit) {
  const auto c = triangle_case();
  Case d;  // a second recording of other length, with holds and steps
  for (int i = 0; i < 90; ++i) {
    d.t.push_back(0.5 * i);
    d.u.push_back(i / 30);
    d.residual.push_back(0.3 * (i % 30));
  }
  for (const auto& recordings :
       {std::vector<SplitInput>{{&c.t, &c.u, &c.residual, "a"}},
        std::vector<SplitInput>{{&c.t, &c.u, &c.residual, "a"}, {&d.t, &d.u, &d.residual, "b"}}}) {
    const auto splits = splits_of(recordings, "u", parse_unit("V"));
    // The second recording adds a split by recording, by swing and by hold.
    EXPECT_EQ(splits.size(), recordings.size() > 1 ? 9U : 6U);
    for (const auto& s : splits) {
      double error = 0, rows = 0;
      for (const auto& p : s.parts) {
        error += p.error;
        rows += p.rows;
      }
      EXPECT_NEAR(error, 1, 1e-12) << s.variable;
      EXPECT_NEAR(rows, 1, 1e-12) << s.variable;
    }
  }
}

using Spans = std::vector<std::pair<double, double>>;

Spans spans_in(const SplitPart& part, const std::string& recording) {
  Spans list;
  for (const auto& in_recording : part.spans)
    if (in_recording.recording == recording)
      for (const auto& span : in_recording.spans) list.emplace_back(span.from, span.to);
  return list;
}

TEST(Splits, SpansAreWhenTheRowsOfAPartAre) {
  Case up_and_down, up;  // one row per second, 0 .. 99 V
  for (int i = 0; i < 200; ++i) {
    up_and_down.t.push_back(i);
    up_and_down.u.push_back(i < 100 ? i : 199 - i);
    up_and_down.residual.push_back(1);
  }
  for (int i = 0; i < 100; ++i) {
    up.t.push_back(1000 + i);
    up.u.push_back(i);
    up.residual.push_back(1);
  }
  const auto splits =
      splits_of({{&up_and_down.t, &up_and_down.u, &up_and_down.residual, "a"}, {&up.t, &up.u, &up.residual, "b"}}, "u",
                parse_unit("V"));
  // Fifths of 0 .. 99 V end at 19.8, 39.6, 59.4 and 79.2 V.
  const auto& level = split(splits, "level").parts;
  EXPECT_EQ(spans_in(level[0], "a"), (Spans{{0, 19}, {180, 199}}));
  EXPECT_EQ(spans_in(level[1], "a"), (Spans{{20, 39}, {160, 179}}));
  EXPECT_EQ(spans_in(level[4], "a"), (Spans{{80, 119}}));
  EXPECT_EQ(spans_in(level[4], "b"), (Spans{{1080, 1099}}));
  // Fifths of 199 s end at 39.8, 79.6, 119.4 and 159.2 s.
  EXPECT_EQ(spans_in(split(splits, "time").parts[3], "a"), (Spans{{120, 159}}));
  const auto& recording = split(splits, "recording").parts;
  EXPECT_EQ(spans_in(recording[1], "b"), (Spans{{1000, 1099}}));
  EXPECT_TRUE(spans_in(recording[1], "a").empty());
  for (const auto& part : split(splits, "frequency").parts) EXPECT_TRUE(part.spans.empty());
}

TEST(Splits, EveryRowLiesInASpanOfExactlyOnePartOfEachSplit) {
  const auto c = triangle_case();
  for (const auto& s : splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V"))) {
    if (s.variable == "frequency") continue;
    for (const double t : c.t) {
      int holding = 0;
      for (const auto& part : s.parts)
        for (const auto& [from, to] : spans_in(part, "a")) holding += from <= t && t <= to ? 1 : 0;
      ASSERT_EQ(holding, 1) << s.variable << " at " << t;
    }
  }
}

TEST(Splits, OfMoreSpansThanCanBeReadTheWidestGapsStay) {
  Rows t;
  std::vector<int> part;
  for (int i = 0; i < 300; ++i) {
    t.push_back(i + (i >= 100 ? 1000 : 0) + (i >= 200 ? 500 : 0));
    part.push_back(i % 2);
  }
  const auto spans = spans_of(t, part, 2)[0];
  ASSERT_EQ(spans.size(), most_spans);
  EXPECT_EQ(spans.front().from, 0);
  EXPECT_EQ(spans.back().to, 298 + 1500);
  int wide = 0;
  for (std::size_t i = 1; i < spans.size(); ++i) wide += spans[i].from - spans[i - 1].to > 100 ? 1 : 0;
  EXPECT_EQ(wide, 2);
}

TEST(Splits, ByFrequencyPutsASineIntoItsDecade) {
  Case c;
  for (int i = 0; i < 4000; ++i) {
    c.t.push_back(1e-3 * i);
    c.u.push_back(0.001 * i);
    c.residual.push_back(std::sin(2 * std::numbers::pi * 30 * c.t.back()));
  }
  const auto splits = splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V"));
  for (const auto& p : split(splits, "frequency").parts)
    // Of a sine of 120 whole cycles hardly anything leaks over a decade.
    EXPECT_NEAR(p.error, p.label == "10 .. 100 Hz" ? 1 : 0, 0.01) << p.label;
}

TEST(Splits, ByHoldTimeFindsWhatGrowsBehindAStep) {
  Case c;
  for (int i = 0; i < 4000; ++i) {
    c.t.push_back(0.01 * i);
    c.u.push_back(i < 2000 ? 0 : 1);
    c.residual.push_back(i < 2000 ? 0 : 0.01 * (i - 2000));  // grows for 20 s
  }
  const auto held = split(splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V")), "hold_time");
  EXPECT_EQ(held.parts.back().label, "above 10 s");
  EXPECT_NEAR(held.parts.back().error, 1 - 1.0 / 8, 0.01);  // of a square that grows, all but (10 / 20)^3
}

/// Ten holds of 40 s, up and down by one step, sampled every 0.1 s; the residual of a hold is a function of its age.
Case holds(double (*residual)(double age), double noise) {
  Case c;
  lab::Noise random(7);
  for (int i = 0; i < 4000; ++i) {
    const int hold = i / 400;
    const double age = 0.1 * (i % 400);
    c.t.push_back(0.1 * i);
    c.u.push_back(hold % 2);
    c.residual.push_back((hold % 2 == 1 ? 1 : -1) * residual(age) + noise * random());
  }
  return c;
}

TEST(Splits, WhatIsSpreadAsTheRowsAreIsNotSaidToLieAnywhere) {
  Case c;
  for (int i = 0; i < 400; ++i) {
    c.t.push_back(0.1 * i);
    c.u.push_back(i % 40 < 20 ? i % 40 : 40 - i % 40);
    c.residual.push_back(i % 2 == 0 ? 1 : -1);
  }
  const auto splits = splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V"));
  EXPECT_EQ(split(splits, "branch").sentence, "Split by branch of u, the squared error is spread as the samples are");
  EXPECT_FALSE(split(splits, "branch").tells);
}

TEST(Splits, WhatSaysNothingIsNotAmongTheSentences) {
  // Fifths of the time that hold 24.5, 15.5, 20, 15.5 and 24.5 % of the squared error: uneven, and none stands out.
  Case c;
  for (int i = 0; i < 500; ++i) {
    c.t.push_back(0.1 * i);
    c.u.push_back(i % 40 < 20 ? i % 40 : 40 - i % 40);
    const double share = i < 100 || i >= 400 ? 0.245 : i >= 200 && i < 300 ? 0.2 : 0.155;
    c.residual.push_back((i % 2 == 0 ? 1 : -1) * std::sqrt(share));
  }
  const auto splits = splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V"));
  EXPECT_GT(split(splits, "time").information, 0.02);
  EXPECT_FALSE(split(splits, "time").tells);
  for (const auto& sentence : telling_sentences(splits)) EXPECT_FALSE(sentence.starts_with("Split by")) << sentence;
}

TEST(Splits, OfABandTheRmsIsWhatItAddsToTheWhole) {
  Case c;
  for (int i = 0; i < 1000; ++i) {
    c.t.push_back(0.01 * i);
    c.u.push_back(i % 100);
    c.residual.push_back(0.3 + 0.4 * std::sin(2 * 3.14159265358979 * 5 * 0.01 * i));
  }
  const auto splits = splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V"));
  double squares = 0, largest = 0;
  for (const auto& part : split(splits, "frequency").parts) {
    squares += part.rms * part.rms;
    largest = std::max(largest, part.rms);
  }
  EXPECT_NEAR(squares, 0.09 + 0.08, 1e-6) << "mean square of a constant and a sine of whole periods";
  EXPECT_LT(largest, 0.31) << "no band holds more than the constant, 0.3, or the sine, 0.28";
}

std::string said_of_holds(const Case& c) {
  return split(splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V")), "hold_time").sentence;
}

TEST(Splits, WhatGrowsDuringHoldsIsToldApartFromWhatIsThere) {
  const auto creep = [](double age) { return 0.1 * std::log10(1 + age / 0.1); };
  EXPECT_EQ(said_of_holds(holds(creep, 0.02)),
            "100 % of the squared error lies in the 39.9 s after a step (100 % of the samples), growing with log time");
  EXPECT_NE(said_of_holds(holds([](double age) { return 0.01 * age; }, 0.02)).find(", growing with time"),
            std::string::npos);
  // What settles, what stands still and what is noise do not grow.
  for (const Case& c : {holds([](double age) { return std::exp(-age); }, 0.001),
                        holds([](double) { return 1.0; }, 0.02), holds([](double) { return 0.0; }, 1.0)})
    EXPECT_EQ(said_of_holds(c).find("growing"), std::string::npos) << said_of_holds(c);
}

TEST(Splits, ByATemperatureOrAnotherAxisAddUpAndFindTheirLevel) {
  auto c = triangle_case();
  SplitSignal room{"room", parse_unit("degC"), {Rows{}}};
  SplitSignal axis{"x", parse_unit("um"), {Rows{}}};
  for (int i = 0; i < 400; ++i) {
    room.rows[0].push_back(293.15 + (i < 300 ? 0 : 5));
    axis.rows[0].push_back(1e-6 * (i % 20));
    c.residual[static_cast<std::size_t>(i)] = i < 300 ? 1 : 3;
  }
  const auto splits = splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V"), {room, axis});
  const auto& by_room = split(splits, "temperature");
  EXPECT_EQ(by_room.title, "by level of room");
  EXPECT_EQ(by_room.parts.back().label, "24 .. 25 degC");
  EXPECT_NEAR(by_room.parts.back().error, 100 * 9.0 / (300 + 100 * 9), 1e-12);
  EXPECT_NEAR(by_room.parts.back().rows, 0.25, 1e-12);
  EXPECT_EQ(by_room.sentence, "75 % of the squared error lies where room is 24 .. 25 degC (25 % of the samples)");
  double sum = 0;
  for (const auto& p : split(splits, "other_axis").parts) {
    EXPECT_NEAR(p.error, 0.2, 1e-12) << p.label;  // five fifths of a ramp that does not matter
    sum += p.error;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(Splits, OfFurtherSignalsThoseThatMoveInAnotherWayTell) {
  const auto c = triangle_case();
  SplitSignal still{"still", parse_unit("degC"), {Rows(400, 293.15)}};
  SplitSignal same{"monitor", parse_unit("V"), {c.u}};
  SplitSignal other{"other", parse_unit("V"), {c.t}};
  for (double& v : same.rows[0]) v = 20 - 0.98 * v;
  const auto telling = telling_signals({still, same, other}, {c.u});
  ASSERT_EQ(telling.size(), 1U);
  EXPECT_EQ(telling[0].name, "other");
}

TEST(Splits, ByAmplitudeTellsLargeSwingsFromSmall) {
  Case c;
  for (int i = 0; i < 800; ++i) {
    const double size = i < 400 ? 1 : 0.2;
    c.t.push_back(0.01 * i);
    c.u.push_back(size * std::sin(2 * std::numbers::pi * i / 100.0));
    c.residual.push_back(i < 400 ? 1 : 0);
  }
  const auto sizes = split(splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V")), "amplitude");
  ASSERT_EQ(sizes.parts.size(), 3U);
  EXPECT_LT(sizes.parts[0].error, 0.1);  // a swing that spans the change belongs to neither
  EXPECT_NEAR(sizes.parts[1].error + sizes.parts[2].error, 1, 0.1);
}

TEST(Splits, TheOneThatTellsMostComesFirstAndSaysWhere) {
  const auto c = triangle_case();
  const auto splits = splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V"));
  EXPECT_EQ(splits.front().variable, "branch");
  // Noise ten times larger while falling: 100/101 of the squared error, on about half of the rows.
  EXPECT_NEAR(split(splits, "branch").parts[1].error, 100.0 / 101, 0.01);
  EXPECT_NE(splits.front().sentence.find("% of the squared error lies on the falling branch (50 % of the samples)"),
            std::string::npos)
      << splits.front().sentence;
}

TEST(Splits, AnEvenErrorTellsNothing) {
  auto c = triangle_case();
  for (double& e : c.residual) e = 1;
  for (const auto& s : splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V")))
    if (s.variable != "frequency") {  // a constant has one, the lowest
      EXPECT_NEAR(s.information, 0, 1e-12) << s.variable;
    }
}

TEST(Splits, ATriangleHasOneRateAndHenceOneMovingPart) {
  const auto c = triangle_case();
  const auto splits = splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V"));
  // At the corners the central difference is zero, everywhere else 1 V/s.
  EXPECT_LE(split(splits, "rate").parts.size(), 3U);
}

TEST(Splits, NoErrorAtAllIsSpreadAsTheRowsAre) {
  auto c = triangle_case();
  for (double& e : c.residual) e = 0;
  for (const auto& s : splits_of({{&c.t, &c.u, &c.residual, "a"}}, "u", parse_unit("V")))
    for (const auto& p : s.parts) EXPECT_EQ(p.error, p.rows);
}

TEST(Splits, WithoutAnInputTimeAndFrequencyAreSplit) {
  const auto c = triangle_case();
  const auto splits = splits_of({{&c.t, nullptr, &c.residual, "a"}}, "", Unit{});
  ASSERT_EQ(splits.size(), 2U);
  EXPECT_EQ(splits[0].variable, "time");
  EXPECT_EQ(splits[1].variable, "frequency");
}

TEST(Metrics, NrmseIsTheRmsOverTheDeviationOfWhatWasMeasured) {
  // Measured 0, 2, 0, 2: mean 1, deviation 1. Residual 0.5 everywhere: rms 0.5, so 50 % and fit 50 %.
  const auto m = metrics_of({0, 2, 0, 2}, {0.5, -0.5, 0.5, -0.5});
  EXPECT_EQ(m.rows, 4U);
  EXPECT_NEAR(m.rms, 0.5, 1e-15);
  EXPECT_NEAR(m.deviation, 1, 1e-15);
  EXPECT_NEAR(m.nrmse, 0.5, 1e-15);
  EXPECT_NEAR(m.fit, 50, 1e-13);
  EXPECT_EQ(m.peak, 0.5);
}

TEST(Metrics, AMeasuredConstantHasNoNrmse) { EXPECT_TRUE(std::isinf(metrics_of({1, 1, 1}, {1, 0, 0}).nrmse)); }

}  // namespace
}  // namespace hysteron
