#include "blocks/math/expression_units.h"

#include <cmath>
#include <map>

namespace hysteron::expression {
namespace {

constexpr std::size_t radian = 7;  // its place in Dimension
constexpr double nothing = 1e-9;   // of an exponent

/// Powers of the base units, and of what is not known yet. Exponents may be broken: sqrt(u).
struct Powers {
  std::array<double, 9> known{};
  std::map<int, double> open{};

  static Powers of(const Dimension& d) {
    Powers p;
    for (std::size_t i = 0; i < p.known.size(); ++i) p.known[i] = d.power[i];
    return p;
  }
  Powers to_power(double n) const {
    Powers p = *this;
    for (double& k : p.known) k *= n;
    for (auto& [variable, k] : p.open) k *= n;
    p.tidy();
    return p;
  }
  Powers times(const Powers& b, double n = 1) const {
    Powers p = *this;
    for (std::size_t i = 0; i < known.size(); ++i) p.known[i] += n * b.known[i];
    for (const auto& [variable, k] : b.open) p.open[variable] += n * k;
    p.tidy();
    return p;
  }
  void tidy() {
    std::erase_if(open, [](const auto& o) { return std::abs(o.second) < nothing; });
  }
  bool is_none(bool but_for_angles) const {
    for (std::size_t i = 0; i < known.size(); ++i)
      if (std::abs(known[i]) > nothing && !(but_for_angles && i == radian)) return false;
    return true;
  }
  /// Nothing where exponents are broken or open.
  std::optional<Dimension> whole() const {
    Dimension d;
    for (std::size_t i = 0; i < known.size(); ++i) {
      d.power[i] = static_cast<std::int8_t>(std::lround(known[i]));
      if (std::abs(known[i] - d.power[i]) > nothing) return std::nullopt;
    }
    return open.empty() ? std::optional(d) : std::nullopt;
  }
};

class Inference {
 public:
  Inference(const Tree& tree, UnitsOfTree& units, const std::function<std::string(const Dimension&)>& name)
      : tree_(tree), units_(units), name_(name) {}

  void run() {
    for (const auto& known : units_.symbols) symbols_.push_back(known ? Powers::of(*known) : open());
    for (const auto& part : tree_.parts) parts_.push_back(of(part));
    const Part& last = tree_.parts.back();
    if (units_.whole) {
      if (!agree(parts_.back(), Powers::of(*units_.whole)))
        throw Wrong("the expression gives " + told(parts_.back()) + ", \"unit\" or what reads it says " +
                        name_(*units_.whole) + ",",
                    last.character, "correct the units of the parameters, or \"unit\"");
    } else {
      const Powers found = now(parts_.back());
      units_.whole = found.whole();
      if (!units_.whole && found.open.empty())
        throw Wrong("the result has the unit " + told(found), last.character,
                    "no wire carries a broken power of a unit; take the root of a number: sqrt(u/u0)");
    }
    for (std::size_t i = 0; i < symbols_.size(); ++i)
      if (!units_.symbols[i]) units_.symbols[i] = now(symbols_[i]).whole();
  }

 private:
  Powers open() {
    Powers p;
    p.open[next_++] = 1;
    return p;
  }

  /// With what has been found since.
  Powers now(const Powers& p) const {
    Powers result = p;
    for (bool again = true; again;) {
      again = false;
      for (const auto& [variable, k] : result.open) {
        const auto found = found_.find(variable);
        if (found == found_.end()) continue;
        const double n = k;
        result.open.erase(variable);
        result = result.times(found->second, n);
        again = true;
        break;
      }
    }
    return result;
  }

  /// Makes them the same, if that can be.
  bool agree(const Powers& a, const Powers& b) {
    const Powers rest = now(a.times(b, -1));
    if (rest.open.empty()) return rest.is_none(true);
    const auto [variable, k] = *rest.open.begin();
    Powers other = rest;
    other.open.erase(variable);
    found_[variable] = other.to_power(-1 / k);
    return true;
  }

  std::string told(const Powers& p) const {
    const Powers known = now(p);
    if (!known.open.empty()) return "a unit that is not known";
    if (const auto whole = known.whole()) return name_(*whole);
    Dimension whole;
    Powers twice = known;
    int times = 1;
    while (times < 6 && !twice.whole()) twice = known.to_power(++times);
    return twice.whole() ? name_(*twice.whole()) + "^(1/" + std::to_string(times) + ")" : "a broken power of a unit";
  }

  void need_number(const Part& part, int argument, const char* of) {
    const Powers p = now(parts_[static_cast<std::size_t>(argument)]);
    if (!p.open.empty() || p.is_none(true)) return;
    const std::string where = name_of(part.op);
    if (p.known[8] != 0 && std::abs(p.known[8] - 1) < nothing) {
      Powers turns = p;
      turns.known[8] = 0;
      if (turns.is_none(true))
        throw Wrong(std::string("the ") + of + " of " + where + " is in cycles", part.character,
                    "multiply it by a parameter of \"6.283185307179586 rad/cycle\"");
    }
    throw Wrong(std::string("the ") + of + " of " + where + " is in " + told(p) + ", expected a plain number" +
                    (part.op >= Op::sin && part.op <= Op::tan ? " or an angle" : ""),
                part.character, "divide it by a parameter of that unit");
  }

  bool is_number(int part) const { return part >= 0 && tree_.parts[static_cast<std::size_t>(part)].is(Op::number); }

  Powers same(const Part& part, const std::string& what) {
    const Powers a = parts_[static_cast<std::size_t>(part.of[0])], b = parts_[static_cast<std::size_t>(part.of[1])];
    return joined(part, a, b, what);
  }
  Powers joined(const Part& part, const Powers& a, const Powers& b, const std::string& what) {
    if (!agree(a, b))
      throw Wrong("cannot " + what + " " + told(a) + " and " + told(b), part.character,
                  is_number(part.of[0]) || is_number(part.of[1]) || is_number(part.of[2])
                      ? "numbers in the text are plain: give this one a name, and the block its value with a unit"
                      : "multiply one of them by a parameter that has the unit between them");
    // An angle and a plain number make an angle.
    const Powers left = now(a), right = now(b);
    return std::abs(right.known[radian]) > std::abs(left.known[radian]) ? right : left;
  }

  Powers of(const Part& part) {
    const auto argument = [&](std::size_t i) { return parts_[static_cast<std::size_t>(part.of[i])]; };
    switch (part.op) {
      case Op::number:
        return part.number == 0 || std::isinf(part.number) ? open() : Powers{};  // zero fits any unit
      case Op::symbol:
        return symbols_[static_cast<std::size_t>(part.symbol)];
      case Op::negative:
      case Op::abs:
        return argument(0);
      case Op::add:
        return same(part, "add");
      case Op::subtract:
        return same(part, "subtract");
      case Op::min:
      case Op::max:
      case Op::hypot:
      case Op::mod:
        return same(part, "take " + name_of(part.op) + " of");
      case Op::less:
      case Op::less_equal:
      case Op::equal:
      case Op::not_equal:
        same(part, "compare");
        return {};
      case Op::multiply:
        return argument(0).times(argument(1));
      case Op::divide:
        return argument(0).times(argument(1), -1);
      case Op::power_by:
        return argument(0).to_power(tree_.parts[static_cast<std::size_t>(part.of[1])].number);
      case Op::power: {
        need_number(part, part.of[1], "exponent");
        const Powers base = now(argument(0));
        if (base.open.empty() && !base.is_none(true))
          throw Wrong("the exponent of " + told(base) + " is no number", part.character,
                      "write the exponent as a number, or divide the base by a parameter of its unit");
        return {};
      }
      case Op::sqrt:
        return argument(0).to_power(0.5);
      case Op::cbrt:
        return argument(0).to_power(1.0 / 3);
      case Op::choose:
        return joined(part, argument(1), argument(2), "choose between");
      case Op::atan2:
        same(part, "take atan2 of");
        return angle();
      case Op::asin:
      case Op::acos:
      case Op::atan:
        need_number(part, part.of[0], "argument");
        return angle();
      case Op::sign:
        return {};
      case Op::both:
      case Op::either:
      case Op::negate:
      case Op::truth:
        for (const int a : part.of)
          if (a >= 0) need_number(part, a, "argument");
        return {};
      default:
        need_number(part, part.of[0], "argument");
        return {};
    }
  }

  static Powers angle() {
    Powers p;
    p.known[radian] = 1;
    return p;
  }

  const Tree& tree_;
  UnitsOfTree& units_;
  const std::function<std::string(const Dimension&)>& name_;
  std::vector<Powers> symbols_{}, parts_{};
  std::map<int, Powers> found_{};
  int next_ = 0;
};

}  // namespace

void infer_units(const Tree& tree, UnitsOfTree& units, const std::function<std::string(const Dimension&)>& name) {
  Inference(tree, units, name).run();
}

}  // namespace hysteron::expression
