// Decides what a data set is good for before any model is judged on it: units and ranges, clock, lost and repeated
// rows, ends at which a column stays, band and turns of the drives, holds, what repeats and how well, lines that no
// drive makes, a shift in time, the way of an input between its samples.
// Knows no effect (discover/placement/visible.h says which of them these data can show). Recordings of the role test
// are not read.
#pragma once

#include <string>
#include <vector>

#include "fit/inspect/delay.h"
#include "fit/inspect/way_between.h"
#include "fit/model/model.h"
#include "fit/signals/excitation.h"
#include "fit/signals/interference.h"
#include "fit/signals/repeatability.h"
#include "fit/signals/row_checks.h"

namespace hysteron {

/// One column over all recordings inspected [SI].
struct InspectedColumn {
  std::string name;
  std::string role;  ///< "input", "output", "auxiliary" (bound to nothing)
  Unit unit;
  double lowest = 0, highest = 0;
  double finest = 0;     ///< step between its levels; 0 = none can be told
  double roughness = 0;  ///< least noise that explains its rows, median over the recordings
};

/// One input in one recording.
struct InspectedDrive {
  std::string input;
  Unit unit;
  double lowest = 0, highest = 0;  ///< [SI]
  double fastest = 0;              ///< [SI/s] between two rows
  Band band;
  std::size_t reversals = 0;
  std::size_t swings = 0;  ///< sizes of swing that differ by a tenth of the range
  Hold hold;
  Period period;
};

struct InspectedRecording {
  std::string name;
  Role role = Role::train;
  std::size_t rows = 0;
  double duration = 0;  ///< [s]
  Clock clock;
  std::vector<InspectedDrive> drives;  ///< of the inputs that move
};

/// The floor of an output, from something that was recorded twice.
struct InspectedRepeat {
  std::string output, what;  ///< "19 periods in 01.csv", "01.csv and 05.csv, driven alike"
  Unit unit;
  Repeatability floor;
};

struct InspectedLine {
  std::string output;
  Unit unit;
  double frequency = 0, amplitude = 0;  ///< [Hz], [SI] median over the recordings
  std::vector<std::string> recordings;
  bool of_residual = true;  ///< seen in what the diagram leaves, else in the measured signal itself
};

/// An end of its range at which an input may have been cut.
struct InspectedCut {
  std::string input;
  Unit unit;
  bool at_top = true;
  double level = 0, would_be = 0;  ///< [SI]; the farthest of all recordings
  std::size_t tops = 0;
  std::vector<std::string> recordings{};
};

struct Inspection {
  std::vector<InspectedColumn> columns;
  std::vector<InspectedRecording> recordings;
  std::vector<InspectedRepeat> repeats;  ///< the lowest of each output first
  std::vector<InspectedLine> lines;
  std::vector<InspectedCut> cuts;
  std::vector<DelayFinding> delays;       ///< one per output, as find_delays
  std::vector<InspectedBetween> between;  ///< only where the other way is clearly better
  std::vector<std::string> faults;        ///< what is wrong with the data, or ought to be written in the data set
  std::vector<std::string> spoiling;      ///< of the faults: those that spoil whatever is found from the data
  std::vector<std::string> notes;         ///< what may be either the data or the device
  std::vector<std::string> sentences;     ///< what the data are, most important first
};

/// The step between the levels of a column [SI], the finest that a recording shows; 0 = none can be told. One that
/// rests on few of them shows none, or several in one.
double finest_step(const DataSet& data, const std::string& column);

/// Does this column have two values that differ, in any recording that is inspected? False where no recording has it.
bool moves(const DataSet& data, const std::string& column);

struct InspectionQuestion {
  std::vector<std::string> free_paths{};  ///< may be fitted beside what the diagram declares free
  /// False: the diagram only stands for one that nobody named, and what it gets wrong in time says nothing of the data.
  bool diagram_is_meant = true;
};

/// Inspects the data set of `model`. Shift, lines and the way between samples are judged against the diagram with its
/// free parameters fitted, and a gain and an offset of each output: a value that the user left open is no fault of the
/// data.
Inspection inspect(DataModel& model, const InspectionQuestion& question = {});

}  // namespace hysteron
