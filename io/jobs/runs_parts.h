// Decides how the values, plots and claims of a job of runs stand in JSON. Which runs there are: runs_job.cpp; whether
// the names fit together: runs_names.h. Internal to io. What is wrong is noted at its place in the file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/jobs/runs_job.h"
#include "io/json/json_reader.h"

namespace hysteron::job_parts {

/// "minus": "reference", or {"run": "golden", "signal": "y"}, into `wish`.
void read_minus(const JsonPlace& object, SignalWish& wish);
/// "where": [{"signal": "gamma", "from": 0.15, "to": 0.25}]
std::vector<RowCondition> conditions_of(const JsonPlace& object);
/// {"take": "stroke", "of": "stage", "run": "none"}, or what is made of other values: {"ratio": ["first", "second"]}.
/// `needs_run`: it must say on which run.
ValueWish value_of(const std::string& name, const JsonPlace& place, bool needs_run);
/// {"title": "...", "y": {"signal": "stage"}}; nothing where it is no object.
std::optional<PlotWish> plot_of(const JsonPlace& place);
/// {"id": "C2-07", "value": "stroke", "expected": "6.6 um", "tolerance": "1 %"}; nothing where it is no object.
std::optional<ClaimPart> claim_of(const JsonPlace& place);

}  // namespace hysteron::job_parts
