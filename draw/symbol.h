// Decides how a block of a type looks: its outline, its size and what stands in it.
// Does not know any block: types are names, and one without a symbol of its own gets a box with its name.
#pragma once

#include <string>
#include <vector>

#include "draw/caption.h"
#include "engine/block/declaration.h"

namespace hysteron::draw {

enum class Outline { box, circle, triangle, port, frame };  // frame: a nested diagram

struct Symbol {
  Outline outline = Outline::box;
  double width = 64, height = 44;
  std::string picture{};             ///< pictogram ("" = none)
  std::vector<std::string> text{};   ///< lines in the middle; a fraction has two
  bool fraction = false;             ///< text[0] over text[1]
  std::string note{};                ///< small, below the pictogram: the type where a pictogram does not tell it
  std::string signs{};               ///< a sum: one + or - per input
  bool port_names = false;           ///< names of the ports stand at the border
  std::vector<std::string> shown{};  ///< parameters that the symbol tells, so that the caption need not
};

/// The symbol of a block with `n_in` wires and `n_out` outputs.
Symbol symbol_of(const Declaration& declaration, const Values& values, int n_in, int n_out);

/// Turns the circle of a sum into a box: many wires, or several loops, need sides of their own.
void make_sum_box(Symbol& sum, int n_in);

/// A box with a text, wide enough for it and for its ports.
Symbol text_symbol(const std::vector<std::string>& lines, int n_in, int n_out);

/// Estimated width of a text: no font is at hand here.
double text_width(const std::string& text, double size);

inline constexpr double port_distance = 22;  ///< between the ports of a box
inline constexpr double sum_radius = 11;
inline constexpr double pictogram_width = 48, pictogram_height = 30;

}  // namespace hysteron::draw
