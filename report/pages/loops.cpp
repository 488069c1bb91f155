#include "report/pages/loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/diagram/index.h"
#include "fit/signals/branches.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr std::size_t parts_of_time = 12;       ///< a closer look shows one of so many
constexpr std::size_t fewest_rows_of_part = 8;  ///< less than that is no curve

Curve loop_curve(const CsvTable& table, const std::string& x, const std::string& y, const std::string& name,
                 const std::string& role) {
  Curve curve = trace_curve(table, x, y, name, "line", role);
  if (role != "before") curve.colour = "time";
  return curve;
}

/// What a signal is to a phase plane.
enum class Kind { other, force, velocity, displacement };

Kind kind_of(const Unit& unit) {
  const auto is = [&](const char* text) { return unit.dimension == parse_unit(text).dimension; };
  if (is("N") || is("N m")) return Kind::force;
  if (is("m/s") || is("rad/s") || unit.text == "rpm" || unit.text == "rev/min") return Kind::velocity;
  if (is("m") || is("rad")) return Kind::displacement;
  return Kind::other;
}

bool there(const CsvTable& table, const Plotted& signal) {
  return table.find(signal.measured) != nullptr && table.find(signal.simulated) != nullptr;
}

/// `y` over `x`, whatever they are.
Figure over(const CsvTable& table, const Plotted& x, const Plotted& y) {
  Figure figure;
  figure.title = fmt::format("{} over {}", y.name, x.name);
  figure.x_label = axis_text(x.name, table.find(x.measured)->unit);
  figure.y_label = axis_text(y.name, table.find(y.measured)->unit);
  const bool two = x.measured != x.simulated || y.measured != y.simulated;
  if (two) figure.curves.push_back(loop_curve(table, x.measured, y.measured, "measured", "measured"));
  if (!y.before.empty()) figure.curves.push_back(loop_curve(table, x.measured, y.before, "before", "before"));
  figure.curves.push_back(loop_curve(table, x.simulated, y.simulated,
                                     !two               ? y.name
                                     : y.before.empty() ? "simulated"
                                                        : "after",
                                     two ? "simulated" : ""));
  return figure;
}

using Part = std::pair<std::size_t, std::size_t>;  ///< first and last row

/// The part in which the squared residual is largest; both 0 where there are no parts.
Part worst_part(const std::vector<double>& t, const std::vector<double>& residual) {
  const std::size_t n = std::min(t.size(), residual.size());
  if (n < parts_of_time * fewest_rows_of_part || !(t[n - 1] > t[0])) return {};
  const double length = (t[n - 1] - t[0]) / static_cast<double>(parts_of_time);
  double sum = 0, largest = -1;
  Part worst{};
  const auto squared = [&](std::size_t i) { return std::isfinite(residual[i]) ? residual[i] * residual[i] : 0.0; };
  for (std::size_t first = 0, last = 0; last < n; ++last) {  // the rows within `length` before each row
    sum += squared(last);
    for (; t[last] - t[first] > length; ++first) sum -= squared(first);
    if (sum > largest && last - first + 1 >= fewest_rows_of_part) {
      largest = sum;
      worst = {first, last};
    }
  }
  return worst;
}

/// That part of a figure whose curves are coloured by time, its numbers in the figure itself.
Figure part_of(Figure figure, const CsvTable& table, Part rows) {
  constexpr std::size_t most_points = 2000;
  const std::size_t stride = (rows.second - rows.first) / most_points + 1;
  for (auto& curve : figure.curves) {
    const auto& x = table.find(curve.x_column)->values;
    const auto& y = table.find(curve.y_column)->values;
    for (std::size_t i = rows.first; i <= rows.second; i += stride) {
      curve.x.push_back(x[i]);
      curve.y.push_back(y[i]);
    }
    curve.trace.clear();
  }
  return figure;
}

/// Whether the main input turns there; else a part of a loop is no loop.
bool turns_in(const Beside& view, const CsvTable& table, Part rows) {
  const int main = view.model->main_input();
  if (main < 0 || rows.second <= rows.first) return false;
  const auto& u = table.find(view.model->program().input_names[at(main)])->values;
  const double threshold = turning_threshold(u);
  return !turning_points(std::span(u).subspan(rows.first, rows.second - rows.first + 1), threshold).empty();
}

Plotted output_signal(const Beside& view, const CsvTable& table, const std::string& name) {
  const bool before = view.before != nullptr && table.find(name + "_simulated_before") != nullptr;
  return {name, name + "_measured", name + "_simulated", before ? name + "_simulated_before" : ""};
}

/// By which residual a closer look is chosen.
std::string residual_shown(const Beside& view) { return view.before != nullptr ? "_residual_before" : "_residual"; }

/// The recording and output with the largest error relative to its motion; of those that validate, where there are any.
std::pair<int, int> worst_of(const Beside& view, const std::vector<int>& recordings) {
  std::pair<int, int> worst{-1, -1};
  for (const bool validate : {true, false}) {
    double largest = -1;
    for (const int r : recordings) {
      if (validate && view.model->recording(r).role != Role::validate) continue;
      for (int y = 0; y < static_cast<int>(view.model->outputs().size()); ++y) {
        const Metrics* m = (view.before != nullptr ? view.before : view.now)->find(r, y);
        if (m == nullptr || !(m->nrmse > largest)) continue;
        largest = m->nrmse;
        worst = {r, y};
      }
    }
    if (worst.first >= 0) break;
  }
  return worst;
}

}  // namespace

Figure loop_figure(const CsvTable& table, const Plotted& u, const Plotted& y) {
  if (!there(table, u) || !there(table, y)) return {};
  const auto& values = table.find(u.measured)->values;
  if (turning_points(values, turning_threshold(values)).empty()) return {};
  return over(table, u, y);
}

std::vector<Figure> phase_planes(const CsvTable& table, const std::vector<Plotted>& signals, std::size_t most) {
  std::vector<const Plotted*> forces, velocities, displacements;
  for (const auto& signal : signals) {
    if (!there(table, signal)) continue;
    const Kind kind = kind_of(table.find(signal.measured)->unit);
    if (kind == Kind::force) forces.push_back(&signal);
    if (kind == Kind::velocity) velocities.push_back(&signal);
    if (kind == Kind::displacement) displacements.push_back(&signal);
  }
  std::vector<Figure> figures;
  if (velocities.empty()) return figures;
  for (const auto* motions : {&velocities, &displacements})
    for (const auto* motion : *motions)
      for (const auto* force : forces)
        if (figures.size() < most) figures.push_back(over(table, *motion, *force));
  return figures;
}

Figure closest_look(const CsvTable& table, const Plotted& y, const std::string& residual) {
  const CsvColumn* t = table.find("t");
  const CsvColumn* left = table.find(residual);
  if (t == nullptr || left == nullptr || !there(table, y)) return {};
  const auto [first, last] = worst_part(t->values, left->values);
  if (last <= first) return {};
  Figure figure;
  figure.title = fmt::format("{} where they differ most", y.name);
  figure.x_label = "t [s]";
  figure.y_label = axis_text(y.name, table.find(y.measured)->unit);
  figure.x_range = {t->values[first], t->values[last]};
  figure.curves.push_back(trace_curve(table, "t", y.measured, "measured", "line", "measured"));
  if (!y.before.empty()) figure.curves.push_back(trace_curve(table, "t", y.before, "before", "line", "before"));
  const bool after = !y.before.empty();
  figure.curves.push_back(
      trace_curve(table, "t", y.simulated, after ? "after" : "simulated", "line", after ? "after" : "simulated"));
  return figure;
}

std::vector<Plotted> signals_of(const Beside& view, const CsvTable& table) {
  std::vector<Plotted> signals;
  for (const auto& name : view.model->program().input_names) signals.push_back({name, name, name});
  for (const auto& name : view.model->outputs())
    if (table.find(name + "_measured") != nullptr) signals.push_back(output_signal(view, table, name));
  return signals;
}

std::vector<Figure> loop_figures(const Beside& view, const CsvTable& table, int output) {
  const std::string& name = view.model->outputs()[at(output)];
  const Plotted y = output_signal(view, table, name);
  std::vector<Figure> figures{closest_look(table, y, name + residual_shown(view))};
  if (const int main = view.model->main_input(); main >= 0) {
    const std::string& u = view.model->program().input_names[at(main)];
    figures.push_back(loop_figure(table, {u, u, u}, y));
  }
  std::erase_if(figures, [](const Figure& figure) { return figure.curves.empty(); });
  return figures;
}

void add_loop_figures(Section& section, const Beside& view, const CsvTable& table) {
  for (int y = 0; y < static_cast<int>(view.model->outputs().size()); ++y)
    for (auto& figure : loop_figures(view, table, y)) section.figures.push_back(std::move(figure));
  for (auto& figure : phase_planes(table, signals_of(view, table))) section.figures.push_back(std::move(figure));
}

std::vector<Figure> how_far_figures(const Beside& view, const std::vector<int>& recordings,
                                    const std::vector<CsvTable>& tables) {
  const auto [recording, output] = worst_of(view, recordings);
  const auto place =
      static_cast<std::size_t>(std::find(recordings.begin(), recordings.end(), recording) - recordings.begin());
  if (place >= recordings.size() || place >= tables.size()) return {};
  const CsvTable& table = tables[place];
  auto figures = time_figures(view, table, output);
  if (!figures.empty()) figures.front().title += ", " + view.model->recording(recording).name;
  const CsvColumn* residual = table.find(view.model->outputs()[at(output)] + residual_shown(view));
  Part part = residual != nullptr ? worst_part(table.find("t")->values, residual->values) : Part{};
  if (!turns_in(view, table, part)) part = {};
  for (auto& figure : loop_figures(view, table, output)) {
    // A loop of many cycles hides what differs: on the first screen, those of the closer look.
    const bool loop = figure.x_range.empty();
    figures.push_back(loop && part.second > part.first ? part_of(std::move(figure), table, part) : std::move(figure));
  }
  return figures;
}

}  // namespace hysteron
