// Laws without memory, by name: what lies beyond a zone or within a period, signs, quotients, functions of an angle,
// counts of an encoder.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/stepwise.h"

namespace reference {
namespace {

using std::numbers::pi;

class DeadZone : public Law {
 public:
  explicit DeadZone(const Block& b) : lower(b.number("lower")), upper(b.number("upper")) {}
  void output(const Point& p, double* y) const override { *y = u(p) - std::max(lower, std::min(upper, u(p))); }
  long branch(const Point& p) const override { return u(p) > upper ? 1 : u(p) < lower ? -1 : 0; }

 private:
  double lower, upper;
};

class Wrap : public Stepwise {
 public:
  explicit Wrap(const Block& b) : period(b.number("period")), lower(b.number("lower", 0)) {}
  void output(const Point& p, double* y) const override { *y = u(p) - period * static_cast<double>(at(p)); }

 private:
  long now(const Point& p) const override { return static_cast<long>(std::floor((u(p) - lower) / period)); }
  double period, lower;
};

class Sign : public Stepwise {
 public:
  void output(const Point& p, double* y) const override { *y = static_cast<double>(at(p)); }

 private:
  long now(const Point& p) const override { return u(p) > 0 ? 1 : u(p) < 0 ? -1 : 0; }
};

class Absolute : public Law {
 public:
  void output(const Point& p, double* y) const override { *y = std::abs(u(p)); }
  long branch(const Point& p) const override { return u(p) < 0; }
};

class Quotient : public Law {
 public:
  std::vector<std::string> inputs() const override { return {"a", "b"}; }
  void output(const Point& p, double* y) const override { *y = u(p, 0) / u(p, 1); }
};

class Function : public Law {
 public:
  explicit Function(double (*of_)(double)) : of(of_) {}
  std::vector<std::string> inputs() const override { return {""}; }
  void output(const Point& p, double* y) const override { *y = of(u(p)); }

 private:
  double (*of)(double);
};

/// Of y and x: it jumps by a turn where y passes through zero and x is negative.
class Direction : public Stepwise {
 public:
  std::vector<std::string> inputs() const override { return {"", ""}; }
  void output(const Point& p, double* y) const override {
    *y = std::atan2(u(p, 0), u(p, 1));
    const long side = at(p);
    if (side != 0 && static_cast<double>(side) * *y < -pi / 2) *y += 2 * pi * static_cast<double>(side);
  }

 private:
  long now(const Point& p) const override { return u(p, 1) >= 0 ? 0 : u(p, 0) < 0 ? -1 : 1; }
};

LawPointer function(const Block& b) {
  const std::string name = b.text("function", "sin");
  if (name == "atan2") return std::make_unique<Direction>();
  static const std::map<std::string, double (*)(double)> all{
      {"sin", std::sin}, {"cos", std::cos}, {"atan", std::atan}, {"sinh", std::sinh}, {"tanh", std::tanh}};
  const auto at = all.find(name);
  if (at == all.end()) throw Unknown("function " + name);
  return std::make_unique<Function>(at->second);
}

class Encoder : public Stepwise {
 public:
  Encoder(const Block& b, double pitch_)
      : pitch(pitch_),
        step(pitch_ / b.number("divisions", 4)),
        cosine(b.number("error_cosine", 0)),
        sine(b.number("error_sine", 0)) {}
  void output(const Point& p, double* y) const override { *y = step * static_cast<double>(at(p)); }

 private:
  long now(const Point& p) const override {
    const double phase = 2 * pi * u(p) / pitch;
    return std::lround((u(p) + cosine * std::cos(phase) + sine * std::sin(phase)) / step);
  }
  double pitch, step, cosine, sine;
};

}  // namespace

LawPointer make_math(const Block& b) {
  if (b.type == "dead_zone") return std::make_unique<DeadZone>(b);
  if (b.type == "wrap") return std::make_unique<Wrap>(b);
  if (b.type == "sign") return std::make_unique<Sign>();
  if (b.type == "abs") return std::make_unique<Absolute>();
  if (b.type == "divide") return std::make_unique<Quotient>();
  if (b.type == "trigonometry") return function(b);
  if (b.type == "encoder") return std::make_unique<Encoder>(b, 2 * pi / b.number("lines"));
  if (b.type == "linear_encoder") return std::make_unique<Encoder>(b, b.number("pitch"));
  return nullptr;
}

}  // namespace reference
