// Decides how far apart a model and measurements are, in the figures people use, and where the squared error lies
// (splits.cpp).
// Does not fit, does not name effects. Everything on exactly the measured instants.
#pragma once

#include <string>
#include <vector>

#include "fit/compare/spans.h"
#include "fit/model/model.h"
#include "fit/model/score.h"

namespace hysteron {

struct Metrics {
  std::size_t rows = 0;
  double rms = 0;        ///< of the residual [SI]
  double peak = 0;       ///< largest |residual| [SI]
  double deviation = 0;  ///< std(measured) over the rows judged [SI]
  double nrmse = 0;      ///< rms / deviation; infinite if the measured signal does not move
  double fit = 0;        ///< 100 (1 - nrmse) [%]
};

/// `recording` = -1: all recordings of that role; `all_roles`: all recordings together.
struct MetricsOf {
  int recording = -1;
  bool all_roles = false;
  Role role = Role::train;
  int output = 0;
  Metrics metrics;
};

/// One part of a split: its share of the squared error and of the rows, both 0..1.
struct SplitPart {
  std::string label;  ///< "falling", "0.2 .. 1.4 V", "first cycle" ...
  double error = 0;   ///< share of the squared error; the shares of a split add up to 1
  double rows = 0;    ///< share of the rows
  double rms = 0;     ///< of the residual in this part [SI]; of a frequency band what it adds to the whole's
  std::vector<SpansInRecording> spans{};  ///< when; recordings without such rows, and frequencies, have none
};

struct Split {
  /// "recording", "time", "level", "branch", "rate", "cycle", "amplitude", "hold_time", "frequency"; where the data
  /// have such a signal "temperature", "force", "other_axis".
  std::string variable;
  std::string title;  ///< "by branch of u"
  std::vector<SplitPart> parts;
  double information = 0;  ///< sum of error * ln(error / rows): 0 where the error is spread evenly
  bool tells = false;      ///< a part holds clearly more of the error than of the rows, or it grows within the holds
  std::string sentence;    ///< "78 % of the squared error lies on the falling branch (45 % of the samples)"
};

struct OutputSplits {
  int output = 0;
  std::vector<Split> splits;  ///< most informative first
};

struct Comparison {
  std::vector<MetricsOf> metrics;
  std::vector<OutputSplits> splits;          ///< per output, over the recordings compared
  std::vector<std::string> sentences;        ///< what matters, most important first
  std::vector<std::vector<double>> zeros;    ///< [recording][output] [SI]: estimated zero, where per recording
  std::vector<std::vector<Rows>> residual;   ///< [recording][output] [SI]
  std::vector<std::vector<Rows>> predicted;  ///< [recording][output] [SI], zero included
  const Metrics* find(int recording, int output) const;
  const Metrics* find(Role role, int output) const;
};

/// Compares a prediction with the measurement on these recordings (empty = all that were predicted).
Comparison compare(const DataModel& model, const Judge& judge, Prediction prediction, std::vector<int> recordings = {});

/// The three that matter of one output's splits, most informative first; fewer, or none, where the error is spread as
/// the rows are: a sentence that says so is none of them.
std::vector<std::string> telling_sentences(const std::vector<Split>& splits);

Metrics metrics_of(const Rows& measured, const Rows& residual);

/// Splits of one residual with its input, for one recording or pooled; also used on results before and after an effect.
struct SplitInput {
  const Rows* t = nullptr;         ///< [s]
  const Rows* u = nullptr;         ///< main input [SI]; null = splits by input are left out
  const Rows* residual = nullptr;  ///< [SI]
  std::string name;                ///< of the recording
  double rough = -1;               ///< roughness of u; below 0: not known yet
};
/// A further signal of the recordings: a temperature, a force, another axis.
struct SplitSignal {
  std::string name;
  Unit unit;
  std::vector<Rows> rows;  ///< per recording [SI]
};
std::vector<Split> splits_of(std::vector<SplitInput> recordings, const std::string& input_name, const Unit& input_unit,
                             const std::vector<SplitSignal>& besides = {});

/// Those of further signals that move, and in another way than the main input `u` (per recording): what moves with it
/// would be split as its level is.
std::vector<SplitSignal> telling_signals(std::vector<SplitSignal> signals, const std::vector<Rows>& u);

}  // namespace hysteron
