// Decides how a discovery is told to people. Decides nothing else.
#include "discover/narrate/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "discover/hypotheses/effect_terms.h"
#include "discover/search/investigation.h"
#include "fit/signals/unit_words.h"

namespace hysteron {
namespace {

/// "a lag, in the amplifier or in the sensor": what kind of thing an effect is, when its place cannot be told.
std::string effect_words(const Effect& effect, const std::vector<std::string>& same_effects) {
  return !same_effects.empty() && effect.family == "lag" ? "a lag, in the amplifier or in the sensor" : effect.title;
}

/// A place as a sentence says it: "outputs.w" is the reading of w.
std::string spoken(const std::string& place) {
  constexpr std::string_view outputs = "outputs.";
  return place.starts_with(outputs) ? "the reading of " + place.substr(outputs.size()) : place;
}

std::vector<std::string> spoken(std::vector<std::string> places) {
  for (auto& place : places) place = spoken(place);
  return places;
}

std::string place_text(const Candidate& c) {
  if (!c.also_at.empty()) return fmt::format("at {} and {}", spoken(c.place), fmt::join(spoken(c.also_at), " and "));
  if (c.same_places.empty()) return "at " + spoken(c.place);
  std::vector<std::string> all{c.place};
  for (const auto& p : c.same_places)
    if (std::find(all.begin(), all.end(), p) == all.end()) all.push_back(p);
  return fmt::format("at {} (these places cannot be told apart)", fmt::join(spoken(all), " or "));
}

/// What would tell effects apart that are one finding in these recordings; "" where nobody says.
std::string what_tells_places(const Effect& effect, const std::vector<std::string>& same_effects) {
  for (const auto& l : effect.look_alikes)
    if (std::find(same_effects.begin(), same_effects.end(), l.effect) != same_effects.end())
      return fmt::format("; which of them, \"{}\" tells: {}", l.experiment, l.deciding);
  return "";
}

std::string remark_of(const ParameterOfEffect& p, const Excitation& at) {
  const ParameterEstimate& e = *p.estimate;
  if (!e.determined) return "the data do not determine it";
  if (!e.value) return "";
  std::string text;
  const auto shown = [&](double si) { return size_text(si, e.unit); };
  if (*e.value > p.law->plausible_upper)
    text = fmt::format("more than {}, which is unusual", shown(p.law->plausible_upper));
  else if (*e.value < p.law->plausible_lower)
    text = fmt::format("less than {}, which is unusual", shown(p.law->plausible_lower));
  if ((e.at_lower || e.at_upper) && p.law->path.find('[') == std::string::npos)
    text += text.empty() ? "held at its bound" : "; held at its bound";
  (void)at;
  return text;
}

/// The plausibility limits of a law's parameter.
std::string usual_range(const ParameterOfEffect& p) {
  const double low = p.law->plausible_lower, high = p.law->plausible_upper;
  const auto shown = [&](double si) { return size_text(si, p.estimate->unit); };
  if (std::isfinite(low) && std::isfinite(high)) return shown(low) + " .. " + shown(high);
  if (std::isfinite(high)) return "at most " + shown(high);
  return std::isfinite(low) ? "at least " + shown(low) : "";
}

constexpr std::size_t most_outputs_told = 3;

/// How the error of each output fell, in its own unit; "" where these are too many.
std::string falls_of(const ModelError& before, const ModelError& after) {
  const auto was = by_output(before, Role::validate), is = by_output(after, Role::validate);
  if (was.size() != is.size() || is.size() > most_outputs_told) return "";
  std::vector<std::string> falls;
  for (std::size_t o = 0; o < is.size(); ++o)
    falls.push_back((is.size() > 1 ? is[o].output + ": " : "") + fall_text(was[o].rms, is[o].rms, is[o].unit));
  return fmt::format("{}", fmt::join(falls, ", "));
}

std::string error_fall(const std::string& on, const ModelError& before, const ModelError& after) {
  const std::string falls = falls_of(before, after);
  return fmt::format("error on {} {:.3g} % -> {:.3g} %{}", on, 100 * before.nrmse_validate, 100 * after.nrmse_validate,
                     falls.empty() ? "" : " (" + falls + ")");
}

/// "0.42 um, 3.2 %"
std::string left_text(const ModelError& e) {
  const std::string sizes = sizes_text(e, Role::validate);
  return fmt::format("{}{:.3g} %", sizes.empty() ? "" : sizes + ", ", 100 * e.nrmse_validate);
}

/// An effect that may explain a step, and where.
struct Named {
  std::string effect;
  std::vector<std::string> places;
};

std::string names_of(const FoundStep& s) {
  std::vector<Named> list;
  const auto add = [&](const std::string& effect, const std::string& at) {
    const std::string place = spoken(at);
    auto named = std::find_if(list.begin(), list.end(), [&](const Named& n) { return n.effect == effect; });
    if (named == list.end()) named = list.insert(named, {effect, {}});
    if (!place.empty() && std::find(named->places.begin(), named->places.end(), place) == named->places.end())
      named->places.push_back(place);
  };
  const auto add_all = [&](const Candidate& c) {
    add(c.effect, c.place);
    for (const auto& same : c.same_effects) add(same, "");
  };
  add_all(s.winner);
  for (const auto& tie : s.ties) add_all(tie);
  std::vector<std::string> names;
  for (const auto& n : list)
    names.push_back(n.places.size() < 2 ? n.effect
                                        : fmt::format("{} (at {})", n.effect, fmt::join(n.places, " or at ")));
  return fmt::format("{}", fmt::join(names, " or "));
}

void tell_noise(Discovery& d) {
  for (const auto& n : d.noise)
    if (!n.remark.empty())
      d.warnings.push_back(fmt::format("{}: {}; {} rms is used", n.output, n.remark, size_text(n.white, n.unit)));
}

}  // namespace

std::string to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::adequate:
      return "adequate";
    case Verdict::missing_effect:
      return "missing_effect";
    case Verdict::not_distinguishable:
      return "not_distinguishable";
    case Verdict::unexplained:
      return "unexplained";
  }
  return "";
}

std::string to_text(Remainder remainder) { return remainder == Remainder::noise ? "noise" : "structured"; }

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string names_of(const std::vector<FoundStep>& steps, std::size_t step) {
  const std::string name = names_of(steps[step]);
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (i != step && names_of(steps[i]) == name) return name + " at " + steps[step].winner.place;
  return name;
}

std::string judged_on(const Discovery& found) {
  return found.fitted_to_all ? "recordings to judge (fitted to as well)" : "recordings not used for the fit";
}

std::string sizes_text(const ModelError& error, Role role) {
  const auto outputs = by_output(error, role);
  if (outputs.size() > most_outputs_told) return "";
  std::vector<std::string> sizes;
  for (const auto& o : outputs) sizes.push_back((outputs.size() > 1 ? o.output + " " : "") + size_text(o.rms, o.unit));
  return fmt::format("{}", fmt::join(sizes, ", "));
}

std::string test_sentence(const ModelError& e) {
  const std::string sizes = sizes_text(e, Role::test);
  return fmt::format("On the test recordings, read once at the end: {:.3g} %{}.", 100 * *e.nrmse_test,
                     sizes.empty() ? "" : " (" + sizes + " rms)");
}

std::vector<FoundParameter> found_parameters(const CandidateModel& c, const Excitation& at) {
  std::vector<FoundParameter> list;
  for (const auto& e : c.fit.estimates) list.push_back({e, "", ""});
  for (const auto& p : parameters_of(c))
    for (auto& f : list) {
      if (p.estimate == nullptr || f.estimate.path != p.estimate->path) continue;
      f.remark = remark_of(p, at);
      f.usual = usual_range(p);
    }
  return list;
}

std::string summary_of(const CandidateModel& c, std::size_t standing, const Excitation& at) {
  const Effect* effect = c.placed[standing].effect;
  const Law& law = c.placed[standing].law;
  if (!effect->summary) return "";
  const auto values = values_of(c, standing);
  // A number that begins where the user has it comes last, and is the user's own where the diagram leaves it free.
  const auto begun =
      std::count_if(law.free.begin(), law.free.end(), [](const auto& p) { return !std::isnan(p.start); });
  return values.size() >= static_cast<std::size_t>(begun) ? effect->summary(law, values, at) : "";
}

namespace {

TriedLaw the_only_law(const Candidate& c, const std::vector<double>& fall_by_recording) {
  TriedLaw law{c.law, c.parameters, c.fall_train, c.fall_validate, {}, c.score, !c.failed, c.failed, {}};
  if (c.failed)
    law.reason = c.reason;
  else
    law.fall_by_recording = fall_by_recording;
  return law;
}

/// Index of the effect among those that stand in its candidate's model: there, elsewhere on its wire, or the last one.
std::size_t standing_of(const TriedEffect& t) {
  const auto& placed = t.candidate.placed;
  std::size_t found = placed.size() - 1;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (placed[i].effect != t.effect) continue;
    found = i;
    if (placed[i].place.where() == t.place.where()) break;
  }
  return found;
}

}  // namespace

Candidate candidate_of(const TriedEffect& t, int step) {
  Candidate c;
  c.effect = t.effect->id;
  c.title = effect_words(*t.effect, t.same_effects);
  c.law = t.laws.empty() ? "" : t.laws[t.law].name;
  c.place = t.place.where();
  c.same_places = t.same_places;
  c.same_effects = t.same_effects;
  c.step = step;
  c.fall_train = t.fall_train;
  c.fall_validate = t.fall_validate;
  c.share_removed = t.share;
  c.failed = !t.candidate.ok;
  for (const auto& p : t.effect->parameters)
    if (!p.range.empty()) c.plausible += fmt::format("{}{}: {}", c.plausible.empty() ? "" : "; ", p.name, p.range);
  c.reason = t.reason;
  c.model_runs = t.candidate.runs;
  if (t.candidate.ok) {
    c.parameters = t.candidate.parameters;
    c.error = t.candidate.error_of;
    c.score = t.score;
    c.found = found_parameters(t.candidate, t.excitation);
    c.summary = summary_of(t.candidate, standing_of(t), t.excitation);
  }
  c.laws_tried = t.laws_tried.empty() ? std::vector{the_only_law(c, t.fall_by_recording)} : t.laws_tried;
  return c;
}

std::string step_sentence(const FoundStep& s, const Effect& effect, const std::string& on) {
  std::string text = fmt::format("{} {}", effect_words(effect, s.winner.same_effects), place_text(s.winner));
  if (!s.winner.summary.empty()) text += ": " + s.winner.summary;
  text += what_tells_places(effect, s.winner.same_effects) + "; " + error_fall(on, s.before, s.after);
  if (!s.ties.empty()) {
    std::vector<std::string> names;
    for (const auto& tie : s.ties) names.push_back(fmt::format("{} at {}", tie.effect, spoken(tie.place)));
    text += fmt::format("; explained as well by {}", fmt::join(names, ", "));
  }
  return text;
}

namespace {

std::string headline_of(const Discovery& d) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < d.steps.size(); ++i) names.push_back(names_of(d.steps, i));
  const std::string fall = error_fall(judged_on(d), d.base, d.final_error);
  const std::string asked =
      d.asked_for.empty() ? "" : fmt::format(" of those asked for ({})", fmt::join(d.asked_for, ", "));
  const std::string tried = asked + (d.broken_off ? " that was tried before the search was stopped" : "");
  switch (d.verdict) {
    case Verdict::adequate:
      return fmt::format(
          "Adequate: the residual ({}) is the noise of the recordings, and no effect{} reduces it by more than chance.",
          left_text(d.base), tried);
    case Verdict::missing_effect:
      return fmt::format("Missing: {}. The {}.", fmt::join(names, ", then "), fall);
    case Verdict::not_distinguishable:
      return fmt::format("Something is missing, and these recordings cannot tell which: {}. With {} the {}.",
                         fmt::join(names, "; "), d.steps.front().winner.effect, fall);
    case Verdict::unexplained:
      break;
  }
  if (d.structure)
    return fmt::format("Unexplained: {}, and no known effect{} explains it.", d.structure->sentence, tried);
  return fmt::format(
      "Unexplained: the residual on validation recordings is {:.2g} times the noise, and no known effect{} explains it.",
      std::sqrt(std::max(d.base.over_floor(), 0.0)), tried);
}

/// "2.4 % more".
std::string further(const OtherNumber& n) {
  const double by = 100 * (n.found / n.written - 1);
  return fmt::format("{:.2g} % {}", std::abs(by), by > 0 ? "more" : "less");
}

/// Before everything else: where the model's numbers are wrong, all that is said holds for others.
std::string other_numbers(const Discovery& d) {
  constexpr std::size_t named = 3;
  std::vector<std::string> list;
  for (std::size_t i = 0; i < std::min(named, d.other_numbers.size()); ++i)
    list.push_back(fmt::format("{} is {} than in the diagram", d.other_numbers[i].path, further(d.other_numbers[i])));
  if (d.other_numbers.size() > named) list.push_back(fmt::format("{} more", d.other_numbers.size() - named));
  const std::string fall =  // beside effects, numbers alone are a fit to what these do
      d.steps.empty() ? fmt::format("With them the {}. ", error_fall(judged_on(d), d.as_given, d.base)) : "";
  return fmt::format("Parameters of the model differ from those of the device: {}. {}", fmt::join(list, ", "), fall);
}

/// Each of them, and what to do.
void tell_numbers(Discovery& d) {
  if (d.other_numbers.empty()) return;
  for (const auto& n : d.other_numbers) {
    const auto shown = [&](double si) { return n.difference ? n.unit.difference_from_si(si) : n.unit.from_si(si); };
    const double sigma = n.unit.difference_from_si(n.sigma);
    d.sentences.push_back(fmt::format("{} is {:.5g} +- {:.2g}{}{} (95 %), {} than {:.5g} in the diagram", n.path,
                                      shown(n.found), 2 * sigma, n.unit.text.empty() ? "" : " ", n.unit.text,
                                      further(n), shown(n.written)));
  }
  d.sentences.push_back(
      "No smaller set of parameters explains as much as these together (another parameter with the same influence, such as a stiffness in place of a force, would do as well). With the values in the diagram an effect might be named that only compensates for them. Mark in the diagram those that are uncertain (\"free\": true); where all are exact, use --exact.");
}

/// What was found and what is left of it; of what nothing explains all that is known.
void tell_what_is_left(Discovery& d) {
  auto& say = d.sentences;
  for (const auto& s : d.steps) say.push_back(s.sentence);
  if (d.verdict == Verdict::unexplained)
    say.push_back(fmt::format("The residual on {} is {}{}.", judged_on(d), left_text(d.final_error),
                              d.structure ? "" : ", without a spectral line, ripple, kink, jumps or bursts"));
  else if (!d.steps.empty())
    say.push_back(d.remainder == Remainder::noise
                      ? fmt::format("The remaining residual ({}) is noise.", left_text(d.final_error))
                      : fmt::format("The remaining residual ({}) still has structure: {:.2g} times the noise.",
                                    left_text(d.final_error), std::sqrt(std::max(d.final_error.over_floor(), 0.0))));
  for (const auto& r : d.refused)
    if (std::find(d.asked_for.begin(), d.asked_for.end(), r.effect) != d.asked_for.end())
      say.push_back(
          fmt::format("{}{} was not tried: {}.", r.effect, r.place.empty() ? "" : " at " + r.place, r.reason));
  if (!d.steps.empty() && d.structure) say.push_back("In the remaining residual " + d.structure->sentence + ".");
  if (d.structure)
    for (auto& sentence : structure_sentences(*d.structure)) say.push_back(std::move(sentence));
}

/// Of what was looked for and not found, the largest that may be there all the same.
void tell_limits(Discovery& d) {
  constexpr std::size_t named = 3;
  if (d.limits.empty()) return;
  std::vector<const EffectLimit*> largest;
  for (const auto& l : d.limits) largest.push_back(&l);
  std::stable_sort(largest.begin(), largest.end(), [](const auto* a, const auto* b) { return a->sizes > b->sizes; });
  std::vector<std::string> list;
  for (std::size_t i = 0; i < std::min(named, largest.size()); ++i)
    list.push_back(fmt::format("{} at {}: {}", largest[i]->effect, largest[i]->place,
                               largest[i]->at_most.substr(0, largest[i]->at_most.find(';'))));
  d.sentences.push_back(
      fmt::format("Not found, with upper limits (95 %): {}{}.", fmt::join(list, "; "),
                  largest.size() > named ? fmt::format("; {} more in the report", largest.size() - named) : ""));
}

}  // namespace

void put_into_words(Discovery& d, const DataSet& data) {
  d.headline = (d.other_numbers.empty() ? "" : other_numbers(d)) + headline_of(d);
  tell_numbers(d);
  tell_what_is_left(d);
  tell_limits(d);
  if (d.final_error.nrmse_test) d.sentences.push_back(test_sentence(d.final_error));
  if (d.experiment)
    d.sentences.push_back(
        fmt::format("To tell {} apart, record {}: {}. The two models differ there by {:.3g} times the noise.{}",
                    d.experiment->between, d.experiment->word, d.experiment->text, d.experiment->separation,
                    d.experiment->another_instrument ? " Without it no input signal tells them apart." : ""));
  if (d.verdict == Verdict::unexplained) d.sentences.push_back(what_to_record(d.structure ? &*d.structure : nullptr));
  if (data.single)
    d.warnings.push_back(
        "One recording only: its first 60 % was fitted, the rest judged. That is weak evidence; add a second recording with another amplitude or frequency.");
  if (d.verdict == Verdict::adequate && d.base.nrmse_validate > 0.9)
    d.warnings.push_back(
        "The measured output hardly moves beyond its noise in the validation recordings: few effects can be found in them.");
  tell_noise(d);
}

}  // namespace hysteron
