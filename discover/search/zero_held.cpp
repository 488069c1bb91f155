// Decides whether the zero that a law found anew hides another effect: a wrong calibration, or what shifts the middle
// likewise. A law in front of the sensor that is neutral at rest cannot move what the sensor reads there.
#include <algorithm>
#include <cmath>
#include <optional>

#include "discover/placement/excitation.h"
#include "discover/search/members.h"
#include "discover/search/search_state.h"

namespace hysteron {
namespace {

/// Where the sensor itself, or what is beside the wire, has a constant of its own, the zero is as much that law's as
/// anybody's.
bool has_own_constant(const PlacedEffect& s) {
  return s.place.kind == "measured" || (s.effect->side != Side::none && !s.effect->own_zero);
}

/// A law that explains the recordings as well as one that stands has a constant of its own: a curve of the sensor.
bool rival_has_own_constant(const SearchState& state) {
  return std::any_of(state.d.steps.begin(), state.d.steps.end(), [&](const FoundStep& s) {
    return std::any_of(s.ties.begin(), s.ties.end(), [&](const Candidate& tie) {
      const Effect* rival = state.effects.find(tie.effect);
      return rival != nullptr && rival->moves_zero && rival->of_the_sensor();
    });
  });
}

/// How far the laws may move the zero by themselves [SI].
double own_zero(const CandidateModel& c) {
  double sum = 0;
  for (std::size_t i = 0; i < c.placed.size(); ++i) {
    const PlacedEffect& s = c.placed[i];
    if (!s.effect->own_zero) continue;
    const auto values = values_of(c, i);
    if (values.size() == s.law.free.size()) sum += s.effect->own_zero(s.law, values);
  }
  return sum;
}

/// The laws that stand, fitted with the zeros of the user's model; nullopt if none of them found one anew, or if it is
/// not the sensor's alone.
std::optional<CandidateModel> with_the_users_zeros(SearchState& state) {
  if (rival_has_own_constant(state)) return std::nullopt;
  CandidateModel c = state.current;
  std::vector<ParameterValue> zeros;
  for (auto& s : c.placed) {
    if (calibrates(s) || (!s.zeros.empty() && has_own_constant(s))) return std::nullopt;
    for (const auto& path : s.zeros) {
      const int parameter = parameter_index(*c.program, path);
      zeros.push_back({parameter, free_parameter(*state.base.program, path).start, -1});
    }
    s.zeros.clear();
  }
  if (zeros.empty()) return std::nullopt;
  c.diagram = with_parameters(c.diagram, *c.program, zeros);
  c.zero_held = true;
  c = refit(state.context, c, Effort::full);
  if (!c.ok) return std::nullopt;
  c.error_of = state.evidence->error(c.prediction);
  return c;
}

/// A calibration that stands moves no zero beyond what the other laws could move it by themselves.
bool owes_its_zero(const CandidateModel& c) {
  for (std::size_t i = 0; i < c.placed.size(); ++i) {
    if (!calibrates(c.placed[i])) continue;
    for (const auto& p : parameters_of(c, static_cast<int>(i)))
      if (p.estimate != nullptr && p.law->path == "offset") return std::abs(p.estimate->used) <= own_zero(c);
  }
  return false;
}

/// The calibration that stands where another law has a constant of its own; -1 = none.
int calibration_beside_a_constant(const CandidateModel& c) {
  int calibration = -1;
  bool constant = false;
  for (std::size_t i = 0; i < c.placed.size(); ++i) {
    if (calibrates(c.placed[i])) calibration = static_cast<int>(i);
    constant = constant || (c.placed[i].effect->moves_zero && has_own_constant(c.placed[i]));
  }
  return constant ? calibration : -1;
}

}  // namespace

int calibration_first(const std::vector<TriedEffect>& tried, int winner) {
  const TriedEffect& w = tried[static_cast<std::size_t>(winner)];
  if (!w.effect->moves_zero) return winner;
  for (const std::size_t i : ranking(tried)) {
    const TriedEffect& t = tried[i];
    if (!t.effect->straight || !t.admitted || t.outputs != w.outputs) continue;
    if (t.fall_train > rules::straight_share * w.fall_train &&
        t.fall_validate > rules::straight_share * w.fall_validate)
      return static_cast<int>(i);
  }
  return winner;
}

bool with_the_zero_held(SearchState& state, const std::function<bool()>& one_more) {
  const auto laws = with_the_users_zeros(state);
  if (!laws) return false;
  const Found found(state);
  if (tell_again(state, *laws) && one_more() && !owes_its_zero(state.current)) return true;
  found.restore(state);
  return false;
}

bool with_the_zero_of_a_curve(SearchState& state, const std::function<bool()>& one_more) {
  const int calibration = calibration_beside_a_constant(state.current);
  if (calibration < 0 || state.stopped()) return false;
  const double score = state.current.score();
  const auto rest = rest_of(state, state.context, static_cast<std::size_t>(calibration), Line::of_a_curve);
  if (!rest || !(rest->score() < score + rules::tie)) return false;
  const Found found(state);
  if (tell_again(state, *rest) && one_more() && state.current.score() < score - rules::exchange) return true;
  found.restore(state);
  return false;
}

}  // namespace hysteron
