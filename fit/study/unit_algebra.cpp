#include "fit/study/unit_algebra.h"

namespace hysteron {
namespace {

bool compound(const Unit& unit) { return unit.text.find_first_of("/ *.") != std::string::npos; }

/// Text that parse_unit reads, and the numbers that belong to it.
Unit named(const std::string& text, const Dimension& dimension, double scale) {
  Unit unit;
  unit.text = text;
  unit.dimension = dimension;
  unit.scale = scale;
  return unit;
}

}  // namespace

Unit without_offset(Unit unit) {
  unit.offset = 0;
  return unit;
}

Unit product(const Unit& a, const Unit& b) {
  const std::string text = a.text.empty() ? b.text : b.text.empty() ? a.text : a.text + " " + b.text;
  return named(text, a.dimension * b.dimension, a.scale * b.scale);
}

Unit quotient(const Unit& a, const Unit& b) {
  const std::string below = compound(b) ? "(" + b.text + ")" : b.text;
  const std::string text = a.text == b.text ? ""
                           : b.text.empty() ? a.text
                                            : (a.text.empty() ? "1" : a.text) + "/" + below;
  return named(text, a.dimension / b.dimension, a.scale / b.scale);
}

Unit squared(const Unit& a) {
  const std::string text = a.text.empty() ? "" : compound(a) ? "(" + a.text + ")2" : a.text + "2";
  return named(text, a.dimension * a.dimension, a.scale * a.scale);
}

}  // namespace hysteron
