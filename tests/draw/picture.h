// Decides how tests read a picture back from its SVG: outlines, wires and texts in the coordinates of the whole sheet.
// Knows nothing of how it was laid out.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace hysteron::picture {

struct Place {
  double x = 0, y = 0;
  bool operator==(const Place&) const = default;
};

/// The outline of a block: a rectangle, a circle or a triangle, as drawn.
struct Outline {
  std::string path, type;
  std::string shape;  ///< "rect", "circle", "polygon"
  double left = 0, top = 0, right = 0, bottom = 0;
  bool is_new = false;            ///< set off from the others
  bool open = false;              ///< a nested diagram whose content is shown
  std::string texts;              ///< all of its texts, one per line
  bool on_border(Place p) const;  ///< to a hundredth of a pixel
  bool holds(Place p) const;      ///< strictly inside
};

struct Wire {
  std::string signal, from, to;
  int input = 0;
  bool feedback = false;
  std::vector<Place> path;
  Place tip;  ///< of its arrow head
};

struct Picture {
  std::vector<Outline> outlines;
  std::vector<Wire> wires;
  std::vector<Place> branches;
  double width = 0, height = 0;
  const Outline* find(const std::string& path, bool port = false) const;
};

/// Throws std::runtime_error if the text is no SVG.
Picture read(const std::string& svg);

/// Laws of every picture; one sentence per violation, empty if all is well: no two outlines overlap (an open diagram
/// holds its own), wires are horizontal and vertical, begin and end on the borders of what they join, arrow heads point
/// to that end, wires of different signals do not lie on each other and no wire runs through a symbol.
std::vector<std::string> violations(const Picture& picture);

}  // namespace hysteron::picture
