// Bodies: one mass on a spring, with what holds it back.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/elements.h"
#include "tests/reference/law.h"

namespace reference {
namespace {

/// An inertia has the law of a mass and words of its own.
bool turns(const Block& b) { return b.type.rfind("inertia", 0) == 0; }

/// mass dv/dt = force - damping v - stiffness x - what an heir holds back.
class Body : public Law {
 public:
  explicit Body(const Block& b)
      : rotates(turns(b)),
        mass(b.number(rotates ? "inertia" : "mass")),
        damping(b.number("damping", 0)),
        stiffness(b.number("stiffness", 0)),
        x0(b.number(rotates ? "initial_angle" : "initial_position", 0)),
        v0(b.number("initial_velocity", 0)) {}
  std::vector<std::string> inputs() const override { return {rotates ? "torque" : "force"}; }
  std::vector<std::string> outputs() const override { return {rotates ? "angle" : "position", "velocity"}; }
  int states() const override { return 2; }
  bool direct() const override { return false; }
  int smooths() const override { return 2; }
  void start(double* values) const override {
    values[x] = x0;
    values[x + 1] = v0;
  }
  void output(const Point& p, double* y) const override {
    y[0] = p.x[x];
    y[1] = p.x[x + 1];
  }
  void rates(const Point& p, double* dx) const override {
    dx[x] = p.x[x + 1];
    dx[x + 1] = (pull(p) - damping * p.x[x + 1] - held_back(p)) / mass;
  }
  double fastest() const override { return 1 / std::max({std::sqrt(stiffness / mass), damping / mass, 1e-9}); }

 protected:
  virtual double held_back(const Point&) const { return 0; }
  double pull(const Point& p) const { return u(p) - stiffness * p.x[x]; }
  bool rotates;
  double mass, damping, stiffness, x0, v0;
};

class StiffeningBody : public Body {
 public:
  explicit StiffeningBody(const Block& b)
      : Body(b),
        cubic(b.number("stiffening", 0)),
        quadratic(b.number("quadratic", 0)),
        quintic(b.number("quintic", 0)),
        drag(b.number("drag", 0)) {}

 protected:
  double held_back(const Point& p) const override {
    const double q = p.x[x], v = p.x[x + 1];
    return drag * v * std::abs(v) + q * q * (quadratic + q * (cubic + q * q * quintic));
  }

 private:
  double cubic, quadratic, quintic, drag;
};

/// Dry friction that truly sticks.
class FrictionBody : public Body {
 public:
  explicit FrictionBody(const Block& b)
      : Body(b),
        coulomb(b.number("coulomb")),
        breakaway(b.number("breakaway")),
        stribeck(b.number("stribeck_velocity", 0)),
        mode(v0 > 0   ? 1
             : v0 < 0 ? -1
                      : 0) {}
  void rates(const Point& p, double* dx) const override {
    if (mode == 0)
      dx[x] = dx[x + 1] = 0;
    else
      Body::rates(p, dx);
  }
  long branch(const Point& p) const override {
    if (mode != 0) return mode * p.x[x + 1] < 0;
    return std::abs(pull(p)) >= breakaway;
  }
  bool change(const Point& p, double* values) override {
    if (branch(p) == 0) return false;
    const int before = mode;
    const double force = pull(p);
    mode = std::abs(force) < breakaway || force == 0 ? 0 : force > 0 ? 1 : -1;
    values[x + 1] = 0;
    return mode != before;
  }

 protected:
  double held_back(const Point& p) const override {
    const double v = std::max(0.0, mode * p.x[x + 1]);
    const double excess = stribeck > 0 ? std::exp(-(v / stribeck) * (v / stribeck)) : 0;
    return mode * (coulomb + (breakaway - coulomb) * excess);
  }

 private:
  double coulomb, breakaway, stribeck;
  int mode;  ///< sticking, sliding up or down
};

/// Two hard stops, Newton's restitution.
class StoppedBody : public Body {
 public:
  explicit StoppedBody(const Block& b)
      : Body(b),
        lower(b.number("lower")),
        upper(b.number("upper")),
        restitution(b.number("restitution", 0)),
        rest_speed(b.number("rest_speed", 1e-6)) {}
  void rates(const Point& p, double* dx) const override {
    if (mode != 0)
      dx[x] = dx[x + 1] = 0;
    else
      Body::rates(p, dx);
  }
  long branch(const Point& p) const override {
    if (mode != 0) return mode * pull(p) < 0;  // it is drawn away
    return p.x[x] > upper ? 1 : p.x[x] < lower ? -1 : 0;
  }
  bool change(const Point& p, double* values) override {
    const long side = branch(p);
    if (side == 0) return false;
    if (mode != 0) {
      mode = 0;
      return true;
    }
    values[x] = side > 0 ? upper : lower;
    const double back = restitution * std::abs(values[x + 1]);
    values[x + 1] = back > rest_speed ? -static_cast<double>(side) * back : 0;
    if (values[x + 1] == 0 && static_cast<double>(side) * (u(p) - stiffness * values[x]) > 0)
      mode = static_cast<int>(side);
    return true;
  }

 private:
  double lower, upper, restitution, rest_speed;
  int mode = 0;  ///< free, or at the stop of this side
};

/// Elements beside the spring that stick and slip.
class PreslidingBody : public StiffeningBody {
 public:
  PreslidingBody(const Block& b, bool yield) : StiffeningBody(b), elements(b, yield) {}
  int states() const override { return 2 + elements.count(); }
  void rates(const Point& p, double* dx) const override {
    const double v = p.x[x + 1];
    for (int i = 0; i < elements.count(); ++i) dx[x + 2 + i] = elements.rate(v, p.x[x + 2 + i], i);
    Body::rates(p, dx);
  }
  long branch(const Point& p) const override { return p.x[x + 1] < 0; }
  double fastest() const override {
    return 1 / std::max(std::sqrt((stiffness + elements.stiffness()) / mass), damping / mass);
  }

 protected:
  double held_back(const Point& p) const override {
    return StiffeningBody::held_back(p) + elements.hold(p.x[x + 1], p.x + x + 2);
  }

 private:
  Elements elements;
};

/// Magnets draw it to certain angles.
class CoggingBody : public Body {
 public:
  explicit CoggingBody(const Block& b)
      : Body(b),
        cosine(b.number("cosine")),
        sine(b.number("sine")),
        periods(b.type == "mass_with_cogging" ? 2 * std::numbers::pi / b.number("period") : b.number("periods")) {}

 protected:
  double held_back(const Point& p) const override {
    const double phase = periods * p.x[x];
    return -cosine * std::cos(phase) - sine * std::sin(phase);
  }

 private:
  double cosine, sine, periods;
};

}  // namespace

LawPointer make_body(const Block& b) {
  if (b.type == "mass_spring_damper" || b.type == "inertia") return std::make_unique<Body>(b);
  if (b.type == "mass_on_stiffening_spring" || b.type == "mass_with_drag" || b.type == "inertia_with_drag")
    return std::make_unique<StiffeningBody>(b);
  if (b.type == "mass_with_friction" || b.type == "inertia_with_friction") return std::make_unique<FrictionBody>(b);
  if (b.type == "mass_with_stops") return std::make_unique<StoppedBody>(b);
  if (b.type == "mass_with_presliding" || b.type == "inertia_with_presliding")
    return std::make_unique<PreslidingBody>(b, false);
  if (b.type == "inertia_with_cogging" || b.type == "mass_with_cogging") return std::make_unique<CoggingBody>(b);
  if (b.type == "mass_on_hysteretic_spring") return std::make_unique<PreslidingBody>(b, true);
  return nullptr;
}

}  // namespace reference
