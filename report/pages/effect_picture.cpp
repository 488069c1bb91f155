// Decides how an effect is drawn. See effect_picture.h.
#include "report/pages/effect_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "report/pages/numbers.h"
#include "report/pages/text_plot.h"

namespace hysteron {
namespace {

/// Curves closer than two lines of the terminal are one there.
constexpr double told_apart = 0.15;

std::vector<double> shown_in(const Unit& unit, std::vector<double> si) {
  std::transform(si.begin(), si.end(), si.begin(), [&](double v) { return unit.from_si(v); });
  return si;
}

std::vector<double> differences_in(const Unit& unit, std::vector<double> si) {
  std::transform(si.begin(), si.end(), si.begin(), [&](double v) { return unit.difference_from_si(v); });
  return si;
}

std::string x_label(const Demonstration& d) {
  if (d.against_input) return axis_text("what goes in", d.in_unit);
  return d.log_time ? "time since the step [s]" : "time [s]";
}

std::vector<double> across(const Demonstration& d) { return d.against_input ? shown_in(d.in_unit, d.in) : d.t; }

Curve curve_of(const Demonstration& d, const std::string& name, const std::string& role, std::vector<double> y) {
  Curve curve;
  curve.name = name;
  curve.style = "line";
  curve.role = role;
  curve.x = across(d);
  curve.y = std::move(y);
  return curve;
}

Figure figure_of(const Demonstration& d, const std::string& title, const std::string& y_label) {
  Figure figure;
  figure.title = title;
  figure.x_label = x_label(d);
  figure.y_label = y_label;
  figure.log_x = d.log_time;
  return figure;
}

}  // namespace

std::string picture_caption(const Demonstration& d) {
  std::string text = "What goes in: " + d.signal;
  if (!d.device.empty()) text += ", into a " + d.device;
  return text + ". Drawn with: " + d.numbers + ".";
}

std::string picture_text(const Demonstration& d) {
  const auto x = across(d);
  if (d.share() < told_apart)
    return text_plot({{"with less without", '*', x, differences_in(d.out_unit, d.difference())}}, x_label(d),
                     axis_text("what it adds", d.out_unit), d.log_time);
  return text_plot(
      {{"without", '.', x, shown_in(d.out_unit, d.without)}, {"with", '*', x, shown_in(d.out_unit, d.with)}},
      x_label(d), axis_text("what comes out", d.out_unit), d.log_time);
}

std::vector<Figure> picture_figures(const Demonstration& d) {
  Figure both = figure_of(d, "With the effect and without it", axis_text("what comes out", d.out_unit));
  both.caption = picture_caption(d);
  both.curves = {curve_of(d, "without", "before", shown_in(d.out_unit, d.without)),
                 curve_of(d, "with", "after", shown_in(d.out_unit, d.with))};
  Figure adds = figure_of(d, "What it adds", axis_text("with less without", d.out_unit));
  adds.curves = {curve_of(d, "", "residual", differences_in(d.out_unit, d.difference()))};
  std::vector<Figure> figures{std::move(both), std::move(adds)};
  if (!d.side.empty()) {
    figures.push_back(figure_of(d, "What it reads besides", axis_text(d.side_name, d.side_unit)));
    figures.back().curves = {curve_of(d, "", "measured", shown_in(d.side_unit, d.side))};
  }
  return figures;
}

}  // namespace hysteron
