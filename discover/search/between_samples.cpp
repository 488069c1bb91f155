#include "discover/search/between_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "discover/search/search_state.h"
#include "fit/inspect/way_between.h"

namespace hysteron {
namespace {

/// Of what the model leaves: who bends less than that (rms, of what the input varies) explains none of it.
constexpr double hardly_bends = 0.02;

FitContext with_input(FitContext context, const std::string& input, Between between) {
  DataSet other = *context.data;
  set_way(other, input, between);
  context.data = std::make_shared<const DataSet>(std::move(other));
  return context;
}

/// More than a claim needs goes in recordings of both roles, and this share of what judging ones have above the noise.
bool explains(const ModelError& now, const ModelError& was, double share) {
  return falls_in_both_roles(now, was) && now.excess_validate() < (1 - share) * was.excess_validate();
}

/// What a gain and a zero of each output would leave beside the prediction: a wrong gain is as much too small at every
/// frequency as straight lines are at one.
ModelError beside_a_calibration(const SearchState& state, Prediction prediction) {
  for (int o = 0; o < static_cast<int>(state.base_model->outputs().size()); ++o)
    prediction = state.evidence->calibrated(std::move(prediction), o);
  return state.evidence->error(prediction);
}

/// What was found says it all, and is nothing that half a sample looks like: then the user's model only fits better
/// where it is wrong.
bool is_explained_otherwise(const SearchState& state, const CandidateModel& other_way) {
  const auto& standing = state.current.placed;
  if (standing.empty() || other_way.error_of.over_floor() <= rules::floor_gate) return false;
  return state.current.error_of.over_floor() <= rules::floor_gate &&
         std::none_of(standing.begin(), standing.end(), [](const PlacedEffect& s) {
           return s.effect->family == "lag" || s.effect->family == "dead_time";
         });
}

/// How far a cubic through the samples lies beside straight lines, rms over all recordings, over what they vary: an
/// eighth of the second difference in the middle between two.
double bend_of(const DataSet& data, const std::string& input) {
  double bends = 0, varies = 0;
  for (const auto& r : data.recordings) {
    const auto column = r.columns.find(input);
    if (column == r.columns.end() || column->second.empty()) continue;
    const auto& u = column->second;
    const double mean = std::accumulate(u.begin(), u.end(), 0.0) / static_cast<double>(u.size());
    for (const double v : u) varies += (v - mean) * (v - mean);
    for (std::size_t i = 1; i + 1 < u.size(); ++i) bends += std::pow((u[i - 1] - 2 * u[i] + u[i + 1]) / 8, 2);
  }
  return varies > 0 ? std::sqrt(bends / varies) : 0;
}

}  // namespace

DataSet as_found(DataSet data, const Discovery& found) {
  for (const auto& s : found.smooth_inputs) set_way(data, s.input, Between::smooth);
  for (auto& r : data.recordings)
    if (std::find(found.found_starts.begin(), found.found_starts.end(), r.name) != found.found_starts.end()) {
      r.at_rest = false;
      r.initial_per_recording = true;
    }
  return data;
}

void tell_unused(SearchState& state, const SmoothInput& smooth) {
  state.d.warnings.push_back(
      fmt::format("{} moves smoothly between its samples, it seems: with it the error of what was found falls from "
                  "{:.3g} % to {:.3g} %. The search that takes it into account was broken off; write "
                  "\"between_samples\": \"smooth\" at its column and begin with that.",
                  smooth.input, 100 * smooth.before, 100 * smooth.after));
}

void tell_smooth_inputs(SearchState& state) {
  for (const auto& s : state.d.smooth_inputs)
    state.d.warnings.push_back(
        fmt::format("{} moves smoothly between its samples, not along straight lines as the data set says: with it the "
                    "error of what had been found fell from {:.3g} % to {:.3g} %. All figures are with that: write "
                    "\"between_samples\": \"smooth\" at its column.",
                    s.input, 100 * s.before, 100 * s.after));
}

void tell_other_ways(SearchState& state) {
  for (const auto& input : state.base_model->program().input_names) {
    if (state.stopped()) return;
    const Between between = given_way(*state.data, input);
    if (between == Between::smooth || state.data->notes.count(input) == 0) continue;
    const bool held = between == Between::hold;
    const FitContext context = with_input(state.context, input, held ? Between::linear : Between::hold);
    const CandidateModel c = base_model(context, state.user, Effort::full);
    const ModelError& was = state.base.error_of;
    if (!c.ok || !explains(c.error_of, was, rules::structure_share) || is_explained_otherwise(state, c)) continue;
    state.d.warnings.push_back(fmt::format(
        "{} {}, not as the data set says: the error of the model as it is would be {:.3g} % instead of {:.3g} %. A "
        "dead time of half a sample looks the same.",
        input, held ? "moves linearly between its samples" : "is held between its samples",
        100 * c.error_of.nrmse_validate, 100 * was.nrmse_validate));
  }
}

std::optional<SmoothInput> find_smooth_input(const SearchState& state, const FitContext& fits) {
  const ModelError& was = state.current.error_of;
  for (const auto& input : state.base_model->program().input_names) {
    if (state.stopped()) return {};
    if (given_way(*state.data, input) != Between::linear) continue;
    if (bend_of(*state.data, input) < hardly_bends * was.nrmse_validate) continue;
    const FitContext context = with_input(fits, input, Between::smooth);
    CandidateModel present = state.current;
    present.prediction = {};  // it is of the data as they were said to be
    const CandidateModel c = refit(context, present, Effort::screen);
    if (c.ok && explains(c.error_of, was, rules::share_of_rest) &&
        explains(beside_a_calibration(state, c.prediction), beside_a_calibration(state, state.current.prediction),
                 rules::share_of_rest))
      return SmoothInput{input, was.nrmse_validate, c.error_of.nrmse_validate};
  }
  return {};
}

}  // namespace hysteron
