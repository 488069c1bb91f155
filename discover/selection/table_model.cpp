#include "discover/selection/table_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "discover/models/fit_candidate_model.h"
#include "discover/search/held_numbers.h"

namespace hysteron {
namespace {

constexpr double settled = 0.05;                 // of V
constexpr double two_sided = 1.959963984540054;  // 95 % of a normal distribution

int numbers_of(const CandidateModel& c, std::size_t recordings) {
  int n = 0;
  for (const auto& s : c.placed) {
    for (const auto& p : s.law.free) n += p.per_recording ? static_cast<int>(recordings) : 1;
    n += static_cast<int>(s.zeros.size() + s.weights.size());
  }
  return n;
}

/// V of the one over that of the other, less one: the mean over all pieces.
bool alike(const NoiseModel& a, const NoiseModel& b) {
  double change = 0, n = 0;
  for (std::size_t o = 0; o < a.outputs.size(); ++o)
    for (std::size_t r = 0; r < a.outputs[o].pieces.size(); ++r)
      for (std::size_t i = 0; i < a.outputs[o].pieces[r].size(); ++i) {
        const double ratio = a.outputs[o].pieces[r][i] / b.outputs[o].pieces[r][i];
        change += std::abs(ratio * ratio - 1);
        n += 1;
      }
  return change <= settled * n;
}

/// Derivatives that another fit has found were weighed by other weights.
CandidateModel refit_afresh(FitContext context, const CandidateModel& c, Effort effort) {
  const auto derivatives = context.derivatives;
  context.derivatives = std::make_shared<DerivativeStore>();
  CandidateModel next = refit(context, c, effort);
  derivatives->count(context.derivatives->runs());
  return next;
}

}  // namespace

double squares_by(const NoiseModel& weights, const LeftSums& left) {
  double chi2 = 0;
  for (const auto& l : left) {
    const auto& rms = weights.outputs[static_cast<std::size_t>(l.output)].pieces[static_cast<std::size_t>(l.recording)];
    for (std::size_t i = 0; i < l.squares.size(); ++i) chi2 += l.squares[i] / (rms[i] * rms[i]);
  }
  return chi2;
}

namespace {

double by_levels(const BlockScore& score, const TableModel& f) {
  return f.levels ? score.fit_of(f.levels->rounded) - score.fit_of(f.levels->left) : 0;
}

double all_tried(const TableModel& f) {
  double sum = 0;
  for (const auto& [effect, ln_tried] : f.tried) sum += ln_tried;
  return sum;
}

}  // namespace

FitSetting::FitSetting(const SearchState& of, std::map<std::string, double> let_go)
    : state(of), numbers(std::move(let_go)) {
  DataSet data = *of.data;
  for (auto& r : data.recordings)
    if (r.role == Role::validate) r.role = Role::train;
  all = std::make_shared<const DataSet>(std::move(data));
  for (const auto& p : of.base_model->program().parameters)
    if (p.known_to && *p.known_to > 0) known[p.path] = *p.known_to;
}

double FitSetting::known_to(const std::string& path) const {
  const auto said = known.find(path);
  return said == known.end() ? usually_known_to : said->second;
}

FitSetting FitSetting::with(std::map<std::string, double> other_numbers) const {
  FitSetting other = *this;
  other.numbers = std::move(other_numbers);
  return other;
}

double score_of(const BlockScore& score, const TableModel& f) {
  return score.fit_of(f.left) + by_levels(score, f) - score.price(f.parameters) - all_tried(f) - 0.5 * f.moved;
}

double tie_score_of(const BlockScore& score, const TableModel& f) {
  return score.fit_of(f.left) + by_levels(score, f) - f.parameters - all_tried(f) - 0.5 * f.moved;
}

TableModel measured(const FitSetting& setting, CandidateModel model, Numbers numbers, NoiseModel weights,
                    const std::map<std::string, double>& tried) {
  TableModel f;
  f.numbers = numbers;
  f.model = std::move(model);
  f.weights = std::move(weights);
  for (const auto& s : f.model.placed)
    if (const auto known = tried.find(s.effect->id); known != tried.end()) f.tried.insert(*known);
  if (!f.model.ok) return f;
  const Evidence& evidence = *setting.state.evidence;
  f.left = left_sums(left_rows(evidence, f.model.unrounded(), f.weights));
  if (f.model.before_rounding) f.rounded = left_sums(left_rows(evidence, f.model.prediction, f.weights));
  f.parameters = numbers_of(f.model, evidence.recordings().size());
  for (const auto& e : f.model.fit.estimates)
    if (const auto n = setting.numbers.find(e.path); n != setting.numbers.end())
      f.moved += std::pow((e.used - n->second) / (setting.known_to(e.path) * n->second), 2);
  return f;
}

NoiseModel weights_of(const FitSetting& setting, const TableModel& f) {
  const Evidence& evidence = *setting.state.evidence;
  return setting.score ? setting.score->weights(evidence, f.left)
                       : BlockScore(evidence, {f.left}).weights(evidence, f.left);
}

FitContext context_for(const FitSetting& setting, const FitContext& context, const NoiseModel& weights,
                       Numbers numbers) {
  FitContext own = context;
  own.weights = weights;
  own.data = setting.all;
  // Whole models are compared by hundreds of fits: what needs more steps is too stiff for that, and integrating it
  // takes a hundred times as long.
  own.simulation_steps /= 4;
  own.bdf_otherwise = false;
  if (numbers == Numbers::written) return own;
  own.known_to = {two_sided * usually_known_to, 0.5, 2};
  for (const auto& [path, known] : setting.known) own.known_to.times[path] = known / usually_known_to;
  own.free_nominal_parameters(setting.numbers);
  return own;
}

TableModel refitted(const FitSetting& setting, const FitContext& context, const TableModel& from, Numbers numbers,
                    int renewals) {
  TableModel now = from;
  for (int i = 0; i < renewals; ++i) {
    NoiseModel weights = weights_of(setting, now);
    if (i > 0 && alike(weights, now.weights)) break;
    CandidateModel next = refit_afresh(context_for(setting, context, weights, numbers), now.model, Effort::full);
    if (!next.ok) return i > 0 ? now : TableModel{};
    now = measured(setting, std::move(next), numbers, std::move(weights), from.tried);
    now.levels = from.levels;
  }
  return now;
}

TableModel with_term(const FitSetting& setting, const FitContext& context, const TableModel& from,
                     const std::vector<Choice>& term, double ln_tried, Effort effort) {
  const NoiseModel weights = weights_of(setting, from);
  const FitContext own = context_for(setting, context, weights, Numbers::written);
  CandidateModel c = from.model;
  for (const auto& choice : term) {
    c = with_effect(own, c, *choice.effect, choice.law, choice.place, choice.at, effort);
    if (!c.ok) break;
  }
  auto tried = from.tried;
  if (!term.empty()) tried[term.front().effect->id] = ln_tried;
  TableModel f = measured(setting, std::move(c), from.numbers, weights, tried);
  if (!f.ok()) return f;
  // Levels are told from noise once, where all else is as it was: what is found later hardly moves what they round.
  f.levels = from.levels;
  if (!f.levels && f.rounded) f.levels = std::make_shared<const LevelsFound>(LevelsFound{*f.rounded, f.left});
  // A law that is off is the model without it: a search that ends above that has not found where it begins.
  if (squares_by(weights, f.left) > squares_by(weights, from.left)) f.left = from.left;
  return f;
}

TableModel without_term(const FitSetting& setting, const FitContext& context, const TableModel& from,
                        const std::vector<std::size_t>& term) {
  CandidateModel rest = from.model;
  for (auto i = term.rbegin(); i != term.rend() && rest.ok; ++i) rest = without(context, rest, *i);
  NoiseModel weights = weights_of(setting, from);
  if (rest.ok) rest = refit(context_for(setting, context, weights, Numbers::written), rest, Effort::full);
  TableModel f = measured(setting, std::move(rest), from.numbers, std::move(weights), from.tried);
  if (f.rounded) f.levels = from.levels;
  return f;
}

double sigma_by_witnesses(const ParameterEstimate& estimate) {
  return estimate.sigma ? *estimate.sigma / std::sqrt(estimate.s2) : 0;
}

namespace {

/// A number that was let go.
struct LetGo {
  std::string path;
  double off, sigma;  ///< from what is written
  int place;          ///< among those that are correlated
  bool at_bound;
};

std::vector<LetGo> all_let_go(const FitResult& fit, const std::map<std::string, double>& numbers) {
  std::vector<LetGo> all;
  for (const auto& e : fit.estimates) {
    const auto n = numbers.find(e.path);
    if (n == numbers.end()) continue;
    LetGo one{e.path, e.used - n->second, sigma_by_witnesses(e), -1, e.at_lower || e.at_upper};
    for (std::size_t k = 0; k < fit.correlated.size(); ++k)
      if (&fit.estimates[static_cast<std::size_t>(fit.correlated[k])] == &e) one.place = static_cast<int>(k);
    if (one.at_bound || (one.place >= 0 && one.sigma > 0)) all.push_back(one);
  }
  return all;
}

/// About the minimum the cost is J + d' C^-1 d; holding the numbers A at what is written, all others at their best,
/// adds d_A' (C_AA)^-1 d_A.
double cost_of_holding(const FitResult& fit, const std::vector<LetGo>& held) {
  const auto n = static_cast<Eigen::Index>(held.size());
  const auto width = fit.correlated.size();
  Eigen::MatrixXd correlation(n, n);
  Eigen::VectorXd d(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const LetGo& a = held[static_cast<std::size_t>(i)];
    d(i) = a.off / a.sigma;
    for (Eigen::Index k = 0; k < n; ++k)
      correlation(i, k) = fit.correlation[static_cast<std::size_t>(a.place) * width +
                                          static_cast<std::size_t>(held[static_cast<std::size_t>(k)].place)];
  }
  return d.dot(correlation.completeOrthogonalDecomposition().solve(d));
}

/// Of the numbers that were let go those that bring more than `worth` each; one that is held back by the widest that is
/// believed is certainly not what is written.
std::map<std::string, double> worth_it(const FitResult& fit, const std::map<std::string, double>& numbers,
                                       double worth) {
  std::map<std::string, double> kept;
  std::vector<LetGo> free = all_let_go(fit, numbers), held;
  for (const auto& one : free)
    if (one.at_bound) kept[one.path] = numbers.at(one.path);
  std::erase_if(free, [](const LetGo& one) { return one.at_bound; });
  double now = 0;
  while (!free.empty()) {
    std::size_t least = 0;
    double least_cost = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < free.size(); ++i) {
      auto with = held;
      with.push_back(free[i]);
      if (const double then = cost_of_holding(fit, with); then < least_cost) least_cost = then, least = i;
    }
    if (least_cost - now > worth) break;
    now = least_cost;
    held.push_back(free[least]);
    free.erase(free.begin() + static_cast<std::ptrdiff_t>(least));
  }
  for (const auto& one : free) kept[one.path] = numbers.at(one.path);
  return kept;
}

}  // namespace

TableModel with_fewest_numbers(const FitSetting& setting, const FitContext& context, const BlockScore& score,
                               const TableModel& let_go, std::map<std::string, double>& kept) {
  constexpr int most_rounds = 4;
  const double worth = 6 + std::log(std::max(score.n_eff(), 2.0));
  TableModel now = let_go;
  kept = setting.numbers;
  for (int round = 0; round < most_rounds && !kept.empty(); ++round) {
    const FitSetting these = setting.with(kept);
    const FitContext own = context_for(these, context, weights_of(these, now), Numbers::let_go);
    const CandidateModel c = refit_afresh(own, now.model, Effort::final);
    if (!c.ok) break;
    const auto few = worth_it(c.fit, kept, worth);
    if (few.size() == kept.size()) break;
    Trial written;
    for (const auto& [path, value] : kept)
      if (!few.contains(path)) written.push_back({parameter_index(*c.program, path), value, -1});
    TableModel start = now;
    start.model = c;
    start.model.diagram = with_parameters(c.diagram, *c.program, written);
    std::erase_if(start.model.fit.estimates,
                  [&](const ParameterEstimate& e) { return kept.contains(e.path) && !few.contains(e.path); });
    TableModel next = refitted(setting.with(few), context, start, few.empty() ? Numbers::written : Numbers::let_go);
    if (!next.ok()) break;
    kept = few;
    now = std::move(next);
  }
  return now;
}

}  // namespace hysteron
