// Decides how runs of diagrams, their figures and the claims that they settle stand in a job ("do": "runs",
// docs/reproduce.md). Reads it and checks the names that the job itself gives; does not know the diagrams' signals and
// units (app/jobs/job_runs.h).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/jobs/job_file.h"

namespace hysteron {

/// A parameter set to a value of the job: {"of": "bottom", "times": -1}.
struct ValueSetting {
  WrittenText path, value;
  double times = 1;
};

/// A parameter set to what another run found: {"fitted": "compensator"} sets compensator.alpha to the fitted alpha.
struct UseWish {
  WrittenText run;
  std::string prefix;  ///< "" = parameters of the same path
};

/// From when to when, both ends included; a job shows or judges this part alone.
struct Window {
  std::optional<WrittenNumber> from{}, to{};
  bool given() const { return from.has_value(); }
};

/// A signal of a run, less another one.
struct SignalWish {
  WrittenText signal;
  std::optional<WrittenText> minus{};      ///< a signal of the same run, or of ...
  std::optional<WrittenText> minus_run{};  ///< ... this one, at the same instants
  bool same_stroke = false;                ///< scaled to the stroke of what is subtracted before it is
};

/// Rows alone whose signal lies between two values, both ends included; either may be left open.
struct RowCondition {
  SignalWish signal;
  std::optional<WrittenNumber> from{}, to{};
};

/// What is measured on traces, or on other values.
struct ValueWish {
  std::string name, pointer;
  WrittenText take;                        ///< one of takes(), or of combinations()
  std::vector<WrittenText> over_values{};  ///< of a combination
  WrittenText run;
  SignalWish of;
  std::optional<WrittenText> over{};  ///< the other signal of an area
  Window between;
  bool rezero = false;  ///< less the value at the first row
  std::vector<RowCondition> where{};
  std::optional<WrittenNumber> at{}, above{}, below{};
  std::optional<WrittenNumber> constant{};  ///< instead of all this: a number as it stands
  WrittenText figure;                       ///< of a computed value: its name; of a parameter: its path
  std::vector<std::pair<WrittenNumber, WrittenNumber>> points{};  ///< of off_points: where, and the value there
};

enum class RunKind { simulate, linearize, fit, table, elsewhere, find, minimize, study, select, rows, computed };

/// The rows of another run as the data of a fit.
struct FitDataWish {
  WrittenText run;
  std::vector<std::pair<std::string, WrittenText>> columns;  ///< input or output of the diagram -> signal
  Window between;
  std::vector<std::string> rezero;  ///< columns less their value at the first judged row
};

/// A column made of values of the job and of numbers.
struct RowsColumn {
  std::string name;
  struct Cell {
    WrittenText value{};                    ///< a value of the job ...
    std::optional<WrittenNumber> number{};  ///< ... or a number as it stands
  };
  std::vector<Cell> cells;
};

/// Parameters at which a value of the run is smallest, sought by a global method from several seeds.
struct SearchWish {
  struct Range {
    WrittenText parameter;
    WrittenNumber low, high;
  };
  std::vector<Range> parameters{};
  WrittenText method{"pso", ""};
  long runs = 505;  ///< budget of each search
  int seeds = 1;    ///< searches, with seeds 1, 2 ...
  std::optional<AttractorWish> attractor{};
};

/// How large a study is here, instead of what its job says.
struct StudySize {
  std::optional<std::uint64_t> draws{}, accepted{};
};

struct RunWish {
  std::string name, pointer, title;
  RunKind kind = RunKind::simulate;
  std::string
      file;  ///< the diagram; of a fit its diagram or job; of a table the CSV; of elsewhere and of study the job
  std::vector<Override> choose, set;
  std::vector<ValueSetting> set_of{};
  std::vector<UseWish> use{};
  std::optional<WrittenNumber> until{}, every{};
  WrittenText from, to;             ///< of linearize: signals
  std::vector<WrittenText> open{};  ///< of linearize
  std::optional<WrittenNumber> at{};
  std::optional<FitDataWish> data{};
  std::vector<std::string> free{};
  std::optional<WrittenText> method{};  ///< of fit: instead of the first one of its job
  WrittenText other_run;                ///< of elsewhere: its name there; of select: the run whose rows it takes
  std::vector<RowsColumn> rows{};
  WrittenText formula;                                    ///< of computed: which
  std::vector<std::pair<std::string, WrittenText>> of{};  ///< of computed: its argument -> a signal of `of_run`
  std::optional<WrittenText> of_run{};
  std::optional<WrittenNumber> top{};  ///< of computed: largest input
  WrittenText parameter;               ///< of find: what is varied ...
  std::vector<WrittenNumber> range{};
  ValueWish aim{};                      ///< ... until this (of the run itself; of minimize: what shall be small) ...
  WrittenNumber equals{};               ///< ... is that
  std::optional<SearchWish> search{};   ///< of minimize
  std::optional<StudySize> size{};      ///< of study
  std::optional<WrittenNumber> step{};  ///< of study: of fixed steps
  std::vector<RowCondition> where{};    ///< of select
  std::vector<WrittenText> record{};    ///< of study: columns; empty: all
};

struct AxisWish {
  std::vector<SignalWish> signals{};
  std::string label{};
  std::optional<WrittenText> unit{};
  std::optional<WrittenNumber> from{}, to{};
  bool log = false;
};

struct PlotWish {
  std::string title, kind = "curve", pointer, caption{};
  AxisWish x, y;
  std::vector<WrittenText> runs{};  ///< empty: all that have the signals
  Window between;
  bool rezero = false;
  std::vector<RowCondition> where{};
  int bins = 30;  ///< of a histogram
};

/// One condition by which a job settles (a part of) a claim.
struct ClaimPart {
  std::string id, pointer;
  WrittenText value{};
  std::optional<WrittenText> expected{}, tolerance{}, above{}, below{};
  std::string thesis{}, remark{};
  bool must_differ = false;
  std::vector<WrittenText> order{};  ///< values that must increase
};

/// "do": "runs".
struct RunsJob {
  std::string file, name;  ///< name = stem of the file: "fig2_15"
  std::string title, source, remark, surrogate, assumed, shows, learnt;
  std::vector<std::pair<std::string, std::string>> draw{};  ///< caption, diagram: block diagrams that the page shows
  std::vector<RunWish> runs{};
  std::vector<PlotWish> plots{};
  std::vector<ValueWish> values{};
  std::vector<ClaimPart> claims{};
};

/// What can be taken from a trace, and how values combine.
const std::vector<std::string>& takes();
const std::vector<std::string>& combinations();
/// What a run may take from a formula ("computed").
const std::vector<std::string>& computed_rows();

/// "do" of a job; "" if the file is no job. Throws Error where it cannot be read as JSON.
std::string what_a_job_does(const std::string& file);

/// Throws Error with file, line and JSON path for syntax, unknown keys and names, wrong types, a newer format, paths
/// outside the project, runs and values that need themselves. `full`: the sizes under "full" instead of the others.
RunsJob read_runs_job(const std::string& file, const std::vector<std::string>& allowed = {}, bool full = false);

}  // namespace hysteron
