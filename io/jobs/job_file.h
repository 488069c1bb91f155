// Decides how a job stands in a JSON file: what to do with a diagram and its data. Reads it; does not know
// which parameters the diagram has, nor their units (fit/thesis/problem.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagram/diagram.h"

namespace hysteron {

/// A number as it is written, and where.
struct WrittenNumber {
  Number number;
  std::string pointer;
};

/// A text as it is written, and where.
struct WrittenText {
  std::string text, pointer;
};

/// A parameter that a fit may change; what is not said comes from the diagram.
struct FreeWish {
  WrittenText parameter;  ///< "stage.k", "core.weights" (all elements), "core.weights[2]"
  std::optional<WrittenNumber> lower{}, upper{}, start{};
  std::optional<bool> log_scale{};
  std::vector<WrittenNumber> prior{};  ///< two: the range that holds it with 95 %
  std::vector<WrittenNumber> scan{};   ///< values at which the search may begin
  bool per_recording = false;
};

/// One parameter of an attractor: drawn in a range, or found from a drawn one.
struct AttractorComponentWish {
  WrittenText parameter;
  std::vector<WrittenNumber> draw{};  ///< two: its ends
  std::optional<WrittenText> of{};  ///< or: the drawn parameter x, and curves sum factor exp(rate x) of it, numbers ...
  std::vector<std::pair<double, double>> upper{}, lower{};  ///< ... in the units in which the diagram shows both
  double scale = 1;                                         ///< the value is scale (upper + lower)/2
};

/// The data-driven attractor of "nmpso": which parameters are c and k of Jiles-Atherton, and the largest input; or any
/// parameters with their curves.
struct AttractorWish {
  WrittenText c, k;
  WrittenNumber top;
  std::vector<AttractorComponentWish> components{};  ///< not empty: these instead
};

struct MethodWish {
  WrittenText name{"search", ""};   ///< "search", or a global method
  int starts = 0;                   ///< points spread over the box from which the search may begin
  std::optional<long> runs{};       ///< budget of a global method
  std::optional<int> iterations{};  ///< of the search
  bool then_search = true;          ///< polish what a global method found
  std::optional<AttractorWish> attractor{};
};

/// Thresholds of a Prandtl-Ishlinskii block, to be placed before the fit.
struct ThresholdWish {
  WrittenText block;
  int count = 10;
  bool by_swing = false;  ///< dense where the input turns often; else evenly
};

/// "do": "fit".
struct FitJob {
  std::string file, title;
  std::string diagram, data;  ///< to open, seen from where the program runs
  std::vector<Override> choose, set;
  std::vector<FreeWish> free;  ///< empty: what the diagram marks
  std::optional<ThresholdWish> thresholds{};
  std::vector<MethodWish> methods;  ///< at least one; several are compared, and the best result is kept
  std::uint64_t seed = 1;
  std::vector<WrittenText> profile;
  std::string write;  ///< where the fitted diagram goes too; "" = nowhere
};

/// True if this JSON file is a job: it has the key "do". Throws Error where it cannot be read as JSON.
bool is_job(const std::string& file);

/// Throws Error with file, line and JSON path for syntax, unknown keys, wrong types, a newer format, paths outside the
/// project, and jobs that this version cannot do.
FitJob read_fit_job(const std::string& file, const std::vector<std::string>& allowed = {});

/// JSON Schema of a job.
std::string job_schema();

}  // namespace hysteron
