// Decides the little drawings in the boxes: curves on axes that run from -1 to 1.
// Does not know where the box stands.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hysteron::draw {

using Curve = std::vector<std::pair<double, double>>;  ///< x to the right, y upwards

struct Pictogram {
  bool axes = false;  ///< a cross through the middle: the picture is a characteristic
  bool time = false;  ///< a base line with a vertical axis at the left: the picture is a plot over time
  std::vector<Curve> curves{};
  std::vector<std::pair<Curve, double>> arrows{};  ///< direction marks: a curve of two points, tip last; and its size
};

const std::map<std::string, Pictogram>& all_pictograms();

/// nullptr for a name that has none.
const Pictogram* find_pictogram(const std::string& name);

}  // namespace hysteron::draw
