// Decides how parameters are found: linear ones by bounded linear least squares on simulated responses, the others by
// bounded nonlinear least squares of what remains (variable projection), from scanned starts; and how sure they are.
// Does not choose the model.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagram.h"
#include "fit/free_parameter.h"
#include "fit/model.h"
#include "fit/noise.h"
#include "fit/score.h"

namespace hysteron {

struct FitProgress {
  double chi2 = 0;      ///< best so far
  long runs = 0;        ///< simulations of one recording so far
  std::string stage{};  ///< "scan", "search", "intervals"
};

struct FitOptions {
  int max_iterations = 40;  ///< of the local search, per start
  int refine = 2;           ///< scan points that are searched from
  int max_scan = 64;        ///< points of a grid over several scanned parameters; beyond, one parameter after the other
  bool intervals = true;    ///< covariance, intervals, undetermined combinations (one more Jacobian)
  std::vector<int> recordings{};  ///< fitted; empty = all train recordings
  std::vector<int> judged{};      ///< scored afterwards; empty = all train and validate recordings (never test)
  /// Called between trials; false = stop with the best so far.
  std::function<bool(const FitProgress&)> progress{};
};

/// What a fit says of one parameter. All numbers SI; `unit` is the one the file used.
struct ParameterEstimate {
  int parameter = -1;
  std::string path;
  Unit unit{};
  bool difference = false;
  bool linear = false;  ///< found by linear least squares
  bool log_scale = false;
  double start = 0;
  double lower = 0, upper = 0;              ///< bounds
  double used = 0;                          ///< what the simulations behind chi2 used; no estimate unless `determined`
  bool determined = true;                   ///< the data fix it (alone, not only in a combination)
  bool at_lower = false, at_upper = false;  ///< held back by a bound: no interval
  std::optional<double> value{};            ///< the estimate; absent if not determined
  std::optional<double> sigma{};            ///< standard deviation (of ln value times value for log scale)
  std::optional<double> low95{}, high95{};  ///< 95 % interval, inside the bounds
};

/// Parameters of which the data fix at most a combination.
struct Undetermined {
  std::vector<std::string> paths;
  std::vector<double> direction;  ///< relative change of each that changes nothing visible, largest = 1
  std::string sentence;           ///< for people
};

struct FitResult {
  bool ok = false;
  std::string error{};  ///< why there is no result, "" if ok
  std::vector<ParameterEstimate> estimates{};
  std::vector<Undetermined> undetermined{};
  std::vector<double> correlation{};     ///< row by row over `correlated`
  std::vector<int> correlated{};         ///< indices into estimates that have an interval
  std::vector<ParameterValue> values{};  ///< what to pass to DataModel::predict
  Score before{}, after{};               ///< at the starts, at the result; all judged recordings
  double chi2 = 0, n = 0;                ///< after, fitted recordings, without priors
  double prior_chi2 = 0;                 ///< sum over the priors of ((mean - value) / sigma)^2
  int n_parameters = 0;                  ///< determined and not held at a bound
  double s2 = 0;                         ///< chi2 / (n - n_parameters): intervals are scaled by it
  long runs = 0, failed_runs = 0;        ///< simulations of one recording
  int starts = 0, iterations = 0;
  bool converged = false, stopped = false;
  std::string method{};  ///< "linear least squares (12), trust region (2)"
  std::string convergence{};
  double seconds = 0;                  ///< for people; no decision depends on it
  std::vector<std::string> remarks{};  ///< what the user must be told
};

/// Fits. Throws Error only where the question is wrong (no free parameter, no train recording, start outside its
/// bounds); a model that cannot be simulated anywhere gives ok = false. Deterministic.
FitResult fit(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free,
              const FitOptions& options = {});

/// Fit, correct the noise by the residual (noise.h), and fit again where that changes the weights of outputs against
/// each other.
struct FitWithNoise {
  FitResult result;
  NoiseModel noise;
};
FitWithNoise fit_and_noise(DataModel& model, const std::vector<FreeParameter>& free, const FitOptions& options = {});

/// The diagram with the used values written where each parameter stands (diagram parameters, block parameters, list
/// elements, nested diagrams), in the unit that the file used, rounded to `digits` significant digits.
/// A value inside a nested diagram's own file changes that file: with `nested`, such a file gets a new name
/// ("stage_fitted.json") and is listed there (name as written in the diagram, content) for the caller to write beside
/// it.
Diagram with_parameters(const Diagram& diagram, const Program& program, const std::vector<ParameterValue>& values,
                        int digits = 8, std::vector<std::pair<std::string, Diagram>>* nested = nullptr);

/// A parameter set as JSON text (ENGINE 10): path -> value with unit, standard deviation, and the interval in words;
/// what the data do not determine is left out. Where all parameters belong to one block, the names are the block's own
/// and the block can name the file as its "parameters".
std::string parameter_file_text(const FitResult& result, const Program& program, const DataSet& data);

}  // namespace hysteron
