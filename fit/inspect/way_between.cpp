#include "fit/inspect/way_between.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "fit/inspect/inspection.h"

namespace hysteron {
namespace {

/// Worth a word as a shift is (delay.cpp): a tenth of the squared error and more than chance. That a signal bends is a
/// share of what is quick in it, and so is what a mode leaves: most of the error.
double least_fall(Between way) { return way == Between::smooth ? 0.5 : 0.1; }

DataModel with_way(const DataModel& model, const std::string& input, Between way) {
  auto data = std::make_shared<DataSet>(model.data());
  set_way(*data, input, way);
  return {model.program_pointer(), data};
}

/// Sum of the squared whitened difference of two predictions, over all that is judged.
double distance(const DataModel& model, const Judge& judge, const std::vector<int>& judged, const Prediction& a,
                const Prediction& b) {
  double sum = 0;
  for (const int r : judged) {
    const auto& one = a.y[static_cast<std::size_t>(r)];
    const auto& other = b.y[static_cast<std::size_t>(r)];
    std::vector<Rows> rows(one.size());
    for (std::size_t o = 0; o < one.size(); ++o)
      for (std::size_t i = 0; i < std::min(one[o].size(), model.measured(r, static_cast<int>(o)).size()); ++i)
        rows[o].push_back(one[o][i] - other[o][i]);
    std::vector<double> white(judge.size(r));
    judge.whiten(r, rows, white.data());
    for (const double w : white) sum += w * w;
  }
  return sum;
}

/// What the diagram leaves with another way of the input, not ok where that cannot be simulated or can bring nothing.
Score score_with(const std::string& input, Between way, const DataModel& model, const Judge& judge,
                 const std::vector<int>& judged, const std::vector<FreeParameter>& free, const BestPrediction& best,
                 double chi2) {
  constexpr auto nothing = [] { return Score{.ok = false}; };
  DataModel other = with_way(model, input, way);
  Prediction prediction = calibrated(other, best.values, judged);
  if (!prediction.ok) return nothing();
  // |r|^2 - |r - d|^2 <= 2 |r| |d|: a small d takes no more than that away, and saves a search.
  const double d = std::sqrt(distance(model, judge, judged, best.prediction, prediction) / chi2);
  if (2 * d < least_fall(way)) return nothing();
  if (!free.empty()) {
    auto from = free;
    for (std::size_t i = 0; i < from.size(); ++i) from[i].start = best.values[i].value;
    prediction = best_beside_calibration(other, judge, from, judged).prediction;
  }
  return judge.score(other, prediction, judged);
}

}  // namespace

Between given_way(const DataSet& data, const std::string& input) {
  const auto note = data.notes.find(input);
  return note == data.notes.end() ? Between::linear : note->second.between;
}

void set_way(DataSet& data, const std::string& input, Between way) {
  data.notes[input].to = input;
  data.notes[input].between = way;
}

std::vector<InspectedBetween> other_ways_between(const DataModel& model, const Judge& judge,
                                                 const std::vector<int>& judged, const std::vector<FreeParameter>& free,
                                                 const BestPrediction& best) {
  std::vector<InspectedBetween> list;
  const Score given = judge.score(model, best.prediction, judged);
  if (!given.ok || !(given.chi2() > 0)) return list;
  for (const auto& name : model.program().input_names) {
    if (!moves(model.data(), name)) continue;
    InspectedBetween seen{name, given_way(model.data(), name)};
    double left = given.chi2();  // a way that needs more than another to be told needs it beside that one, too
    for (const Between way : {Between::linear, Between::hold, Between::smooth}) {
      if (way == seen.given) continue;
      const Score score = score_with(name, way, model, judge, judged, free, best, given.chi2());
      if (!score.ok) continue;
      const double chance = 25 * std::max(1.0, score.chi2() / std::max(1.0, score.n()));
      if (!(score.chi2() < (1 - least_fall(way)) * left) || left - score.chi2() < chance) continue;
      left = score.chi2();
      seen.better = way;
      seen.fall = 1 - left / given.chi2();
    }
    if (seen.fall > 0) list.push_back(seen);
  }
  return list;
}

BetweenWords words_of(const InspectedBetween& seen) {
  const char* moves = seen.better == Between::linear ? "linearly" : "smoothly";
  if (seen.better == Between::hold)
    return {false,
            fmt::format("Held between samples, {} would explain {:.0f} % of the squared error; so may a lag or a "
                        "delay of half a sample. If the drive is known to be held, write \"between_samples\": \"hold\" "
                        "at its column.",
                        seen.input, 100 * seen.fall)};
  if (seen.given == Between::hold)
    return {true, fmt::format("Between samples {0} moves {1}, it is not held as the data set says: with that the "
                              "diagram leaves {2:.0f} % less of the squared error (an output that is early by half a "
                              "sample looks the same). At its column write \"between_samples\": \"{3}\".",
                              seen.input, moves, 100 * seen.fall, to_text(seen.better))};
  return {false, fmt::format("Moving {1} between samples, {0} would explain {2:.0f} % of the squared error. If it does "
                             "(a generator behind a filter moves smoothly), write \"between_samples\": \"{3}\" at its "
                             "column.",
                             seen.input, moves, 100 * seen.fall, to_text(seen.better))};
}

}  // namespace hysteron
