// Decides at which points a run passes whose inputs are recordings: the instants asked for, the samples between them,
// and the jumps of held inputs; with the values of the inputs there. Made once for the same instants and recordings,
// used by many runs. Internal to the exact advance.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/diagram/series.h"

namespace hysteron {

struct Schedule {
  using Instants = std::shared_ptr<const std::vector<double>>;

  Instants instants;
  std::vector<SeriesPointer> series;
  std::span<const double> t;    ///< per point [s]; the first is the start
  double start_branch = 0;      ///< a time inside the first piece of every input [s]
  std::vector<double> h;        ///< per point: the step that leads to it [s]; 0: the first, or an input jumps
  std::vector<int> kind;        ///< per point: steps of one length but for rounding have one kind; -1 where h = 0
  std::vector<double> lengths;  ///< per kind [s]
  bool one_to_one = false;      ///< every point is an instant
  std::vector<std::span<const double>> values;  ///< [series][point] [SI]

  Schedule(Instants instants, std::vector<SeriesPointer> series);
  Schedule(const Schedule&) = delete;
  Schedule& operator=(const Schedule&) = delete;

  bool is_for(const Instants& other, std::span<const SeriesPointer> others) const;
  std::size_t point_of(std::size_t instant) const { return one_to_one ? instant : point_[instant]; }

 private:
  bool inputs_are_plain() const;
  bool take_instants();
  void take_samples(std::size_t input);
  void lay_out();

  // Of what is not an instant or a sample as it is.
  std::vector<double> own_t_;
  std::vector<std::vector<double>> own_values_;
  std::vector<std::size_t> point_;  // per instant; empty where one_to_one
};

/// A recording as it comes `by` seconds later to one that knows nothing of it before `start` [s].
SeriesPointer later(const Series& series, double by, double start);

/// First sample of any of them behind t [s], or infinity.
double next_sample(std::span<const SeriesPointer> series, double t);

/// Instants and the samples of all inputs between them, in order.
std::vector<double> rows_between(std::span<const double> instants, std::span<const SeriesPointer> series);

}  // namespace hysteron
