// Decides how numbers are taken from traces while these are simulated, row by row, for several samples at once: nothing
// of a trace is kept, so that millions of samples need no memory. The same numbers as features.h takes from whole
// traces, whatever the number of samples at once. Does not simulate.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hysteron {

enum class Take {
  at,
  first,
  last,
  min,
  max,
  stroke,
  mean,
  rms,
  deviation,
  max_abs,
  sum_squares,
  area,
  remanence,
  overshoot
};

/// In the order of Take.
const std::vector<std::string>& trace_takes();

/// One number of a trace. Signals are places in a row.
struct TraceFeature {
  Take take = Take::stroke;
  int signal = 0;
  int minus = -1;              ///< a signal that is subtracted
  std::vector<double> less{};  ///< per row: what is subtracted besides; empty = nothing
  int over = -1;               ///< of an area: the signal along x
  long first = 0, last = 0;    ///< rows [first, last)
  bool rezero = false;         ///< less the value at the first row
  double at = 0;               ///< of at [s]: between rows by a straight line, held beyond the ends
};

/// What several features of one piece of one trace share, while its rows pass. Internal to Reducers.
struct TracePiece {
  TraceFeature of;  ///< signal, minus, less, over, rows and rezero
  bool extremes = false, mean = false, squares = false, deviation = false, area = false;
  long before = -1, after = -1;  ///< of at: the rows on both sides of the instant
  double along = 0, step = 1;    ///< the instant lies along/step of the way from `before` to `after`
  std::vector<double> numbers;   ///< [number][lane]
};

class Reducers {
 public:
  /// `instants`: of all rows [s], increasing; `lanes`: samples at once.
  Reducers(const std::vector<TraceFeature>& features, std::vector<double> instants, int lanes);

  /// Row `k` of every sample: signals[s * lanes + lane]. Called for each row in order; the first row begins anew.
  void row(long k, const double* signals);
  /// After the last row: values[feature * lanes + lane]. NaN where the trace was not finite in the rows that are used.
  void values(double* values) const;

 private:
  int piece_of(const TraceFeature& feature);
  double value(const TraceFeature& feature, const TracePiece& piece, int lane) const;

  int lanes_;
  std::vector<double> instants_;
  std::vector<TraceFeature> features_;
  std::vector<int> place_;  ///< per feature: its piece
  std::vector<TracePiece> pieces_;
};

}  // namespace hysteron
