// Decides how a recording is shown where it turns: output over input, force over velocity and over displacement, and
// the part of the time in which model and measurement differ most. Does not simulate and does not judge.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "io/results/result.h"
#include "report/pages/curves.h"

namespace hysteron {

/// A signal of a table: of a recording, measured and simulated; of a simulation alone, the same column twice.
struct Plotted {
  std::string name;
  std::string measured, simulated;  ///< columns
  std::string before{};             ///< column of the model before, or ""
};

/// `y` over `u`, coloured by time; no curves where one of the columns is missing or `u` never turns.
Figure loop_figure(const CsvTable& table, const Plotted& u, const Plotted& y);

/// Each force and torque among the signals over each velocity and each displacement among them, where there is a
/// velocity: dry friction is a step at zero, viscous friction a slope, stiffness a slope over the displacement. The
/// first `most` of them.
std::vector<Figure> phase_planes(const CsvTable& table, const std::vector<Plotted>& signals,
                                 std::size_t most = std::numeric_limits<std::size_t>::max());

/// Measured and simulated in that twelfth of the time in which the squared residual is largest; no curves where the
/// recording is too short to have parts.
Figure closest_look(const CsvTable& table, const Plotted& y, const std::string& residual);

/// Inputs and measured outputs of a table of recording_table().
std::vector<Plotted> signals_of(const Beside& view, const CsvTable& table);

/// closest_look() of an output and its loop over the main input, as far as there are such.
std::vector<Figure> loop_figures(const Beside& view, const CsvTable& table, int output);

/// Those of all outputs, and phase planes.
void add_loop_figures(Section& section, const Beside& view, const CsvTable& table);

/// What shows on the first screen how far the model is: of the recording and output with the largest error relative to
/// its motion, measured and simulated and the residual over time, a closer look, and the loop. `tables`: of
/// `recordings`, in their order.
std::vector<Figure> how_far_figures(const Beside& view, const std::vector<int>& recordings,
                                    const std::vector<CsvTable>& tables);

}  // namespace hysteron
