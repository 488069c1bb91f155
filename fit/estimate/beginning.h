// Decides whether a recording begins where the model does. A model is started in equilibrium where the data set says
// nothing else; a device that still swings or relaxes from what was before shows a residual that no parameter explains.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fit/model/noise.h"
#include "fit/model/score.h"

namespace hysteron {

/// A recording that does not begin where the model was started.
struct Beginning {
  int recording = -1;
  double fall = 0;       ///< of chi2 within `lasts`, with the states at the start free
  double elsewhere = 0;  ///< the most that the same answers take away in a window of that length later on
  int states = 0;        ///< numbers that this takes: states of which the outputs show the start
  double lasts = 0;      ///< [s] until what the start leaves has decayed to a hundredth
  double rms = 0;        ///< of the first output that it moves most: what the start makes of it there [SI]
  int output = -1;       ///< that one
};

/// Those of `recordings`, judged at these values, of which `prediction` is what the model says there. Only recordings
/// that the model begins in equilibrium are looked at, and of them at most the first 20 000 rows.
///
/// The answer of the outputs to each state at the start is laid over the residual, there and, where it has decayed, at
/// one window behind the other. Told is what takes away more at the start than chance does (six standard deviations of
/// chi2 with as many degrees of freedom) and four times as much as anywhere else: a model that lacks something is wrong
/// in every window alike.
std::vector<Beginning> begin_elsewhere(const DataModel& model, const NoiseModel& noise, const Prediction& prediction,
                                       std::span<const ParameterValue> values, std::span<const int> recordings);

/// "a.csv does not begin at rest, where the model is started: ...", with the cure.
std::string to_text(const DataModel& model, const Beginning& beginning);

}  // namespace hysteron
