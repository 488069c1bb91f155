#include "discover/search/nominal_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "discover/models/parts.h"
#include "discover/search/search_state.h"
#include "discover/wiring/wiring.h"

namespace hysteron {
namespace {

/// More of them are a fit of its own, and whoever has so many knows which are not sure.
constexpr std::size_t most_numbers = 60;

/// "weights[2]" -> "weights".
std::string without_index(const std::string& name) { return name.substr(0, name.find('[')); }

/// Numbers of one block that have a size: not where a zero lies, not what cuts a range into parts, no clock.
bool has_a_size(const Declaration& d, const std::string& name) {
  const int i = d.parameter_index(name);
  if (i < 0 || (d.is_sampled && (name == "period" || name == "offset"))) return false;
  const ParameterDeclaration& p = d.parameters[static_cast<std::size_t>(i)];
  return !p.is_offset && !p.is_increasing && !p.is_structural;
}

/// Is it written, not a default, at this level of the diagram or of one inside it; numbers of effects were fitted, or
/// are the user's guess: the user is told that they are held.
bool is_written(const Diagram& diagram, const Registry& registry, const std::string& block, const std::string& name) {
  const auto slash = block.find('/');
  const std::string here = block.substr(0, slash);
  const Node* node = diagram.blocks.find(here);
  const Node* body = Wiring(diagram, registry).body(here);
  if (node == nullptr || body == nullptr) return false;
  if (!node->effect.empty()) body = node->from.find("off");  // what it varies is the user's
  if (body == nullptr) return false;
  if (slash != std::string::npos)
    return body->nested && is_written(*body->nested, registry, block.substr(slash + 1), name);
  return body->parameters.find(name) != nullptr || body->parameters_from_file.find(name) != nullptr;
}

bool is_measured(const SearchState& state, int block) {
  const Program& program = state.base_model->program();
  const auto& judged = state.base_model->outputs();
  const auto behind = outputs_behind(program, block);
  return std::any_of(behind.begin(), behind.end(), [&](int o) {
    return std::find(judged.begin(), judged.end(), program.output_names[static_cast<std::size_t>(o)]) != judged.end();
  });
}

double spread(double written) { return nominal_uncertainty * std::abs(written) / 2; }  // 95 % are two of these

/// What a number costs that the data tell from what is written, in parts of one: one that they leave where it was costs
/// nothing (MacKay, Neural Computation 4 (1992) 415: the number of well-determined parameters).
struct Cost {
  double numbers = 0, moved = 0;
  bool plausible = true;  ///< none of them at its bound
};
Cost cost_of(const CandidateModel& c, const std::map<std::string, double>& numbers) {
  Cost cost;
  for (const auto& e : c.fit.estimates) {
    const auto n = numbers.find(e.path);
    if (n == numbers.end()) continue;
    const double sigma = spread(n->second);
    cost.moved += std::pow((e.used - n->second) / sigma, 2);
    if (e.at_lower || e.at_upper) cost.plausible = false;
    if (e.determined && e.sigma) cost.numbers += std::max(0.0, 1 - std::pow(*e.sigma / sigma, 2));
  }
  return cost;
}

/// The numbers, where they may be asked for at all.
std::map<std::string, double> may_be_let_go(const SearchState& state) {
  if (state.options.numbers_are_exact || !state.context.roughly.empty() || state.stopped()) return {};
  auto numbers = held_numbers(state);
  if (numbers.size() > most_numbers) numbers.clear();
  return numbers;
}

CandidateModel with_numbers(const SearchState& state, const CandidateModel& model,
                            const std::map<std::string, double>& numbers, Effort effort) {
  FitContext context = state.context;
  context.free_nominal_parameters(numbers);
  return refit(context, model, effort);
}

/// `model` with these numbers let go, if that explains more than `other` and is `enough`. A law that finds weights anew
/// pays nothing for them: beside it nobody does.
std::optional<CandidateModel> explaining_better(const SearchState& state, const CandidateModel& model,
                                                const std::map<std::string, double>& numbers,
                                                const CandidateModel& other, const Law* law,
                                                const std::function<bool(const CandidateModel&)>& enough) {
  const bool free_of_charge = law != nullptr && law->reweighs;
  CandidateModel c = model;
  for (const Effort effort : {Effort::full, Effort::final}) {  // what they cost is known once there are intervals
    c = with_numbers(state, c, numbers, effort);
    if (!c.ok || !enough(c)) return {};
    const Cost cost = cost_of(c, numbers);
    const double each = std::log(std::max(c.error_of.effective_sample_size, 2.0));
    double score = c.score();
    if (!free_of_charge) score += rules::tie + cost.moved + (effort == Effort::final ? cost.numbers * each : 0);
    if (!cost.plausible || score > other.score()) return {};
  }
  return c;
}

/// Numbers of which one does what another does (a force and the spring it acts on) each move half the way. The fewest
/// that explain as much as all: those that moved for certain, and of the others the ones that moved most.
std::map<std::string, double> fewest(const SearchState& state, const CandidateModel& model, const CandidateModel& all,
                                     const std::map<std::string, double>& numbers) {
  std::map<std::string, double> few;
  std::vector<std::pair<double, std::string>> others;
  for (const auto& e : all.fit.estimates) {
    const auto n = numbers.find(e.path);
    if (n == numbers.end()) continue;
    const double moved = std::abs(e.used - n->second);
    if (e.sigma && moved > rules::moved * *e.sigma)
      few.insert(*n);
    else
      others.emplace_back(-moved / std::abs(n->second), e.path);
  }
  std::sort(others.begin(), others.end());
  const auto worth = [](const CandidateModel& c, const std::map<std::string, double>& free_nominal_parameters) {
    return c.score() + cost_of(c, free_nominal_parameters).moved;
  };
  const double reached = worth(all, numbers) + rules::tie;
  for (std::size_t next = 0; few.size() < numbers.size(); ++next) {
    if (!few.empty()) {
      const CandidateModel c = with_numbers(state, model, few, Effort::full);
      if (c.ok && worth(c, few) < reached) return few;
    }
    if (next >= others.size()) break;
    few.insert(*numbers.find(others[next].second));
  }
  return numbers;
}

/// More than a gain and a zero of each output would explain: one that is off alone is a calibration, and called that.
bool is_no_calibration(const SearchState& state, const CandidateModel& c) {
  Prediction straight = state.current.prediction;
  for (int o = 0; o < static_cast<int>(state.base_model->outputs().size()); ++o)
    straight = state.evidence->calibrated(std::move(straight), o);
  return c.error_of.evidence() + rules::tie < state.evidence->error(straight).evidence();
}

/// Where no effect would be claimed: most of what stands above the noise, and more than the laws that stand may have
/// left, for a spring a little harder is just what a law that is not exact leaves of a loop in it.
bool is_more_than_laws_leave(const SearchState& state, const ModelError& now) {
  const ModelError& was = state.current.error_of;
  const bool first = state.current.placed.empty();
  const double share = first ? rules::share_of_first : rules::share_of_rest;
  if (now.excess_validate() > (1 - share) * was.excess_validate()) return false;
  const auto left = left_by_laws(state, first ? As::first : As::further);
  double train = 0, validate = 0;
  for (std::size_t i = 0; i < left.size(); ++i)
    (was.recordings[i].role == Role::train ? train : validate) +=
        left[i] * std::pow(rules::imitated_left / rules::own_law_left, 2);
  return was.chi2_train - now.chi2_train > train && was.chi2_validate - now.chi2_validate > validate;
}

}  // namespace

std::map<std::string, double> held_numbers(const SearchState& state) {
  std::map<std::string, double> numbers;
  const Program& program = state.base_model->program();
  const auto free = free_parameters(program, state.context.free_paths);
  for (std::size_t i = 0; i < program.parameters.size(); ++i) {
    const ParameterInfo& p = program.parameters[i];
    const bool is_free = std::any_of(free.begin(), free.end(),
                                     [&](const FreeParameter& f) { return f.parameter == static_cast<int>(i); });
    const bool from_elsewhere = p.offset || (!p.difference && p.unit.to_si(0) != 0);  // a zero, a temperature
    const bool is_exact = p.known_to && *p.known_to == 0;
    if (is_free || is_exact || p.value == 0 || p.block < 0 || from_elsewhere || !is_measured(state, p.block)) continue;
    const auto& block = program.blocks[static_cast<std::size_t>(p.block)];
    const Declaration& d = block.kernel->declaration;
    if (d.inputs.empty()) continue;
    const auto dot = p.path.rfind('.');
    if (dot != std::string::npos) {
      const std::string name = without_index(p.path.substr(dot + 1));
      if (!has_a_size(d, name) || !is_written(state.user, state.registry, block.path, name)) continue;
    }
    numbers[p.path] = p.value;
  }
  return numbers;
}

bool are_the_numbers(SearchState& state, const TriedEffect* winner) {
  const auto numbers = may_be_let_go(state);
  if (numbers.empty()) return false;
  const auto enough = [&](const CandidateModel& c) {
    return falls_in_both_roles(c.error_of, state.current.error_of) && is_no_calibration(state, c) &&
           (winner != nullptr || is_more_than_laws_leave(state, c.error_of));
  };
  const auto all = explaining_better(state, state.current, numbers, winner ? winner->candidate : state.current,
                                     winner ? &winner->laws[winner->law] : nullptr, enough);
  if (all) state.other_numbers = fewest(state, state.current, *all, numbers);
  return all.has_value();
}

bool are_numbers_in_place_of_an_effect(SearchState& state) {
  const auto numbers = may_be_let_go(state);
  if (numbers.empty()) return false;
  for (std::size_t i = 0; i < state.current.placed.size(); ++i) {
    if (calibrates(state.current.placed[i])) continue;
    const CandidateModel rest = without(state.context, state.current, i);
    if (!rest.ok) continue;
    const Law& law = state.current.placed[i].law;
    const auto all =
        explaining_better(state, rest, numbers, state.current, &law, [](const CandidateModel&) { return true; });
    if (!all) continue;
    state.other_numbers = fewest(state, rest, *all, numbers);
    return true;
  }
  return false;
}

std::map<std::string, double> numbers_to_try(const SearchState& state) {
  if (state.current.error_of.over_floor() <= rules::floor_gate) return {};
  auto numbers = may_be_let_go(state);
  if (numbers.empty()) return {};
  // Those that change nothing of the model alone - a mass of 1 kg where force and spring are free - need no search.
  const ModelError was = state.evidence->error(state.base.prediction);
  const CandidateModel c = with_numbers(state, state.base, numbers, Effort::full);
  const bool tell = c.ok && falls_in_both_roles(c.error_of, was) &&
                    c.error_of.excess_validate() < (1 - rules::hardly_shown) * was.excess_validate();
  return tell ? numbers : std::map<std::string, double>{};
}

std::map<std::string, double> numbers_that_help(const SearchState& free_nominal_parameters, const SearchState& held) {
  const auto& numbers = free_nominal_parameters.context.roughly;
  const CandidateModel& now = free_nominal_parameters.current;
  CandidateModel was = held.current;
  was.error_of = free_nominal_parameters.evidence->error(was.prediction);
  const Cost cost = cost_of(now, numbers);
  const double each = std::log(std::max(now.error_of.effective_sample_size, 2.0));
  const double score = now.score() + cost.moved + cost.numbers * each + rules::tie;
  const bool most = now.error_of.excess_validate() < (1 - rules::share_of_rest) * was.error_of.excess_validate();
  if (!most || !cost.plausible || score > was.score()) return {};
  CandidateModel as_written = now;
  Trial written;
  for (const auto& [path, value] : numbers) written.push_back({parameter_index(*now.program, path), value, -1});
  as_written.diagram = with_parameters(now.diagram, *now.program, written);
  return fewest(held, as_written, now, numbers);
}

void tell_other_numbers(SearchState& state) {
  for (const auto& e : state.current.fit.estimates) {
    const auto n = state.context.roughly.find(e.path);
    if (n == state.context.roughly.end() || !e.sigma) continue;
    if (std::abs(e.used - n->second) > rules::moved * *e.sigma)
      state.d.other_numbers.push_back({e.path, e.unit, e.difference, n->second, e.used, *e.sigma});
  }
  if (!state.context.roughly.empty() && state.d.other_numbers.empty())
    state.d.warnings.push_back(
        "numbers that the model holds were let go, each near what is written, and all figures are with what was found "
        "for "
        "them, as the diagram has it: none alone is another one for certain (several may do the same); with --exact "
        "they "
        "stay as they are");
  std::stable_sort(state.d.other_numbers.begin(), state.d.other_numbers.end(), [](const auto& a, const auto& b) {
    return std::abs(a.found / a.written - 1) > std::abs(b.found / b.written - 1);
  });
}

void tell_unused_numbers(SearchState& state) {
  state.d.warnings.push_back(
      "other values of the model's own numbers, within some per cent of what is written, explain more than what was "
      "found does. The search that takes them into account was broken off: leave those free that are not sure "
      "(\"free\": true), and begin with that.");
}

}  // namespace hysteron
