// Decides which candidate may be claimed: chance, share of what is left, an excitation of its own (DISCOVERY 1, steps 6
// and 8).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/investigation.h"

namespace hysteron {
namespace {

/// True if the candidate takes away most of what stands above the noise in at least one train and one validate
/// recording: a real effect owns a kind of excitation, a patch nibbles everywhere.
bool owns_an_excitation(const ModelError& before, const ModelError& after) {
  bool train = false;
  bool validate = false;
  for (std::size_t i = 0; i < before.recordings.size() && i < after.recordings.size(); ++i) {
    const auto& b = before.recordings[i];
    const double rows = static_cast<double>(b.rows);
    if (b.chi2 < rules::floor_gate * rows) continue;
    if (b.chi2 - after.recordings[i].chi2 < rules::share_of_own * b.excess()) continue;
    (b.role == Role::train ? train : validate) = true;
  }
  return train && validate;
}

/// What stands above the noise on validation, of the outputs that the place moves: one axis cannot take away what
/// another one leaves. Counted by chi2, or `plain`.
double excess_of(const ModelError& error, const std::vector<std::string>& outputs, bool plain) {
  double excess = 0;
  for (const auto& r : error.recordings)
    if (r.role == Role::validate &&
        (outputs.empty() || std::find(outputs.begin(), outputs.end(), r.output) != outputs.end()))
      excess += plain ? r.plain_excess() : r.excess();
  return excess;
}

/// Share of what stands above the noise. By chi2; where that says noise, by plain squares: a wrong zero is one
/// coefficient in each recording, and what it takes away is lost among the thousands of the others.
double share_of_excess(const ModelError& was, const ModelError& is, const std::vector<std::string>& outputs) {
  const bool plain = was.over_floor() <= rules::floor_gate;
  const double excess = excess_of(was, outputs, plain);
  return excess > 0 ? (excess - excess_of(is, outputs, plain)) / excess : 0;
}

}  // namespace

std::vector<double> own_values(const Tried& tried) {
  return values_of(tried.contender, tried.contender.standing.size() - 1);
}

bool look_alike(const Effect& a, const Effect& b) {
  const auto names = [](const Effect& x, const Effect& y) {
    return std::any_of(x.look_alikes.begin(), x.look_alikes.end(),
                       [&](const LookAlike& l) { return l.effect == y.id; });
  };
  return names(a, b) || names(b, a);
}

void judge(Tried& tried, const Contender& before, double first_fall) {
  const Contender& c = tried.contender;
  tried.admitted = false;
  if (!c.ok) {
    tried.reason = "could not be fitted: " + c.error;
    return;
  }
  const ModelError& was = before.error_of;
  const ModelError& is = c.error_of;
  tried.fall_train = was.evidence_train - is.evidence_train;
  // A value found on a validate recording takes one of chi2 away there by chance, and would cost one on another.
  const int found_there = std::max(0, c.found_on_validation - before.found_on_validation);
  tried.fall_validate = was.evidence_validate - is.evidence_validate - 2 * found_there;
  const double plain = was.chi2_validate - is.chi2_validate;
  tried.share = share_of_excess(was, is, tried.outputs);
  if (!(tried.fall_validate > rules::claim_fall)) {
    tried.reason =
        fmt::format("on recordings not used for the fit it takes away {:.1f} of chi2, no more than chance ({:.0f})",
                    tried.fall_validate, rules::claim_fall);
    return;
  }
  if (!(c.score() < before.score())) {
    tried.reason = fmt::format("its {} parameters cost more than they bring", c.parameters - before.parameters);
    return;
  }
  if (tried.effect->implausible) {
    const auto values = own_values(tried);
    if (values.size() == tried.laws[tried.law].free.size())
      if (const std::string why = tried.effect->implausible(tried.laws[tried.law], values, tried.circumstances);
          !why.empty()) {
        tried.reason = why;
        return;
      }
  }
  const bool above_noise = was.over_floor() > rules::floor_gate;
  if (first_fall <= 0 && above_noise && tried.share < rules::share_of_first && !owns_an_excitation(was, is)) {
    tried.reason =
        fmt::format("a patch: it takes away {} of what stands above the noise, and most of it in no kind of recording",
                    percent(tried.share));
    return;
  }
  if (first_fall > 0) {
    // Another effect's law does not take what an imperfect law leaves down to the noise of other recordings.
    const bool to_the_noise = is.over_floor() <= rules::floor_gate;
    if (!to_the_noise && plain < rules::own_law_left * rules::own_law_left * first_fall) {
      tried.reason = "no larger than what the law of the first effect may have left of its own";
      return;
    }
    if (tried.share < rules::share_of_rest && !owns_an_excitation(was, is)) {
      tried.reason = fmt::format("a patch: it takes away {} of what is left, and most of it in no kind of recording",
                                 percent(tried.share));
      return;
    }
  }
  tried.admitted = true;
  tried.reason =
      fmt::format("takes away {:.0f} of chi2 on recordings not used for the fit, {} of what stands above the noise",
                  tried.fall_validate, percent(std::clamp(tried.share, 0.0, 1.0)));
}

}  // namespace hysteron
