// Decides how effects enter and leave one model of a discovery. See contender.h.
#include "discover/models/contender.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "discover/models/fit_contender.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "fit/numerics/median.h"

namespace hysteron {
namespace {

/// Parameters that the effects spend: what is held at a bound is not there (a play with weight 0), and what the data do
/// not determine buys nothing.
int spent(const Contender& c, int standing) {
  int n = 0;
  for (const auto& p : parameters_of(c, standing))
    if (p.law->per_recording)
      n += static_cast<int>(std::count_if(
          c.fit.estimates.begin(), c.fit.estimates.end(),
          [&](const ParameterEstimate& e) { return p.estimate != nullptr && e.path == p.estimate->path; }));
    else if (p.estimate == nullptr || !(p.estimate->at_lower || p.estimate->at_upper))
      ++n;
  for (std::size_t i = 0; i < c.standing.size(); ++i)
    if (standing < 0 || standing == static_cast<int>(i))
      n += static_cast<int>(c.standing[i].zeros.size() + c.standing[i].weights.size());
  return n;
}

/// Values of single recordings, some of them silenced.
Prediction predicted_with(const Workshop& shop, const Contender& c, Effort effort,
                          const std::function<bool(const RecordingValue&)>& silent) {
  Trial trial;
  for (const auto& v : c.of_recordings)
    trial.push_back({parameter_index(*c.program, v.path), silent(v) ? 0 : v.value, v.recording});
  DataModel model(c.program, shop.data, accuracy(shop, *c.program, effort));
  begin_as_found(c, model);
  if (shop.evidence != nullptr) model.choose_substeps(trial, noise_of(shop, model).white());
  return model.predict(trial, train_and_validate(*shop.data));
}

/// See Contender::without_line; as accurate as `c` itself, for the two are compared.
void look_without_line(const Workshop& shop, Contender& c, Effort effort) {
  c.without_line.reset();
  const double line = c.standing.empty() ? 0 : line_of(c);
  const auto coarse = [&](int r) {
    return !resolves(median_step(shop.data->recordings[static_cast<std::size_t>(r)].t), line);
  };
  const auto judged = train_and_validate(*shop.data);
  if (std::none_of(judged.begin(), judged.end(), coarse)) return;
  c.without_line = predicted_with(shop, c, effort, [&](const RecordingValue& v) {
    return v.path.starts_with(c.standing.back().name + ".") && !coarse(v.recording);
  });
}

constexpr char broken_off[] = "the search was broken off before";

Contender guarded(const Workshop& shop, Contender c, Effort effort, int fresh, int held_parameters) {
  try {
    fit_contender(shop, c, effort, fresh);
    if (c.ok) look_without_line(shop, c, effort);
    if (c.ok && shop.evidence != nullptr) c.error_of = shop.evidence->error(c.prediction);
    // Effects that were held keep what they spent before.
    c.found_on_validation = 0;
    for (const auto& v : c.of_recordings)
      if (shop.data->recordings[static_cast<std::size_t>(v.recording)].role == Role::validate) ++c.found_on_validation;
    c.parameters = effort == Effort::screen && fresh >= 0 ? held_parameters + spent(c, fresh) : spent(c, -1);
  } catch (const Error& e) {
    c.ok = false;
    c.error = e.what();
  } catch (const Stopped&) {
    c.ok = false;
    c.error = broken_off;
  }
  shop.notes->count(c.runs);
  return c;
}

}  // namespace

double row_tolerance(const DataModel& model, const NoiseModel& noise, double part) {
  double least = std::numeric_limits<double>::infinity();
  for (int o = 0; o < static_cast<int>(model.outputs().size()); ++o)
    if (model.span(o) > 0) least = std::min(least, noise.outputs[static_cast<std::size_t>(o)].white / model.span(o));
  return std::clamp(part * least, 1e-7, 1e-3);
}

void Workshop::free_nominal_parameters(const std::map<std::string, double>& numbers) {
  roughly = numbers;
  for (const auto& [path, written] : numbers) free_paths.push_back(path);
}

double Contender::score() const {
  return error_of.evidence() + parameters * std::log(std::max(error_of.effective_sample_size, 2.0));
}
double Contender::tie_score() const { return error_of.evidence() + 2.0 * parameters; }

Contender base_contender(const Workshop& shop, const Diagram& diagram, Effort effort) {
  Contender c;
  c.diagram = diagram;
  fit_contender(shop, c, effort, -1);  // the user's own question: what is wrong with it is told, not swallowed
  shop.notes->count(c.runs);
  if (c.ok && shop.evidence != nullptr) c.error_of = shop.evidence->error(c.prediction);
  return c;
}

Contender with_effect(const Workshop& shop, const Contender& before, const Effect& effect, const Law& law,
                      const Place& place, const Excitation& at, Effort effort) {
  Contender c;
  c.standing = before.standing;
  c.of_recordings = before.of_recordings;
  c.starts = before.starts;
  c.fit.estimates = before.fit.estimates;
  c.cuts = before.cuts;
  try {
    c.change = add_effect(before.diagram, *shop.registry, effect, law, place);
  } catch (const Error& e) {
    c.error = e.what();
    return c;
  }
  c.diagram = c.change.diagram;
  c.zero_held = before.zero_held;
  const bool new_zero = effect.moves_zero && !c.zero_held && !at.offset_is_free;
  c.standing.push_back({&effect, law, place, c.change.name, new_zero ? at.zeros : std::vector<std::string>{}});
  if (law.reweighs) c.standing.back().weights = at.weights;
  const int fresh = static_cast<int>(c.standing.size()) - 1;
  try {
    if (before.program) refuse_new_loop(*before.program, *compile(c.diagram, *shop.registry), place.at);
  } catch (const Error& e) {
    c.error = e.what();
    return c;
  }
  return guarded(shop, std::move(c), effort, fresh, before.parameters);
}

bool calibrates(const Standing& s) { return s.effect->straight; }

std::vector<std::string> free_anyway(const Workshop& shop, const Contender& c) {
  auto paths = shop.free_paths;
  for (const auto& s : c.standing)
    if (calibrates(s))
      for (const auto& p : s.law.free) paths.push_back(parameter_path(s.name, s.law, p));
  return paths;
}

Contender refit(const Workshop& shop, const Contender& contender, Effort effort) {
  Contender c;
  c.diagram = contender.diagram;
  c.standing = contender.standing;
  c.of_recordings = contender.of_recordings;
  c.starts = contender.starts;
  c.change = contender.change;
  c.zero_held = contender.zero_held;
  c.fit.estimates = contender.fit.estimates;  // of what is held
  c.cuts = contender.cuts;
  return guarded(shop, std::move(c), effort, -1, 0);
}

Contender without(const Workshop& shop, const Contender& contender, std::size_t standing) {
  Contender c;
  const Standing& leaving = contender.standing[standing];
  try {
    c.diagram = remove_effect(contender.diagram, *shop.registry, leaving.name, leaving.effect->id);
    c.program = compile(c.diagram, *shop.registry);
  } catch (const Error& e) {
    c.error = e.what();
    return c;
  }
  c.ok = true;
  c.standing = contender.standing;
  c.standing.erase(c.standing.begin() + static_cast<std::ptrdiff_t>(standing));
  for (auto& s : c.standing) {  // what stood behind it on its wire stands on that wire
    if (s.place.at == leaving.name) s.place.at = leaving.place.at;
    if (s.place.wire == leaving.name) s.place.wire = leaving.place.wire;
  }
  c.of_recordings = contender.of_recordings;
  c.starts = contender.starts;
  c.fit.estimates = contender.fit.estimates;
  // Others may stand in the same block.
  std::erase_if(c.fit.estimates, [&](const ParameterEstimate& e) {
    return std::any_of(leaving.law.free.begin(), leaving.law.free.end(),
                       [&](const LawParameter& p) { return e.path == parameter_path(leaving.name, leaving.law, p); });
  });
  c.zero_held = contender.zero_held;
  c.parameters = contender.parameters - spent(contender, static_cast<int>(standing));
  return c;
}

Contender before_last(const Workshop& shop, const Contender& contender) {
  return without(shop, contender, contender.standing.size() - 1);
}

Prediction without_lines(const Workshop& shop, const Contender& contender) {
  return predicted_with(shop, contender, Effort::full, [&](const RecordingValue& v) {
    return std::any_of(contender.standing.begin(), contender.standing.end(),
                       [&](const Standing& s) { return has_line(s.law) && v.path.starts_with(s.name + "."); });
  });
}

Prediction predicted(const Workshop& shop, const Contender& contender, const std::vector<int>& recordings) {
  Contender c = contender;
  c.program = compile(c.diagram, *shop.registry);
  DataModel model(c.program, shop.data, accuracy(shop, *c.program, Effort::final));
  std::vector<FreeParameter> free;
  for (const auto& s : c.standing)
    for (auto& f : free_of_law(*c.program, s, false, recordings))
      if (f.recording >= 0) free.push_back(std::move(f));
  if (free.empty()) return model.predict({}, recordings);
  FitOptions options;
  options.recordings = options.judged = recordings;
  options.intervals = false;
  const FitResult found = fit(model, shop.evidence->noise(), free, options);
  return found.ok ? model.predict(found.values, recordings) : model.predict({}, recordings);
}

std::vector<ParameterOfEffect> parameters_of(const Contender& contender, int standing) {
  std::vector<ParameterOfEffect> list;
  for (std::size_t i = 0; i < contender.standing.size(); ++i) {
    if (standing >= 0 && static_cast<int>(i) != standing) continue;
    const Standing& s = contender.standing[i];
    for (const auto& p : s.law.free) {
      ParameterOfEffect one;
      one.law = &p;
      for (const auto& e : contender.fit.estimates)
        if (e.path == parameter_path(s.name, s.law, p)) one.estimate = &e;
      list.push_back(one);
    }
  }
  return list;
}

double line_of(const Contender& contender) {
  for (const auto& p : parameters_of(contender, static_cast<int>(contender.standing.size()) - 1))
    if (!p.law->line_bands.empty() && p.estimate != nullptr) return p.estimate->used;
  return 0;
}

std::vector<double> values_of(const Contender& contender, std::size_t standing) {
  std::vector<double> values;
  for (const auto& p : parameters_of(contender, static_cast<int>(standing)))
    if (p.estimate != nullptr) values.push_back(p.estimate->used);
  return values;
}

}  // namespace hysteron
