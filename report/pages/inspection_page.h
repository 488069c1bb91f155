// Decides how an inspection of a data set is told: the section of a report, the sentences, the facts for programs.
// Does not inspect (fit/inspect/inspection.h, discover/placement/visible.h).
#pragma once

#include <string>
#include <vector>

#include "discover/placement/visible.h"
#include "fit/inspect/inspection.h"
#include "io/results/result.h"
#include "report/pages/facts.h"

namespace hysteron {

/// What a data set is, and which effects it can show in a diagram.
struct Inspected {
  Inspection data;
  std::vector<Visible> effects;
};

/// Inspects the recordings behind `model`, and asks which effects they can show in `diagram`.
Inspected inspect_data(const Diagram& diagram, const Registry& registry, DataModel& model, const Effects& effects,
                       const std::vector<std::string>& free_paths = {}, bool diagram_is_meant = true);

/// "No problem found in the data.", or how many and the first.
std::string inspection_headline(const Inspected& seen);
/// What the data are and what may be odd about them; then what they can and cannot show, if there is a library to ask.
std::vector<std::string> inspection_sentences(const Inspected& seen);
Section inspection_section(const Inspected& seen);
Facts inspection_facts(const Inspected& seen);

}  // namespace hysteron
