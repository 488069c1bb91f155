// Laws that run at their instants and hold between: at an instant each reads what its inputs are then.
#include <algorithm>
#include <cmath>

#include "tests/reference/law.h"

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
      : Sampled(b), gain(b.number("gain", 1)), num(b.list("num")), den(b.list("den")) {
    if (b.text("direct", "yes") == "no") num.insert(num.begin(), 0.0);
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
  double plain(const Point& p) const {
    double y = num[0] == 0 ? 0 : num[0] * u(p);
    for (std::size_t i = 1; i < num.size(); ++i) y += num[i] * last_u[i - 1];
    for (std::size_t i = 1; i < den.size(); ++i) y -= den[i] * last_y[i - 1];
    return y / den[0];
  }
  double gain;
  std::vector<double> num, den, last_u{}, last_y{};
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

}  // namespace

LawPointer make_sampled(const Block& b) {
  if (b.type == "sample_hold") return std::make_unique<SampleHold>(b);
  if (b.type == "quantizer") return std::make_unique<Quantizer>(b);
  if (b.type == "delay_line") return std::make_unique<DelayLine>(b);
  if (b.type == "discrete_transfer_function") return std::make_unique<DiscreteTransferFunction>(b);
  if (b.type == "sampled_pid") return std::make_unique<SampledPid>(b);
  return nullptr;
}

}  // namespace reference
