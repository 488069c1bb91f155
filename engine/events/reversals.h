// Decides when the input of a memory block turns back, as falling roots of a signed and shifted indicator.
// Does not commit memory: the loop in adaptive_step.cpp does, wherever one of these fires.
#pragma once

#include <vector>

#include "engine/program/nominal.h"
#include "engine/program/program.h"

namespace hysteron {

/// One indicator per signal that drives memory and has a rate: g = s * du/dt + eps, s the committed direction
/// (Run::direction). The shift keeps g off zero while the input rests; the sign makes it fall through zero at every
/// reversal, late by eps / |u''|, which misses eps^2 / (2 |u''|) of the peak.
class Reversals {
 public:
  /// `tolerance`: relative, of the integration; a rate smaller than its share of the nominal rate is rounding.
  Reversals(const Program& program, const NominalSizes& sizes, double tolerance);

  int count() const { return static_cast<int>(watched_.size()); }
  /// work.rate must be that of evaluate_memory_rates.
  void indicate(const Run& run, const Work& work, double* g) const;
  /// True while some input has not moved yet, so that its direction is open.
  bool open(const Run& run) const;
  /// Gives a direction to inputs that have begun to move. Those that move against theirs have turned at a corner;
  /// returns how many.
  int follow(Run& run, const Work& work) const;
  /// The indicator `i` has fired.
  void turn(Run& run, int i) const;

 private:
  struct Watched {
    int signal;
    std::vector<std::size_t> directions;  // of the memory blocks that read it, in Run::direction
    double threshold;                     // eps [SI/s]
  };
  std::vector<Watched> watched_;
};

}  // namespace hysteron
