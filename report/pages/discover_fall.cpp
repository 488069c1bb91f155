// Decides how the fall of the error is shown: the waterfall against what repeats, the residual before and after each
// step on the same axes, the diagram before and after with what is new set off. Everything from recordings that were
// not used for the fit. Does not discover, and does not write files.
#include "report/pages/discover_fall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/narrate/words.h"
#include "draw/drawing.h"
#include "engine/diagram/error.h"
#include "engine/diagram/index.h"
#include "fit/model/noise.h"
#include "fit/model/score.h"
#include "fit/signals/unit_words.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// Over all recordings that were not used for the fit; null where none measured the output.
const OutputError* find(const std::vector<OutputError>& judged, const std::string& output) {
  const auto found = std::find_if(judged.begin(), judged.end(), [&](const auto& o) { return o.output == output; });
  return found == judged.end() ? nullptr : &*found;
}

/// How far below what the device repeats to an error is no chance: of some hundred rows rms is known to some per cent.
constexpr double clearly_below = 0.9;

/// The unit of the axis of a waterfall, in which its bars and lines are told, too.
struct AxisUnit {
  Unit column;
  ReadableUnit readable;

  double number(double si) const { return readable.times * column.difference_from_si(si); }
  std::string text(double si, int digits) const {
    return number_text(number(si), digits) + (readable.text.empty() ? "" : " " + readable.text);
  }
  std::string label() const { return fmt::format("RMS [{}]", readable.text.empty() ? "1" : readable.text); }
};

/// For all of these [SI], those that are not above zero left out.
AxisUnit axis_unit(const Unit& column, std::vector<double> sizes) {
  std::erase_if(sizes, [](double si) { return !(si > 0); });
  if (sizes.empty()) return {column, {1, unit_text(column)}};
  const auto [small, large] = std::minmax_element(sizes.begin(), sizes.end());
  return {column, readable_unit_of_range(*small, *large, unit_of_differences(column))};
}

/// What the lines are, and what it means to be below them. `begun`, `reached`: errors of the base and of the last
/// model.
std::string floor_text(const Floor& floor, const AxisUnit& unit, double begun, double reached) {
  const std::string noise =
      floor.noise > 0 ? fmt::format("sensor noise, {} rms ({})", unit.text(floor.noise, 4), floor.noise_from) : "";
  if (!(floor.repeatability > 0))
    return noise.empty() ? "" : fmt::format("Nothing was recorded twice, so the limit is the {}.", noise);
  std::string text = fmt::format("The limit is the repeatability of the device: {}, {} rms.", floor.repeats,
                                 unit.text(floor.repeatability, 4));
  if (reached < clearly_below * floor.repeatability && begun > floor.repeatability)
    text += " The model is better than that: it explains why the repeats differ (creep, drift, the start).";
  if (!noise.empty()) text += fmt::format(" Judged against the {}.", noise);
  return text;
}

/// [SI], 0 where no recording of these measured the output.
double unseen_error(const ModelError& error, const std::string& output) {
  const auto judged = by_output(error, Role::validate);
  const OutputError* j = find(judged, output);
  return j == nullptr ? 0 : j->rms;
}

/// A bar or a line, before the unit of the axis is known.
struct Told {
  std::string label, role;
  double rms = 0;    ///< [SI]
  double nrmse = 0;  ///< of a bar
};

/// The error of an output as given, with the user's parameters fitted, and after each step; below them what limits it.
std::vector<Told> told_of(const Discovery& found, const std::string& output, const Floor& floor) {
  std::vector<Told> list;
  const auto bar = [&](const std::string& label, const ModelError& error, const std::string& role) {
    const auto judged = by_output(error, Role::validate);
    if (const OutputError* j = find(judged, output); j != nullptr) list.push_back({label, role, j->rms, j->nrmse});
  };
  bar("as given", found.as_given, "before");
  // A refit of the user's own parameters is a step of its own only where there were any.
  if (!found.base_parameters.empty()) bar("own parameters fitted", found.base, "");
  for (std::size_t i = 0; i < found.steps.size(); ++i) bar("+ " + names_of(found.steps, i), found.steps[i].after, "");
  if (list.empty()) return list;
  if (list.size() > 1) list.back().role = "after";
  const double reached = unseen_error(found.final_error, output);
  if (floor.repeatability > 0) list.push_back({"repeatability", "floor", floor.repeatability});
  if (floor.noise > 0 && (!(floor.repeatability > 0) || reached < floor.repeatability))
    list.push_back({"noise of the sensor", "floor", floor.noise});
  return list;
}

Figure waterfall(const Discovery& found, const DataModel& model, int output, const Floor& floor) {
  const std::string name = model.outputs()[at(output)];
  const auto told = told_of(found, name, floor);
  std::vector<double> sizes;
  for (const auto& one : told) sizes.push_back(one.rms);
  const AxisUnit unit = axis_unit(output_unit(model, output), sizes);
  Figure figure;
  figure.kind = "waterfall";
  figure.title = fmt::format("{}: error on {}, step by step", name, judged_on(found));
  figure.y_label = unit.label();
  for (const auto& one : told) {
    const std::string size = unit.text(one.rms, 3);
    figure.bars.push_back({one.label, unit.number(one.rms),
                           one.role == "floor" ? size : fmt::format("{} ({})", size, percent_text(one.nrmse)),
                           one.role});
  }
  if (figure.bars.empty()) return figure;
  const auto bars = std::count_if(told.begin(), told.end(), [](const auto& one) { return one.role != "floor"; });
  figure.log_y = told.front().rms > 20 * told[static_cast<std::size_t>(bars) - 1].rms;
  figure.caption = floor_text(floor, unit, unseen_error(found.base, name), unseen_error(found.final_error, name));
  return figure;
}

/// Where a step took most: chi2, because outputs may have different units.
struct Place {
  std::string recording, output;
  double rms_before = 0, rms_after = 0;
};

Place most_taken(const FoundStep& step) {
  Place place;
  double largest = -std::numeric_limits<double>::infinity();
  for (const auto& before : step.before.recordings) {
    const auto& list = step.after.recordings;
    const auto after = std::find_if(list.begin(), list.end(), [&](const RecordingError& r) {
      return r.recording == before.recording && r.output == before.output;
    });
    if (before.role != Role::validate || after == list.end() || before.chi2 - after->chi2 <= largest) continue;
    largest = before.chi2 - after->chi2;
    place = {before.recording, before.output, before.rms, after->rms};
  }
  return place;
}

/// Figures over the same quantity move together: those of different recordings must not.
std::string time_label(const std::string& recording) { return "t of " + recording + " [s]"; }

Curve residual_curve(const CsvTable& table, const std::string& column, const std::string& name,
                     const std::string& role) {
  return {name, "line", role, table.file, "t", column, {}, {}};
}

/// Before and after one step, on the same axes.
void add_step_figure(Section& section, const Document& document, const Discovery& found, const Stages& stages,
                     std::size_t step) {
  const DataModel& model = stages.model();
  const Place place = most_taken(found.steps[step]);
  const auto recordings = judged_recordings(model);
  for (std::size_t i = 0; i < recordings.size() && i < document.traces.size(); ++i) {
    if (model.recording(recordings[i]).name != place.recording) continue;
    const auto& outputs = model.outputs();
    const auto output = static_cast<int>(std::find(outputs.begin(), outputs.end(), place.output) - outputs.begin());
    const Unit unit = output_unit(model, output);
    const CsvTable& table = document.traces[i];
    Figure figure;
    figure.title = fmt::format("Step {}, {}: residual of {} before and after, {}", step + 1,
                               names_of(found.steps, step), place.output, place.recording);
    figure.x_label = time_label(place.recording);
    figure.y_label = axis_text("residual", unit_of_differences(unit));
    const Beside view = stages.beside();
    figure.curves.push_back(residual_curve(table, residual_column(view, place.output, step), "before", "before"));
    figure.curves.push_back(residual_curve(table, residual_column(view, place.output, step + 1), "after", "after"));
    figure.caption = fmt::format("Of {}, the one that this step improved most: {} rms.", judged_on(found),
                                 fall_text(place.rms_before, place.rms_after, unit));
    section.figures.push_back(std::move(figure));
    return;
  }
}

/// Index of the recording, among those not used for the fit, on which the base model was worst.
int most_telling(const Stages& stages) {
  int best = -1;
  double largest = -1;
  for (const int r : stages.unseen()) {
    const Metrics* m = stages.before().find(r, 0);
    if (m == nullptr || m->rms <= largest) continue;
    largest = m->rms;
    best = r;
  }
  return best;
}

/// How many diagrams deep a block lies.
int depth_of(const std::string& path) { return static_cast<int>(std::count(path.begin(), path.end(), '/')); }

}  // namespace

// --- floors ----------------------------------------------------------------------------------------------------------

std::vector<Floor> floors_of(const Discovery& found, const DataModel& model, const Inspected& inspected) {
  std::vector<Floor> floors;
  for (std::size_t o = 0; o < model.outputs().size(); ++o) {
    const std::string& output = model.outputs()[o];
    Floor floor{output, 0, "", 0, ""};
    const bool free_zero = model.zero_per_recording(static_cast<int>(o));
    for (const auto& r : inspected.data.repeats) {
      const double rms = free_zero ? r.floor.without_offset : r.floor.rms;
      if (r.output != output || !(rms > 0) || (floor.repeatability > 0 && rms >= floor.repeatability)) continue;
      floor.repeatability = rms;
      floor.repeats = r.what;
    }
    const auto noise =
        std::find_if(found.noise.begin(), found.noise.end(), [&](const auto& n) { return n.output == output; });
    if (noise != found.noise.end()) {
      floor.noise = noise->white * std::hypot(1, noise->one_over_f);
      floor.noise_from = noise->origin;
    }
    floors.push_back(std::move(floor));
  }
  return floors;
}

Facts floor_facts(const std::vector<Floor>& floors, const DataModel& model) {
  Facts::List list;
  for (std::size_t o = 0; o < floors.size(); ++o) {
    const Unit unit = output_unit(model, static_cast<int>(o));
    Facts one = Facts::object({{"output", floors[o].output}, {"unit", unit_text(unit_of_differences(unit))}});
    if (floors[o].repeatability > 0) {
      one.set("repeatability_rms", unit.difference_from_si(floors[o].repeatability));
      one.set("repeats", floors[o].repeats);
    }
    if (floors[o].noise > 0) one.set("noise_rms", unit.difference_from_si(floors[o].noise));
    list.push_back(std::move(one));
  }
  return list;
}

// --- stages ----------------------------------------------------------------------------------------------------------

Stages::Stages(const Discovery& found, const std::shared_ptr<const DataSet>& data, const Registry& registry)
    : registry_(registry) {
  all_.push_back(compared(found.base_diagram, data));
  before_unseen_ = std::move(after_unseen_);
  for (const auto& step : found.steps) all_.push_back(compared(step.change.diagram, data));
  if (found.steps.empty()) after_unseen_ = before_unseen_;
}

Comparison Stages::compared(const Diagram& diagram, const std::shared_ptr<const DataSet>& data) {
  models_.push_back(std::make_unique<DataModel>(compile(diagram, registry_), data));
  DataModel& model = *models_.back();
  const auto recordings = judged_recordings(model);
  unseen_ = model.recordings(Role::validate);
  if (unseen_.empty()) unseen_ = recordings;
  const Judge judge(model, noise_before_fit(model));
  const Prediction prediction = model.predict({}, recordings);
  after_unseen_ = compare(model, judge, prediction, unseen_);
  return compare(model, judge, prediction, recordings);
}

Beside Stages::beside() const {
  Beside view{&model(), &after(), &before(), {}};
  for (std::size_t i = 1; i + 1 < all_.size(); ++i) view.between.push_back(&all_[i]);
  return view;
}

// --- figures ---------------------------------------------------------------------------------------------------------

std::vector<Figure> waterfalls(const Discovery& found, const DataModel& model, const std::vector<Floor>& floors) {
  std::vector<Figure> figures;
  for (std::size_t o = 0; o < floors.size(); ++o)
    if (Figure f = waterfall(found, model, static_cast<int>(o), floors[o]); !f.bars.empty())
      figures.push_back(std::move(f));
  return figures;
}

void add_fall_figures(Section& section, const Document& document, const Discovery& found, const Stages& stages) {
  if (found.steps.empty()) return;
  const auto recordings = judged_recordings(stages.model());
  const int worst = most_telling(stages);
  for (std::size_t i = 0; i < recordings.size() && i < document.traces.size(); ++i) {
    if (recordings[i] != worst) continue;
    Section of_recording;
    add_time_figures(of_recording, stages.beside(), document.traces[i]);
    Figure measured = std::move(of_recording.figures.front());
    const std::string& name = stages.model().recording(worst).name;
    measured.title += ", " + name;
    measured.x_label = time_label(name);
    section.figures.push_back(std::move(measured));
  }
  for (std::size_t step = 0; step < found.steps.size(); ++step) add_step_figure(section, document, found, stages, step);
}

void add_diagram_pictures(Section& section, Document& document, const Discovery& found, const Registry& registry) {
  DrawOptions options;
  for (const auto& step : found.steps) {
    options.added.push_back(step.change.name);
    options.depth = std::max(options.depth, depth_of(step.change.name));
  }
  const auto add = [&](const std::string& title, const std::string& file, const Diagram& diagram) {
    document.files.emplace_back(file, diagram_svg(diagram, *compile(diagram, registry), registry, options));
    Figure figure;
    figure.kind = "picture";
    figure.title = title;
    figure.picture = file;
    section.figures.push_back(std::move(figure));
  };
  try {
    add(found.steps.empty() ? "The diagram" : "Before", "base.svg", found.base_diagram);
    if (found.steps.empty()) return;
    add("After", "final.svg", found.final_diagram);
    section.figures.back().caption = fmt::format("Marked \"new\": {}.", fmt::join(options.added, ", "));
  } catch (const Error& e) {
    if (e.problems.empty() || e.problems.front().code != "no_graphviz") throw;
    section.text.emplace_back("Pictures of the diagram need the program dot of Graphviz, which is not installed.");
  }
}

}  // namespace hysteron
