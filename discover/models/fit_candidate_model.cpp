#include "discover/models/fit_candidate_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "discover/models/fit_cost.h"
#include "discover/models/free_numbers.h"
#include "discover/models/parts.h"
#include "engine/diagram/stop.h"
#include "fit/estimate/starts.h"

namespace hysteron {

namespace {

/// Whether a fit to the end says how sure its values are. Profiles take ten times as long as the fit.
enum class Intervals { told, not_yet };

/// How one fit goes about it.
struct Manner {
  KnownLines lines = KnownLines::held;
  Intervals intervals = Intervals::told;
  Own own = Own::free;
  bool levels = false;  ///< levels of a column are what is fitted; else they are silent
};

/// Rows are no more exact than this share of what a candidate leaves: a law that leaves a thousand times the noise of
/// an encoder is not told from others by the last tenth of that noise.
constexpr double residual_share = 1.0 / 300;

/// Values of single recordings that are not free this time.
Trial held(const CandidateModel& c, const std::vector<FreeParameter>& free) {
  Trial trial;
  for (const auto& v : c.of_recordings) {
    if (c.program->find_parameter(v.path) == nullptr) continue;  // its effect has left
    const int parameter = parameter_index(*c.program, v.path);
    if (std::none_of(free.begin(), free.end(),
                     [&](const FreeParameter& f) { return f.parameter == parameter && f.recording == v.recording; }))
      trial.push_back({parameter, v.value, v.recording});
  }
  return trial;
}

void keep_of_recordings(CandidateModel& c, const Trial& held) {
  c.of_recordings.clear();
  for (const auto* trial : {&held, static_cast<const Trial*>(&c.fit.values)})
    for (const auto& v : *trial)
      if (v.recording >= 0)
        c.of_recordings.push_back(
            {c.program->parameters[static_cast<std::size_t>(v.parameter)].path, v.recording, v.value});
}

// Candidates are told apart by some units of chi2, and a screened one counts from some units on; steps for less are for
// the one that is claimed.
constexpr double full_matters = 0.2, screen_matters = 0.5;

void keep_starts(CandidateModel& c, const DataModel& model, const Judge& judge) {
  const auto starts = starts_of(model, judge, c.prediction);
  const auto& states = model.free_initial_states();
  c.starts.assign(starts.size(), {});
  for (std::size_t r = 0; r < starts.size(); ++r)
    for (std::size_t k = 0; k < starts[r].size(); ++k) c.starts[r][states[k]] = starts[r][k];
}

/// The same values with the levels of columns silent.
Trial unrounded(const CandidateModel& c, const Program& program, Trial values) {
  for (const auto& silent : silent_levels(c, program)) {
    std::erase_if(values, [&](const ParameterValue& v) { return v.parameter == silent.parameter; });
    values.push_back(silent);
  }
  return values;
}

/// What it says before columns are rounded, moved towards what is read by half a level at most: anything within half a
/// level of a reading is read so, and a saw tooth that rounding makes is no effect.
Prediction nearest_to_levels(const CandidateModel& c, DataModel& model, const Trial& values,
                             const std::vector<int>& recordings) {
  const Program& program = model.program();
  Prediction p = model.predict(unrounded(c, program, values), recordings);
  if (!p.ok) return p;
  for (const auto& silent : silent_levels(c, program)) {
    const ParameterInfo& info = program.parameters[static_cast<std::size_t>(silent.parameter)];
    double level = info.value;
    for (const auto& v : values)
      if (v.parameter == silent.parameter) level = v.value;
    for (const int o : outputs_behind(program, info.block))
      for (int k = 0; k < static_cast<int>(model.outputs().size()); ++k) {
        if (model.outputs()[static_cast<std::size_t>(k)] != program.output_names[static_cast<std::size_t>(o)]) continue;
        if (model.zero_per_recording(k)) continue;  // nobody knows where the levels lie
        for (const int r : recordings) {
          if (!p.initial[static_cast<std::size_t>(r)].empty()) continue;  // it begins anywhere
          Rows& y = p.y[static_cast<std::size_t>(r)][static_cast<std::size_t>(k)];
          const Rows& read = model.measured(r, k);
          for (std::size_t i = 0; i < read.size() && i < y.size(); ++i)
            y[i] += std::clamp(read[i] - y[i], -level / 2, level / 2);
        }
      }
  }
  return p;
}

void predict(const FitContext& context, CandidateModel& c, DataModel& model, const Trial& values) {
  const std::vector<Role> judged{Role::train, Role::validate};
  const long before = model.runs();
  const bool free_starts = !model.free_initial_states().empty();
  std::optional<Judge> judge;
  if (free_starts) judge.emplace(model, noise_of(context, model));
  if (model.starts_are_searched()) improve_starts(model, *judge, values, model.recordings(judged));
  c.prediction = model.predict(values, model.recordings(judged));
  if (std::any_of(c.placed.begin(), c.placed.end(), reads_off_column))
    c.before_rounding = nearest_to_levels(c, model, values, model.recordings(judged));
  if (free_starts && c.prediction.ok) keep_starts(c, model, *judge);
  c.runs += model.runs() - before;
  c.ok = c.prediction.ok;
  c.error = c.prediction.error;
}

DataModel model_of(const FitContext& context, const CandidateModel& c, const ProgramPointer& program, Effort effort) {
  const auto known = c.cuts.find(program->output_names);
  DataModel model = searched_model(context, program, effort, known == c.cuts.end() ? nullptr : known->second);
  begin_as_found(c, model);
  return model;
}

/// Not those of the last fit, which is finer than a search needs.
void keep_cuts(CandidateModel& c, const DataModel& model, Effort effort) {
  if (effort != Effort::final) c.cuts[model.program().output_names] = std::make_shared<const Cuts>(model.cuts());
}

/// What is fitted, and what is seen of it.
std::string name_of_fit(const Program& program, const std::vector<FreeParameter>& free,
                        const std::vector<std::string>& outputs) {
  std::string name;
  for (const auto& o : outputs) name += o + ";";
  for (const auto& f : free)
    name += fmt::format("{}@{};", program.parameters[static_cast<std::size_t>(f.parameter)].path, f.recording);
  return name;
}

/// What was held this time keeps what was said of it last time: parts that are fitted apart have nothing to do with
/// each other, and no number of the one is correlated with one of the other.
void keep_estimates(FitResult& now, FitResult before) {
  std::vector<int> place(before.estimates.size(), -1);  // among those of now
  for (std::size_t i = 0; i < before.estimates.size(); ++i) {
    auto& e = before.estimates[i];
    if (std::any_of(now.estimates.begin(), now.estimates.end(),
                    [&](const ParameterEstimate& n) { return n.path == e.path && n.recording == e.recording; }))
      continue;
    place[i] = static_cast<int>(now.estimates.size());
    now.estimates.push_back(std::move(e));
  }
  std::vector<std::size_t> kept;  // rows of what was correlated before
  for (std::size_t k = 0; k < before.correlated.size(); ++k)
    if (place[static_cast<std::size_t>(before.correlated[k])] >= 0) kept.push_back(k);
  const std::size_t own = now.correlated.size(), all = own + kept.size(), was = before.correlated.size();
  std::vector<double> correlation(all * all, 0.0);
  for (std::size_t i = 0; i < own; ++i)
    for (std::size_t j = 0; j < own; ++j) correlation[i * all + j] = now.correlation[i * own + j];
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t j = 0; j < kept.size(); ++j)
      correlation[(own + i) * all + own + j] = before.correlation[kept[i] * was + kept[j]];
    now.correlated.push_back(place[static_cast<std::size_t>(before.correlated[kept[i]])]);
  }
  now.correlation = std::move(correlation);
}

/// Fits the diagram of `c`, which is compiled, in the parameters of the chosen effects, and simulates only what these
/// `outputs` see; `fresh` = index of the effect that starts from its law instead of its values, -1 = none.
/// The answer: steps_from().
double fit_chosen(const FitContext& context, CandidateModel& c, Effort effort, int fresh,
                  const std::vector<bool>& chosen, const std::vector<std::string>& outputs, const Manner& manner = {}) {
  c.program = compile(c.diagram, *context.registry);
  const bool some = outputs.size() < c.program->output_names.size();
  const ProgramPointer seen = some ? compile(seen_at(c.diagram, outputs), *context.registry) : c.program;
  DataModel model = model_of(context, c, seen, effort);
  auto free = free_of(context, c, chosen, fresh, train_and_validate(*context.data), manner.lines, manner.own);
  if (some) std::erase_if(free, [&](const FreeParameter& f) { return !moves_an_output(*seen, f.parameter); });
  const Trial fixed = held(c, free);
  if (free.empty()) {
    if (!c.prediction.y.empty()) return 0;  // another part was fitted, and told all outputs
    DataModel whole = model_of(context, c, c.program, effort);
    predict(context, c, whole, fixed);
    return 0;
  }
  Trial in_fit = manner.levels ? fixed : unrounded(c, *c.program, fixed);
  NoiseModel noise = noise_of(context, model);
  FitOptions options;
  options.max_iterations = effort == Effort::full ? 15 : 30;
  const double steps = effort == Effort::final ? 0 : steps_from(model, noise.white(), in_fit, free);
  if (effort == Effort::screen) spend_less(c, steps, free, options);
  if (effort == Effort::full) keep_within_time(c, steps, free, options);
  options.intervals = effort == Effort::final && manner.intervals == Intervals::told;
  options.profile_steps = fit_steps;
  if (effort != Effort::final) options.search_again_steps = effort == Effort::full ? fit_steps : screening_steps;
  options.scores = false;
  options.matters = effort == Effort::full ? full_matters : effort == Effort::screen ? screen_matters : 0;
  options.fixed = std::move(in_fit);
  FitResult before = std::move(c.fit);
  const bool sought = fresh >= 0 && has_line(c.placed[static_cast<std::size_t>(fresh)].law);
  if (sought || manner.lines == KnownLines::tuned)  // what is left out about one frequency would hide every other
    for (auto& o : noise.outputs) o.left_out = {};
  const bool again = effort == Effort::full && fresh < 0;
  const std::string name = again ? name_of_fit(*seen, free, outputs) : "";
  if (again) options.known_derivatives = context.derivatives->derivatives_of(name);
  c.fit = fit(model, noise, free, options);
  if (again && c.fit.derivatives) context.derivatives->keep(name, c.fit.derivatives);
  c.ok = c.fit.ok;
  c.error = c.fit.error;
  c.runs += model.runs();
  if (!c.ok && c.fit.stopped) throw Stopped{};  // nothing was found that could be kept
  std::optional<StopScope> to_its_end;          // what was found until then is compared
  if (c.fit.stopped) to_its_end.emplace(nullptr);
  if (!c.ok) return steps;
  keep_of_recordings(c, fixed);
  Trial all = c.fit.values;
  all.insert(all.end(), fixed.begin(), fixed.end());
  if (some) {
    DataModel whole = model_of(context, c, c.program, effort);
    whole.choose_substeps(all, noise_of(context, whole).white());
    predict(context, c, whole, all);
    keep_cuts(c, whole, effort);
  } else {
    predict(context, c, model, all);
  }
  keep_cuts(c, model, effort);
  c.diagram = with_parameters(c.diagram, *c.program, c.fit.values);
  keep_estimates(c.fit, std::move(before));
  return steps;
}

/// Laws with many weights one behind the other multiply each other: linear each, not together. Each trial of what is
/// not linear simulates every weight of the rest; solving the laws in turn costs a fraction of that.
bool better_in_turn(const FitContext& context, const CandidateModel& c, const std::vector<bool>& chosen,
                    Effort effort) {
  if (std::count(chosen.begin(), chosen.end(), true) < 2) return false;
  std::vector<int> parameters;
  for (const auto& f : free_of(context, c, chosen, -1, {})) parameters.push_back(f.parameter);
  const auto affine = jointly_affine(*c.program, parameters, c.program->output_signals);
  const auto linear = std::count(affine.begin(), affine.end(), true);
  const auto searched = static_cast<std::ptrdiff_t>(affine.size()) - linear;
  return searched > 4 || (effort != Effort::final && searched * linear > 12);
}

/// One effect after the other, the newest first: it has no values yet. The answer: whether any of them is slow.
bool sweep_through(const FitContext& context, CandidateModel& c, Effort effort, int fresh,
                   const std::vector<bool>& chosen, const std::vector<std::string>& outputs, Intervals intervals) {
  bool slow = false;
  for (std::size_t k = 0; k < c.placed.size(); ++k) {
    const std::size_t i = c.placed.size() - 1 - k;
    if (!chosen[i]) continue;
    std::vector<bool> one(c.placed.size(), false);
    one[i] = true;
    const double steps = fit_chosen(context, c, effort, static_cast<int>(i) == fresh ? fresh : -1, one, outputs,
                                    {.intervals = intervals});
    if (!c.ok) return false;
    slow = slow || steps > 0;
  }
  return slow;
}

/// How many of these numbers are found by linear least squares when they are fitted together with `beside`.
std::ptrdiff_t linear_beside(const Program& program, std::vector<int> numbers, const std::vector<int>& beside) {
  const auto count = static_cast<std::ptrdiff_t>(numbers.size());
  numbers.insert(numbers.end(), beside.begin(), beside.end());
  const auto affine = jointly_affine(program, numbers, program.output_signals);
  return std::count(affine.begin(), affine.begin() + count, true);
}

/// Do the user's free numbers take it from a new law that some of its own are linear: of a mode behind a stage whose
/// weights are free, what it adds is then searched from a start that is far from everything, at each frequency.
bool begins_better_alone(const FitContext& context, const CandidateModel& c, int fresh) {
  if (fresh < 0) return false;
  std::vector<int> own, law;
  for (const auto& f : free_parameters(*c.program, context.free_paths)) own.push_back(f.parameter);
  if (own.empty()) return false;
  for (const auto& f : free_of_law(*c.program, c.placed[static_cast<std::size_t>(fresh)], true, {}))
    law.push_back(f.parameter);
  return linear_beside(*c.program, law, {}) > linear_beside(*c.program, law, own);
}

/// The chosen effects of one part, together or in turn.
void fit_together(const FitContext& context, CandidateModel& c, Effort effort, int fresh,
                  const std::vector<bool>& chosen, const std::vector<std::string>& outputs) {
  if (begins_better_alone(context, c, fresh)) {
    std::vector<bool> one(c.placed.size(), false);
    one[static_cast<std::size_t>(fresh)] = true;
    fit_chosen(context, c, effort, fresh, one, outputs, {.intervals = Intervals::not_yet, .own = Own::held});
    if (!c.ok) return;
    fresh = -1;
  }
  if (!better_in_turn(context, c, chosen, effort)) {
    fit_chosen(context, c, effort, fresh, chosen, outputs);
    return;
  }
  double last = std::numeric_limits<double>::infinity();
  int sweeps = 6;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const bool slow = sweep_through(context, c, effort, sweep == 0 ? fresh : -1, chosen, outputs, Intervals::not_yet);
    if (!c.ok) return;
    if (slow) sweeps = 2;  // a slow model is searched from coarse to fine anyway
    const double now = c.fit.chi2;
    if (last - now < 1) break;
    last = now;
  }
  if (effort == Effort::final) sweep_through(context, c, effort, -1, chosen, outputs, Intervals::told);
}

/// The chosen effects of one part. Levels that a column has are found by themselves, when they are new and to be told;
/// all else is fitted beside silent ones.
void fit_part(const FitContext& context, CandidateModel& c, Effort effort, int fresh, std::vector<bool> chosen,
              const std::vector<std::string>& outputs) {
  std::vector<bool> levels(chosen.size(), false);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    levels[i] = chosen[i] && reads_off_column(c.placed[i]);
    chosen[i] = chosen[i] && !levels[i];
  }
  const Manner alone{.own = Own::held, .levels = true};
  const bool new_levels = fresh >= 0 && levels[static_cast<std::size_t>(fresh)];
  if (new_levels) {
    fit_chosen(context, c, effort, fresh, levels, outputs, alone);
    if (!c.ok || effort == Effort::screen) return;
    fresh = -1;
  }
  fit_together(context, c, effort, fresh, chosen, outputs);
  const bool any = std::find(levels.begin(), levels.end(), true) != levels.end();
  if (c.ok && effort == Effort::final && any) fit_chosen(context, c, effort, -1, levels, outputs, alone);
}

/// Known lines once more by themselves: beside an effect that came later their frequency may be another one by a
/// little, and in a long recording that is many turns.
void tune_known_lines(const FitContext& context, CandidateModel& c, Effort effort, const std::vector<bool>& chosen,
                      const std::vector<std::string>& outputs) {
  std::vector<bool> lines(chosen.size(), false);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    lines[i] =
        chosen[i] && std::any_of(c.placed[i].law.free.begin(), c.placed[i].law.free.end(),
                                 [&](const LawParameter& p) { return is_known_line(context, c, c.placed[i], p); });
  if (std::find(lines.begin(), lines.end(), true) != lines.end())
    fit_chosen(context, c, effort, -1, lines, outputs, {.lines = KnownLines::tuned});
}

/// Does any recording measure one of these outputs: what nobody measured, nothing can fit.
bool any_recorded(const DataSet& data, const std::vector<std::string>& outputs) {
  return std::any_of(outputs.begin(), outputs.end(), [&](const std::string& name) {
    return std::any_of(data.recordings.begin(), data.recordings.end(),
                       [&](const Recording& r) { return r.columns.contains(name); });
  });
}

/// How far the states of a block that stands on a wire may be from equilibrium when a recording begins: what it follows
/// has moved no further before than it moves in the recordings. Without that an effect of no size at all would describe
/// any drift, by what it remembers of an endless past.
double start_sigma_of(const PlacedEffect& s, const BlockInstance& block, std::size_t state) {
  constexpr double free = std::numeric_limits<double>::infinity();
  if (s.at == nullptr || !s.at->from_data || !s.place.by.empty()) return free;
  const Declaration& d = block.kernel->declaration;
  const auto& unit = d.states[std::min(state, d.states.size() - 1)].unit;  // one stands for all of a kind
  const auto follows = [&](std::size_t port) { return port < d.inputs.size() && d.inputs[port].unit == unit; };
  const double range = follows(0) ? s.at->range() : follows(1) ? s.at->side_highest - s.at->side_lowest : 0;
  return range > 0 ? range : free;
}

/// Of each free initial state of the model; empty where nothing holds any.
std::vector<double> start_sigmas(const CandidateModel& c, const DataModel& model) {
  std::map<std::string, double> held;
  for (const auto& s : c.placed)
    for (const auto& block : model.program().blocks) {
      if (block.path != s.name && !block.path.starts_with(s.name + "/")) continue;
      for (int i = 0; i < block.sizes.states; ++i)
        held[model.program().state_names[static_cast<std::size_t>(block.x_begin + i)]] =
            start_sigma_of(s, block, static_cast<std::size_t>(i));
    }
  if (held.empty()) return {};
  std::vector<double> sigma;
  for (const auto& state : model.free_initial_states()) {
    const auto known = held.find(state);
    sigma.push_back(known == held.end() ? std::numeric_limits<double>::infinity() : known->second);
  }
  return sigma;
}

}  // namespace

void begin_as_found(const CandidateModel& c, DataModel& model) {
  if (!model.free_initial_states().empty()) model.hold_starts(start_sigmas(c, model));
  if (!model.starts_are_searched() || c.starts.empty()) return;
  for (int r = 0; r < model.n_recordings(); ++r) {
    const auto& found = c.starts[static_cast<std::size_t>(r)];
    if (found.empty() || !model.recording(r).initial_per_recording || !model.recording(r).initial_values.empty())
      continue;
    std::vector<double> start;
    for (const auto& state : model.free_initial_states()) {
      const auto here = found.find(state);
      start.push_back(here == found.end() ? 0 : here->second);
    }
    model.begin_at(r, std::move(start));
  }
}

DataModel searched_model(const FitContext& context, const ProgramPointer& program, Effort effort,
                         std::shared_ptr<const Cuts> begin_with) {
  DataModelOptions options = accuracy(context, *program, effort);
  options.begin_with = std::move(begin_with);
  DataModel model(program, context.data, options);
  if (effort == Effort::final || !model.goes_by_points()) return model;
  const DataModelOptions by_points = accuracy(context, *program, effort, cost_of_a_point);
  if (by_points.max_substeps == options.max_substeps) return model;
  options.max_substeps = by_points.max_substeps;
  options.bdf_otherwise = by_points.bdf_otherwise;
  return DataModel(program, context.data, options);
}

/// Nonlinear states in rows of slow recordings need many substeps, and are still ten times quicker than BDF. In long
/// recordings a law so stiff that it needs more is simulated as finely as time allows until it is claimed.
DataModelOptions accuracy(const FitContext& context, const Program& program, Effort effort, double cost_of_a_step) {
  DataModelOptions options;
  options.threads = context.threads;
  options.max_substeps = 1024;
  double rows = 1;
  for (const auto& r : context.data->recordings)
    if (r.role == Role::train) rows += static_cast<double>(r.last);
  options.bdf_otherwise = context.bdf_otherwise;
  const double of_a_step = cost_of_a_step * work_of_a_step(program);
  const double work = rows * of_a_step;
  const double fewest = 32 / of_a_step;
  while (effort != Effort::final && options.max_substeps > fewest &&
         options.max_substeps * work > context.simulation_steps) {
    options.max_substeps /= 2;
    options.bdf_otherwise = false;
  }
  options.relative_tolerance *= context.looser;
  options.substep_tolerance = effort == Effort::final ? context.row_tolerance / 5 : context.row_tolerance;
  options.substep_share = effort == Effort::final ? residual_share / 5 : residual_share;
  return options;
}

std::vector<int> train_and_validate(const DataSet& data) {
  std::vector<int> list;
  for (std::size_t r = 0; r < data.recordings.size(); ++r)
    if (data.recordings[r].role != Role::test) list.push_back(static_cast<int>(r));
  return list;
}

NoiseModel noise_of(const FitContext& context, const DataModel& model) {
  if (context.evidence == nullptr) return noise_before_fit(model);
  const auto& all = context.evidence->model().outputs();
  const NoiseModel& of_all = context.weights ? *context.weights : context.evidence->noise();
  NoiseModel some;
  for (const auto& name : model.outputs())
    some.outputs.push_back(
        of_all.outputs[static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin())]);
  return some;
}

void fit_candidate_model(const FitContext& context, CandidateModel& c, Effort effort, int fresh) {
  c.program = compile(c.diagram, *context.registry);
  for (const auto& part : parts_of(c, context.free_paths)) {
    if (fresh >= 0 && !part.has(static_cast<std::size_t>(fresh))) continue;  // nothing there has changed
    if (!any_recorded(*context.data, part.outputs)) continue;
    auto chosen = part.effects;
    if (effort == Effort::screen && fresh >= 0)
      for (std::size_t i = 0; i < chosen.size(); ++i)
        chosen[i] = chosen[i] && (static_cast<int>(i) == fresh || calibrates(c.placed[i]));
    fit_part(context, c, effort, fresh, chosen, part.outputs);
    if (c.ok && effort != Effort::screen) tune_known_lines(context, c, effort, chosen, part.outputs);
    if (!c.ok) return;
  }
}

}  // namespace hysteron
