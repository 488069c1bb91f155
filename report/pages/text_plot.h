// Decides how curves look in a terminal: marks in a frame, with the ends of both axes.
// Does not know what they show.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

struct TextCurve {
  std::string name;
  char mark = '*';
  std::vector<double> x, y;
};

/// Curves in one frame, later ones over earlier ones, lines closed between their points; the names with their marks
/// stand above, the labels with the ends of the axes beside and below. "" where there is nothing to draw.
std::string text_plot(const std::vector<TextCurve>& curves, const std::string& x_label, const std::string& y_label,
                      bool log_x = false);

}  // namespace hysteron
