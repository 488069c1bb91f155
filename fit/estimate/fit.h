// Decides how parameters are found: linear ones by bounded linear least squares on simulated responses, the others by
// bounded nonlinear least squares of what remains (variable projection), from scanned starts; and how sure they are.
// With the noise in turn: fit_and_noise.cpp; back into the diagram: write_back.cpp. Does not choose the model.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagram/diagram.h"
#include "fit/estimate/global.h"
#include "fit/model/free_parameter.h"
#include "fit/model/model.h"
#include "fit/model/noise.h"
#include "fit/model/score.h"
#include "fit/numerics/dense.h"

namespace hysteron {

struct Neighbourhood;  // colour.h

struct FitProgress {
  double chi2 = 0;       ///< best so far
  double rows = 0;       ///< what chi2 is when nothing but noise is left
  long runs = 0;         ///< simulations of one recording so far
  long candidates = 0;   ///< points tried so far
  double fraction = -1;  ///< of this stage; negative = unknown
  std::string stage{};   ///< "scan", "global", "search", "intervals", "profile"
};

struct FitOptions {
  int max_iterations = 40;  ///< of the local search, per start
  double matters = 0;       ///< a fall of chi2 for which no further step of the local search is taken
  /// Derivatives of the whitened residual by the parameters searched that another fit of them has found on the same
  /// recordings (FitResult::derivatives), beside a model that differs a little: steps begin with these.
  std::shared_ptr<const Dense> known_derivatives{};
  int refine = 2;     ///< scan points that are searched from; a start from which nothing moves is none of them
  int max_scan = 64;  ///< points of a grid over several scanned parameters; beyond, one parameter after the other
  /// Covariance, intervals, undetermined combinations: one more Jacobian and two points per parameter searched; where
  /// the model bends over an interval and is advanced exactly, profiles besides.
  bool intervals = true;
  /// Steps (rows times substeps) that these profiles may take; where they would take more, the result says that it is
  /// worth asking for them.
  double profile_steps = std::numeric_limits<double>::infinity();
  /// Where the values that were found need finer rows, they are searched again from there; not where some steps of that
  /// search would take more steps of simulation than this. Nor are starts and values searched in turn for longer.
  double search_again_steps = std::numeric_limits<double>::infinity();
  int starts = 0;  ///< further points spread evenly over the box, tried like those of a scan
  /// A method of global.h that looks for a start before the local search; "" = none. Needs finite bounds.
  std::string global{};
  long global_runs = 505;                ///< its budget of points
  bool polish = true;                    ///< false: the best point of the global method is the result
  std::optional<Attractor> attractor{};  ///< of "nmpso"; components count the free parameters
  std::uint64_t seed = 1;                ///< of the starts and of the global method
  std::vector<int> profile{};            ///< free parameters (places in the list) whose profile is wanted
  std::vector<ParameterValue> fixed{};   ///< held at these values
  /// What the residual is like, where that is not what the weights say: the intervals follow it.
  std::optional<NoiseModel> residual_noise{};
  bool scores = true;  ///< FitResult::before and after; false where the caller judges by a measure of its own
  bool keep_neighbourhood = false;  ///< for noise_from_likelihood()
  std::vector<int> recordings{};    ///< fitted; empty = all train recordings
  std::vector<int> judged{};        ///< scored afterwards; empty = all train and validate recordings (never test)
  /// Called between trials; false = stop with the best so far.
  std::function<bool(const FitProgress&)> progress{};
};

/// What a fit says of one parameter. All numbers SI; `unit` is the one the file used.
struct ParameterEstimate {
  int parameter = -1;
  std::string path;
  int recording = -1;  ///< of this recording alone; -1: of all
  Unit unit{};
  bool difference = false;
  bool linear = false;  ///< found by linear least squares
  bool log_scale = false;
  double start = 0;
  double lower = 0, upper = 0;              ///< bounds
  double used = 0;                          ///< what the simulations behind chi2 used; no estimate unless `determined`
  bool determined = true;                   ///< the data fix it (alone, not only in a combination)
  bool at_lower = false, at_upper = false;  ///< held back by a bound: no interval
  std::optional<std::pair<double, double>> prior{};  ///< as given
  std::optional<double> value{};                     ///< the estimate; absent if not determined
  std::optional<double> sigma{};                     ///< standard deviation (of ln value times value for log scale)
  double s2 = 1;                                     ///< its square was scaled by it: FitResult::s2 of its own fit
  /// 95 % interval, inside the bounds: of the linearization, or of the profile where the model bends over it.
  std::optional<double> low95{}, high95{};
};

/// Parameters of which the data fix at most a combination.
struct Undetermined {
  std::vector<std::string> paths;
  std::vector<double> direction;  ///< relative change of each that changes nothing visible, largest = 1
  std::string sentence;           ///< for people
};

/// How chi2 rises where one parameter is held and all others are fitted again.
struct Profile {
  int estimate = -1;
  std::vector<double> value;  ///< [SI] increasing
  std::vector<double> rise;   ///< of chi2 (priors included) over its least value, over s2
  /// Where the rise is 3.84 (95 % of chi-square with one degree of freedom); absent: an open end.
  std::optional<double> low95{}, high95{};
};

struct FitResult {
  bool ok = false;
  std::string error{};  ///< why there is no result, "" if ok
  std::vector<ParameterEstimate> estimates{};
  std::vector<Undetermined> undetermined{};
  std::vector<double> correlation{};  ///< row by row over `correlated`
  std::vector<int> correlated{};      ///< indices into estimates that have an interval
  std::vector<Profile> profiles{};
  std::vector<ParameterValue> values{};  ///< what to pass to DataModel::predict
  std::shared_ptr<const Neighbourhood> neighbourhood{};
  std::shared_ptr<const Dense> derivatives{};  ///< of the last linearization of the search; null: none was needed
  Score before{}, after{};                     ///< at the starts, at the result; all judged recordings
  double chi2 = 0, n = 0;                      ///< after, fitted recordings, without priors
  double prior_chi2 = 0;                       ///< sum over the priors of ((mean - value) / sigma)^2
  int n_parameters = 0;                        ///< determined and not held at a bound
  double s2 = 0;                               ///< chi2 / (n - n_parameters): intervals are scaled by it
  long runs = 0, failed_runs = 0;              ///< simulations of one recording
  int starts = 0, iterations = 0;
  bool converged = false, stopped = false;
  std::vector<std::pair<long, double>> global_history{};  ///< points tried so far, chi2 reached; of a global method
  std::string method{};                                   ///< "linear least squares (12), Levenberg-Marquardt (2)"
  std::string convergence{};
  double seconds = 0;                  ///< for people; no decision depends on it
  std::vector<std::string> remarks{};  ///< what the user must be told
};

/// Fits. Throws Error only where the question is wrong (no free parameter, no train recording, start outside its
/// bounds); a model that cannot be simulated anywhere gives ok = false. Deterministic.
FitResult fit(DataModel& model, const NoiseModel& noise, const std::vector<FreeParameter>& free,
              const FitOptions& options = {});

/// Fit, estimate the noise from the residual - white rms, and the share of 1/f where the data set does not state it -
/// and fit again with it, so that the intervals hold with coloured noise too.
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

/// Where a set of parameters comes from, for people who find the file later.
struct FitOrigin {
  std::string diagram{}, data{};  ///< as they were named
  std::string date{};             ///< "" = not said
  std::uint64_t seed = 1;
};

/// A parameter set as JSON text: path -> value with unit, standard deviation, and the interval in words;
/// what the data do not determine is left out. Where all parameters belong to one block, the names are the block's own
/// and the block can name the file as its "parameters".
/// Where the numbers come from stands under "fit"; parameters of single recordings too.
std::string parameter_file_text(const FitResult& result, const Program& program, const DataSet& data,
                                const FitOrigin& origin = {});

}  // namespace hysteron
