// Decides what is told of the experiments that competed for a tie: how far each sets the rivals apart, and why one was
// chosen. Does not simulate and does not choose.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

/// An experiment of the menu as it was simulated with all rivals.
struct MenuItem {
  std::string word;             ///< as effects name it: "multisine", "step_hold" ...
  std::string drive{};          ///< the input that moves
  double slower = 1, part = 1;  ///< as Variant: times the usual time, of the range
  double faster_rows = 1;       ///< sampled so many times as fast as the recordings
  /// rms over the noise, of each of Menu::pairs; negative = not known. Empty = not simulated.
  std::vector<double> separations{};
  double separation = -1;               ///< as Experiment::separation; negative = it says nothing
  int rivals_told = 0, pairs_told = 0;  ///< told from the first; of all pairs
  bool asked = false;                   ///< a pair that it clearly tells names its word
  bool chosen = false;
  bool as_recorded = false;  ///< as Variant: moves nothing faster than the recordings did
  std::string reason{};      ///< why it was chosen, or why not

  bool simulated() const { return !separations.empty(); }
};

struct Menu {
  std::vector<std::string> pairs;  ///< "amplifier_lag and dead_time"
  std::vector<MenuItem> items;     ///< in the order in which they were simulated
};

/// Fills the reasons of all that say something, beside the one that was chosen.
void give_reasons(Menu& menu);
Menu without_choice(Menu menu);
/// Adds what `further` has that is not there yet. What is chosen there takes the place of what was chosen so far.
void add_items(Menu& menu, Menu further);

}  // namespace hysteron
