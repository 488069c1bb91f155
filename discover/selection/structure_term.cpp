#include "discover/selection/structure_term.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "discover/structure/residual_parts.h"
#include "discover/structure/structure_fit.h"

namespace hysteron {
namespace {

constexpr int renewals = 3;  // of weights, by what is left: the fit is linear, and settles at once

/// One structure on one model.
struct WithStructure {
  std::size_t structure = 0;
  int numbers = 0;
  LeftSums left;
};

Rows row_weights(const NoiseModel& weights, int recording, int output, std::size_t rows) {
  const auto& pieces = weights.outputs[static_cast<std::size_t>(output)].pieces[static_cast<std::size_t>(recording)];
  Rows list(rows);
  for (std::size_t k = 0; k < rows; ++k) {
    const double sigma = pieces[k * pieces.size() / rows];
    list[k] = 1 / (sigma * sigma);
  }
  return list;
}

int index_of(const DataModel& model, const std::string& output) {
  int o = 0;
  while (model.outputs()[static_cast<std::size_t>(o)] != output) ++o;
  return o;
}

/// What a model leaves, with structures in it.
class OnModel {
 public:
  OnModel(const SearchState& state, const BlockScore& score, const TableModel& base)
      : evidence_(*state.evidence),
        score_(score),
        base_(base),
        rows_(left_rows(evidence_, base.model.unrounded(), base.weights)),
        search_(find_structures(evidence_, base.model.unrounded(), state.context.threads, Where::all_recordings)) {}

  const StructureSearch& search() const { return search_; }

  std::vector<WithStructure> rivals() {
    std::vector<WithStructure> list;
    for (std::size_t i = 0; i < search_.list.size(); ++i)
      if (search_.list[i].explains())
        for (const bool with_gain : {false, true}) list.push_back(with(i, with_gain));
    return list;
  }

 private:
  WithStructure with(std::size_t i, bool with_gain) {
    const Structure& s = search_.list[i];
    const int output = index_of(evidence_.model(), s.output);
    const ResidualParts& parts = parts_of(output);
    std::vector<LeftRows> left = rows_;
    std::vector<LeftRows*> of_parts;
    std::vector<Rows> rows;
    for (const auto& p : parts.list())
      for (auto& l : left)
        if (l.recording == p.recording && l.output == output) of_parts.push_back(&l), rows.push_back(l.rows);
    WithStructure rival{i, 0, base_.left};
    for (int k = 0; k < renewals; ++k) {
      const NoiseModel weights = score_.weights(evidence_, rival.left);
      std::vector<Rows> row_by_row;
      for (const auto* l : of_parts) row_by_row.push_back(row_weights(weights, l->recording, output, l->rows.size()));
      StructureFit fit = fit_structure(s, parts, rows, row_by_row, with_gain);
      rival.numbers = fit.numbers;
      for (std::size_t p = 0; p < of_parts.size(); ++p) of_parts[p]->rows = std::move(fit.left[p]);
      rival.left = left_sums(left);
    }
    return rival;
  }
  const ResidualParts& parts_of(int output) {
    const auto known = parts_.find(output);
    if (known != parts_.end()) return known->second;
    return parts_.try_emplace(output, evidence_, base_.model.unrounded(), output).first->second;
  }

  const Evidence& evidence_;
  const BlockScore& score_;
  const TableModel& base_;
  const std::vector<LeftRows> rows_;
  StructureSearch search_;
  std::map<int, ResidualParts> parts_;
};

/// A line or a ripple where a law that stands looks for one is that law's own.
bool is_of_a_standing_law(const SearchState& state, const CandidateModel& model, const Structure& s) {
  const auto looks_for_it = [&](const LawParameter& p) {
    if (s.kind == "line_in_level") return p.period_of_wire && p.lower <= s.period && s.period <= p.upper;
    return s.kind == "line_in_time" &&
           std::any_of(p.line_bands.begin(), p.line_bands.end(), [&](const std::pair<double, double>& band) {
             return band.first * s.period <= 1 && 1 <= band.second * s.period;
           });
  };
  return std::any_of(model.placed.begin(), model.placed.end(), [&](const PlacedEffect& standing) {
    const auto moved = measured_moved(state, model, standing.place.moves_from());
    return std::any_of(moved.begin(), moved.end(),
                       [&](int o) { return state.base_model->outputs()[static_cast<std::size_t>(o)] == s.output; }) &&
           std::any_of(standing.law.free.begin(), standing.law.free.end(), looks_for_it);
  });
}

}  // namespace

std::optional<CompetingStructure> structure_beside_effects(SearchState& state, Selection& selection) {
  struct Searched {
    const TableModel* on;
    StructureSearch search;
    std::vector<WithStructure> rivals;
  };
  std::vector<Searched> all;
  for (const TableModel* base : {&selection.nulls().written, &selection.nulls().let_go, &selection.best()}) {
    if (!base->ok()) continue;
    state.settle(state.current.prediction, base->model);  // a line of an effect would hide one beside it
    OnModel on(state, selection.score(), *base);
    all.push_back({base, on.search(), on.rivals()});
  }
  state.settle(state.current);
  for (const auto& s : all)
    for (const auto& r : s.rivals) selection.count_in(r.left);
  const auto score_by = [&](const BlockScore& score, const Searched& s, const WithStructure& r) {
    return score.fit_of(r.left) - score.fit_of(s.on->left) + score_of(score, *s.on) - score.price(r.numbers) -
           std::log(static_cast<double>(s.search.list.size()));
  };
  const BlockScore& score = selection.score();
  const Searched* where = nullptr;
  const WithStructure* best = nullptr;
  double alone = -std::numeric_limits<double>::infinity(), beside_effects = alone;
  for (const auto& s : all)
    for (const auto& r : s.rivals) {
      const double of_it = score_by(score, s, r);
      if (s.on == &selection.best()) {
        beside_effects = std::max(beside_effects, of_it);
      } else if (of_it > alone) {
        alone = of_it;
        where = &s;
        best = &r;
      }
    }
  if (best == nullptr) return std::nullopt;
  // Where both leave more than noise, what they leave lasts, and as few witnesses as that has tell them apart.
  const BlockScore of_both(*state.evidence, {best->left, selection.best().left});
  CompetingStructure of_all{{where->search, Where::all_recordings, {}},
                            score_by(of_both, *where, *best) - score_of(of_both, selection.best())};
  of_all.judged.search.best = static_cast<int>(best->structure);
  auto& why_not = of_all.judged.requirement.why_not;
  if (alone <= selection.score_of(selection.nulls().better(score)) + rules::by_score)
    why_not = "no more than chance";
  else if (of_all.by <= rules::tie)
    why_not = fmt::format("its score is {:.0f} {} that of the effects that were found", std::abs(of_all.by),
                          of_all.by < 0 ? "below" : "above");
  else if (beside_effects >= alone + rules::by_score)
    why_not = "the effects would be claimed beside it";
  // A law is simpler than what it stands for, and may leave a part of that; a structure stands for nothing but what it
  // describes.
  else if (!score.leaves_little(best->left, where->on->left))
    why_not = "it leaves more than a tenth of what it explains";
  else if (is_of_a_standing_law(state, selection.best().model, *of_all.judged.search.winner()))
    why_not = "an effect that was found looks for it";
  return of_all;
}

}  // namespace hysteron
