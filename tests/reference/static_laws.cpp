// Laws without memory, and those whose only memory is a level that they are at: relay and rounding.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/stepwise.h"

namespace reference {
namespace {

class Gain : public Law {
 public:
  Gain(double gain_, double offset_) : gain(gain_), offset(offset_) {}
  void output(const Point& p, double* y) const override { *y = gain * u(p) + offset; }

 private:
  double gain, offset;
};

class Sum : public Law {
 public:
  explicit Sum(const Block& b) : signs(b.text("signs", std::string(b.in.size(), '+'))), count(b.in.size()) {}
  std::vector<std::string> inputs() const override { return std::vector<std::string>(count, ""); }
  void output(const Point& p, double* y) const override {
    *y = 0;
    for (std::size_t i = 0; i < count; ++i) *y += signs[i] == '-' ? -u(p, i) : u(p, i);
  }

 private:
  std::string signs;
  std::size_t count;
};

class Product : public Law {
 public:
  std::vector<std::string> inputs() const override { return {"a", "b"}; }
  void output(const Point& p, double* y) const override { *y = u(p, 0) * u(p, 1); }
};

class CrossCoupling : public Law {
 public:
  explicit CrossCoupling(const Block& b) : c(b.number("coefficient")) {}
  std::vector<std::string> inputs() const override { return {"u", "other"}; }
  void output(const Point& p, double* y) const override { *y = u(p, 0) + c * u(p, 1); }

 private:
  double c;
};

class ManualSwitch : public Law {
 public:
  explicit ManualSwitch(const Block& b) : second(b.text("position", "first") == "second") {}
  std::vector<std::string> inputs() const override { return {"first", "second"}; }
  void output(const Point& p, double* y) const override { *y = u(p, second ? 1 : 0); }

 private:
  bool second;
};

class Saturation : public Law {
 public:
  explicit Saturation(const Block& b) : lower(b.number("lower")), upper(b.number("upper")) {}
  void output(const Point& p, double* y) const override { *y = std::max(lower, std::min(upper, u(p))); }
  long branch(const Point& p) const override { return u(p) > upper ? 1 : u(p) < lower ? -1 : 0; }

 private:
  double lower, upper;
};

class SoftSaturation : public Law {
 public:
  explicit SoftSaturation(const Block& b) : limit(b.number("limit")), sharpness(b.number("sharpness", 2)) {}
  void output(const Point& p, double* y) const override {
    *y = u(p) / std::pow(1 + std::pow(std::abs(u(p) / limit), sharpness), 1 / sharpness);
  }

 private:
  double limit, sharpness;
};

class Rectifier : public Law {
 public:
  explicit Rectifier(const Block& b) : mix(b.number("mix")) {}
  void output(const Point& p, double* y) const override { *y = (1 - mix) * u(p) + mix * std::abs(u(p)); }
  long branch(const Point& p) const override { return u(p) < 0; }

 private:
  double mix;
};

class Polynomial : public Law {
 public:
  explicit Polynomial(const Block& b)
      : c(b.list("coefficients")),
        reference(b.number("reference")),
        lower(b.number("lower")),
        upper(b.number("upper")),
        about(b.number("about", 0)) {}
  void output(const Point& p, double* y) const override {
    const double at = std::clamp(u(p), lower, upper), z = (at - about) / reference;
    double value = 0, slope = 0;
    for (std::size_t k = 0; k < c.size(); ++k) {
      const auto n = static_cast<double>(k);
      value += c[k] * std::pow(z, n);
      if (k > 0) slope += n * c[k] * std::pow(z, n - 1) / reference;
    }
    *y = value + slope * (u(p) - at);
  }

 private:
  std::vector<double> c;
  double reference, lower, upper, about;
};

class Rounding : public Stepwise {
 public:
  explicit Rounding(const Block& b) : step(b.number("step")) {}
  void output(const Point& p, double* y) const override { *y = step == 0 ? u(p) : step * static_cast<double>(at(p)); }

 private:
  long now(const Point& p) const override { return step == 0 ? 0 : std::lround(u(p) / step); }
  double step;
};

class Relay : public Law {
 public:
  explicit Relay(const Block& b)
      : on_at(b.number("on_at")),
        off_at(b.number("off_at")),
        on_value(b.number("on_value")),
        off_value(b.number("off_value")),
        on(b.text("initial", "off") == "on") {}
  void output(const Point& p, double* y) const override { *y = (p.free ? switched(p) : on) ? on_value : off_value; }
  long branch(const Point& p) const override { return switched(p); }
  int roughness() const override { return 0; }
  void keep(const Point& p) override {
    if (p.free) on = switched(p);
  }

 private:
  bool switched(const Point& p) const { return u(p) >= on_at || (u(p) > off_at && on); }
  double on_at, off_at, on_value, off_value;
  bool on;
};

/// One of two values, or of two signals, by a level. Between instants it stays on its side.
class Level : public Stepwise {
 public:
  Level(double level_, double above_, double below_) : level(level_), above(above_), below(below_) {}
  void output(const Point& p, double* y) const override { *y = at(p) > 0 ? above : below; }

 protected:
  virtual double control(const Point& p) const { return u(p); }

 private:
  long now(const Point& p) const override { return control(p) > level; }
  double level, above, below;
};

class Switch : public Level {
 public:
  explicit Switch(const Block& b) : Level(b.number("level", 0), 0, 0) {}
  std::vector<std::string> inputs() const override { return {"above", "control", "below"}; }
  void output(const Point& p, double* y) const override { *y = at(p) > 0 ? u(p, 0) : u(p, 2); }

 private:
  double control(const Point& p) const override { return u(p, 1); }
};

class Larger : public Law {
 public:
  explicit Larger(const Block& b) : smaller(b.text("is", "max") == "min") {}
  std::vector<std::string> inputs() const override { return {"", ""}; }
  void output(const Point& p, double* y) const override {
    *y = smaller ? std::min(u(p, 0), u(p, 1)) : std::max(u(p, 0), u(p, 1));
  }
  long branch(const Point& p) const override { return u(p, 0) > u(p, 1); }

 private:
  bool smaller;
};

class Table : public Law {
 public:
  explicit Table(const Block& b)
      : knots(b.list("at")), values(b.list("values")), clips(b.text("outside", "clip") == "clip") {}
  void output(const Point& p, double* y) const override {
    const double at = clips ? std::clamp(u(p), knots.front(), knots.back()) : u(p);
    std::size_t i = 0;
    while (i + 2 < knots.size() && at > knots[i + 1]) ++i;
    *y = values[i] + (values[i + 1] - values[i]) / (knots[i + 1] - knots[i]) * (at - knots[i]);
  }
  long branch(const Point& p) const override {
    return std::count_if(knots.begin(), knots.end(), [&](double knot) { return u(p) > knot; });
  }

 private:
  std::vector<double> knots, values;
  bool clips;
};

/// Expressions that the random diagrams write, each by hand.
class Bent : public Law {
 public:
  explicit Bent(const Block& b) : a(b.number("a")), b_(b.number("b")) {}
  void output(const Point& p, double* y) const override {
    *y = std::max(u(p), a) - 0.5 * std::min(u(p), b_) + std::abs(u(p));
  }
  long branch(const Point& p) const override { return (u(p) > a) + 2 * (u(p) > b_) + 4 * (u(p) > 0); }

 private:
  double a, b_;
};
class Waved : public Law {
 public:
  explicit Waved(const Block& b) : a(b.number("a")), b_(b.number("b")) {}
  void output(const Point& p, double* y) const override {
    *y = a * std::sin(u(p) / b_) + u(p) * u(p) / std::sqrt(b_ * b_ + u(p) * u(p));
  }

 private:
  double a, b_;
};
LawPointer expression(const Block& b) {
  const std::string y = b.text("y", "");
  if (y == "a*sin(u/b) + u^2/sqrt(b^2 + u^2)") return std::make_unique<Waved>(b);
  if (y == "max(u, a) - 0.5*min(u, b) + abs(u)") return std::make_unique<Bent>(b);
  if (y == "if(u > a, b, c)") return std::make_unique<Level>(b.number("a"), b.number("b"), b.number("c"));
  throw Unknown("expression " + y);
}

}  // namespace

LawPointer make_static(const Block& b) {
  if (b.type == "gain") return std::make_unique<Gain>(b.number("gain"), 0);
  if (b.type == "pass") return std::make_unique<Gain>(1, 0);
  if (b.type == "calibration") return std::make_unique<Gain>(b.number("gain", 1), b.number("offset", 0));
  if (b.type == "sum") return std::make_unique<Sum>(b);
  if (b.type == "product") return std::make_unique<Product>();
  if (b.type == "cross_coupling") return std::make_unique<CrossCoupling>(b);
  if (b.type == "manual_switch") return std::make_unique<ManualSwitch>(b);
  if (b.type == "saturation") return std::make_unique<Saturation>(b);
  if (b.type == "soft_saturation") return std::make_unique<SoftSaturation>(b);
  if (b.type == "rectifier") return std::make_unique<Rectifier>(b);
  if (b.type == "polynomial") return std::make_unique<Polynomial>(b);
  if (b.type == "rounding") return std::make_unique<Rounding>(b);
  if (b.type == "relay") return std::make_unique<Relay>(b);
  if (b.type == "expression") return expression(b);
  if (b.type == "lookup") return std::make_unique<Table>(b);
  if (b.type == "comparator") return std::make_unique<Level>(b.number("level"), b.number("above"), b.number("below"));
  if (b.type == "switch") return std::make_unique<Switch>(b);
  if (b.type == "min_max") return std::make_unique<Larger>(b);
  return nullptr;
}

}  // namespace reference
