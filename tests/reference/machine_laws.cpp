// Laws of machines: coils and windings, bridges and their modulator, motors in their own frame, a battery, a propeller,
// arms and motors in bearings that stick and slip.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "tests/reference/elements.h"
#include "tests/reference/stepwise.h"

namespace reference {
namespace {

using std::numbers::pi;

/// inductance di/dt = voltage - resistance i - induced * second input.
class Coil : public Law {
 public:
  Coil(const Block& b, double pushes_, double induced_)
      : type(b.type),
        resistance(b.number("resistance")),
        inductance(b.number("inductance")),
        initial(b.number("initial", 0)),
        pushes(pushes_),
        induced(induced_) {}
  std::vector<std::string> inputs() const override { return {"voltage", type == "winding" ? "emf" : "velocity"}; }
  std::vector<std::string> outputs() const override {
    if (type == "winding") return {"current"};
    return {type == "voice_coil" ? "force" : "torque", "current"};
  }
  int states() const override { return 1; }
  bool direct() const override { return false; }
  void start(double* v) const override { v[x] = initial; }
  void output(const Point& p, double* y) const override {
    y[0] = pushes * p.x[x];
    if (type != "winding") y[1] = p.x[x];
  }
  void rates(const Point& p, double* dx) const override {
    dx[x] = (u(p) - resistance * p.x[x] - induced * u(p, 1)) / inductance;
  }
  double fastest() const override { return inductance / resistance; }

 private:
  std::string type;
  double resistance, inductance, initial, pushes, induced;
};

class Bridge : public Stepwise {
 public:
  explicit Bridge(const Block& b)
      : supply(b.number("supply")), resistance(b.number("resistance", 0)), loss(b.number("loss", 0)) {}
  std::vector<std::string> inputs() const override { return {"gate", "current"}; }
  void output(const Point& p, double* y) const override {
    *y = supply * u(p) - resistance * u(p, 1) - loss * static_cast<double>(at(p));
  }

 private:
  long now(const Point& p) const override { return loss == 0 ? 0 : u(p, 1) > 0 ? 1 : u(p, 1) < 0 ? -1 : 0; }
  double supply, resistance, loss;
};

/// Natural sampling by a triangle that begins at -1.
class Pulses : public Stepwise {
 public:
  explicit Pulses(const Block& b) : frequency(b.number("frequency")), modulation(b.text("modulation", "bipolar")) {}
  void output(const Point& p, double* y) const override { *y = static_cast<double>(at(p)); }
  double largest_step() const override { return 0.01 / frequency; }
  /// Of the two legs of a bridge, that no pulse between them is missed.
  long branch(const Point& p) const override { return 2L * (u(p) > carrier(p)) + (-u(p) > carrier(p)) + 4 * now(p); }

 private:
  double carrier(const Point& p) const {
    const double phase = frequency * p.t - std::floor(frequency * p.t);
    return phase < 0.5 ? 4 * phase - 1 : 3 - 4 * phase;
  }
  long now(const Point& p) const override {
    if (modulation == "single") return 2 * u(p) - 1 > carrier(p);
    if (modulation == "unipolar") return (u(p) > carrier(p)) - (-u(p) > carrier(p));
    return u(p) > carrier(p) ? 1 : -1;
  }
  double frequency;
  std::string modulation;
};

class Battery : public Law {
 public:
  explicit Battery(const Block& b)
      : capacity(b.number("capacity")),
        resistance(b.number("resistance")),
        initial(b.number("initial", 1)),
        charges(b.list("charges")),
        voltages(b.list("open_circuit")),
        resistances(b.list("resistances")),
        times(b.list("times")) {}
  std::vector<std::string> inputs() const override { return {"current"}; }
  std::vector<std::string> outputs() const override { return {"voltage", "charge"}; }
  int states() const override { return 1 + static_cast<int>(times.size()); }
  void start(double* v) const override {
    v[x] = initial;
    std::fill_n(v + x + 1, times.size(), 0.0);
  }
  void output(const Point& p, double* y) const override {
    const std::size_t i = piece(p);
    y[1] = p.x[x];
    y[0] = voltages[i] + (voltages[i + 1] - voltages[i]) / (charges[i + 1] - charges[i]) * (y[1] - charges[i]) -
           resistance * u(p);
    for (std::size_t k = 0; k < times.size(); ++k) y[0] -= resistances[k] * p.x[x + 1 + k];
  }
  void rates(const Point& p, double* dx) const override {
    dx[x] = -u(p) / capacity;
    for (std::size_t k = 0; k < times.size(); ++k) dx[x + 1 + k] = (u(p) - p.x[x + 1 + k]) / times[k];
  }
  long branch(const Point& p) const override { return static_cast<long>(piece(p)); }
  double fastest() const override { return *std::min_element(times.begin(), times.end()); }

 private:
  std::size_t piece(const Point& p) const {
    std::size_t i = 0;
    while (i + 2 < charges.size() && p.x[x] > charges[i + 1]) ++i;
    return i;
  }
  double capacity, resistance, initial;
  std::vector<double> charges, voltages, resistances, times;
};

class Propeller : public Law {
 public:
  explicit Propeller(const Block& b)
      : lift(b.number("thrust_coefficient")),
        drag(b.number("torque_coefficient", 0)),
        time(b.number("time")),
        initial(b.number("initial", 0)) {}
  std::vector<std::string> inputs() const override { return {"command"}; }
  std::vector<std::string> outputs() const override { return {"thrust", "torque", "speed"}; }
  int states() const override { return 1; }
  bool direct() const override { return false; }
  void start(double* v) const override { v[x] = initial; }
  void output(const Point& p, double* y) const override {
    const double w = p.x[x];
    y[0] = lift * w * std::abs(w);
    y[1] = drag * w * std::abs(w);
    y[2] = w;
  }
  void rates(const Point& p, double* dx) const override { dx[x] = (u(p) - p.x[x]) / time; }
  long branch(const Point& p) const override { return p.x[x] < 0; }
  double fastest() const override { return time; }

 private:
  double lift, drag, time, initial;
};

/// An arm under gravity; its pivot may stick and slip.
class Arm : public Law {
 public:
  explicit Arm(const Block& b)
      : inertia(b.number("inertia", 0) + b.number("mass") * b.number("length") * b.number("length")),
        weight(b.number("mass") * b.number("gravity", 9.80665) * b.number("length")),
        damping(b.number("damping", 0)),
        angle(b.number("initial_angle", 0)),
        speed(b.number("initial_speed", 0)) {
    if (b.type == "pendulum_with_presliding") bearings.emplace(b);
  }
  std::vector<std::string> inputs() const override { return {"torque"}; }
  std::vector<std::string> outputs() const override { return {"angle", "speed"}; }
  int states() const override { return 2 + (bearings ? bearings->count() : 0); }
  bool direct() const override { return false; }
  void start(double* v) const override {
    std::fill_n(v + x, states(), 0.0);
    v[x] = angle;
    v[x + 1] = speed;
  }
  void output(const Point& p, double* y) const override { std::copy_n(p.x + x, 2, y); }
  void rates(const Point& p, double* dx) const override {
    const double w = p.x[x + 1];
    double torque = u(p) - damping * w - weight * std::sin(p.x[x]);
    if (bearings) {
      torque -= bearings->hold(w, p.x + x + 2);
      for (int i = 0; i < bearings->count(); ++i) dx[x + 2 + i] = bearings->rate(w, p.x[x + 2 + i], i);
    }
    dx[x] = w;
    dx[x + 1] = torque / inertia;
  }
  long branch(const Point& p) const override { return bearings && p.x[x + 1] < 0; }
  double fastest() const override {
    const double held = weight + (bearings ? bearings->stiffness() : 0);
    return 1 / std::max(std::sqrt(held / inertia), damping / inertia);
  }

 private:
  double inertia, weight, damping, angle, speed;
  std::optional<Elements> bearings{};
};

/// Direct and quadrature currents, or those of two phases of a stepper: two coils, their torque.
class Phases : public Law {
 public:
  explicit Phases(const Block& b)
      : steps(b.type == "stepper_motor"),
        resistance(b.number("resistance")),
        first(b.number(steps ? "inductance" : "inductance_d")),
        second(b.number(steps ? "inductance" : "inductance_q")),
        constant(b.number(steps ? "torque_constant" : "flux")),
        periods(steps ? b.number("teeth", 50) : b.number("pole_pairs")),
        detent(b.number("detent", 0)) {}
  std::vector<std::string> inputs() const override {
    if (steps) return {"voltage_a", "voltage_b", "angle", "speed"};
    return {"voltage_d", "voltage_q", "speed"};
  }
  std::vector<std::string> outputs() const override {
    if (steps) return {"torque", "current_a", "current_b"};
    return {"torque", "current_d", "current_q"};
  }
  int states() const override { return 2; }
  bool direct() const override { return steps; }  // its torque hangs on the angle
  void output(const Point& p, double* y) const override {
    const double a = p.x[x], b = p.x[x + 1];
    y[1] = a;
    y[2] = b;
    if (steps) {
      const double angle = periods * u(p, 2);
      y[0] = constant * (b * std::cos(angle) - a * std::sin(angle)) - detent * std::sin(4 * angle);
    } else {
      y[0] = 1.5 * periods * (constant * b + (first - second) * a * b);
    }
  }
  void rates(const Point& p, double* dx) const override {
    const double a = p.x[x], b = p.x[x + 1], w = u(p, steps ? 3 : 2);
    const double angle = steps ? periods * u(p, 2) : 0;
    const double to_a = steps ? constant * w * std::sin(angle) : periods * w * second * b;
    const double to_b = steps ? -constant * w * std::cos(angle) : -periods * w * (first * a + constant);
    dx[x] = (u(p, 0) - resistance * a + to_a) / first;
    dx[x + 1] = (u(p, 1) - resistance * b + to_b) / second;
  }
  double fastest() const override { return std::min(first, second) / resistance; }

 private:
  bool steps;
  double resistance, first, second, constant, periods, detent;
};

}  // namespace

LawPointer make_machine(const Block& b) {
  if (b.type == "winding") return std::make_unique<Coil>(b, 1, 1);
  if (b.type == "voice_coil") return std::make_unique<Coil>(b, b.number("force_constant"), b.number("force_constant"));
  if (b.type == "dc_winding") {
    const double kt = b.number("torque_constant"), ke = b.number("back_emf", 0);
    return std::make_unique<Coil>(b, kt, ke == 0 ? kt : ke);
  }
  if (b.type == "h_bridge" || b.type == "h_bridge_with_dead_time") return std::make_unique<Bridge>(b);
  if (b.type == "pwm") return std::make_unique<Pulses>(b);
  if (b.type == "battery_cell") return std::make_unique<Battery>(b);
  if (b.type == "propeller") return std::make_unique<Propeller>(b);
  if (b.type == "pendulum" || b.type == "pendulum_with_presliding") return std::make_unique<Arm>(b);
  if (b.type == "synchronous_motor" || b.type == "stepper_motor") return std::make_unique<Phases>(b);
  return nullptr;
}

}  // namespace reference
