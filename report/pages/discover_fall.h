// Decides how the fall of the error is shown: the waterfall against what repeats, the residual before and after each
// step on the same axes, the diagram before and after with what is new set off. Everything from recordings that were
// not used for the fit. Does not discover, and does not write files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "discover/search/discovery.h"
#include "io/results/result.h"
#include "report/pages/curves.h"
#include "report/pages/inspection_page.h"

namespace hysteron {

/// Against what the error of an output is held.
struct Floor {
  std::string output;
  double repeatability = 0;  ///< [SI] what the device itself repeats to; 0 = nothing was recorded twice
  std::string repeats;       ///< "19 periods in 01.csv"
  double noise = 0;          ///< [SI] of the sensor, as it was judged; 0 = not known
  std::string noise_from;    ///< "data sheet"
};

/// One per output. A zero that is free per recording is no part of what repeats.
std::vector<Floor> floors_of(const Discovery& found, const DataModel& model, const Inspected& inspected);
Facts floor_facts(const std::vector<Floor>& floors, const DataModel& model);

/// The user's diagram and what it became, one after the other, on the same recordings: the base, then a stage per step.
class Stages {
 public:
  Stages(const Discovery& found, const std::shared_ptr<const DataSet>& data, const Registry& registry);
  const DataModel& model() const { return *models_.back(); }  ///< bound to the final diagram
  const std::vector<Comparison>& all() const { return all_; }
  const Comparison& before() const { return all_.front(); }
  const Comparison& after() const { return all_.back(); }
  /// Recordings that were not used for the fit; of the base and of the final diagram, with shares over these alone.
  const std::vector<int>& unseen() const { return unseen_; }
  const Comparison& before_unseen() const { return before_unseen_; }
  const Comparison& after_unseen() const { return after_unseen_; }
  Beside beside() const;

 private:
  Comparison compared(const Diagram& diagram, const std::shared_ptr<const DataSet>& data);
  const Registry& registry_;
  std::vector<std::unique_ptr<DataModel>> models_;
  std::vector<Comparison> all_;
  std::vector<int> unseen_;
  Comparison before_unseen_, after_unseen_;
};

/// A waterfall for each output.
std::vector<Figure> waterfalls(const Discovery& found, const DataModel& model, const std::vector<Floor>& floors);

/// Measured and simulated on the recording on which the base was worst; then for each step the residual before and
/// after it, on the recording and output from which it took most. `document` has the traces of judged_recordings().
void add_fall_figures(Section& section, const Document& document, const Discovery& found, const Stages& stages);

/// Pictures of the diagram before and after, with what was added set off; their files go into the document. Where
/// Graphviz is missing the section says so instead.
void add_diagram_pictures(Section& section, Document& document, const Discovery& found, const Registry& registry);

}  // namespace hysteron
