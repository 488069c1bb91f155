// Decides at which values of its parameters an effect changes nothing. See neutral.h.
#include "discover/demonstration/neutral.h"

#include <algorithm>
#include <cmath>

#include "discover/demonstration/trial.h"

namespace hysteron {
namespace {

constexpr double nothing = 1e-9;          // of the signal: rounding
constexpr double next_to_nothing = 1e-4;  // of the signal: what is left of it this near to a limit
constexpr double far = 1e6;               // times a size of the signal or of the parameter: as good as infinite

/// The elements of one list, or one number.
struct Group {
  std::string name;
  std::vector<std::size_t> elements;  ///< places in Law::free
};

std::vector<Group> groups_of(const Law& law) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < law.free.size(); ++i) {
    const std::string name = law.free[i].path.substr(0, law.free[i].path.find('['));
    const auto known = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == name; });
    if (known == groups.end())
      groups.push_back({name, {i}});
    else
      known->elements.push_back(i);
  }
  return groups;
}

/// What the elements of a group are set to.
enum class Rule {
  zero,
  factors,  ///< what begins at 1 is a factor and stays 1, everything else is an amount: 0
  straight  ///< the first two of a list, constant and slope of a curve, as they begin; those that bend it 0
};

enum class Kind { towards_infinity, towards_minus_infinity, towards_zero };

std::string text_of(Kind kind) {
  if (kind == Kind::towards_zero) return "towards 0";
  return kind == Kind::towards_infinity ? "towards inf" : "towards -inf";
}

class Search {
 public:
  explicit Search(const DemoRun& trial)
      : trial_(trial), groups_(groups_of(trial.law())), top_(largest(trial.plain())) {}

  std::vector<NeutralValue> found() const {
    for (std::size_t size = 1; size <= groups_.size(); ++size)
      for (const Rule rule : {Rule::zero, Rule::factors, Rule::straight})
        for (const auto& some : subsets(size))
          if (trial_.share_with(set(some, rule)) <= nothing) return told(with_silent(some, rule), rule);
    for (std::size_t size = 1; size <= std::min<std::size_t>(2, groups_.size()); ++size)
      for (const auto& some : subsets(size))
        if (auto limits = limits_of(some); !limits.empty()) return limits;
    return {};
  }

 private:
  using Some = std::vector<std::size_t>;  ///< places in groups_

  /// Sets of so many groups, the first groups first.
  std::vector<Some> subsets(std::size_t size) const {
    std::vector<Some> sets;
    for (std::size_t bits = 1; bits < (std::size_t{1} << groups_.size()); ++bits) {
      Some some;
      for (std::size_t g = 0; g < groups_.size(); ++g)
        if ((bits >> g & 1) != 0) some.push_back(g);
      if (some.size() == size) sets.push_back(std::move(some));
    }
    return sets;
  }

  double start(std::size_t element) const { return trial_.law().free[element].start; }
  bool kept(std::size_t element, Rule rule) const {
    const std::string& path = trial_.law().free[element].path;
    return rule == Rule::straight && (path.ends_with("[0]") || path.ends_with("[1]"));
  }
  double value(std::size_t element, Rule rule) const {
    if (kept(element, rule)) return start(element);
    return rule == Rule::factors && start(element) == 1 ? 1 : 0;
  }
  std::vector<double> set(const Some& some, Rule rule) const {
    auto values = trial_.values();
    for (const auto g : some)
      for (const auto i : groups_[g].elements) values[i] = value(i, rule);
    return values;
  }

  /// And the groups that the picture leaves at zero, but that would change something.
  Some with_silent(Some some, Rule rule) const {
    const auto values = set(some, rule);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const auto& elements = groups_[g].elements;
      if (std::any_of(elements.begin(), elements.end(), [&](auto i) { return trial_.values()[i] != 0; })) continue;
      auto moved = values;
      for (const auto i : elements) moved[i] = std::min(top_, trial_.law().free[i].upper);
      if (std::find(some.begin(), some.end(), g) == some.end() && !(trial_.share_with(moved) <= nothing))
        some.push_back(g);
    }
    std::sort(some.begin(), some.end());
    return some;
  }

  std::vector<NeutralValue> told(const Some& some, Rule rule) const {
    std::vector<NeutralValue> list;
    for (const auto g : some) {
      const auto& elements = groups_[g].elements;
      const auto ones = std::count_if(elements.begin(), elements.end(), [&](auto i) { return value(i, rule) == 1; });
      const bool alike = ones == 0 || ones == static_cast<std::ptrdiff_t>(elements.size());
      if (rule == Rule::straight) {
        for (const auto i : elements)
          if (!kept(i, rule)) list.push_back({trial_.law().free[i].path, "0"});
        continue;
      }
      if (!alike)
        for (const auto i : elements)
          if (value(i, rule) == 1) list.push_back({trial_.law().free[i].path, "1"});
      list.push_back({alike ? groups_[g].name : "the other " + groups_[g].name, alike && ones > 0 ? "1" : "0"});
    }
    return list;
  }

  double limit(Kind kind, std::size_t element) const {
    const double size = std::abs(trial_.values()[element]);
    if (kind == Kind::towards_zero) return size / far;
    return (kind == Kind::towards_infinity ? far : -far) * std::max(size, top_);
  }

  std::vector<NeutralValue> limits_of(const std::vector<std::size_t>& some) const {
    constexpr std::size_t kinds = 3;
    std::size_t ways = 1;
    for (std::size_t k = 0; k < some.size(); ++k) ways *= kinds;
    for (std::size_t way = 0; way < ways; ++way) {
      auto values = trial_.values();
      std::vector<NeutralValue> list;
      std::size_t digits = way;
      for (const auto g : some) {
        const Kind kind = static_cast<Kind>(digits % kinds);
        digits /= kinds;
        for (const auto i : groups_[g].elements) values[i] = limit(kind, i);
        list.push_back({groups_[g].name, text_of(kind)});
      }
      if (trial_.share_with(values) <= next_to_nothing) return list;
    }
    return {};
  }

  const DemoRun& trial_;
  std::vector<Group> groups_;
  double top_ = 0;
};

}  // namespace

std::vector<NeutralValue> neutral_values(const DemoRun& trial) { return Search(trial).found(); }

}  // namespace hysteron
