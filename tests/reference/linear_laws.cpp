// Laws with states that move by ordinary differential equations, limits of rate, and dead time.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "tests/reference/law.h"

namespace reference {
namespace {

using std::numbers::pi;

class Lag : public Law {
 public:
  explicit Lag(const Block& b) : times(b.list("times")) {}
  int states() const override { return static_cast<int>(times.size()); }
  bool direct() const override { return false; }
  void output(const Point& p, double* y) const override { *y = p.x[x + states() - 1]; }
  void rates(const Point& p, double* dx) const override {
    for (int i = 0; i < states(); ++i) dx[x + i] = ((i == 0 ? u(p) : p.x[x + i - 1]) - p.x[x + i]) / times[i];
  }
  double fastest() const override { return *std::min_element(times.begin(), times.end()); }

 private:
  std::vector<double> times;
};

class Integrator : public Law {
 public:
  explicit Integrator(const Block& b) : initial(b.number("initial", 0)) {}
  int states() const override { return 1; }
  bool direct() const override { return false; }
  void start(double* v) const override { v[x] = initial; }
  void output(const Point& p, double* y) const override { *y = p.x[x]; }
  void rates(const Point& p, double* dx) const override { dx[x] = u(p); }

 private:
  double initial;
};

class PiController : public Law {
 public:
  explicit PiController(const Block& b) : kp(b.number("kp")), ki(b.number("ki")), initial(b.number("initial", 0)) {}
  int states() const override { return 1; }
  void start(double* v) const override { v[x] = initial; }
  void output(const Point& p, double* y) const override { *y = kp * u(p) + p.x[x]; }
  void rates(const Point& p, double* dx) const override { dx[x] = ki * u(p); }

 private:
  double kp, ki, initial;
};

class Resonance : public Law {
 public:
  explicit Resonance(const Block& b) : w(2 * pi * b.number("frequency")), d(b.number("damping")) {}
  int states() const override { return 2; }
  bool direct() const override { return false; }
  void output(const Point& p, double* y) const override { *y = p.x[x]; }
  void rates(const Point& p, double* dx) const override {
    dx[x] = w * p.x[x + 1];
    dx[x + 1] = w * (u(p) - p.x[x]) - 2 * d * w * p.x[x + 1];
  }
  double fastest() const override { return 1 / w / std::max(1.0, 2 * d); }

 private:
  double w, d;
};

/// Duffing's: the spring y + quadratic y^2 + stiffening y^3 + quintic y^5.
class Duffing : public Law {
 public:
  explicit Duffing(const Block& b)
      : w(2 * pi * b.number("frequency")),
        d(b.number("damping")),
        square(b.number("quadratic", 0)),
        cubic(b.number("stiffening", 0)),
        fifth(b.number("quintic", 0)) {}
  int states() const override { return 2; }
  bool direct() const override { return false; }
  void output(const Point& p, double* y) const override { *y = p.x[x]; }
  void rates(const Point& p, double* dx) const override {
    const double y = p.x[x];
    const double spring = y + square * std::pow(y, 2) + cubic * std::pow(y, 3) + fifth * std::pow(y, 5);
    dx[x] = p.x[x + 1];
    dx[x + 1] = w * w * (u(p) - spring) - 2 * d * w * p.x[x + 1];
  }
  double fastest() const override { return 0.3 / w / std::max(1.0, 2 * d); }

 private:
  double w, d, square, cubic, fifth;
};

/// y = u + sum positions (q - u) + velocities q'/w.
class Modes : public Law {
 public:
  explicit Modes(const Block& b)
      : f(b.list("frequencies")), d(b.list("dampings")), share(b.list("positions")), speed(b.list("velocities")) {}
  int states() const override { return static_cast<int>(2 * f.size()); }
  void output(const Point& p, double* y) const override {
    *y = u(p);
    for (std::size_t k = 0; k < f.size(); ++k) *y += share[k] * (p.x[x + 2 * k] - u(p)) + speed[k] * p.x[x + 2 * k + 1];
  }
  void rates(const Point& p, double* dx) const override {
    for (std::size_t k = 0; k < f.size(); ++k) {
      const double w = 2 * pi * f[k], q = p.x[x + 2 * k], v = p.x[x + 2 * k + 1];
      dx[x + 2 * k] = w * v;
      dx[x + 2 * k + 1] = w * (u(p) - q) - 2 * d[k] * w * v;
    }
  }
  double fastest() const override { return 1 / (2 * pi * *std::max_element(f.begin(), f.end())); }

 private:
  std::vector<double> f, d, share, speed;
};

class Creep : public Law {
 public:
  explicit Creep(const Block& b) : amounts(b.list("amounts")), times(b.list("times")) {}
  int states() const override { return static_cast<int>(times.size()); }
  void output(const Point& p, double* y) const override {
    *y = u(p);
    for (int k = 0; k < states(); ++k) *y += amounts[k] * p.x[x + k];
  }
  void rates(const Point& p, double* dx) const override {
    for (int k = 0; k < states(); ++k) dx[x + k] = (u(p) - p.x[x + k]) / times[k];
  }
  double fastest() const override { return *std::min_element(times.begin(), times.end()); }

 private:
  std::vector<double> amounts, times;
};

/// gain num(s)/den(s), as a chain of derivatives: x_1' = x_2, ..., den x = u.
class TransferFunction : public Law {
 public:
  explicit TransferFunction(const Block& b) : TransferFunction(b.number("gain", 1), b.list("num"), b.list("den")) {}
  /// Highest power first.
  TransferFunction(double gain_, std::vector<double> num_, std::vector<double> den_)
      : gain(gain_), num(std::move(num_)), den(std::move(den_)) {
    num.insert(num.begin(), den.size() - num.size(), 0.0);
    for (auto& n : num) n /= den[0];
    for (std::size_t i = den.size(); i-- > 0;) den[i] /= den[0];
  }
  int states() const override { return static_cast<int>(den.size()) - 1; }
  bool direct() const override { return num[0] != 0; }
  void output(const Point& p, double* y) const override {
    double value = num[0] == 0 ? 0 : num[0] * highest(p);
    for (int i = 0; i < states(); ++i) value += num[states() - i] * p.x[x + i];
    *y = gain * value;
  }
  void rates(const Point& p, double* dx) const override {
    for (int i = 0; i + 1 < states(); ++i) dx[x + i] = p.x[x + i + 1];
    dx[x + states() - 1] = highest(p);
  }
  double fastest() const override {  // no root is larger than this sum (Lagrange)
    double bound = 0;
    for (std::size_t i = 1; i < den.size(); ++i) bound += std::pow(std::abs(den[i]), 1.0 / static_cast<double>(i));
    return 1 / bound;
  }

 private:
  double highest(const Point& p) const {
    double value = u(p);
    for (int i = 0; i < states(); ++i) value -= den[states() - i] * p.x[x + i];
    return value;
  }
  double gain;
  std::vector<double> num, den;
};

double angular(double hertz) { return 2 * pi * hertz; }

/// Product of polynomials, highest power first.
std::vector<double> times(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> c(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}

/// What is known by corner frequencies, as quotients of polynomials.
LawPointer section(const Block& b) {
  if (b.type == "lead_lag")
    return std::make_unique<TransferFunction>(b.number("gain", 1),
                                              std::vector<double>{1 / angular(b.number("zero")), 1},
                                              std::vector<double>{1 / angular(b.number("pole")), 1});
  if (b.type == "biquads") {
    std::vector<double> num{1}, den{1};
    const auto quadratic = [](double w, double z) { return std::vector<double>{1 / (w * w), 2 * z / w, 1}; };
    for (std::size_t k = 0; k < b.list("pole_frequencies").size(); ++k) {
      num = times(num, quadratic(angular(b.list("zero_frequencies")[k]), b.list("zero_dampings")[k]));
      den = times(den, quadratic(angular(b.list("pole_frequencies")[k]), b.list("pole_dampings")[k]));
    }
    return std::make_unique<TransferFunction>(b.number("gain", 1), num, den);
  }
  const double w = angular(b.number("frequency")), z = b.number("damping");
  std::vector<double> num{w * w};
  const std::string pass = b.text("pass", "low");
  if (b.type == "notch") num = {1, 2 * b.number("depth", 0) * z * w, w * w};
  if (pass == "band") num = {2 * z * w, 0};
  if (pass == "high") num = {1, 0, 0};
  return std::make_unique<TransferFunction>(b.number("gain", 1), num, std::vector<double>{1, 2 * z * w, w * w});
}

/// Real roots, and pairs [real part, imaginary part].
std::vector<double> of_roots(const Block& b, const char* real, const char* pairs) {
  std::vector<double> all{1};
  if (b.numbers.contains(real))
    for (const double r : b.list(real)) all = times(all, {1, -r});
  if (b.numbers.contains(pairs))
    for (std::size_t i = 0; i + 1 < b.list(pairs).size(); i += 2) {
      const double re = b.list(pairs)[i], im = b.list(pairs)[i + 1];
      all = times(all, {1, -2 * re, re * re + im * im});
    }
  return all;
}

class RateLimiter : public Law {
 public:
  RateLimiter(const Block& b, double rise_, double fall_, double time_)
      : rise(rise_), fall(fall_), time(time_), initial(b.number("initial", 0)) {}
  int states() const override { return 1; }
  bool direct() const override { return false; }
  void start(double* v) const override { v[x] = initial; }
  void output(const Point& p, double* y) const override { *y = p.x[x]; }
  void rates(const Point& p, double* dx) const override { dx[x] = std::max(-fall, std::min(rise, wanted(p))); }
  long branch(const Point& p) const override { return wanted(p) > rise ? 1 : wanted(p) < -fall ? -1 : 0; }
  double fastest() const override { return time; }

 private:
  double wanted(const Point& p) const { return (u(p) - p.x[x]) / time; }
  double rise, fall, time, initial;
};

LawPointer slew_limit(const Block& b) {
  const double rate = b.number("rate"), rise = b.number("rise", 0), fall = b.number("fall", 0);
  if (b.numbers.find("time") == b.numbers.end()) throw Unknown("a slew limit of a nanosecond needs steps of one");
  return std::make_unique<RateLimiter>(b, rise > 0 ? rise : rate, fall > 0 ? fall : rate, b.number("time"));
}

/// Keeps what its input was, piece by piece between instants, and reads it with cubics that stay within a piece.
class DeadTime : public Law {
 public:
  explicit DeadTime(double delay_) : delay(delay_) {}
  bool direct() const override { return delay == 0; }
  bool is_late() const override { return delay > 0; }
  void rest_at(double rest) override { before = rest; }
  void output(const Point& p, double* y) const override {
    *y = delay == 0 ? u(p) : pieces.empty() ? before.value_or(u(p)) : reading < 0 ? first : past(p.t - delay);
  }
  double next() const override {
    const auto following = static_cast<std::size_t>(reading + 1);
    return delay > 0 && following < pieces.size() ? t[pieces[following].begin] + delay : never;
  }
  void arrive(double now) override {
    while (next() <= now + same_instant) ++reading;
  }
  void bends(int roughness_) override { coming = roughness_; }
  int roughness() const override { return reading < 0 ? 9 : pieces[static_cast<std::size_t>(reading)].roughness; }
  int smooths() const override { return delay > 0 ? 9 : 0; }
  void keep(const Point& p) override {
    if (delay == 0) return;
    if (p.free && (coming <= 1 || pieces.empty())) {
      if (pieces.empty()) first = before.value_or(u(p));
      if (pieces.empty() || pieces.back().begin + 1 != t.size() || t.back() != p.t) {
        if (pieces.size() > 20000) throw Unknown("a dead time that is fed back with too many instants");
        pieces.push_back({t.size(), coming});
      } else {  // the instant is looked at once more
        t.pop_back();
        v.pop_back();
      }
    } else if (p.t - t.back() < nearest) {
      return;
    }
    t.push_back(p.t);
    v.push_back(u(p));
  }
  double largest_step() const override { return delay > 0 ? delay / 2 : never; }

 private:
  double past(double at) const {
    const auto piece = static_cast<std::size_t>(reading);
    const std::size_t begin = pieces[piece].begin, end = piece + 1 < pieces.size() ? pieces[piece + 1].begin : t.size();
    std::size_t i = std::upper_bound(t.begin() + begin, t.begin() + end, at) - t.begin();
    const std::size_t count = std::min<std::size_t>(4, end - begin);
    i = std::clamp(i, begin + count / 2, end - count + count / 2);
    double value = 0;
    for (std::size_t j = i - count / 2; j < i - count / 2 + count; ++j) {
      double factor = v[j];
      for (std::size_t k = i - count / 2; k < i - count / 2 + count; ++k)
        if (k != j) factor *= (at - t[k]) / (t[j] - t[k]);
      value += factor;
    }
    return value;
  }
  static constexpr double nearest = 1e-9;  ///< points nearer than this would spoil the cubic [s]
  double delay, first = 0;
  std::optional<double> before{};  ///< the start; else as the input is at first
  std::vector<double> t{}, v{};
  struct Piece {
    std::size_t begin;
    int roughness;
  };
  std::vector<Piece> pieces{};
  long reading = -1;  ///< the piece that comes out; before the first one the input was at rest
  int coming = 0;
};

/// Half of it at once, half of it half a period later, so that a mode does not answer.
class InputShaper : public DeadTime {
 public:
  explicit InputShaper(const Block& b) : InputShaper(b.number("frequency"), std::sqrt(1 - squared(b)), b) {}
  bool direct() const override { return true; }
  int smooths() const override { return 0; }
  void output(const Point& p, double* y) const override {
    double late = 0;
    DeadTime::output(p, &late);
    *y = (u(p) + later * late) / (1 + later);
  }

 private:
  InputShaper(double frequency, double root, const Block& b)
      : DeadTime(1 / (2 * frequency * root)), later(std::exp(-pi * b.number("damping", 0) / root)) {}
  static double squared(const Block& b) { return b.number("damping", 0) * b.number("damping", 0); }
  double later;
};

/// One input and one output; the matrices row by row.
class StateSpace : public Law {
 public:
  explicit StateSpace(const Block& b)
      : a(b.list("a")), b_(b.list("b")), c(b.list("c")), d(b.numbers.contains("d") ? b.number("d") : 0) {}
  int states() const override { return static_cast<int>(b_.size()); }
  bool direct() const override { return d != 0; }
  void output(const Point& p, double* y) const override {
    *y = d == 0 ? 0 : d * u(p);
    for (int i = 0; i < states(); ++i) *y += c[i] * p.x[x + i];
  }
  void rates(const Point& p, double* dx) const override {
    for (int i = 0; i < states(); ++i) {
      dx[x + i] = b_[i] * u(p);
      for (int j = 0; j < states(); ++j) dx[x + i] += a[i * states() + j] * p.x[x + j];
    }
  }
  double fastest() const override {
    double most = 1e-9;
    for (const double cell : a) most = std::max(most, std::abs(cell));
    return 1 / most;
  }

 private:
  std::vector<double> a, b_, c;
  double d;
};

}  // namespace

LawPointer make_linear(const Block& b) {
  if (b.type == "lag") return std::make_unique<Lag>(b);
  if (b.type == "integrator") return std::make_unique<Integrator>(b);
  if (b.type == "pi_controller") return std::make_unique<PiController>(b);
  if (b.type == "resonance") return std::make_unique<Resonance>(b);
  if (b.type == "duffing") return std::make_unique<Duffing>(b);
  if (b.type == "modes") return std::make_unique<Modes>(b);
  if (b.type == "creep") return std::make_unique<Creep>(b);
  if (b.type == "transfer_function") return std::make_unique<TransferFunction>(b);
  if (b.type == "lead_lag" || b.type == "biquads" || b.type == "notch" || b.type == "second_order") return section(b);
  if (b.type == "zero_pole_gain")
    return std::make_unique<TransferFunction>(b.number("gain", 1), of_roots(b, "zeros", "zero_pairs"),
                                              of_roots(b, "poles", "pole_pairs"));
  if (b.type == "rate_limiter")
    return std::make_unique<RateLimiter>(b, b.number("rise"), b.number("fall"), b.number("time", 1e-5));
  if (b.type == "slew_limit") return slew_limit(b);
  if (b.type == "dead_time") return std::make_unique<DeadTime>(b.number("delay"));
  if (b.type == "input_shaper") return std::make_unique<InputShaper>(b);
  if (b.type == "state_space") return std::make_unique<StateSpace>(b);
  return nullptr;
}

}  // namespace reference
