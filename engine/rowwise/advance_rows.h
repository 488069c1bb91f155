// Decides how runs that see nothing but rows are advanced many rows at once: every block, in its order, passes a chunk
// of rows before the next block does, several runs of one program side by side ("lanes"). Nothing is looked up or
// allocated row by row. Which runs these are: AdvancePlan::is_plain. Internal to the exact advance.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/rowwise/advance_plan.h"
#include "engine/rowwise/advance_state.h"
#include "engine/rowwise/schedule.h"

namespace hysteron {

class AdvanceRows {
 public:
  /// lanes: 1 or RowsView::most_lanes.
  AdvanceRows(const AdvancePlan& plan, int lanes);

  /// Runs that have been started at the first point, one to as many as there are lanes, through all others:
  /// values[run]->[signal][instant] [SI].
  void operator()(std::span<AdvanceState* const> states, const Schedule& schedule, int substeps,
                  std::span<std::vector<std::vector<double>>* const> values);

 private:
  using Values = std::vector<std::vector<double>>;

  void begin(std::span<AdvanceState* const> states, std::size_t rows);
  void find_direct(const Schedule& schedule, int substeps);
  void point_direct(std::size_t first, std::span<Values* const> values);
  std::size_t lay_out_rows(const Schedule& schedule, std::size_t first, std::size_t points, int substeps);
  void fill_sources(const Schedule& schedule, std::size_t first, std::size_t points, int substeps);
  void pass_linear(std::span<AdvanceState* const> states, int part, std::size_t rows, const Schedule& schedule,
                   int substeps);
  void pass_block(std::span<AdvanceState* const> states, int block, std::size_t rows);
  void pass_history(AdvanceState& state, int lane, int block, std::size_t rows);
  void pass_loop(AdvanceState& state, std::size_t lane, int loop, std::size_t rows);
  void record(const Schedule& schedule, std::size_t first, std::size_t points, std::span<Values* const> values);
  void keep_last_row(std::size_t rows);
  bool has_run_away(std::span<Values* const> values) const;

  const AdvancePlan& plan_;
  const Program& program_;
  std::size_t lanes_;
  std::size_t next_instant_ = 0;
  std::vector<int> signals_;             // that have a place of their own
  std::vector<bool> computed_;           // per signal: made row by row
  std::vector<char> direct_;             // per place in plan_.signals: made where it is wanted
  std::vector<bool> is_direct_;          // per signal
  std::vector<double> arena_;            // per such signal: a row before the chunk, then its rows
  std::vector<double*> own_;             // per signal: row 0 in the arena, or null
  std::vector<const double*> in_;        // per signal: row 0, in the arena or in the schedule
  std::vector<double> x_, m_, scratch_;  // states and memory of nonlinear blocks, lane by lane within a block
  std::vector<View<double>> views_;      // per block and lane
  // Of the chunk: per row, step, kind and time with the piece that it belongs to; per point its row.
  std::vector<double> h_, t_, branch_;
  std::vector<int> kind_;
  std::vector<std::size_t> row_;
  bool row_is_point_ = false;  // then row_ is not there
  const double* steps_ = nullptr;
  const int* kinds_ = nullptr;
  const double* times_ = nullptr;
  std::vector<const double*> inputs_;
  std::vector<double*> outputs_;
};

}  // namespace hysteron
