// Decides the order of a discovery: base fit, every admissible candidate alone, richer laws, claim, further effects
// with guards, exchange of look-alikes, ties and the experiment that would break them, generic structures as
// competitors, verdict. Does not decide what counts as chance (judge_step.cpp) nor how anything is told (words.cpp).
#include "discover/discover.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "discover/circumstances.h"
#include "discover/investigation.h"
#include "discover/residual_parts.h"
#include "discover/structures.h"
#include "discover/visible.h"
#include "discover/wiring.h"
#include "engine/error.h"

namespace hysteron {
namespace {

class Investigation {
 public:
  Investigation(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                const DiscoverOptions& options)
      : registry_(registry),
        effects_(effects),
        options_(options),
        data_(std::make_shared<const DataSet>(data)),
        user_(diagram) {
    shop_.registry = &registry_;
    shop_.data = data_;
    shop_.free_paths = options.free_paths;
    shop_.stop = options.stop;
    shop_.looser = options.looser;
  }

  Discovery run() {
    base();
    double first_fall = 0;
    for (int step = 1; step <= options_.max_steps && !stopped(); ++step) {
      if (step > 1 && evidence_->over_usual_floor(current_.prediction) <= rules::floor_gate) break;
      const ModelError before = current_.error_of;
      if (!one_step(step, first_fall)) break;
      if (step == 1) first_fall = before.chi2_validate - current_.error_of.chi2_validate;
    }
    finish();
    return std::move(d_);
  }

 private:
  bool stopped() const { return options_.stop && options_.stop(); }
  void progress(const std::string& what, double done) const {
    if (options_.progress) options_.progress(what, std::min(done, 1.0));
  }
  bool wanted(const Effect& e) const {
    return options_.only.empty() || std::find(options_.only.begin(), options_.only.end(), e.id) != options_.only.end();
  }

  // --- the user's own model
  // -------------------------------------------------------------------------------------------

  void base() {
    progress("the model as it is", 0);
    for (const auto& id : options_.only) effects_.get(id);
    base_model_ = std::make_unique<DataModel>(compile(user_, registry_), data_);
    if (base_model_->recordings(Role::train).empty() || base_model_->recordings(Role::validate).empty())
      fail("no_validation", data_->file.empty() ? "recordings" : data_->file,
           "discovery fits on train recordings and judges on validate recordings; one of the two is missing",
           "give at least one recording the role \"train\" and one the role \"validate\", or name a single CSV: it is "
           "cut in time");
    evidence_ = std::make_unique<Evidence>(*base_model_);
    shop_.evidence = evidence_.get();
    shop_.row_tolerance = row_tolerance(*base_model_, evidence_->noise(), options_.looser * rules::of_noise);
    const Prediction as_given = base_model_->predict({}, evidence_->recordings());
    current_ = base_contender(shop_, user_, Effort::final);
    if (!current_.ok)
      fail_numerics("base_failed", user_.title,
                    "the diagram cannot be simulated on these recordings: " + current_.error,
                    "run `hysteron compare` or `hysteron run` on it and look at the first recording");
    d_.model_runs += current_.runs;
    settle(current_);
    base_ = current_;
    if (as_given.ok) d_.as_given = evidence_->error(as_given);
    d_.base = current_.error_of;
    d_.base_parameters = found_parameters(current_, {});
    d_.base_diagram = current_.diagram;
    d_.data_remarks = data_->remarks;
    for (const auto& r : base_model_->remarks()) d_.data_remarks.push_back(r);
    tell_between_samples();
  }

  /// How an input moves between its samples is the user's word. Where the other way fits better the recordings are
  /// asked to speak: it is half a sample of delay, which would be sold as an effect.
  void tell_between_samples() {
    for (const auto& input : base_model_->program().input_names) {
      if (stopped()) return;
      const auto note = data_->notes.find(input);
      if (note == data_->notes.end()) continue;
      DataSet other = *data_;
      auto& between = other.notes[input].between;
      between = between == Between::hold ? Between::linear : Between::hold;
      Workshop shop = shop_;
      shop.data = std::make_shared<const DataSet>(std::move(other));
      const Contender c = base_contender(shop, user_, Effort::full);
      d_.model_runs += c.runs;
      if (!c.ok) continue;
      const ModelError& was = base_.error_of;
      const bool better = was.evidence_train - c.error_of.evidence_train > rules::claim_fall &&
                          was.evidence_validate - c.error_of.evidence_validate > rules::claim_fall &&
                          c.error_of.excess_validate() < (1 - rules::structure_share) * was.excess_validate();
      if (!better) continue;
      const bool held = note->second.between == Between::hold;
      d_.warnings.push_back(fmt::format(
          "{} {}, not as the data set says: the error of the model as it is would be {:.3g} % instead of {:.3g} %. A "
          "dead time of half a sample looks the same.",
          input, held ? "moves linearly between its samples" : "is held between its samples",
          100 * c.error_of.nrmse_validate, 100 * was.nrmse_validate));
    }
  }

  /// Noise from the residual of `best`; whoever is compared afterwards is compared in its units.
  void settle(Contender& best) {
    evidence_->settle(best.prediction);
    best.error_of = evidence_->error(best.prediction);
  }

  // --- one step
  // -------------------------------------------------------------------------------------------------------

  bool one_step(int step, double first_fall) {
    auto tried = candidates(step);
    const double share_of_bar = 1.0 / options_.max_steps;
    const auto bar = [&](double part) { return (step - 1 + part) * share_of_bar; };
    for (std::size_t i = 0; i < tried.size() && !stopped(); ++i) {
      Tried& t = tried[i];
      progress(fmt::format("step {}: {} at {}", step, t.effect->id, t.place.at),
               bar(0.6 * static_cast<double>(i) / static_cast<double>(tried.size())));
      t.contender = with_effect(shop_, current_, *t.effect, t.laws.front(), t.place, t.circumstances,
                                step == 1 || taken_up(*t.effect) ? Effort::full : Effort::screen);
      d_.model_runs += t.contender.runs;
    }
    join_twins(tried);
    compare_all(tried, first_fall);
    if (step > 1) refit_best(tried, first_fall, bar(0.7));
    enrich(tried, step, first_fall, bar(0.8));
    int winner = best_admitted(tried);
    if (winner >= 0) {
      sharpen_rivals(tried, static_cast<std::size_t>(winner));
      winner = best_admitted(tried);
    }
    std::vector<int> ties;
    if (winner >= 0) try_hidden(tried, *tried[static_cast<std::size_t>(winner)].effect, first_fall);
    if (winner >= 0) ties = ties_of(tried, static_cast<std::size_t>(winner));
    if (winner >= 0) claim(step, tried, static_cast<std::size_t>(winner), ties, bar(0.9));
    for (std::size_t i = 0; i < tried.size(); ++i) {
      Candidate c = candidate_of(tried[i], step);
      c.claimed = static_cast<int>(i) == winner;
      if (std::find(ties.begin(), ties.end(), static_cast<int>(i)) != ties.end())
        c.reason = "explains the recordings as well as the one that was taken: " + c.reason;
      else if (tried[i].admitted && !c.claimed)
        c.reason = "less than the one that was taken: " + c.reason;
      d_.candidates.push_back(std::move(c));
    }
    return winner >= 0;
  }

  /// An effect that can be taken for one that stands: what there is of it, that one has taken up in its own values, and
  /// with these held it would not be seen.
  bool taken_up(const Effect& effect) const {
    return std::any_of(current_.standing.begin(), current_.standing.end(),
                       [&](const Standing& s) { return look_alike(*s.effect, effect); });
  }

  /// Every effect at every place where it may enter and could be seen; places that its law cannot tell apart once.
  std::vector<Tried> candidates(int step) {
    hidden_.clear();
    std::vector<Tried> list;
    std::vector<Place> places;
    for (const auto& e : effects_.list()) {
      if (!wanted(e)) continue;
      auto where = places_of(e, current_.diagram, registry_, data_.get());
      std::erase_if(where, [&](const Place& p) { return standing_before(e, p); });
      if (where.empty() && standing(e)) continue;
      if (where.empty() && step == 1) d_.refused.push_back({e.id, "", why_no_place(e)});
      for (const auto& p : where) {
        Tried t;
        t.effect = &e;
        t.place = p;
        list.push_back(std::move(t));
        places.push_back(p);
      }
    }
    if (list.empty()) return list;
    const auto seen = circumstances_at(current_.diagram, registry_, *data_, places, options_.free_paths);
    std::vector<Tried> kept;
    for (std::size_t i = 0; i < list.size(); ++i) {
      Tried& t = list[i];
      t.circumstances = seen[i];
      if (const std::string why = t.effect->unseen(t.circumstances); !why.empty()) {
        if (step == 1) d_.refused.push_back({t.effect->id, t.place.at, why});
        if (t.effect->may_hide && t.effect->may_hide(t.circumstances)) hidden_.push_back(std::move(t));
        continue;
      }
      t.laws = t.effect->laws(t.circumstances);
      if (t.laws.empty() || t.laws.front().free.empty()) continue;
      if (Tried* same = same_finding(kept, t)) {
        if (same->effect != t.effect) same->same_effects.push_back(t.effect->id);
        same->same_places.push_back(t.place.at);
        // A delay is best put where the signal is smooth: behind the plant, not on a drive with corners between rows;
        // it is fitted at both ends all the same, for what lies between may be rougher than the drive.
        if (same->effect == t.effect && t.effect->commutes == Commutes::time_invariant) {
          t.twin = static_cast<int>(same - kept.data());
          kept.push_back(std::move(t));
        }
        continue;
      }
      kept.push_back(std::move(t));
    }
    for (auto* list_of : {&kept, &hidden_})
      for (auto& t : *list_of) {
        for (const int o : moved_by(t.place.wire))
          t.outputs.push_back(base_model_->program().output_names[static_cast<std::size_t>(o)]);
        begin_at_lines(t);
      }
    return kept;
  }

  /// A frequency is sought in what the present model leaves: a fit from anywhere else sees the next side lobe only.
  void begin_at_lines(Tried& t) const {
    std::map<std::vector<std::pair<double, double>>, std::vector<double>> lines;  // by their bands
    for (auto& law : t.laws)
      for (auto& p : law.free) {
        if (p.line_bands.empty()) continue;
        const auto [found, is_new] = lines.try_emplace(p.line_bands);
        if (is_new) found->second = lines_left(t, p.line_bands);
        if (!found->second.empty()) p.scan = found->second;
      }
  }

  /// The two strongest lines of each output that the place moves [Hz].
  std::vector<double> lines_left(const Tried& t, const std::vector<std::pair<double, double>>& bands) const {
    std::vector<double> lines;
    for (std::size_t o = 0; o < base_model_->outputs().size(); ++o) {
      const auto& name = base_model_->outputs()[o];
      if (!t.outputs.empty() && std::find(t.outputs.begin(), t.outputs.end(), name) == t.outputs.end()) continue;
      const ResidualParts parts(*evidence_, current_.prediction, static_cast<int>(o));
      for (const double f : strongest_lines(parts, bands, 2)) lines.push_back(f);
    }
    return lines;
  }

  bool standing(const Effect& e) const {
    if (e.side == Side::other_axis) return false;  // each axis has its own; a wire that has it is left out by places_of
    return std::any_of(current_.standing.begin(), current_.standing.end(),
                       [&](const Standing& s) { return s.effect->family == e.family; });
  }

  /// The effect stands already on the way to an output that this place moves: each axis has its own.
  bool standing_before(const Effect& e, const Place& place) const {
    if (e.side == Side::other_axis) return false;
    const auto here = moved_by(place.wire);
    return std::any_of(current_.standing.begin(), current_.standing.end(), [&](const Standing& s) {
      if (s.effect->family != e.family) return false;
      const auto there = moved_by(s.place.wire);
      return there.empty() || here.empty() || std::any_of(here.begin(), here.end(), [&](int o) {
               return std::find(there.begin(), there.end(), o) != there.end();
             });
    });
  }

  /// Outputs that a wire moves, as indices of the program's outputs.
  std::vector<int> moved_by(const std::string& written) const {
    const Program& p = *current_.program;
    const std::string wire = program_signal(current_.diagram, *shop_.registry, written);
    int signal = p.find_signal(wire);
    if (signal < 0) signal = p.find_signal(wire + "[0]");
    std::vector<int> list;
    if (signal < 0) return list;
    const int from = p.signals[static_cast<std::size_t>(signal)].block;
    const auto below = p.downstream_of(from);
    for (std::size_t o = 0; o < p.output_signals.size(); ++o) {
      const int block = p.signals[static_cast<std::size_t>(p.output_signals[o])].block;
      if (block == from || below[static_cast<std::size_t>(block)]) list.push_back(static_cast<int>(o));
    }
    return list;
  }

  /// Of twins the one behind stays, unless the other is better by more than the rows are accurate; it names both
  /// places.
  static void join_twins(std::vector<Tried>& tried) {
    for (std::size_t i = 0; i < tried.size(); ++i) {
      if (tried[i].twin < 0) continue;
      Tried& first = tried[static_cast<std::size_t>(tried[i].twin)];
      Tried& second = tried[i];
      std::erase(first.same_places, second.place.at);
      if (second.contender.ok &&
          (!first.contender.ok || second.contender.score() < first.contender.score() + blur(first.contender))) {
        first.same_places.push_back(first.place.at);
        std::swap(first.place, second.place);
        std::swap(first.circumstances, second.circumstances);
        std::swap(first.laws, second.laws);
        std::swap(first.contender, second.contender);
      } else {
        first.same_places.push_back(second.place.at);
      }
    }
    std::erase_if(tried, [](const Tried& t) { return t.twin >= 0; });
  }

  /// What rows that are off by a part of the noise can add to chi2 or take from it: their square, and their product
  /// with the noise.
  static double blur(const Contender& c) {
    const double n = c.error_of.n();
    return rules::of_noise * (rules::of_noise * n + 2 * std::sqrt(n));
  }

  static Tried* same_finding(std::vector<Tried>& kept, const Tried& t) {
    if (t.effect->commutes == Commutes::nothing) return nullptr;
    for (auto& k : kept)
      if (k.twin < 0 && k.effect->family == t.effect->family && k.effect->commutes == t.effect->commutes &&
          !k.place.group_for(*k.effect).empty() && k.place.group_for(*k.effect) == t.place.group_for(*t.effect))
        return &k;
    return nullptr;
  }

  /// Noise by the best of them, then everybody's error in its units, then the rules.
  void compare_all(std::vector<Tried>& tried, double first_fall) {
    Tried* best = nullptr;
    for (auto& t : tried)
      if (t.contender.ok && (best == nullptr || t.contender.error_of.evidence() < best->contender.error_of.evidence()))
        best = &t;
    if (best != nullptr && best->contender.error_of.evidence() < current_.error_of.evidence())
      settle(best->contender);
    else
      settle(current_);
    current_.error_of = evidence_->error(current_.prediction);
    for (auto& t : tried) {
      if (t.contender.ok) t.contender.error_of = evidence_->error(t.contender.prediction);
      judge(t, current_, first_fall);
    }
    leave_to_calibration(tried);
  }

  /// A law that has a zero of its own found anew, and is neutral otherwise, is a calibration by another name.
  static void leave_to_calibration(std::vector<Tried>& tried) {
    for (const auto& plain : tried) {
      if (plain.effect->id != "calibration" || !plain.admitted) continue;
      for (auto& t : tried) {
        if (!t.admitted || !t.effect->moves_zero) continue;
        if (plain.contender.error_of.evidence() - t.contender.error_of.evidence() > rules::claim_fall) continue;
        t.admitted = false;
        t.reason = "a gain and a zero alone take away as much";
      }
    }
  }

  /// Indices of candidates that could be fitted, best score first.
  std::vector<std::size_t> ranking(const std::vector<Tried>& tried) const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < tried.size(); ++i)
      if (tried[i].contender.ok) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return tried[a].contender.score() < tried[b].contender.score();
    });
    return order;
  }

  /// Further effects were screened with the earlier ones held: the best few are fitted together with them.
  void refit_best(std::vector<Tried>& tried, double first_fall, double bar) {
    auto order = ranking(tried);
    std::vector<std::size_t> screened_out;
    for (std::size_t k = 0; k < order.size() && !stopped(); ++k) {
      Tried& t = tried[order[k]];
      if (k >= 4 || !within_reach(t, first_fall)) {
        screened_out.push_back(order[k]);
        continue;
      }
      progress("together with what was found: " + t.effect->id, bar);
      Contender better = refit(shop_, t.contender, Effort::full);
      d_.model_runs += better.runs;
      if (better.ok) t.contender = std::move(better);
    }
    compare_all(tried, first_fall);
    for (const std::size_t i : screened_out) tried[i].admitted = false;
  }

  /// What was fitted with the earlier effects held takes away less than together with them, but not by orders of
  /// magnitude: what stays far below the least fall of a claim needs no fit of everything.
  bool within_reach(const Tried& t, double first_fall) const {
    const double own =
        std::min(rules::own_law_left * rules::own_law_left * first_fall, current_.error_of.excess_validate());
    const double fall = current_.error_of.chi2_validate - t.contender.error_of.chi2_validate;
    return fall > rules::screened_part * std::max(rules::claim_fall, own);
  }

  /// A right effect with too simple a law invites wrong ones: richer laws of the best names come first. On top of an
  /// effect that was found they are screened with that one held, and fitted together only where that brings something.
  void enrich(std::vector<Tried>& tried, int step, double first_fall, double bar) {
    const auto order = ranking(tried);
    if (order.empty()) return;
    const bool far = step == 1 && tried[order.front()].contender.error_of.over_floor() > 3;
    bool any = false;
    for (std::size_t k = 0; k < order.size() && !stopped(); ++k) {
      if (!far && k >= static_cast<std::size_t>(rules::enriched)) break;
      Tried& t = tried[order[k]];
      if (!(t.fall_validate > 0)) continue;  // a law that brings nothing in its simple form has nothing to enrich
      if (step > 1 && !within_reach(t, first_fall)) continue;
      for (std::size_t law = 1; law < t.laws.size(); ++law) {
        progress(fmt::format("{}: {}", t.effect->id, t.laws[law].name), bar);
        Contender richer = with_effect(shop_, current_, *t.effect, started_from(t, law), t.place, t.circumstances,
                                       step == 1 ? Effort::full : Effort::screen);
        d_.model_runs += richer.runs;
        if (step > 1 && richer.ok && richer.score() < t.contender.score()) {
          Contender together = refit(shop_, richer, Effort::full);
          d_.model_runs += together.runs;
          if (together.ok) richer = std::move(together);
        }
        if (!richer.ok || !(richer.score() < t.contender.score())) continue;
        t.contender = std::move(richer);
        t.law = law;
        any = true;
      }
    }
    if (any) compare_all(tried, first_fall);
  }

  /// The richer law starts where the simple one ended, for parameters of the same name.
  static Law started_from(const Tried& t, std::size_t law) {
    Law richer = t.laws[law];
    for (const auto& p : parameters_of(t.contender, static_cast<int>(t.contender.standing.size()) - 1)) {
      if (p.estimate == nullptr || p.estimate->linear) continue;
      for (auto& q : richer.free)
        if (q.path == p.law->path) {
          q.start = p.estimate->used;
          q.scan = {p.estimate->used, p.estimate->used / 2};
        }
    }
    return richer;
  }

  /// What these recordings cannot show may have acted in all of them alike. Where the winner looks like it, it is a
  /// rival: that it was refused says nothing against it.
  void try_hidden(std::vector<Tried>& tried, const Effect& winner, double first_fall) {
    for (auto& t : hidden_) {
      if (!look_alike(*t.effect, winner) || stopped()) continue;
      t.laws = t.effect->laws(t.circumstances);
      if (t.laws.empty() || same_finding(tried, t) != nullptr) continue;
      t.contender = with_effect(shop_, current_, *t.effect, t.laws.front(), t.place, t.circumstances, Effort::full);
      d_.model_runs += t.contender.runs;
      if (t.contender.ok) t.contender.error_of = evidence_->error(t.contender.prediction);
      judge(t, current_, first_fall);
      t.hidden = true;
      tried.push_back(std::move(t));
    }
    hidden_.clear();
  }

  int best_admitted(const std::vector<Tried>& tried) const {
    for (const std::size_t i : ranking(tried))
      if (tried[i].admitted) return static_cast<int>(i);
    return -1;
  }

  // --- ties
  // -----------------------------------------------------------------------------------------------------------

  /// With few recordings a spare gain tells look-alikes apart that are none: each gets one, and an offset, before the
  /// comparison.
  double tie_score(const Tried& t, bool few) {
    if (!few || t.effect->id == "calibration") return t.contender.tie_score();
    const Effect* calibration = effects_.find("calibration");
    if (calibration == nullptr) return t.contender.tie_score();
    const auto places = places_of(*calibration, t.contender.diagram, registry_);
    if (places.empty()) return t.contender.tie_score();
    const auto at = circumstances_at(t.contender.diagram, registry_, *data_, places.front(), options_.free_paths);
    if (!calibration->unseen(at).empty()) return t.contender.tie_score();
    const Contender free =
        with_effect(shop_, t.contender, *calibration, calibration->laws(at).front(), places.front(), at, Effort::full);
    d_.model_runs += free.runs;
    return free.ok ? std::min(free.tie_score(), t.contender.tie_score()) : t.contender.tie_score();
  }

  std::vector<int> ties_of(const std::vector<Tried>& tried, std::size_t winner) {
    const bool few = static_cast<int>(evidence_->recordings().size()) <= rules::few_recordings;
    const Tried& w = tried[winner];
    std::vector<int> ties;
    double own = w.contender.tie_score();
    bool freed = false;
    for (const std::size_t i : ranking(tried)) {
      const Tried& t = tried[i];
      if (i == winner || t.effect->id == w.effect->id || !t.admitted) continue;
      if (std::find(t.effect->contains.begin(), t.effect->contains.end(), w.effect->id) != t.effect->contains.end())
        continue;
      bool tied = t.contender.tie_score() - w.contender.tie_score() < rules::tie;
      if (!tied && few && look_alike(*t.effect, *w.effect)) {
        if (!freed) own = tie_score(w, true);
        freed = true;
        tied = tie_score(t, true) - own < rules::tie;
      }
      // Where structure is left, neither law is right, and a difference counts only if it is there wherever one looks.
      if (!tied && w.contender.error_of.over_floor() > rules::floor_gate && look_alike(*t.effect, *w.effect))
        tied = std::abs(vuong(evidence_->pieces(t.contender.prediction), evidence_->pieces(w.contender.prediction))) <
               rules::pieces_tell;
      if (tied) ties.push_back(static_cast<int>(i));
    }
    return ties;
  }

  /// Look-alikes that the accuracy of the search cannot tell apart are fitted again with finer rows.
  void sharpen_rivals(std::vector<Tried>& tried, std::size_t winner) {
    Tried& w = tried[winner];
    const double reach = rules::tie + blur(w.contender);
    const double best = w.contender.tie_score();
    bool sharp = false;
    for (auto& t : tried) {
      if (&t == &w || !t.admitted || t.effect->id == w.effect->id || !look_alike(*t.effect, *w.effect)) continue;
      const double gap = t.contender.tie_score() - best;
      if (gap < rules::tie || gap > reach) continue;
      if (!sharp) sharpen(w);
      sharp = true;
      sharpen(t);
    }
  }

  void sharpen(Tried& t) {
    Contender finer = refit(shop_, t.contender, Effort::final);
    d_.model_runs += finer.runs;
    if (!finer.ok) return;
    finer.error_of = evidence_->error(finer.prediction);
    t.contender = std::move(finer);
  }

  static bool is_of_sensor(const Effect& e) {
    return e.places == std::vector<std::string>{"measured"} && e.id != "calibration";
  }

  /// Compiled anew: fitted values stand in the diagram. `motion`: without the last effect where it is the sensor's.
  ProgramPointer rival(const Tried& t, bool motion) const {
    const Contender& c = t.contender;
    return compile(motion && is_of_sensor(*t.effect) ? remove_effect(c.diagram, c.standing.back().name) : c.diagram,
                   registry_);
  }

  std::optional<Experiment> experiment_between(const Tried& a, const Tried& b) {
    Rivals rivals{rival(a, false), rival(b, false), {}, {}, {}, {}};
    for (const auto* t : {&a, &b}) {
      if (!t->place.side.empty()) rivals.sides.push_back({t->place.side, t->effect->side});
      for (const auto& l : t->effect->look_alikes)
        if (l.effect == (t == &a ? b : a).effect->id) rivals.preferred.push_back(l.experiment);
    }
    if (is_of_sensor(*a.effect) != is_of_sensor(*b.effect)) {
      rivals.motion_a = rival(a, true);
      rivals.motion_b = rival(b, true);
    }
    std::vector<bool> free_zero;
    for (int o = 0; o < static_cast<int>(base_model_->outputs().size()); ++o)
      free_zero.push_back(base_model_->zero_per_recording(o));
    Device device = device_of(base_model_->program(), *data_);
    auto e = separate(rivals, base_model_->outputs(), device, evidence_->noise().white(), free_zero);
    // Few recordings of one kind may just have been too slow: the same menu, sampled faster.
    const bool few = static_cast<int>(evidence_->recordings().size()) <= rules::few_recordings;
    for (int faster = 0; few && faster < 2 && (!e || e->separation <= rules::experiment_tells); ++faster) {
      device.shortest_step /= 8;
      auto again = separate(rivals, base_model_->outputs(), device, evidence_->noise().white(), free_zero);
      if (again && (!e || again->separation > e->separation)) e = std::move(again);
    }
    if (e) e->between = a.effect->id + " and " + b.effect->id;
    return e;
  }

  /// Rivals that all recordings could have told apart are tied by noise, and another recording must be far better than
  /// they were. One that no recording could show needs only to be seen.
  static bool would_tell(const Experiment& e, bool hidden) {
    return e.separation > rules::experiment_tells ||
           (hidden && e.separation * e.separation * e.rows > 2 * rules::claim_fall);
  }

  // --- claim
  // ----------------------------------------------------------------------------------------------------------

  void claim(int step, std::vector<Tried>& tried, std::size_t winner, const std::vector<int>& ties, double bar) {
    Tried& w = tried[winner];
    progress("intervals of " + w.effect->id, bar);
    FoundStep found;
    found.before = current_.error_of;
    Contender final = refit(shop_, w.contender, Effort::final);
    d_.model_runs += final.runs;
    if (final.ok && final.error_of.evidence() <= w.contender.error_of.evidence() + 1) {
      final.change = w.contender.change;
      w.contender = std::move(final);
    }
    for (const int t : ties) {
      found.ties.push_back(candidate_of(tried[static_cast<std::size_t>(t)], step));
      const Tried& rival = tried[static_cast<std::size_t>(t)];
      auto e = experiment_between(w, rival);
      // The nearest rival first: what separates a third one best may leave the second.
      if (!e || found.experiment_would_tell) continue;
      found.experiment_would_tell = would_tell(*e, rival.hidden);
      if (found.experiment_would_tell || !found.experiment || e->separation > found.experiment->separation)
        found.experiment = e;
    }
    const ModelError before = current_.error_of;
    current_ = w.contender;
    if (current_.standing.size() > 1) exchange(w, bar);
    settle(current_);
    found.before = evidence_->error(before_prediction_.y.empty() ? base_.prediction : before_prediction_);
    before_prediction_ = current_.prediction;
    w.contender.error_of = current_.error_of;
    judge_again(w, found.before);
    found.after = current_.error_of;
    found.winner = candidate_of(w, step);
    found.winner.claimed = true;
    found.change = current_.change;
    found.change.diagram = current_.diagram;
    found.sentence = step_sentence(w, found.ties, found.before, found.after, output_unit());
    d_.steps.push_back(std::move(found));
  }

  /// The reason is told in the units of the noise as settled by the claimed model.
  void judge_again(Tried& w, const ModelError& before) {
    Contender was;
    was.ok = true;
    was.error_of = before;
    was.parameters = 0;
    const bool admitted = w.admitted;
    judge(w, was, 0);
    w.admitted = admitted;
  }

  /// Greedy search takes a look-alike where the right one was masked: in sets of two or more each member is replaced in
  /// turn.
  void exchange(Tried& w, double bar) {
    for (std::size_t i = 0; i + 1 < current_.standing.size() && !stopped(); ++i) {
      const Effect& member = *current_.standing[i].effect;
      for (const auto& e : effects_.list()) {
        if (!wanted(e) || !look_alike(member, e) || (e.family != member.family && standing(e))) continue;
        Contender rest = without(shop_, current_, i);
        const auto places = places_of(e, rest.diagram, registry_, data_.get());
        if (places.empty()) continue;
        const auto at = circumstances_at(rest.diagram, registry_, *data_, places, options_.free_paths);
        for (std::size_t p = 0; p < places.size() && !stopped(); ++p) {
          if (!e.unseen(at[p]).empty()) continue;
          progress(fmt::format("{} in place of {}", e.id, member.id), bar);
          Contender other = with_effect(shop_, rest, e, e.laws(at[p]).front(), places[p], at[p], Effort::full);
          d_.model_runs += other.runs;
          if (!other.ok || other.score() > current_.score() - rules::exchange) continue;
          d_.data_remarks.push_back(fmt::format("{} was taken at first; together with {} the recordings speak for {}",
                                                member.id, w.effect->id, e.id));
          current_ = std::move(other);
          return;
        }
      }
    }
  }

  // --- verdict
  // --------------------------------------------------------------------------------------------------------

  /// As the recordings have it.
  Unit output_unit() const {
    const auto& name = base_model_->outputs().front();
    for (const auto& r : data_->recordings)
      if (const auto found = r.units.find(name); found != r.units.end()) return found->second;
    return base_model_->program().signals[static_cast<std::size_t>(base_model_->output_signal(0))].unit;
  }

  void finish() {
    progress("what is left", 0.97);
    settle(current_);
    d_.base = evidence_->error(base_.prediction);
    const double floor = current_.error_of.over_floor();
    const bool base_is_off = d_.base.over_floor() > rules::floor_gate;
    std::optional<Structure> structure;
    if (base_is_off) structure = find_structure(*evidence_, base_.prediction);
    // A clamp is a kink at a level too: what effects explain down to the noise needs no structure.
    const bool effects_suffice = !d_.steps.empty() && floor <= rules::floor_gate;
    const bool structure_wins =
        structure && structure->explains() && !effects_suffice && structure->share_removed > rules::structure_share &&
        structure->fall_validate > std::max(removed_beyond_calibration(*structure), rules::claim_fall);
    if (structure_wins) {
      d_.verdict = Verdict::unexplained;
      d_.structure = structure;
      withdraw();
    } else if (d_.steps.empty()) {
      // chi2/N alone speaks of the noise model as much as of the plant: slow noise of unknown size lifts it too.
      const bool told = structure && structure->fall_validate > rules::claim_fall;
      const bool holds = told && structure->share_removed > rules::structure_share;
      const bool unexplained = base_is_off && (holds || d_.base.over_floor() > rules::slow_noise);
      d_.verdict = unexplained ? Verdict::unexplained : Verdict::adequate;
      if (unexplained && told) d_.structure = structure;
    } else {
      const bool certain = std::any_of(d_.steps.begin(), d_.steps.end(),
                                       [](const FoundStep& s) { return s.ties.empty() || !s.experiment_would_tell; });
      d_.verdict = certain ? Verdict::missing_effect : Verdict::not_distinguishable;
      if (floor > rules::floor_gate && !stopped()) {
        auto left = find_structure(*evidence_, current_.prediction);
        if (left && left->share_removed > rules::structure_share && left->fall_validate > rules::claim_fall)
          d_.structure = left;
      }
    }
    d_.remainder = current_.error_of.over_floor() > rules::floor_gate ? Remainder::structured : Remainder::noise;
    for (const auto& s : d_.steps)
      if (s.experiment && s.experiment_would_tell &&
          (!d_.experiment || s.experiment->separation > d_.experiment->separation))
        d_.experiment = s.experiment;
    d_.final_diagram = current_.diagram;
    d_.final_error = current_.error_of;
    d_.final_prediction = current_.prediction;
    add_zeros(*base_model_, evidence_->judge(), d_.final_prediction);
    test_recordings();
    tell_noise();
    put_into_words(d_, *data_, output_unit());
    progress("done", 1);
  }

  /// What the effects take away of what a gain and an offset leave: a structure is counted from there too.
  double removed_beyond_calibration(const Structure& s) const {
    double left = 0;
    for (const auto& r : current_.error_of.recordings)
      if (r.role == Role::validate && r.output == s.output) left += r.chi2;
    return s.beyond_calibration - left;
  }

  /// A structure that no effect describes explains more than the effects did: what they took away was part of it.
  void withdraw() {
    for (auto& c : d_.candidates)
      if (c.claimed) {
        c.claimed = false;
        c.reason = "withdrawn: " + d_.structure->sentence + ", more than this effect takes away";
      }
    d_.steps.clear();
    current_ = base_;
    settle(current_);
  }

  /// Read once, here, and used for nothing but the report.
  void test_recordings() {
    const auto test = base_model_->recordings(Role::test);
    if (test.empty()) return;
    const Prediction p = predicted(shop_, current_, test);
    if (!p.ok) return;
    if (const auto e = evidence_->test_error(p)) {
      d_.final_error.rms_test = e->first;
      d_.final_error.nrmse_test = e->second;
    }
  }

  void tell_noise() {
    d_.noise_guessed = !evidence_->noise_known();
    for (std::size_t o = 0; o < base_model_->outputs().size(); ++o) {
      const auto& n = evidence_->noise().outputs[o];
      JudgedNoise told;
      told.output = base_model_->outputs()[o];
      told.unit = base_model_->program()
                      .signals[static_cast<std::size_t>(base_model_->output_signal(static_cast<int>(o)))]
                      .unit;
      told.white = n.white;
      told.one_over_f = n.one_over_f;
      told.origin = to_text(n.source);
      told.remark = n.remark;
      d_.noise.push_back(std::move(told));
    }
  }

  const Registry& registry_;
  const Effects& effects_;
  const DiscoverOptions& options_;
  std::shared_ptr<const DataSet> data_;
  const Diagram& user_;
  Workshop shop_;
  std::unique_ptr<DataModel> base_model_;
  std::unique_ptr<Evidence> evidence_;
  Contender base_, current_;
  std::vector<Tried> hidden_;     ///< of the present step: cannot be seen here, may have acted all the same
  Prediction before_prediction_;  ///< of the model before the present step; empty = the base
  Discovery d_;
};

}  // namespace

Discovery discover(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                   const DiscoverOptions& options) {
  return Investigation(diagram, data, registry, effects, options).run();
}

Discovery diagnose(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                   DiscoverOptions options) {
  options.max_steps = 1;
  return discover(diagram, data, registry, effects, options);
}

}  // namespace hysteron
