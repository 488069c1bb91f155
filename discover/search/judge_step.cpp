// Decides which candidate may be claimed: chance, share of what is left, an excitation of its own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "discover/search/investigation.h"

namespace hysteron {
namespace {

/// Most of what stands above the noise in a recording; or half of it, where only noise is left: how large the noise of
/// one recording is nobody knows to some per cent, and of a small excess that is a large part.
bool takes_most(const RecordingError& was, const RecordingError& is) {
  const double fall = was.chi2 - is.chi2;
  const bool to_the_noise = is.chi2 <= rules::floor_gate * static_cast<double>(is.rows);
  return fall >= (to_the_noise ? rules::share_to_noise : rules::share_of_own) * was.excess();
}

/// True if the candidate takes away most of what stands above the noise in at least one train and one validate
/// recording: a real effect owns a kind of excitation, a patch nibbles everywhere.
bool owns_an_excitation(const ModelError& before, const ModelError& after) {
  bool train = false;
  bool validate = false;
  for (std::size_t i = 0; i < before.recordings.size() && i < after.recordings.size(); ++i) {
    const auto& b = before.recordings[i];
    const double rows = static_cast<double>(b.rows);
    if (b.chi2 < rules::floor_gate * rows) continue;
    if (!takes_most(b, after.recordings[i])) continue;
    (b.role == Role::train ? train : validate) = true;
  }
  return train && validate;
}

/// A recording of an output that the place moves: one axis cannot take away what another one leaves.
bool is_moved(const RecordingError& r, const std::vector<std::string>& outputs) {
  return outputs.empty() || std::find(outputs.begin(), outputs.end(), r.output) != outputs.end();
}

bool counts(const RecordingError& r, const std::vector<std::string>& outputs) {
  return r.role == Role::validate && is_moved(r, outputs);
}

/// What stands above the noise on validation, by chi2 or `plain`.
double excess_of(const ModelError& error, const std::vector<std::string>& outputs, bool plain) {
  double excess = 0;
  for (const auto& r : error.recordings)
    if (counts(r, outputs)) excess += plain ? r.plain_excess() : r.excess();
  return excess;
}

/// The same by chi2 on all recordings.
double excess_everywhere(const ModelError& error, const std::vector<std::string>& outputs) {
  double excess = 0;
  for (const auto& r : error.recordings)
    if (is_moved(r, outputs)) excess += r.excess();
  return excess;
}

/// Other recordings decide whether it is chance. Whether it is a patch all of them tell: what is large in one kind of
/// them need not be in those that judge, beside something else that is missing; of these it must take a good part.
double share_of_recordings(double on_validation, const ModelError& was, const ModelError& is,
                           const std::vector<std::string>& outputs) {
  const double excess = excess_everywhere(was, outputs);
  if (on_validation < rules::share_of_all || !(excess > 0)) return on_validation;
  return std::max(on_validation, (excess - excess_everywhere(is, outputs)) / excess);
}

/// The same by chi2, without what the laws that stand may have left in each recording.
double excess_beyond(const ModelError& error, const std::vector<std::string>& outputs,
                     const std::vector<double>& left_by_laws) {
  double excess = 0;
  for (std::size_t i = 0; i < left_by_laws.size(); ++i)
    if (const auto& r = error.recordings[i]; counts(r, outputs)) excess += std::max(0.0, r.excess() - left_by_laws[i]);
  return excess;
}

/// Fall of chi2 in recordings where it is more than the laws that stand may have left there. The fitted ones count,
/// too: whether it is chance is asked elsewhere, and what shows where the other law is at rest may show in one of them
/// alone (the first recording of a device that ages). Some of their fall is the fit's.
double fall_beyond(const ModelError& was, const ModelError& is, const std::vector<double>& left_by_laws) {
  double beyond = 0;
  for (std::size_t i = 0; i < left_by_laws.size(); ++i) {
    const double fall = was.recordings[i].chi2 - is.recordings[i].chi2;
    const double by_the_fit = was.recordings[i].role == Role::train ? rules::claim_fall : 0;
    if (fall > left_by_laws[i] + by_the_fit) beyond += fall;
  }
  return beyond;
}

/// What a law leaves of its own need not lie where it acts most, but where it ends (a creep that begins earlier than
/// its fastest relaxation): is it less in all recordings together than what was taken away? Asked where these show
/// noise, and one kind of them a rest.
bool more_in_all(const ModelError& was, const ModelError& is, const std::vector<double>& left_by_laws) {
  if (was.over_floor() > rules::floor_gate) return true;
  double left = 0;
  for (std::size_t i = 0; i < left_by_laws.size(); ++i)
    if (was.recordings[i].role == Role::validate) left += left_by_laws[i];
  return was.chi2_validate - is.chi2_validate > left;
}

/// Another effect's law does not take what an imperfect law leaves down to the noise of other recordings, but one that
/// imitates it does.
bool takes_to_the_noise(const ModelError& was, const ModelError& is) {
  return was.over_floor() > rules::floor_gate && is.over_floor() <= rules::floor_gate;
}

/// Share of what stands above the noise. By chi2; where that says noise, by plain squares too: a wrong zero is one
/// coefficient in each recording, and what it takes away is lost among the thousands of the others.
double share_of_excess(const ModelError& was, const ModelError& is, const std::vector<std::string>& outputs,
                       const std::vector<double>& left_by_laws) {
  const auto share = [&](bool plain) {
    const double excess = excess_of(was, outputs, plain);
    return excess > 0 ? (excess - excess_of(is, outputs, plain)) / excess : 0;
  };
  double by_chi2 = share(false);
  const double beyond = excess_beyond(was, outputs, left_by_laws);
  if (beyond > rules::claim_fall && by_chi2 > rules::share_of_all)
    by_chi2 = std::max(by_chi2, (beyond - excess_beyond(is, outputs, left_by_laws)) / beyond);
  return was.over_floor() > rules::floor_gate ? by_chi2 : std::max(by_chi2, share(true));
}

/// chi2/N of one output in the middle one of its recordings: noise is the same in all of them, and as far as its data
/// sheet may be wrong, that is noise.
double noise_level(const ModelError& error, const std::string& output) {
  std::vector<double> levels;
  for (const auto& r : error.recordings)
    if (r.output == output && r.rows > 0) levels.push_back(r.chi2 / static_cast<double>(r.rows));
  if (levels.empty()) return 1;
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>((levels.size() - 1) / 2);
  std::nth_element(levels.begin(), middle, levels.end());
  return std::clamp(*middle, 1.0, rules::data_sheet_wrong);
}

/// Something is left above the noise on validation that is more than chance. A patch leaves most of it.
bool leaves_more_than_noise(const ModelError& is, const std::vector<std::string>& outputs) {
  double excess = 0, rows = 0;
  for (const auto& r : is.recordings) {
    if (!counts(r, outputs)) continue;
    excess += r.chi2 - noise_level(is, r.output) * static_cast<double>(r.rows);
    rows += static_cast<double>(r.rows);
  }
  return excess > 2 * std::sqrt(2 * rows);
}

bool lists(const std::vector<std::string>& ids, const Effect& effect) {
  return std::find(ids.begin(), ids.end(), effect.id) != ids.end();
}

/// Its law can imitate one that stands (hysteresis a friction), or what that one leaves of its own. A straight line
/// leaves nothing.
bool imitates_a_standing_law(const Effect& effect, const CandidateModel& standing) {
  return std::any_of(standing.placed.begin(), standing.placed.end(), [&](const PlacedEffect& s) {
    return !calibrates(s) && (lists(effect.contains, *s.effect) || lists(s.effect->leaves, effect));
  });
}

/// Of one output: what stands above the noise, chance included, as a share of what the laws took away, in the worst of
/// the recordings in which a candidate is at rest and the laws act half as much as anywhere; nullopt where none of
/// these judges.
std::optional<double> left_at_rest(const ModelError& was, const ModelError& is, const std::vector<double>& left_by_laws,
                                   const std::string& output) {
  const auto taken_per_row = [&](std::size_t i) {
    return left_by_laws[i] / (rules::own_law_left * rules::own_law_left) / static_cast<double>(was.recordings[i].rows);
  };
  // The others are fitted with the candidate, and move a little everywhere.
  const auto moved_per_row = [&](std::size_t i) {
    return (was.recordings[i].chi2 - is.recordings[i].chi2) / static_cast<double>(was.recordings[i].rows);
  };
  double most = 0, moved_most = 0, worst = 0;
  for (std::size_t i = 0; i < left_by_laws.size(); ++i) {
    if (was.recordings[i].output != output) continue;
    most = std::max(most, taken_per_row(i));
    moved_most = std::max(moved_most, moved_per_row(i));
  }
  bool judged = false;
  for (std::size_t i = 0; i < left_by_laws.size(); ++i) {
    const RecordingError& r = was.recordings[i];
    const bool at_rest = std::abs(moved_per_row(i)) < rules::at_rest * moved_most;
    if (r.output != output || !at_rest || !(taken_per_row(i) > 0.5 * most)) continue;
    const double rows = static_cast<double>(r.rows);
    worst = std::max(worst, (std::max(0.0, r.excess() / rows) + 2 * std::sqrt(2 / rows)) / taken_per_row(i));
    judged = judged || r.role == Role::validate;
  }
  return judged ? std::optional(worst) : std::nullopt;
}

/// A candidate that is at rest in some recordings leaves them to the laws that stand: these show how well they know
/// their own effects, and need not have left more elsewhere.
std::vector<double> as_seen_at_rest(const ModelError& was, const ModelError& is, std::vector<double> left_by_laws) {
  const auto all = left_by_laws;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const auto seen = left_at_rest(was, is, all, was.recordings[i].output))
      left_by_laws[i] *= std::min(1.0, *seen / (rules::own_law_left * rules::own_law_left));
  return left_by_laws;
}

/// What the laws that stand may have left, as much more as one has to take away that looks like that.
std::vector<double> left_for(const Effect& effect, const CandidateModel& standing, std::vector<double> left_by_laws) {
  if (imitates_a_standing_law(effect, standing))
    for (double& chi2 : left_by_laws) chi2 *= std::pow(rules::imitated_left / rules::own_law_left, 2);
  return left_by_laws;
}

/// What speaks for the newest law. Rows too coarse for a line show it at another frequency, where it may be
/// anything that is slow: what it takes away there proves nothing, nor what the others take away elsewhere since then.
/// A line proves itself where it is seen, by what is left there without it.
ModelError proved(const ModelError& was, const TriedEffect& tried) {
  ModelError is = tried.candidate.error_of;
  if (!tried.without_line) return is;
  const ModelError& without = *tried.without_line;
  const double line = line_of(tried.candidate);
  for (std::size_t i = 0; i < is.recordings.size() && without.ok; ++i) {
    RecordingError& r = is.recordings[i];
    const auto& before = was.recordings[i];
    const bool seen = resolves(r.step, line);
    const double chi2 = before.chi2 - (seen ? without.recordings[i].chi2 - r.chi2 : 0);
    const double of_evidence = before.evidence - (seen ? without.recordings[i].evidence - r.evidence : 0);
    const bool is_train = r.role == Role::train;
    (is_train ? is.chi2_train : is.chi2_validate) += chi2 - r.chi2;
    (is_train ? is.evidence_train : is.evidence_validate) += of_evidence - r.evidence;
    r.chi2 = chi2;
    r.evidence = of_evidence;
  }
  return is;
}

/// Values of the newest law that were found on validate recordings which can speak for it.
int found_where_proved(const CandidateModel& c, const CandidateModel& before) {
  const int found = std::max(0, c.found_on_validation - before.found_on_validation);
  const auto judging = [](const RecordingError& r) { return r.role == Role::validate; };
  const double line = line_of(c);
  const auto& list = c.error_of.recordings;
  const auto all = std::count_if(list.begin(), list.end(), judging);
  const auto some = std::count_if(list.begin(), list.end(),
                                  [&](const RecordingError& r) { return judging(r) && resolves(r.step, line); });
  return all > 0 ? static_cast<int>(found * some / all) : 0;
}

/// Where nothing stands that could have left it, and nothing was found on recordings that judge: chance takes less of
/// all recordings away with as many numbers (chi2 of as many degrees of freedom). ln N for each is the price where they
/// are known as well as N rows know a number: of a weak slow effect they know few.
bool beyond_chance(const TriedEffect& tried, const CandidateModel& before, bool first, double beginnings) {
  const int numbers = tried.candidate.parameters - before.parameters;
  return first && tried.candidate.found_on_validation == before.found_on_validation &&
         tried.fall_train + tried.fall_validate > rules::by_chance(numbers, beginnings);
}

/// A recording that hardly shows an effect can agree with the others, and not prove it: what they prove counts, less
/// the price of every number that was fitted, and of every beginning that was tried.
bool all_agree(const TriedEffect& tried, const CandidateModel& before) {
  return tried.fall_validate > rules::agreed_fall &&
         (before.score() - tried.candidate.score() > rules::claim_fall ||
          beyond_chance(tried, before, true, beginnings_of(tried.laws[tried.law])));
}

/// It is worth its numbers. Beginnings were compared on fitted recordings: where others prove it, they are paid for.
bool is_worth_its_numbers(const TriedEffect& tried, const CandidateModel& before, bool first) {
  const bool proved = tried.fall_validate > rules::claim_fall;
  return tried.candidate.score() < before.score() ||
         beyond_chance(tried, before, first, proved ? 1 : beginnings_of(tried.laws[tried.law]));
}

}  // namespace

double beginnings_of(const Law& law) {
  double all = 1;
  for (const auto& p : law.free) all *= std::max(1.0, static_cast<double>(p.scan.size()));
  return all;
}

std::vector<double> own_values(const TriedEffect& tried) {
  return values_of(tried.candidate, tried.candidate.placed.size() - 1);
}

std::string what_it_takes(const TriedEffect& tried) {
  return fmt::format(
      "explains {} of the error above the noise on recordings not used for the fit (chi2 falls by {:.0f})",
      percent(std::clamp(tried.share, 0.0, 1.0)), tried.fall_validate);
}

std::string why_implausible(const Effect& effect, const Law& law, const CandidateModel& fitted, const Excitation& at) {
  if (!effect.implausible) return "";
  const auto values = values_of(fitted, fitted.placed.size() - 1);
  return !values.empty() && values.size() == law.free.size() ? effect.implausible(law, values, at) : "";
}

bool more_than_laws_leave(const Effect& effect, const CandidateModel& before, const ModelError& after,
                          const std::vector<double>& left_by_laws) {
  if (left_by_laws.empty()) return true;
  const bool imitates = imitates_a_standing_law(effect, before);
  if (!imitates && takes_to_the_noise(before.error_of, after)) return true;
  const auto left = left_for(effect, before, as_seen_at_rest(before.error_of, after, left_by_laws));
  return fall_beyond(before.error_of, after, left) >= rules::claim_fall &&
         (!imitates || more_in_all(before.error_of, after, left));
}

bool more_than_a_line(const Effect& effect, const CandidateModel& straight, const ModelError& after,
                      const std::vector<double>& left_by_laws) {
  return straight.error_of.evidence() - after.evidence() > rules::claim_fall &&
         more_than_laws_leave(effect, straight, after, left_by_laws);
}

bool look_alike(const Effect& a, const Effect& b) {
  const auto names = [](const Effect& x, const Effect& y) {
    return std::any_of(x.look_alikes.begin(), x.look_alikes.end(),
                       [&](const LookAlike& l) { return l.effect == y.id; });
  };
  return names(a, b) || names(b, a);
}

std::vector<double> fall_by_recording(const ModelError& before, const ModelError& after) {
  std::vector<double> falls;
  for (std::size_t i = 0; i < before.recordings.size() && i < after.recordings.size(); ++i)
    falls.push_back(before.recordings[i].evidence - after.recordings[i].evidence);
  return falls;
}

void judge(const Evidence& evidence, TriedEffect& tried, const CandidateModel& before,
           const std::vector<double>& left_by_laws) {
  tried.without_line.reset();
  if (tried.candidate.without_line) tried.without_line = evidence.error(*tried.candidate.without_line);
  judge(tried, before, left_by_laws);
}

void judge(TriedEffect& tried, const CandidateModel& before, const std::vector<double>& left_by_laws) {
  const CandidateModel& c = tried.candidate;
  tried.admitted = tried.patch = false;
  if (!c.ok) {
    tried.reason = "could not be fitted: " + c.error;
    return;
  }
  const ModelError& was = before.error_of;
  const ModelError is = proved(was, tried);
  tried.fall_by_recording = fall_by_recording(was, c.error_of);
  tried.fall_train = was.evidence_train - is.evidence_train;
  // A value found on a validate recording takes one of chi2 away there by chance, and would cost one on another.
  tried.fall_validate = was.evidence_validate - is.evidence_validate - 2 * found_where_proved(c, before);
  tried.share = share_of_recordings(
      share_of_excess(was, is, tried.outputs, left_for(*tried.effect, before, as_seen_at_rest(was, is, left_by_laws))),
      was, is, tried.outputs);
  const bool above_noise = was.over_floor() > rules::floor_gate;
  if (!(tried.fall_validate > rules::claim_fall) &&
      (above_noise || !left_by_laws.empty() || !all_agree(tried, before))) {
    tried.reason =
        tried.fall_validate < -rules::claim_fall
            ? fmt::format(
                  "on recordings not used for the fit it adds {:.0f} to chi2: what it says of those that were "
                  "fitted does not hold there",
                  -tried.fall_validate)
            : fmt::format("on recordings not used for the fit chi2 falls by {:.1f}, no more than by chance ({:.0f})",
                          tried.fall_validate, rules::claim_fall);
    return;
  }
  // Its values were found on the fitted recordings: a law that these hardly need says of others what they have by
  // chance, or by what the laws that stand do there.
  const bool found_elsewhere = c.found_on_validation > before.found_on_validation;  // a line: in each recording anew
  if (!left_by_laws.empty() && !found_elsewhere && !(tried.fall_train > rules::claim_fall)) {
    tried.reason = fmt::format(
        "on the recordings that were fitted chi2 falls by {:.1f}, no more than by chance ({:.0f}): what it does in others "
        "was not found there",
        tried.fall_train, rules::claim_fall);
    return;
  }
  if (!is_worth_its_numbers(tried, before, left_by_laws.empty())) {
    tried.reason = fmt::format("its {} parameters cost more than they bring", c.parameters - before.parameters);
    return;
  }
  if (const std::string why = why_implausible(*tried.effect, tried.laws[tried.law], c, tried.excitation);
      !why.empty()) {
    tried.reason = why;
    return;
  }
  // Where only noise is left behind it, it need not take more than a structure would have to.
  const double enough = takes_to_the_noise(was, is) ? rules::structure_share : rules::share_of_first;
  if (left_by_laws.empty() && above_noise && tried.share < enough && !owns_an_excitation(was, is) &&
      leaves_more_than_noise(is, tried.outputs)) {
    tried.patch = true;
    tried.reason = fmt::format(
        "not specific: it explains only {} of the error above the noise, and is the main cause in no kind of recording",
        percent(tried.share));
    return;
  }
  if (!left_by_laws.empty()) {
    if (!more_than_laws_leave(*tried.effect, before, is, left_by_laws)) {
      tried.reason = "no larger than what the laws that were found may have left of their own";
      return;
    }
    // Where nobody states the noise, what is left need not be anything that the list can name: a part of it that a
    // structure would be told for is enough.
    const double of_rest = was.noise_known ? rules::share_of_rest : rules::structure_share;
    if (tried.share < of_rest && !owns_an_excitation(was, is)) {
      tried.patch = true;
      tried.reason = fmt::format(
          "not specific: it explains only {} of what is left, and is the main cause in no kind of recording",
          percent(tried.share));
      return;
    }
  }
  tried.admitted = true;
  tried.reason = what_it_takes(tried);
}

}  // namespace hysteron
