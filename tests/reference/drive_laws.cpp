// Laws of drives: a continuous PID controller with limits, a motor with brushes, a gear with play and losses.
#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/reference/elements.h"
#include "tests/reference/law.h"

namespace reference {
namespace {

/// kp (b r - m + lead d) + I + kd d, whose derivative d is filtered; limits, a follower of limited rate, anti-windup.
class Pid : public Law {
 public:
  explicit Pid(const Block& b)
      : gains(pid_gains(b)),
        weight(b.number("setpoint_weight", 1)),
        lower(b.number("lower", -never)),
        upper(b.number("upper", never)),
        rate(b.number("rate", 0)),
        follow(b.number("follow_time", 1e-3)),
        initial(b.number("initial", 0)),
        of_error(b.text("derivative_on", "measured") == "error"),
        follows(b.text("output_rate", "free") == "limited"),
        tracks(b.type == "pid_tracking"),
        windup(b.text("anti_windup", "back_calculation")) {}
  std::vector<std::string> inputs() const override { return pid_inputs(tracks); }
  int states() const override { return follows ? 3 : 2; }
  bool direct() const override { return !follows; }
  void start(double* values) const override {
    values[x] = initial;
    values[x + 1] = 0;
    if (follows) values[x + 2] = std::clamp(initial, lower, upper);
  }
  void output(const Point& p, double* y) const override { *y = given(p); }
  void rates(const Point& p, double* dx) const override {
    const double pushed = gains.ki * (u(p) - u(p, 1) + gains.lead * slope(p));
    dx[x] = pushed;
    if (windup == "back_calculation" && gains.ki != 0)
      dx[x] += ((tracks ? u(p, 2) : given(p)) - raw(p)) / gains.tracking;
    if (windup == "clamping") dx[x] *= 1 - std::clamp(beyond(p, pushed), 0.0, 1.0);
    dx[x + 1] = slope(p);
    if (follows) dx[x + 2] = std::clamp(asked(p), -rate, rate);
  }
  long branch(const Point& p) const override {
    const double pushed = gains.ki * (u(p) - u(p, 1) + gains.lead * slope(p));
    long b = side(raw(p), lower, upper);
    if (windup == "clamping") b = 3 * (3 * b + side(beyond(p, pushed), 0, 1)) + (pushed > 0);
    if (follows) b = 3 * b + side(asked(p), -rate, rate);
    return b;
  }
  double fastest() const override {
    double time = gains.filter;
    if (gains.ki != 0) time = std::min(time, gains.tracking);
    return follows ? std::min(time, follow) : time;
  }

 private:
  static long side(double v, double low, double high) { return v > high ? 1 : v < low ? -1 : 0; }
  double slope(const Point& p) const { return ((of_error ? u(p) - u(p, 1) : -u(p, 1)) - p.x[x + 1]) / gains.filter; }
  double raw(const Point& p) const {
    const double d = slope(p);
    return gains.kp * (weight * u(p) - u(p, 1) + gains.lead * d) + p.x[x] + gains.kd * d;
  }
  double given(const Point& p) const { return follows ? p.x[x + 2] : std::clamp(raw(p), lower, upper); }
  double asked(const Point& p) const { return (std::clamp(raw(p), lower, upper) - p.x[x + 2]) / follow; }
  /// How far behind the limit that the integral is pushed to, in thousandths of the range: there it comes to rest.
  double beyond(const Point& p, double pushed) const {
    return (pushed > 0 ? raw(p) - upper : lower - raw(p)) / (1e-3 * (upper - lower));
  }
  PidGains gains;
  double weight, lower, upper, rate, follow, initial;
  bool of_error, follows, tracks;
  std::string windup;
};

class DcMotor : public Law {
 public:
  explicit DcMotor(const Block& b)
      : resistance(b.number("resistance")),
        inductance(b.number("inductance")),
        kt(b.number("torque_constant")),
        ke(b.number("back_emf", 0)),
        inertia(b.number("inertia")),
        damping(b.number("damping", 0)),
        angle(b.number("initial_angle", 0)),
        speed(b.number("initial_velocity", 0)) {
    if (ke == 0) ke = kt;
    if (b.type == "dc_motor_with_presliding") bearings.emplace(b);
  }
  std::vector<std::string> inputs() const override { return {"voltage", "load"}; }
  std::vector<std::string> outputs() const override { return {"angle", "velocity", "current"}; }
  int states() const override { return 3 + (bearings ? bearings->count() : 0); }
  bool direct() const override { return false; }
  void start(double* values) const override {
    std::fill_n(values + x, states(), 0.0);
    values[x] = angle;
    values[x + 1] = speed;
  }
  void output(const Point& p, double* y) const override { std::copy_n(p.x + x, 3, y); }
  void rates(const Point& p, double* dx) const override {
    const double w = p.x[x + 1], i = p.x[x + 2];
    dx[x] = w;
    const double held = bearings ? bearings->hold(w, p.x + x + 3) : 0;
    for (int k = 3; k < states(); ++k) dx[x + k] = bearings->rate(w, p.x[x + k], k - 3);
    dx[x + 1] = (kt * i - damping * w - u(p, 1) - held) / inertia;
    dx[x + 2] = (u(p) - resistance * i - ke * w) / inductance;
  }
  long branch(const Point& p) const override { return bearings && p.x[x + 1] < 0; }
  double fastest() const override {
    const double spring = bearings ? std::sqrt(bearings->stiffness() / inertia) : 0;
    return 1 /
           std::max({spring, resistance / inductance, damping / inertia, std::sqrt(kt * ke / (inertia * inductance))});
  }

 private:
  double resistance, inductance, kt, ke, inertia, damping, angle, speed;
  std::optional<Elements> bearings{};
};

/// Stiffness and damping in contact, which never pull where there is play; the driver feels the losses. `lever`: way of
/// the driven side per angle of the driver.
class Transmission : public Law {
 public:
  Transmission(const Block& b, double lever_)
      : lever(lever_),
        turns(b.type == "gear"),
        longer(1 + b.number("pitch_error", 0)),
        wobble(b.number("wobble", 0)),
        phase(b.number("wobble_phase", 0)),
        stiffness(b.number("stiffness")),
        damping(b.number("damping", 0)),
        half(b.number("gap", 0) / 2),
        efficiency(b.number("efficiency", 1)) {}
  std::vector<std::string> inputs() const override {
    if (turns) return {"angle_in", "velocity_in", "angle_out", "velocity_out"};
    return {"angle", "angular_velocity", "position", "velocity"};
  }
  std::vector<std::string> outputs() const override {
    if (turns) return {"torque_out", "torque_in"};
    return {"force", "torque"};
  }
  int roughness() const override { return half > 0 && damping > 0 ? 0 : 1; }  // the damping sets in at once
  void output(const Point& p, double* y) const override {
    const double force = between(p), drives = force < 0 ? -1 : 1;
    const double way = drives * std::tanh(u(p, 1) / 0.01);  // 1: power goes from the driver to the driven side
    y[0] = force;
    y[1] = lever * force * ((1 + way) / 2 / efficiency + (1 - way) / 2 * efficiency);
  }
  long branch(const Point& p) const override {
    const double f = between(p);
    const long contact = half > 0 ? (ahead(p) > half ? 1 : ahead(p) < -half ? -1 : 0) : 0;
    return 3 * contact + (half > 0 || efficiency < 1 ? (f > 0 ? 1 : f < 0 ? -1 : 0) : 0);
  }

 private:
  double ahead(const Point& p) const { return lever * longer * u(p) + wobble * std::sin(u(p) + phase) - u(p, 2); }
  double between(const Point& p) const {
    const double s = ahead(p);
    const double rate = damping * ((lever * longer + wobble * std::cos(u(p) + phase)) * u(p, 1) - u(p, 3));
    if (half == 0) return stiffness * s + rate;
    if (s > half) return std::max(0.0, stiffness * (s - half) + rate);
    return s < -half ? std::min(0.0, stiffness * (s + half) + rate) : 0;
  }
  double lever;
  bool turns;
  double longer, wobble, phase, stiffness, damping, half, efficiency;
};

}  // namespace

std::vector<std::string> pid_inputs(bool tracks) {
  return tracks ? std::vector<std::string>{"reference", "measured", "tracked"}
                : std::vector<std::string>{"reference", "measured"};
}

PidGains pid_gains(const Block& b) {
  PidGains g;
  g.kp = b.number("kp");
  const double ti = b.number("integral_time", 0), td = b.number("derivative_time", 0);
  const std::string form = b.text("form", "parallel");
  if (form == "parallel") {
    g.ki = b.number("ki", 0);
    g.kd = b.number("kd", 0);
  } else {
    g.ki = ti > 0 ? g.kp / ti : 0;
    (form == "standard" ? g.kd : g.lead) = form == "standard" ? g.kp * td : td;
  }
  g.filter = b.number("filter", 0);
  if (g.filter == 0) g.filter = g.lead > 0 ? g.lead / 10 : g.kd != 0 ? std::abs(g.kd / g.kp) / 10 : 1;
  g.tracking = b.number("tracking_time", 0);
  if (g.tracking == 0 && g.ki != 0) g.tracking = std::abs(g.kp / g.ki);
  return g;
}

LawPointer make_drive(const Block& b) {
  if (b.type == "pid" || b.type == "pid_tracking") return std::make_unique<Pid>(b);
  if (b.type == "dc_motor" || b.type == "dc_motor_with_presliding") return std::make_unique<DcMotor>(b);
  if (b.type == "gear") return std::make_unique<Transmission>(b, 1 / b.number("ratio"));
  if (b.type == "belt") return std::make_unique<Transmission>(b, b.number("radius"));
  if (b.type == "ball_screw") return std::make_unique<Transmission>(b, b.number("pitch") / (2 * std::acos(-1.0)));
  return nullptr;
}

}  // namespace reference
