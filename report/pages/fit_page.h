// Decides what the page and the facts of a fit say. Does not decide what is fitted: fit.cpp.
#pragma once

#include <string>
#include <vector>

#include "fit/compare/compare.h"
#include "fit/estimate/fit.h"
#include "fit/inspect/delay.h"
#include "io/jobs/job_file.h"
#include "io/results/result.h"
#include "report/pages/facts.h"

namespace hysteron {

/// What one of several methods reached.
struct Attempt {
  std::string method;
  bool ok = false;
  std::string error{};
  double rms = 0;  ///< of the first output over the fitted recordings [SI]
  double chi2 = 0, n = 0;
  long runs = 0, failed = 0;
  double seconds = 0;
};

struct Fitted {
  FitResult result;
  NoiseModel noise;
  Comparison before, after;
  std::vector<DelayFinding> delays;
  std::vector<Attempt> attempts;
  /// Root of chi2 per row over the train recordings, before and after: the error as the fit weighs it.
  double weighed_before = 0, weighed_after = 0;
  bool by_search = true;  ///< false: a method of the thesis, which does not minimize it
};

/// Headline and sentences: how far the error fell, and every value with its interval.
void tell(Document& document, const DataModel& model, const Fitted& fitted);
/// Tables and figures. diff: of the diagram's text before and after.
void add_sections(Document& document, const DataModel& model, const Fitted& fitted, const std::string& diff);
/// What result.json says.
Facts fit_facts(const FitJob& job, const DataModel& model, const Fitted& fitted);
/// Of several methods: reached error against what it took. Seconds differ from run to run: not for files.
Table method_table(const DataModel& model, const std::vector<Attempt>& attempts, bool with_seconds);

}  // namespace hysteron
