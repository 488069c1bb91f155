// Rate-independent laws: each is a map from what it remembers and its input to its output. Within a step the input runs
// straight from the last accepted value, so that neither rates nor reversals are needed: what a step leaves out of a
// turn is of the order of its square.
#include <algorithm>
#include <cmath>

#include "tests/reference/law.h"

namespace reference {
namespace {

/// Which end moves what is carried along. Only that it begins bends the output; that it ends does not, the input stands
/// still then. What is smaller than `noise` is rounding.
struct Contact {
  static constexpr double noise = 1e-13;
  int held = 0;  ///< 1: carried up, 2: down

  int now(double up, double down) const { return up > noise ? 1 : down > noise ? 2 : held; }
  void keep(double up, double down) {
    if (up > 0) held = 1;
    if (down > 0) held = 2;
    if ((held == 1 && up < -noise) || (held == 2 && down < -noise)) held = 0;
  }
};

struct Play {
  double radius = 0;
  bool one_sided = false;
  double w = 0;
  Contact contact{};

  double low(double u) const { return u - radius; }
  double high(double u) const { return one_sided ? u : u + radius; }
  double at(double u) const { return std::max(low(u), std::min(high(u), w)); }
  int carried(double u) const { return contact.now(low(u) - w, w - high(u)); }
  void keep(double u) {
    contact.keep(low(u) - w, w - high(u));
    w = at(u);
  }
};

/// y = sum weights[i] w_i, each w_i a play of the input.
class Plays : public Law {
 public:
  Plays(const std::vector<double>& radii, const std::vector<double>& weights_, bool one_sided, double before)
      : weights(weights_) {
    for (const double r : radii) {
      Play play{r, one_sided, 0, {}};
      play.w = play.at(before);
      plays.push_back(play);
    }
  }
  void output(const Point& p, double* y) const override { *y = sum(u(p)); }
  long branch(const Point& p) const override {
    long code = 0;
    for (const auto& play : plays) code = 3 * code + play.carried(u(p));
    return code;
  }
  void keep(const Point& p) override {
    for (auto& play : plays) play.keep(u(p));
  }

 protected:
  double sum(double input) const {
    double y = 0;
    for (std::size_t i = 0; i < plays.size(); ++i) y += weights[i] * plays[i].at(input);
    return y;
  }

 private:
  std::vector<Play> plays{};
  std::vector<double> weights;
};

class AsymmetricPlays : public Plays {
 public:
  explicit AsymmetricPlays(const Block& b)
      : Plays(b.list("thresholds"), b.list("weights"), true, b.number("before", 0)),
        first(b.list("weights").at(0)),
        saturation(b.number("saturation")),
        bend(b.number("bend")) {}
  void output(const Point& p, double* y) const override {
    *y = first * saturation * std::tanh(u(p) / bend) + sum(u(p));
  }

 private:
  double first, saturation, bend;
};

/// The inverse of a Prandtl-Ishlinskii model is one of its output (Kuhnen 2003).
LawPointer inverse_of_plays(const Block& b) {
  const auto &r = b.list("thresholds"), &c = b.list("weights");
  std::vector<double> radii, weights;
  double m = 0;
  for (std::size_t j = 0; j < r.size(); ++j) {
    double radius = 0;
    for (std::size_t i = 0; i <= j; ++i) radius += c[i] * (r[j] - r[i]);
    weights.push_back(j == 0 ? 1 / c[0] : 1 / (m + c[j]) - 1 / m);
    m += c[j];
    radii.push_back(radius);
  }
  if (b.number("before", 0) != 0) throw Unknown("an inverse with a past");
  return std::make_unique<Plays>(radii, weights, b.text("sides", "one") == "one", 0);
}

/// Kernels of relays over cells: w_k = max(p_i, min(p_j, w_k)).
class Preisach : public Law {
 public:
  explicit Preisach(const Block& b) : levels(b.list("levels")), weights(b.list("weights")), gain(b.number("gain")) {
    const double before = b.number("before", 0);
    if (before > levels.front() && before < levels.back())
      throw Unknown("how kernels begin within the levels is not documented to the number");
    w.assign(weights.size(), before <= levels.front() ? 0 : 1);
    contacts.resize(w.size());
  }
  void output(const Point& p, double* y) const override {
    *y = gain * u(p);
    for (std::size_t k = 0, i = 0; i + 1 < levels.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k) *y += weights[k] * at(i, j, k, u(p));
  }
  long branch(const Point& p) const override {
    long code = std::upper_bound(levels.begin(), levels.end(), u(p)) - levels.begin();
    for (std::size_t k = 0, i = 0; i + 1 < levels.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k) {
        code = 3 * code + contacts[k].now(share(i, u(p)) - w[k], w[k] - share(j, u(p)));
      }
    return code;
  }
  void keep(const Point& p) override {
    for (std::size_t k = 0, i = 0; i + 1 < levels.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j, ++k) {
        contacts[k].keep(share(i, u(p)) - w[k], w[k] - share(j, u(p)));
        w[k] = at(i, j, k, u(p));
      }
  }

 private:
  double share(std::size_t i, double input) const {
    return std::clamp((input - levels[i]) / (levels[i + 1] - levels[i]), 0.0, 1.0);
  }
  double at(std::size_t i, std::size_t j, std::size_t k, double input) const {
    return std::max(share(i, input), std::min(share(j, input), w[k]));
  }
  std::vector<double> levels, weights, w{};
  std::vector<Contact> contacts{};
  double gain;
};

/// A law dz/du = slope(u, z, direction), followed along the straight way of its input by classical Runge-Kutta.
class Path : public Law {
 public:
  void keep(const Point& p) override {
    if (known) z = followed(u(p));
    at = u(p);
    known = true;
  }

 protected:
  Path(double z_, double finest_) : z(z_), finest(finest_) {}
  virtual double slope(double input, double value, double direction) const = 0;

  double followed(double to) const {
    if (!known || to == at) return z;
    const double way = to - at, direction = way > 0 ? 1 : -1;
    const double pieces = std::max(1.0, std::ceil(std::abs(way) / finest));
    const double h = way / pieces;
    double value = z, input = at;
    for (double i = 0; i < pieces; ++i) {
      const double k1 = slope(input, value, direction), k2 = slope(input + h / 2, value + h / 2 * k1, direction),
                   k3 = slope(input + h / 2, value + h / 2 * k2, direction),
                   k4 = slope(input + h, value + h * k3, direction);
      value += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      input += h;
    }
    return value;
  }

 private:
  double z, at = 0, finest;
  bool known = false;  ///< has the input been anywhere yet?
};

struct BoucWenNumbers {
  double alpha, beta, gamma, d_p, exponent, scale;

  explicit BoucWenNumbers(const Block& b)
      : alpha(b.number("alpha")),
        beta(b.number("beta")),
        gamma(b.number("gamma")),
        d_p(b.number("d_p")),
        exponent(b.number("exponent", 1)),
        scale(b.number("scale", 0)) {}

  /// dz/du while u moves in this direction.
  double slope(double z, double direction) const {
    const double bend = exponent == 1 ? 1 : std::pow(std::abs(z / scale), exponent - 1);
    return alpha - (beta * direction * z + gamma * std::abs(z)) * bend;
  }
};

class BoucWen : public Path {
 public:
  explicit BoucWen(const Block& b) : Path(b.number("initial", 0), 2e-3), law(b) {}
  void output(const Point& p, double* y) const override { *y = law.d_p * u(p) - followed(u(p)); }

 protected:
  double slope(double, double value, double direction) const override { return law.slope(value, direction); }

 private:
  BoucWenNumbers law;
};

class BoucWenInverse : public Path {
 public:
  explicit BoucWenInverse(const Block& b) : Path(b.number("initial", 0), 2e-3), law(b), origin(b.number("origin", 0)) {}
  void output(const Point& p, double* y) const override { *y = (u(p) + origin + followed(u(p))) / law.d_p; }

 protected:
  double slope(double, double value, double direction) const override {
    const double dz_du = law.slope(value, direction);
    return dz_du / (law.d_p - dz_du);
  }

 private:
  BoucWenNumbers law;
  double origin;
};

struct JilesAthertonNumbers {
  double p_s, a, alpha, k, c, scale;

  explicit JilesAthertonNumbers(const Block& b)
      : p_s(b.number("p_s")),
        a(b.number("a")),
        alpha(b.number("alpha")),
        k(b.number("k")),
        c(b.number("c")),
        scale(b.number("scale", 1)) {
    if (b.text("curve", "tanh") != "tanh") throw Unknown("another anhysteretic curve");
  }

  double slope(double u, double p, double d) const {
    const double s = (u + alpha * p) / a, anhysteretic = p_s * std::tanh(s);
    const double reversible = c * p_s / a / (std::cosh(s) * std::cosh(s));
    const double gap = anhysteretic - p;
    return (gap / (k * d - alpha / (1 - c) * gap) + reversible) / (1 - alpha * reversible);
  }
};

class JilesAtherton : public Path {
 public:
  explicit JilesAtherton(const Block& b) : Path(b.number("initial", 0), 2e-3), law(b) {}
  void output(const Point& p, double* y) const override { *y = law.scale * followed(u(p)); }

 protected:
  double slope(double input, double value, double direction) const override {
    return law.slope(input, value, direction);
  }

 private:
  JilesAthertonNumbers law;
};

class JilesAthertonInverse : public Path {
 public:
  explicit JilesAthertonInverse(const Block& b)
      : Path(b.number("initial", 0), 2e-3), law(b), origin(b.number("origin", 0)) {}
  void output(const Point& p, double* y) const override { *y = followed(u(p)); }

 protected:
  double slope(double wanted, double field, double direction) const override {
    return 1 / (law.scale * law.slope(field, (wanted + origin) / law.scale, direction));
  }

 private:
  JilesAthertonNumbers law;
  double origin;
};

/// Dahl's friction of a guide on a wire; rate independent without excess.
class GuideFriction : public Path {
 public:
  explicit GuideFriction(const Block& b)
      : Path(b.number("initial", 0), b.number("slip_distance") / 100),
        level(b.number("level")),
        slip(b.number("slip_distance")) {
    if (b.number("excess", 0) != 0) throw Unknown("guide friction with an excess");
  }
  void output(const Point& p, double* y) const override { *y = u(p) - level * followed(u(p)); }

 protected:
  double slope(double, double share, double direction) const override { return (1 - direction * share) / slip; }

 private:
  double level, slip;
};

}  // namespace

LawPointer make_hysteresis(const Block& b) {
  const bool one = b.text("sides", b.type == "play" ? "two" : "one") == "one";
  const double before = b.number("before", 0);
  if (b.type == "play") return std::make_unique<Plays>(std::vector{b.number("radius")}, std::vector{1.0}, one, before);
  if (b.type == "backlash")
    return std::make_unique<Plays>(std::vector{b.number("gap") / 2}, std::vector{1.0}, false, before);
  if (b.type == "prandtl_ishlinskii")
    return std::make_unique<Plays>(b.list("thresholds"), b.list("weights"), one, before);
  if (b.type == "prandtl_ishlinskii_inverse") return inverse_of_plays(b);
  if (b.type == "asymmetric_prandtl_ishlinskii") return std::make_unique<AsymmetricPlays>(b);
  if (b.type == "preisach") return std::make_unique<Preisach>(b);
  if (b.type == "bouc_wen") return std::make_unique<BoucWen>(b);
  if (b.type == "bouc_wen_inverse") return std::make_unique<BoucWenInverse>(b);
  if (b.type == "jiles_atherton") return std::make_unique<JilesAtherton>(b);
  if (b.type == "jiles_atherton_inverse") return std::make_unique<JilesAthertonInverse>(b);
  if (b.type == "guide_friction") return std::make_unique<GuideFriction>(b);
  return nullptr;
}

}  // namespace reference
