// The surrogate actuator S1 of diagrams/chapter2 as a source of recordings. Its numbers are no measurements.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/simulate/simulate.h"
#include "io/diagram/diagram_file.h"
#include "tests/fit/lab.h"

namespace hysteron::surrogate {

inline std::string folder() { return std::string(HYSTERON_SOURCE_DIR) + "/diagrams/chapter2/"; }

/// Drive [V], static part and output [m] of the surrogate on the drive of the thesis, at these instants [s].
inline Traces open_loop(const std::string& shape, const std::vector<double>& instants,
                        const std::string& file = "s1_open_loop.json") {
  Diagram d = read_diagram(folder() + file);
  d.blocks.find("drive")->choose = shape;
  const auto program = compile(d, lab::registry());
  SimulateOptions options;
  options.instants = instants;
  options.until = instants.back();
  options.relative_tolerance = 1e-9;
  return simulate(*program, start(*program), options);
}

/// One cycle of 2000 rows of the steady loop of S1 [V, um], zero arbitrary, behind `before` cycles of 200 rows that are
/// not judged and bring a model from rest to its own steady loop. Where the thesis counts N = 10000 rows, five such
/// cycles, sums of squares are five times as large.
inline DataSet steady_loop(int before = 12) {
  std::vector<double> t;
  for (int k = 0; k < 200 * before; ++k) t.push_back(1e-3 * k);
  const std::size_t first = t.size();
  for (int k = 0; k < 2000; ++k) t.push_back(0.2 * before + 1e-4 * k);  // s
  std::vector<double> instants;
  for (const double x : t) instants.push_back(1 + x);  // S1 itself has settled: its relaxation takes 5 ms
  const Traces traces = open_loop("sine", instants);
  DataSet data;
  data.notes["u"].to = "u";
  data.notes["y"].to = "y";
  data.notes["y"].zero_per_recording = true;
  data.notes["y"].noise.white = 10e-9;
  data.notes["y"].noise.one_over_f = 0.0;
  Recording r = lab::recording("loop", Role::train, 1, t.size(), [](double) { return 0.0; });
  r.t = std::move(t);
  r.columns["u"] = traces.values[0];
  r.columns["y"] = traces.values[2];
  r.first = first;
  data.recordings.push_back(std::move(r));
  return data;
}

}  // namespace hysteron::surrogate
