// Decides how a figure stands on a page: title, legend, picture, caption, its numbers; figures in pairs, and those of
// the first screen. Does not decide what they show (prepare.h) nor draw curves (figure_svg.h).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/page/prepare.h"

namespace hysteron {

/// Narrow figures stand in pairs; one that stays alone takes the full width if it holds curves.
void widen_lonely(std::vector<PreparedFigure>& figures);

/// Figures of a section; "" for none.
std::string figures_html(const std::vector<PreparedFigure>& figures, std::size_t section);

/// The figures that show the answer, as large as a screen of 1280 x 800 has room below the headline: those over time on
/// the left, one below the other, others on the right. "" for none.
std::string answer_html(std::vector<PreparedFigure> figures);

}  // namespace hysteron
