// Decides how a discovery stands in result.json: every decision with its numbers, for programs.
// Does not decide how people see it (discover_page.h).
#include "app/discover_facts.h"

#include <nlohmann/json.hpp>

#include "app/numbers.h"

namespace hysteron {
namespace {

using Json = nlohmann::json;

Json optional_number(const std::optional<double>& value, const Unit& unit) {
  return value ? Json(unit.difference_from_si(*value)) : Json(nullptr);
}

Json facts_of(const ModelError& error, const Unit& unit) {
  Json recordings = Json::array();
  for (const auto& r : error.recordings)
    recordings.push_back({{"recording", r.recording},
                          {"role", to_text(r.role)},
                          {"output", r.output},
                          {"rows", r.rows},
                          {"rms", unit.difference_from_si(r.rms)},
                          {"nrmse", r.nrmse},
                          {"chi2", r.chi2}});
  Json facts{{"unit", unit_text(unit)},
             {"rms_train", unit.difference_from_si(error.rms_train)},
             {"rms_validate", unit.difference_from_si(error.rms_validate)},
             {"nrmse_train", error.nrmse_train},
             {"nrmse_validate", error.nrmse_validate},
             {"chi2_train", error.chi2_train},
             {"chi2_validate", error.chi2_validate},
             {"n_train", error.n_train},
             {"n_validate", error.n_validate},
             {"recordings", recordings}};
  if (error.rms_test) facts["rms_test"] = optional_number(error.rms_test, unit);
  if (error.nrmse_test) facts["nrmse_test"] = *error.nrmse_test;
  return facts;
}

Json facts_of(const std::vector<FoundParameter>& parameters) {
  Json list = Json::array();
  for (const auto& p : parameters) {
    const auto& e = p.estimate;
    const auto shown = [&](const std::optional<double>& si) -> Json {
      if (!si) return nullptr;
      return e.difference ? e.unit.difference_from_si(*si) : e.unit.from_si(*si);
    };
    Json entry{{"parameter", e.path},        {"unit", unit_text(e.unit)},
               {"determined", e.determined}, {"value", shown(e.value)},
               {"low95", shown(e.low95)},    {"high95", shown(e.high95)},
               {"start", shown(e.start)},    {"at_bound", e.at_lower || e.at_upper}};
    if (!p.remark.empty()) entry["remark"] = p.remark;
    list.push_back(std::move(entry));
  }
  return list;
}

Json facts_of(const Experiment& e) {
  return {{"word", e.word}, {"text", e.text}, {"separation_over_noise", e.separation}, {"between", e.between}};
}

Json facts_of(const Candidate& c, const Unit& unit) {
  return {{"step", c.step},
          {"effect", c.effect},
          {"law", c.law},
          {"place", c.place},
          {"same_places", c.same_places},
          {"same_effects", c.same_effects},
          {"parameters", c.parameters},
          {"fall_train", c.fall_train},
          {"fall_validate", c.fall_validate},
          {"score", c.score},
          {"share_removed", c.share_removed},
          {"error", facts_of(c.error, unit)},
          {"found", facts_of(c.found)},
          {"claimed", c.claimed},
          {"failed", c.failed},
          {"summary", c.summary},
          {"reason", c.reason}};
}

Json facts_of(const FoundStep& step, std::size_t number, const Unit& unit) {
  Json ties = Json::array();
  for (const auto& tie : step.ties) ties.push_back(facts_of(tie, unit));
  Json facts{{"step", number},
             {"effect", step.winner.effect},
             {"place", step.winner.place},
             {"block", step.change.name},
             {"evidence", facts_of(step.winner, unit)},
             {"ties", ties},
             {"experiment_would_tell", step.experiment_would_tell},
             {"before", facts_of(step.before, unit)},
             {"after", facts_of(step.after, unit)},
             {"sentence", step.sentence}};
  if (step.experiment) facts["experiment"] = facts_of(*step.experiment);
  return facts;
}

Json facts_of(const Structure& s) {
  Json intervals = Json::object();
  for (const auto& [recording, list] : s.intervals) intervals[recording] = list;
  Json facts{{"kind", s.kind},
             {"variable", s.variable},
             {"output", s.output},
             {"unit", unit_text(s.unit)},
             {"intervals_s", intervals},
             {"fall_validate", s.fall_validate},
             {"share_removed", s.share_removed},
             {"sentence", s.sentence}};
  if (s.period > 0) facts["period"] = s.unit.difference_from_si(s.period);
  if (s.has_threshold) facts["threshold"] = s.unit.from_si(s.threshold);
  return facts;
}

}  // namespace

nlohmann::json discovery_facts(const Discovery& found, const Unit& unit, const std::string& diagram_file,
                               const std::string& data_file) {
  Json facts{{"diagram", diagram_file}, {"data", data_file}, {"remainder", to_text(found.remainder)}};
  Json effects = Json::array();
  for (const auto& step : found.steps) effects.push_back(step.winner.effect);
  facts["effects"] = effects;
  facts["as_given"] = facts_of(found.as_given, unit);
  facts["base"] = facts_of(found.base, unit);
  facts["base_parameters"] = facts_of(found.base_parameters);
  facts["final"] = facts_of(found.final_error, unit);
  facts["steps"] = Json::array();
  for (std::size_t i = 0; i < found.steps.size(); ++i) facts["steps"].push_back(facts_of(found.steps[i], i + 1, unit));
  facts["candidates"] = Json::array();
  for (const auto& c : found.candidates) facts["candidates"].push_back(facts_of(c, unit));
  facts["refused"] = Json::array();
  for (const auto& r : found.refused)
    facts["refused"].push_back({{"effect", r.effect}, {"place", r.place}, {"reason", r.reason}});
  if (found.structure) facts["structure"] = facts_of(*found.structure);
  facts["noise"] = Json::array();
  for (const auto& n : found.noise)
    facts["noise"].push_back({{"output", n.output},
                              {"unit", unit_text(n.unit)},
                              {"white_rms", n.unit.difference_from_si(n.white)},
                              {"one_over_f", n.one_over_f},
                              {"origin", n.origin},
                              {"remark", n.remark}});
  facts["noise_guessed"] = found.noise_guessed;
  if (found.experiment) facts["next_experiment"] = facts_of(*found.experiment);
  facts["simulations"] = found.model_runs;
  return facts;
}

}  // namespace hysteron
