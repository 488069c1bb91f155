// Laws that run at their instants and hold between: at an instant each reads what its inputs are then.
#include <algorithm>
#include <cmath>

#include "tests/reference/stepwise.h"

namespace reference {
namespace {

class Sampled : public Law {
 public:
  explicit Sampled(const Block& b) : period(b.number("period")), offset(b.number("offset", 0)) {}
  double next() const override { return offset + k * period; }
  int roughness() const override { return 0; }
  int smooths() const override { return smooth; }  // between its instants nothing gets through
  void arrive(double t) override { due = next() <= t + same_instant; }
  void output(const Point& p, double* y) const override { *y = p.free && due ? computed(p) : held; }
  void leave(const Point& p) override {
    if (!due) return;
    run(p);
    due = false;
    ++k;
  }

 protected:
  virtual double computed(const Point& p) const = 0;
  virtual void run(const Point& p) { held = computed(p); }
  double period, offset, held = 0, k = 0;
  bool due = false;

 private:
  static constexpr int smooth = 9;
};

class SampleHold : public Sampled {
 public:
  using Sampled::Sampled;

 protected:
  double computed(const Point& p) const override { return u(p); }
};

class Quantizer : public Sampled {
 public:
  explicit Quantizer(const Block& b)
      : Sampled(b),
        lower(b.number("lower")),
        upper(b.number("upper")),
        q((upper - lower) / std::exp2(b.number("bits"))) {}

 protected:
  double computed(const Point& p) const override {
    return std::clamp(lower + q * std::round((u(p) - lower) / q), lower, upper - q);
  }

 private:
  double lower, upper, q;
};

class DelayLine : public Sampled {
 public:
  explicit DelayLine(const Block& b)
      : Sampled(b), line(static_cast<std::size_t>(b.number("samples")), b.number("before", 0)) {}
  bool direct() const override { return line.empty(); }

 protected:
  double computed(const Point& p) const override { return line.empty() ? u(p) : line.front(); }
  void run(const Point& p) override {
    held = computed(p);
    if (line.empty()) return;
    line.erase(line.begin());
    line.push_back(u(p));
  }

 private:
  std::vector<double> line;
};

/// The difference equation itself, with the last inputs and outputs.
class DiscreteTransferFunction : public Sampled {
 public:
  explicit DiscreteTransferFunction(const Block& b)
      : DiscreteTransferFunction(b, b.number("gain", 1), numerator(b), b.list("den")) {}
  DiscreteTransferFunction(const Block& b, double gain_, std::vector<double> num_, std::vector<double> den_)
      : Sampled(b), gain(gain_), num(std::move(num_)), den(std::move(den_)) {
    const double before = b.number("before", 0);
    double above = 0, below = 0;
    for (const double n : num) above += n;
    for (const double d : den) below += d;
    last_u.assign(num.size(), before);
    last_y.assign(den.size(), before == 0 ? 0 : before * above / below);
  }
  bool direct() const override { return num[0] != 0; }

 protected:
  double computed(const Point& p) const override { return gain * plain(p); }
  void run(const Point& p) override {
    const double y = plain(p);
    last_u.insert(last_u.begin(), u(p));
    last_u.pop_back();
    last_y.insert(last_y.begin(), y);
    last_y.pop_back();
    held = gain * y;
  }

 private:
  static std::vector<double> numerator(const Block& b) {
    auto all = b.list("num");
    if (b.text("direct", "yes") == "no") all.insert(all.begin(), 0.0);
    return all;
  }
  double plain(const Point& p) const {
    double y = num[0] == 0 ? 0 : num[0] * u(p);
    for (std::size_t i = 1; i < num.size(); ++i) y += num[i] * last_u[i - 1];
    for (std::size_t i = 1; i < den.size(); ++i) y -= den[i] * last_y[i - 1];
    return y / den[0];
  }
  double gain;
  std::vector<double> num, den, last_u{}, last_y{};
};

/// One input and one output; the matrices row by row.
class DiscreteStateSpace : public Sampled {
 public:
  explicit DiscreteStateSpace(const Block& b)
      : Sampled(b),
        a(b.list("a")),
        b_(b.list("b")),
        c(b.list("c")),
        d(b.numbers.contains("d") ? b.number("d") : 0),
        z(b_.size(), 0.0) {}
  bool direct() const override { return d != 0; }

 protected:
  double computed(const Point& p) const override {
    double y = d == 0 ? 0 : d * u(p);
    for (std::size_t i = 0; i < z.size(); ++i) y += c[i] * z[i];
    return y;
  }
  void run(const Point& p) override {
    held = computed(p);
    std::vector<double> next(z.size());
    for (std::size_t i = 0; i < z.size(); ++i) {
      next[i] = b_[i] * u(p);
      for (std::size_t j = 0; j < z.size(); ++j) next[i] += a[i * z.size() + j] * z[j];
    }
    z = next;
  }

 private:
  std::vector<double> a, b_, c;
  double d;
  std::vector<double> z;
};

/// 1 for one sample when its input has become true since the last one.
class Edge : public Sampled {
 public:
  explicit Edge(const Block& b) : Sampled(b), edges(b.text("edge", "rising")) {}

 protected:
  double computed(const Point& p) const override { return edges.at(is_true(u(p))) ? 1 : 0; }
  void run(const Point& p) override {
    held = computed(p);
    edges.take(is_true(u(p)));
  }

 private:
  Edges edges;
};

class SampledPid : public Sampled {
 public:
  explicit SampledPid(const Block& b)
      : Sampled(b),
        kp(b.number("kp")),
        ki(b.number("ki", 0)),
        kd(b.number("kd", 0)),
        filter(b.number("filter", 0)),
        lower(b.number("lower")),
        upper(b.number("upper")),
        tracking(b.number("tracking_time", 0)),
        integral(b.number("initial", 0)),
        rule(b.text("rule", "forward")),
        windup(b.text("anti_windup", "none")) {
    if (tracking == 0) tracking = ki > 0 ? std::max(kp / ki, period) : period;
  }

 protected:
  double computed(const Point& p) const override { return command(u(p)).limited; }
  void run(const Point& p) override {
    const Command c = command(u(p));
    integral = c.integral;
    if (windup == "back_calculation" && ki != 0) integral += period / tracking * (c.limited - c.wanted);
    derivative = c.derivative;
    error = u(p);
    held = c.limited;
  }

 private:
  struct Command {
    double integral, derivative, wanted, limited;
  };
  Command command(double e) const {
    Command c{};
    c.derivative = (filter * derivative + kd * (e - error)) / (filter + period);
    const double increment = ki * period * (rule == "trapezoidal" ? (e + error) / 2 : e);
    const bool at_once = rule != "forward";
    c.integral = integral + (at_once ? increment : 0);
    c.wanted = kp * e + c.integral + c.derivative;
    const bool beyond = (c.wanted > upper && increment > 0) || (c.wanted < lower && increment < 0);
    if (windup == "clamping" && beyond) {
      c.integral = integral;  // the command of this instant is the limit all the same
    } else if (!at_once) {
      c.integral += increment;
    }
    c.limited = std::clamp(c.wanted, lower, upper);
    return c;
  }
  double kp, ki, kd, filter, lower, upper, tracking, integral, derivative = 0, error = 0;
  std::string rule, windup;
};

/// Reference and measured value; before its first instant all was as it is then.
class DiscretePid : public Sampled {
 public:
  explicit DiscretePid(const Block& b)
      : Sampled(b),
        gains(pid_gains(b)),
        weight(b.number("setpoint_weight", 1)),
        lower(b.number("lower", -never)),
        upper(b.number("upper", never)),
        step(b.number("rate", 0) > 0 ? b.number("rate") * period : never),
        tracking(b.number("tracking_time", 0) > 0 ? gains.tracking : std::max(gains.tracking, period)),
        integral(b.number("initial", 0)),
        of_error(b.text("derivative_on", "measured") == "error"),
        tracks(b.type == "discrete_pid_tracking"),
        rule(b.text("rule", "forward")),
        windup(b.text("anti_windup", "back_calculation")) {}
  std::vector<std::string> inputs() const override { return pid_inputs(tracks); }

 protected:
  double computed(const Point& p) const override { return command(p).given; }
  void run(const Point& p) override {
    const Command c = command(p);
    const bool further = (c.wanted - c.given) * c.added > 0;
    if (!(windup == "clamping" && further)) integral += c.added;
    if (windup == "back_calculation" && gains.ki != 0)
      integral += period / tracking * ((tracks ? u(p, 2) : c.given) - c.wanted);
    slope = c.slope;
    seen = differentiated(p);
    error = c.error;
    held = c.given;
    begun = true;
  }

 private:
  struct Command {
    double slope, error, added, wanted, given;
  };
  double differentiated(const Point& p) const { return of_error ? u(p) - u(p, 1) : -u(p, 1); }
  Command command(const Point& p) const {
    Command c{};
    c.slope = (gains.filter * slope + (begun ? differentiated(p) - seen : 0)) / (gains.filter + period);
    c.error = u(p) - u(p, 1) + gains.lead * c.slope;
    const double last = begun ? error : c.error;
    c.added = gains.ki * period * (rule == "trapezoidal" ? (c.error + last) / 2 : c.error);
    c.wanted = gains.kp * (weight * u(p) - u(p, 1) + gains.lead * c.slope) + gains.kd * c.slope + integral;
    if (rule != "forward") c.wanted += c.added;
    c.given = begun ? std::clamp(c.wanted, held - step, held + step) : c.wanted;
    c.given = std::clamp(c.given, lower, upper);
    return c;
  }
  PidGains gains;
  double weight, lower, upper, step, tracking, integral, slope = 0, seen = 0, error = 0;
  bool of_error, begun = false, tracks;
  std::string rule, windup;
};

/// Sums over samples as difference equations.
LawPointer difference_equation(const Block& b) {
  const auto made = [&](std::vector<double> num, std::vector<double> den) {
    return std::make_unique<DiscreteTransferFunction>(b, 1.0, std::move(num), std::move(den));
  };
  if (b.type == "fir") return made(b.list("coefficients"), {1});
  if (b.type == "moving_average") {
    const double n = b.number("samples");
    return made(std::vector<double>(static_cast<std::size_t>(n), 1 / n), {1});
  }
  const double t = b.number("period");
  if (b.type == "discrete_integrator") {
    const std::string rule = b.text("rule", "forward");
    if (b.number("initial", 0) != 0) throw Unknown("a sum that begins elsewhere");
    return made(rule == "forward"    ? std::vector<double>{0, t}
                : rule == "backward" ? std::vector<double>{t}
                                     : std::vector<double>{t / 2, t / 2},
                {1, -1});
  }
  // Butterworth's filters of order one and two, by the bilinear transform: s = (1 - z^-1)/(k (1 + z^-1)).
  const double k = std::tan(std::acos(-1.0) * b.number("corner") * t), order = b.number("order", 2);
  const std::string pass = b.text("pass", "low");
  if (order > 2 || b.text("family", "butterworth") != "butterworth" || (pass != "low" && pass != "high"))
    throw Unknown("filters of higher order");
  const double sign = pass == "low" ? 1 : -1;
  if (order == 1) return made(pass == "low" ? std::vector<double>{k, k} : std::vector<double>{1, -1}, {1 + k, k - 1});
  const double top = pass == "low" ? k * k : 1, d = std::sqrt(2.0) * k;
  return made({top, 2 * sign * top, top}, {1 + d + k * k, 2 * (k * k - 1), 1 - d + k * k});
}

}  // namespace

LawPointer make_sampled(const Block& b) {
  if (b.type == "sample_hold") return std::make_unique<SampleHold>(b);
  if (b.type == "quantizer") return std::make_unique<Quantizer>(b);
  if (b.type == "delay_line") return std::make_unique<DelayLine>(b);
  if (b.type == "discrete_transfer_function") return std::make_unique<DiscreteTransferFunction>(b);
  if (b.type == "discrete_state_space") return std::make_unique<DiscreteStateSpace>(b);
  if (b.type == "edge") return std::make_unique<Edge>(b);
  if (b.type == "sampled_pid") return std::make_unique<SampledPid>(b);
  if (b.type == "discrete_pid" || b.type == "discrete_pid_tracking") return std::make_unique<DiscretePid>(b);
  if (b.type == "fir" || b.type == "moving_average" || b.type == "discrete_integrator" || b.type == "digital_filter")
    return difference_equation(b);
  return nullptr;
}

}  // namespace reference
