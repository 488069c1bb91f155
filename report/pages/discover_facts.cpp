// Decides how a discovery stands in result.json: every decision with its numbers, for programs.
// Does not decide how people see it (discover_page.h).
#include "report/pages/discover_facts.h"

#include "report/pages/numbers.h"

namespace hysteron {
namespace {

/// Each output over all recordings of a role, in its own unit.
Facts output_facts(const ModelError& error) {
  Facts::List list;
  for (const Role role : {Role::train, Role::validate, Role::test})
    for (const auto& o : by_output(error, role))
      list.push_back(Facts::object({{"output", o.output},
                                    {"role", to_text(role)},
                                    {"unit", unit_text(o.unit)},
                                    {"rms", o.unit.difference_from_si(o.rms)},
                                    {"nrmse", o.nrmse}}));
  return list;
}

Facts recording_facts(const ModelError& error) {
  Facts::List list;
  for (const auto* recordings : {&error.recordings, &error.test})
    for (const auto& r : *recordings) {
      Facts facts = Facts::object({{"recording", r.recording},
                                   {"role", to_text(r.role)},
                                   {"output", r.output},
                                   {"unit", unit_text(r.unit)},
                                   {"rows", r.rows},
                                   {"rms", r.unit.difference_from_si(r.rms)},
                                   {"nrmse", r.nrmse}});
      if (recordings == &error.recordings) facts.set("chi2", r.chi2);
      list.push_back(std::move(facts));
    }
  return list;
}

/// Outputs of several dimensions have no rms in common.
Facts facts_of(const ModelError& error) {
  Facts facts = Facts::object({{"nrmse_train", error.nrmse_train},
                               {"nrmse_validate", error.nrmse_validate},
                               {"chi2_train", error.chi2_train},
                               {"chi2_validate", error.chi2_validate},
                               {"n_train", error.n_train},
                               {"n_validate", error.n_validate},
                               {"outputs", output_facts(error)},
                               {"recordings", recording_facts(error)}});
  if (error.nrmse_test) facts.set("nrmse_test", *error.nrmse_test);
  if (error.recordings.empty() || !of_one_dimension(error.recordings)) return facts;
  const Unit& unit = error.recordings.front().unit;
  facts.set("unit", unit_text(unit));
  facts.set("rms_train", unit.difference_from_si(error.rms_train));
  facts.set("rms_validate", unit.difference_from_si(error.rms_validate));
  if (error.rms_test) facts.set("rms_test", unit.difference_from_si(*error.rms_test));
  return facts;
}

Facts facts_of(const std::vector<FoundParameter>& parameters) {
  Facts::List list;
  for (const auto& p : parameters) {
    const auto& e = p.estimate;
    const auto shown = [&](const std::optional<double>& si) -> std::optional<double> {
      if (!si) return {};
      return e.difference ? e.unit.difference_from_si(*si) : e.unit.from_si(*si);
    };
    Facts entry = Facts::object({{"parameter", e.path},
                                 {"unit", unit_text(e.unit)},
                                 {"determined", e.determined},
                                 {"value", shown(e.value)},
                                 {"low95", shown(e.low95)},
                                 {"high95", shown(e.high95)},
                                 {"start", shown(e.start)},
                                 {"at_bound", e.at_lower || e.at_upper}});
    if (!p.usual.empty()) entry.set("usual", p.usual);
    if (!p.remark.empty()) entry.set("remark", p.remark);
    list.push_back(std::move(entry));
  }
  return list;
}

Facts facts_of(const Experiment& e) {
  return Facts::object({{"word", e.word},
                        {"text", e.text},
                        {"separation_over_noise", e.separation},
                        {"between", e.between},
                        {"another_instrument", e.another_instrument}});
}

/// Gains are in the order of the recordings of the error.
Facts facts_of(const TriedLaw& law) {
  Facts facts = Facts::object({{"law", law.law}, {"taken", law.taken}});
  if (!law.failed) {
    facts.set("parameters", law.parameters);
    facts.set("fall_train", law.fall_train);
    facts.set("fall_validate", law.fall_validate);
    facts.set("fall_by_recording", law.fall_by_recording);
    facts.set("score", law.score);
  }
  if (!law.taken) facts.set("reason", law.reason);
  return facts;
}

Facts facts_of(const Menu& menu) {
  const auto known = [](double separation) {
    return separation < 0 ? std::optional<double>{} : std::optional(separation);
  };
  Facts::List items;
  for (const auto& item : menu.items) {
    Facts facts = Facts::object({{"word", item.word}, {"chosen", item.chosen}});
    if (item.simulated()) {
      Facts::List separations;
      for (const double s : item.separations) separations.emplace_back(known(s));
      facts.set("input", item.drive);
      facts.set("slower", item.slower);
      facts.set("part_of_range", item.part);
      facts.set("faster_rows", item.faster_rows);
      facts.set("separations_over_noise", separations);
      facts.set("separation_over_noise", known(item.separation));
      facts.set("pairs_told", item.pairs_told);
    }
    facts.set("reason", item.reason);
    items.push_back(std::move(facts));
  }
  return Facts::object({{"pairs", menu.pairs}, {"experiments", items}});
}

Facts facts_of(const Candidate& c) {
  return Facts::object({{"step", c.step},
                        {"effect", c.effect},
                        {"law", c.law},
                        {"place", c.place},
                        {"also_at", c.also_at},
                        {"same_places", c.same_places},
                        {"same_effects", c.same_effects},
                        {"parameters", c.parameters},
                        {"fall_train", c.fall_train},
                        {"fall_validate", c.fall_validate},
                        {"score", c.score},
                        {"share_removed", c.share_removed},
                        {"error", facts_of(c.error)},
                        {"found", facts_of(c.found)},
                        {"claimed", c.claimed},
                        {"failed", c.failed},
                        {"summary", c.summary},
                        {"reason", c.reason}});
}

Facts facts_of(const FoundStep& step, std::size_t number) {
  Facts::List ties;
  for (const auto& tie : step.ties) ties.push_back(facts_of(tie));
  Facts facts = Facts::object({{"step", number},
                               {"effect", step.winner.effect},
                               {"place", step.winner.place},
                               {"block", step.change.name},
                               {"evidence", facts_of(step.winner)},
                               {"ties", ties},
                               {"experiment_would_tell", step.experiment_would_tell},
                               {"before", facts_of(step.before)},
                               {"after", facts_of(step.after)},
                               {"sentence", step.sentence}});
  if (step.experiment) facts.set("experiment", facts_of(*step.experiment));
  if (!step.menu.items.empty()) facts.set("menu", facts_of(step.menu));
  return facts;
}

/// With the laws that competed: a step and its ties do without, they stand among the candidates.
Facts with_laws(const Candidate& c) {
  Facts facts = facts_of(c);
  Facts::List laws;
  for (const auto& law : c.laws_tried) laws.push_back(facts_of(law));
  facts.set("laws", laws);
  return facts;
}

void add_where_it_lives(Facts& facts, const Structure& s) {
  if (s.period > 0) facts.set("period", s.unit.difference_from_si(s.period));
  if (s.has_threshold) facts.set("threshold", s.unit.from_si(s.threshold));
}

Facts facts_of(const Structure& s) {
  Facts intervals = Facts::object({});
  for (const auto& [recording, list] : s.intervals) {
    Facts::List of_recording;
    for (const auto& [from, to] : list) of_recording.push_back(Facts::List{from, to});
    intervals.set(recording, of_recording);
  }
  Facts facts = Facts::object({{"kind", s.kind},
                               {"variable", s.variable},
                               {"output", s.output},
                               {"unit", unit_text(s.unit)},
                               {"intervals_s", intervals},
                               {"fall_train", s.fall.train},
                               {"fall_validate", s.fall.validate},
                               {"share_removed", s.share_removed},
                               {"sentence", s.sentence}});
  add_where_it_lives(facts, s);
  return facts;
}

Facts facts_of(const TriedStructure& tried) {
  const Structure& s = tried.structure;
  const bool in_all = tried.where == Where::all_recordings;
  Facts facts = Facts::object({{"kind", s.kind},
                               {"variable", s.variable},
                               {"output", s.output},
                               {"unit", unit_text(s.unit)},
                               {"left_by", tried.left_by == LeftBy::effects ? "effects" : "base"},
                               {"counted_on", in_all ? "all" : "validate"},
                               {"fall_train", s.fall.train},
                               {"fall_validate", s.fall.validate},
                               {"fall_needed", tried.needed},
                               {"share_removed", s.share_removed},
                               {"told", tried.told},
                               {"reason", tried.reason}});
  add_where_it_lives(facts, s);
  return facts;
}

}  // namespace

Facts discovery_facts(const Discovery& found, const std::string& diagram_file, const std::string& data_file) {
  Facts::List effects, steps, candidates, refused, noise, structures;
  for (const auto& step : found.steps) {
    effects.emplace_back(step.winner.effect);
    steps.push_back(facts_of(step, steps.size() + 1));
  }
  for (const auto& c : found.candidates) candidates.push_back(with_laws(c));
  for (const auto& s : found.structures) structures.push_back(facts_of(s));
  for (const auto& r : found.refused)
    refused.push_back(Facts::object({{"effect", r.effect}, {"place", r.place}, {"reason", r.reason}}));
  for (const auto& n : found.noise)
    noise.push_back(Facts::object({{"output", n.output},
                                   {"unit", unit_text(n.unit)},
                                   {"white_rms", n.unit.difference_from_si(n.white)},
                                   {"one_over_f", n.one_over_f},
                                   {"origin", n.origin},
                                   {"remark", n.remark}}));
  Facts facts = Facts::object({{"diagram", diagram_file},
                               {"data", data_file},
                               {"remainder", to_text(found.remainder)},
                               {"effects", effects},
                               {"as_given", facts_of(found.as_given)},
                               {"base", facts_of(found.base)},
                               {"base_parameters", facts_of(found.base_parameters)},
                               {"final", facts_of(found.final_error)},
                               {"steps", steps},
                               {"candidates", candidates},
                               {"refused", refused},
                               {"structures", structures},
                               {"noise", noise},
                               {"noise_guessed", found.noise_guessed},
                               {"simulations", found.model_runs}});
  if (found.fitted_to_all) facts.set("fitted_to_all", true);
  if (!found.smooth_inputs.empty()) {
    Facts::List smooth;
    for (const auto& s : found.smooth_inputs)
      smooth.push_back(Facts::object({{"input", s.input}, {"nrmse_before", s.before}, {"nrmse_after", s.after}}));
    facts.set("smooth_between_samples", smooth);
  }
  if (!found.other_numbers.empty()) {
    Facts::List numbers;
    for (const auto& n : found.other_numbers) {
      const auto shown = [&](double si) { return n.difference ? n.unit.difference_from_si(si) : n.unit.from_si(si); };
      numbers.push_back(Facts::object({{"parameter", n.path},
                                       {"unit", n.unit.text},
                                       {"written", shown(n.written)},
                                       {"found", shown(n.found)},
                                       {"standard_deviation", n.unit.difference_from_si(n.sigma)}}));
    }
    facts.set("other_numbers", numbers);
  }
  if (!found.limits.empty()) {
    Facts::List limits;
    for (const auto& l : found.limits)
      limits.push_back(
          Facts::object({{"effect", l.effect},
                         {"place", l.place},
                         {"law", l.law},
                         {"parameter", l.parameter},
                         {"value", l.difference ? l.unit.difference_from_si(l.value) : l.unit.from_si(l.value)},
                         {"unit", l.unit.text},
                         {"at_most", l.at_most}}));
    facts.set("limits", limits);
  }
  if (found.structure) facts.set("structure", facts_of(*found.structure));
  if (found.experiment) facts.set("next_experiment", facts_of(*found.experiment));
  return facts;
}

Facts check_facts(const Check& answer) {
  return Facts::object({{"explained", answer.explained}, {"parameters_moved", answer.moved}, {"named", answer.named}});
}

}  // namespace hysteron
