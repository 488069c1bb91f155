// Decides what the fit of one candidate may cost: where it begins and how many steps it takes. Internal to discover.
#pragma once

#include <vector>

#include "discover/models/candidate_model.h"

namespace hysteron {

/// Steps that may be spent on screening one candidate: some seconds. Only what stands behind nonlinear states in slow
/// recordings comes near.
inline constexpr double screening_steps = 5e6;
/// Steps that may be spent on the fit of one candidate with nonlinear states: some seconds.
inline constexpr double fit_steps = 4e7;

/// Steps of many rows at once that one of a single point takes the time of (a delayed held drive beside friction, and a
/// linear plant).
inline constexpr double cost_of_a_point = 6;

/// What a step of the program costs, in steps of one mass or tank: elements that remember beside a mass are asked at
/// each place that it passes.
double work_of_a_step(const Program& program);
/// Steps of one simulation of the train recordings from the start values: rows times substeps times
/// their work. 0: nothing is slow.
double steps_from(DataModel& model, const std::vector<double>& noise, const Trial& fixed,
                  const std::vector<FreeParameter>& free);
/// Screening costs little however slow the model is: fewer places to begin, fewer steps from there.
void spend_less(const CandidateModel& c, double steps, std::vector<FreeParameter>& free, FitOptions& options);
/// A full fit of a slow model begins in fewer places and takes fewer steps from there.
void keep_within_time(const CandidateModel& c, double steps, std::vector<FreeParameter>& free, FitOptions& options);

}  // namespace hysteron
