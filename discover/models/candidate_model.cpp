// Decides how effects enter and leave one model of a discovery. See candidate_model.h.
#include "discover/models/candidate_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "discover/models/fit_candidate_model.h"
#include "discover/models/free_numbers.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "fit/numerics/median.h"

namespace hysteron {
namespace {

/// Parameters that the effects spend: what is held at a bound is not there (a play with weight 0), and what the data do
/// not determine buys nothing.
int spent(const CandidateModel& c, int standing) {
  int n = 0;
  for (const auto& p : parameters_of(c, standing))
    if (p.law->per_recording)
      n += static_cast<int>(std::count_if(
          c.fit.estimates.begin(), c.fit.estimates.end(),
          [&](const ParameterEstimate& e) { return p.estimate != nullptr && e.path == p.estimate->path; }));
    else if (p.estimate == nullptr || !(p.estimate->at_lower || p.estimate->at_upper))
      ++n;
  for (std::size_t i = 0; i < c.placed.size(); ++i)
    if (standing < 0 || standing == static_cast<int>(i))
      n += static_cast<int>(c.placed[i].zeros.size() + c.placed[i].weights.size());
  return n;
}

/// Values of single recordings, some of them silenced.
Prediction predicted_with(const FitContext& context, const CandidateModel& c, Effort effort,
                          const std::function<bool(const RecordingValue&)>& silent) {
  Trial trial;
  for (const auto& v : c.of_recordings)
    trial.push_back({parameter_index(*c.program, v.path), silent(v) ? 0 : v.value, v.recording});
  DataModel model = searched_model(context, c.program, effort);
  begin_as_found(c, model);
  if (context.evidence != nullptr) model.choose_substeps(trial, noise_of(context, model).white());
  return model.predict(trial, train_and_validate(*context.data));
}

constexpr char broken_off[] = "the search was broken off before";

CandidateModel guarded(const FitContext& context, CandidateModel c, Effort effort, int fresh, int held_parameters) {
  try {
    fit_candidate_model(context, c, effort, fresh);
    if (c.ok && context.evidence != nullptr) c.error_of = context.evidence->error(c.prediction);
    // Effects that were held keep what they spent before.
    c.parameters = effort == Effort::screen && fresh >= 0 ? held_parameters + spent(c, fresh) : spent(c, -1);
  } catch (const Error& e) {
    c.ok = false;
    c.error = e.what();
  } catch (const Stopped&) {
    c.ok = false;
    c.stopped = true;
    c.error = broken_off;
  }
  context.derivatives->count(c.runs);
  return c;
}

}  // namespace

double row_tolerance(const DataModel& model, const NoiseModel& noise, double part) {
  double least = std::numeric_limits<double>::infinity();
  for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o)
    if (model.span(o) > 0) least = std::min(least, noise.outputs[static_cast<std::size_t>(o)].white / model.span(o));
  return std::clamp(part * least, 1e-7, 1e-3);
}

void FitContext::free_nominal_parameters(const std::map<std::string, double>& numbers) {
  roughly = numbers;
  for (const auto& [path, written] : numbers) free_paths.push_back(path);
}

CandidateModel base_model(const FitContext& context, const Diagram& diagram, Effort effort) {
  CandidateModel c;
  c.diagram = diagram;
  fit_candidate_model(context, c, effort, -1);  // the user's own question: what is wrong with it is told, not swallowed
  context.derivatives->count(c.runs);
  if (c.ok && context.evidence != nullptr) c.error_of = context.evidence->error(c.prediction);
  return c;
}

CandidateModel with_effect(const FitContext& context, const CandidateModel& before, const Effect& effect,
                           const Law& law, const Place& place, const Excitation& at, Effort effort) {
  CandidateModel c;
  c.placed = before.placed;
  c.of_recordings = before.of_recordings;
  c.starts = before.starts;
  c.fit.estimates = before.fit.estimates;
  c.cuts = before.cuts;
  try {
    c.change = add_effect(before.diagram, *context.registry, effect, law, place);
  } catch (const Error& e) {
    c.error = e.what();
    return c;
  }
  c.diagram = c.change.diagram;
  const bool new_zero = effect.moves_zero && !at.offset_is_free;
  c.placed.push_back({&effect, law, place, c.change.name, new_zero ? at.zeros : std::vector<std::string>{}});
  if (law.reweighs) c.placed.back().weights = at.weights;
  c.placed.back().at = std::make_shared<const Excitation>(at);
  if (before.program)
    for (const auto* anew : {&c.placed.back().zeros, &c.placed.back().weights})
      for (const auto& path : *anew)
        if (const auto* p = before.program->find_parameter(path)) c.placed.back().before[path] = p->value;
  const int fresh = static_cast<int>(c.placed.size()) - 1;
  try {
    if (before.program) refuse_new_loop(*before.program, *compile(c.diagram, *context.registry), place.at);
  } catch (const Error& e) {
    c.error = e.what();
    return c;
  }
  return guarded(context, std::move(c), effort, fresh, before.parameters);
}

bool calibrates(const PlacedEffect& s) { return s.effect->straight; }

std::vector<std::string> free_anyway(const FitContext& context, const CandidateModel& c) {
  auto paths = context.free_paths;
  for (const auto& s : c.placed)
    if (calibrates(s))
      for (const auto& p : s.law.free) paths.push_back(parameter_path(s.name, s.law, p));
  return paths;
}

CandidateModel refit(const FitContext& context, const CandidateModel& candidate, Effort effort) {
  CandidateModel c;
  c.diagram = candidate.diagram;
  c.placed = candidate.placed;
  c.of_recordings = candidate.of_recordings;
  c.starts = candidate.starts;
  c.change = candidate.change;
  c.fit.estimates = candidate.fit.estimates;  // of what is held
  c.cuts = candidate.cuts;
  return guarded(context, std::move(c), effort, -1, 0);
}

namespace {

/// Numbers of the user that were found anew with an effect hold only beside it: they are again what they were, or
/// another's that stands and finds them anew, too.
void give_back(CandidateModel& c, const PlacedEffect& leaving) {
  Trial values;
  for (const auto& [path, value] : leaving.before) {
    const auto finds_it = [&, at = path](const PlacedEffect& s) { return s.before.contains(at); };
    const auto other = std::find_if(c.placed.begin(), c.placed.end(), finds_it);
    if (other != c.placed.end()) {
      other->before[path] = value;
      continue;
    }
    if (c.program->find_parameter(path) == nullptr) continue;
    values.push_back({parameter_index(*c.program, path), value, -1});
    std::erase_if(c.fit.estimates, [&, at = path](const ParameterEstimate& e) { return e.path == at; });
  }
  if (!values.empty()) c.diagram = with_parameters(c.diagram, *c.program, values);
}

}  // namespace

CandidateModel without(const FitContext& context, const CandidateModel& candidate, std::size_t standing) {
  CandidateModel c;
  const PlacedEffect& leaving = candidate.placed[standing];
  try {
    c.diagram = remove_effect(candidate.diagram, *context.registry, leaving.name, leaving.effect->id);
    c.program = compile(c.diagram, *context.registry);
  } catch (const Error& e) {
    c.error = e.what();
    return c;
  }
  c.ok = true;
  c.placed = candidate.placed;
  c.placed.erase(c.placed.begin() + static_cast<std::ptrdiff_t>(standing));
  for (auto& s : c.placed) {  // what stood behind it on its wire stands on that wire
    if (s.place.at == leaving.name) s.place.at = leaving.place.at;
    if (s.place.wire == leaving.name) s.place.wire = leaving.place.wire;
  }
  c.of_recordings = candidate.of_recordings;
  c.starts = candidate.starts;
  c.fit.estimates = candidate.fit.estimates;
  // Others may stand in the same block.
  std::erase_if(c.fit.estimates, [&](const ParameterEstimate& e) {
    return std::any_of(leaving.law.free.begin(), leaving.law.free.end(),
                       [&](const LawParameter& p) { return e.path == parameter_path(leaving.name, leaving.law, p); });
  });
  c.parameters = candidate.parameters - spent(candidate, static_cast<int>(standing));
  give_back(c, leaving);
  return c;
}

Prediction without_lines(const FitContext& context, const CandidateModel& candidate) {
  return predicted_with(context, candidate, Effort::full, [&](const RecordingValue& v) {
    return std::any_of(candidate.placed.begin(), candidate.placed.end(),
                       [&](const PlacedEffect& s) { return has_line(s.law) && v.path.starts_with(s.name + "."); });
  });
}

Prediction predicted(const FitContext& context, const CandidateModel& candidate, const std::vector<int>& recordings) {
  CandidateModel c = candidate;
  c.program = compile(c.diagram, *context.registry);
  DataModel model(c.program, context.data, accuracy(context, *c.program, Effort::final));
  begin_as_found(c, model);
  std::vector<FreeParameter> free;
  for (const auto& s : c.placed)
    for (auto& f : free_of_law(*c.program, s, false, recordings))
      if (f.recording >= 0) free.push_back(std::move(f));
  if (free.empty()) return model.predict({}, recordings);
  FitOptions options;
  options.recordings = options.judged = recordings;
  options.intervals = false;
  const FitResult found = fit(model, context.evidence->noise(), free, options);
  return found.ok ? model.predict(found.values, recordings) : model.predict({}, recordings);
}

std::vector<ParameterOfEffect> parameters_of(const CandidateModel& candidate, int standing) {
  std::vector<ParameterOfEffect> list;
  for (std::size_t i = 0; i < candidate.placed.size(); ++i) {
    if (standing >= 0 && static_cast<int>(i) != standing) continue;
    const PlacedEffect& s = candidate.placed[i];
    for (const auto& p : s.law.free) {
      ParameterOfEffect one;
      one.law = &p;
      for (const auto& e : candidate.fit.estimates)
        if (e.path == parameter_path(s.name, s.law, p)) one.estimate = &e;
      list.push_back(one);
    }
  }
  return list;
}

std::vector<double> values_of(const CandidateModel& candidate, std::size_t standing) {
  std::vector<double> values;
  for (const auto& p : parameters_of(candidate, static_cast<int>(standing)))
    if (p.estimate != nullptr) values.push_back(p.estimate->used);
  return values;
}

}  // namespace hysteron
