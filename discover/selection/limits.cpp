#include "discover/selection/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "discover/selection/seen.h"
#include "engine/diagram/error.h"
#include "fit/numerics/dense.h"

namespace hysteron {
namespace {

constexpr double one_sided = 1.644853626951473;  // 95 % of a normal distribution
constexpr double agrees = 0.1;                   // of the size at which its effect was looked at, and of the limit
constexpr int most_looks = 6;

/// What is fitted to what is left, one of them the effect.
struct Amount {
  double value = 0, sigma = 0;
};
std::optional<Amount> amount_of(const Column& effect, const Column& left, const std::vector<Moving>& beside) {
  std::vector<Moving> all{{effect, 0, 0}};
  all.insert(all.end(), beside.begin(), beside.end());
  const LinearFit fit = fit_linearly(all, left);
  if (!(fit.sigma.front() > 0)) return std::nullopt;
  return Amount{fit.value.front(), fit.sigma.front()};
}

class Limits {
 public:
  Limits(SearchState& state, const Selection& selection)
      : state_(state),
        selected_(selection.best()),
        context_(context_for(selection.setting(), state.context, weights_of(selection.setting(), selected_),
                             Numbers::written)),
        scale_(scale_to_noise(selection)),
        base_(context_, selected_.model, selected_.model.diagram, scale_),
        setting_(selection.setting()) {
    if (auto left = base_.left({})) left_ = std::move(*left);
    if (!left_.empty()) look_beside();
  }

  /// Nothing where the recordings allow any.
  std::optional<EffectLimit> of(const TriedEffect& t) {
    const Law& law = t.laws.front();
    const auto first = std::find_if(law.free.begin(), law.free.end(), [](const auto& p) { return p.is_size; });
    if (left_.empty() || first == law.free.end()) return std::nullopt;
    const Added added = add_effect(selected_.model.diagram, state_.registry, *t.effect, law, t.place);
    Seen with(context_, selected_.model, added.diagram, scale_);
    const auto sizes = sizes_of(t, law, with, added.name);
    if (!sizes) return std::nullopt;
    EffectLimit limit{t.effect->id, t.place.where(), law.name, first->path, {}, false, 0, {}, *sizes};
    const ParameterInfo* info = with.program().find_parameter(parameter_path(added.name, law, *first));
    limit.unit = parameter_unit(with.program(), *info);
    limit.difference = info->difference;
    limit.value = *sizes * first->start;
    if (t.effect->summary) limit.at_most = t.effect->summary(law, values(law, *sizes), t.excitation);
    return limit;
  }

 private:
  /// The score weighs rows by 1/(s^2 + V), which is half of what noise alone would weigh where only noise is left. By
  /// this factor witnesses have the variance one that they show.
  double scale_to_noise(const Selection& selection) const {
    Seen seen(context_, selected_.model, selected_.model.diagram, 1);
    const auto left = seen.left({});
    const double chi2 = left ? dot(left->data(), left->data(), left->size()) : 0;
    return chi2 > 0 ? std::sqrt(selection.score().n_eff() / chi2) : 1;
  }
  /// In sizes with which the law begins; nothing where no size is the limit that it gives itself.
  std::optional<double> sizes_of(const TriedEffect& t, const Law& law, Seen& with, const std::string& name) {
    const double most = most_of(law);
    double size = 1;
    for (int look = 0; look < most_looks; ++look) {
      // Both of the same program: how it is simulated is no effect.
      const auto left = with.left(values_at(with.program(), name, law, size));
      const auto half = with.left(values_at(with.program(), name, law, size / 2));
      if (!left || !half) return std::nullopt;
      auto beside = beside_;
      for (const auto& path : zeros_of(t)) add(beside, path, std::max(t.excitation.range(), a_little));
      for (const auto& p : law.free)
        if (p.beside_size) add(beside, with, name, law, size, p, *left);
      const auto amount = amount_of(per_unit(*half, *left, size / 2), left_, beside);
      if (!amount) return std::nullopt;
      const double found = is_signed(law) ? std::abs(amount->value) : std::max(amount->value, 0.0);
      const double limit = found + one_sided * amount->sigma;
      if (!(limit > 0) || !(limit < most)) return std::nullopt;
      if (std::abs(limit - size) <= agrees * limit) return limit;
      size = limit;
    }
    return std::nullopt;
  }

  /// What the law says at so many sizes.
  std::vector<double> values(const Law& law, double size) const {
    std::vector<double> list;
    for (const auto& p : law.free)
      if (!std::isnan(p.start)) list.push_back(p.is_size ? size * p.start : p.start);
    return list;
  }

  static bool is_signed(const Law& law) {
    return std::any_of(law.free.begin(), law.free.end(), [](const auto& p) { return p.is_size && p.lower < 0; });
  }
  static double most_of(const Law& law) {
    double most = std::numeric_limits<double>::infinity();
    for (const auto& p : law.free)
      if (p.is_size && std::isfinite(p.upper) && p.start > 0) most = std::min(most, p.upper / p.start);
    return most;
  }
  static Trial values_at(const Program& program, const std::string& name, const Law& law, double size) {
    Trial trial;
    for (const auto& p : law.free)
      if (p.is_size) trial.push_back({parameter_index(program, parameter_path(name, law, p)), size * p.start, -1});
    return trial;
  }
  static std::vector<std::string> zeros_of(const TriedEffect& t) {
    if (!t.effect->moves_zero || t.excitation.offset_is_free) return {};
    return t.excitation.zeros;
  }

  /// A number of the selected model.
  void add(std::vector<Moving>& list, const std::string& path, double least, double written = 0) {
    const ParameterInfo* info = base_.program().find_parameter(path);
    if (info == nullptr) return;
    const double by = a_little * std::max(std::abs(info->value), least);
    if (!(by > 0)) return;
    const int index = parameter_index(base_.program(), path);
    const auto moved = base_.left({{index, info->value + by, -1}});
    if (!moved) return;
    Moving b{per_unit(left_, *moved, by)};
    if (written != 0) b.known = 1 / std::pow(setting_.known_to(path) * written, 2), b.off = info->value - written;
    list.push_back(std::move(b));
  }
  /// A number of the law that makes up for its size.
  void add(std::vector<Moving>& list, Seen& with, const std::string& name, const Law& law, double size,
           const LawParameter& p, const Column& left) const {
    Trial trial = values_at(with.program(), name, law, size);
    const int index = parameter_index(with.program(), parameter_path(name, law, p));
    const double now = with.program().parameters[static_cast<std::size_t>(index)].value;
    const double by = a_little * std::abs(now);
    trial.push_back({index, now + by, -1});
    if (const auto moved = with.left(trial); moved && by > 0) list.push_back({per_unit(left, *moved, by)});
  }

  /// The user's numbers, what the diagram leaves free, and the laws that stand.
  void look_beside() {
    std::set<std::string> done;
    for (const auto& [path, written] : setting_.numbers)
      if (done.insert(path).second) add(beside_, path, 0, written);
    for (const auto& f : free_parameters(base_.program(), state_.options.free_paths)) {
      const auto& path = base_.program().parameters[static_cast<std::size_t>(f.parameter)].path;
      if (done.insert(path).second) add(beside_, path, 0);
    }
    for (const auto& p : parameters_of(selected_.model))
      if (p.estimate != nullptr && !p.law->per_recording && !p.estimate->at_lower && !p.estimate->at_upper &&
          done.insert(p.estimate->path).second)
        add(beside_, p.estimate->path, 0);
  }

  SearchState& state_;
  const TableModel& selected_;
  const FitContext context_;
  const double scale_;
  Seen base_;
  const FitSetting& setting_;
  Column left_;
  std::vector<Moving> beside_;
};

}  // namespace

void tell_limits(SearchState& state, const Selection& selection, Discovery& d) {
  if (!selection.best().ok() || selection.score().over_noise(selection.best().left_at_last()) > rules::near_noise)
    return;
  const CandidateModel was = std::exchange(state.current, selection.best().model);
  std::vector<EffectLimit> widest;  // one of each effect
  state.unless_stopped([&] {
    Limits limits(state, selection);
    for (const auto& t : list_candidates(state, 2)) {
      if (state.stopped()) return;
      try {
        const auto limit = limits.of(t);
        if (!limit) continue;
        const auto known =
            std::find_if(widest.begin(), widest.end(), [&](const auto& l) { return l.effect == limit->effect; });
        if (known == widest.end())
          widest.push_back(*limit);
        else if (known->sizes < limit->sizes)
          *known = *limit;
      } catch (const Error&) {  // it has no place beside what stands
      }
    }
  });
  d.limits = std::move(widest);
  state.current = was;
}

}  // namespace hysteron
