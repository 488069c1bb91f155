// Sources: their corners and jumps are instants that are known beforehand.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/law.h"

namespace reference {
namespace {

constexpr double pi = std::numbers::pi;

class Source : public Law {
 public:
  std::vector<std::string> inputs() const override { return {}; }
  bool direct() const override { return false; }
};

class Constant : public Source {
 public:
  explicit Constant(const Block& b) : value(b.number("value")) {}
  void output(const Point&, double* y) const override { *y = value; }

 private:
  double value;
};

class Sine : public Source {
 public:
  explicit Sine(const Block& b)
      : a(b.number("amplitude")),
        o(b.number("offset", 0)),
        w(2 * pi * b.number("frequency")),
        phi(b.number("phase", 0)) {}
  void output(const Point& p, double* y) const override { *y = o + a * std::sin(w * p.t + phi); }
  double fastest() const override { return 1 / w; }

 private:
  double a, o, w, phi;
};

class Triangle : public Source {
 public:
  explicit Triangle(const Block& b)
      : a(b.number("amplitude")), o(b.number("offset", 0)), f(b.number("frequency")), phi(b.number("phase", 0)) {
    line = std::floor(half_turns(0));
  }
  void output(const Point& p, double* y) const override {
    const double along = half_turns(p.t) - line;
    const bool rising = std::fmod(line, 2) == 0;
    *y = o + a * (rising ? 2 * along - 1 : 1 - 2 * along);
  }
  double next() const override { return ((line + 1) * pi - pi / 2 - phi) / (2 * pi * f); }
  void arrive(double t) override {
    while (next() <= t + same_instant) ++line;
  }

 private:
  double half_turns(double t) const { return (2 * pi * f * t + phi + pi / 2) / pi; }  ///< since a minimum
  double a, o, f, phi, line;
};

class Step : public Source {
 public:
  explicit Step(const Block& b) : before(b.number("before", 0)), after(b.number("after")), time(b.number("time", 0)) {}
  void output(const Point&, double* y) const override { *y = done ? after : before; }
  double next() const override { return done ? never : time; }
  int roughness() const override { return 0; }
  void arrive(double t) override { done = done || time <= t + same_instant; }

 private:
  double before, after, time;
  bool done = false;
};

class Staircase : public Source {
 public:
  int roughness() const override { return 0; }
  explicit Staircase(const Block& b) : levels(b.list("levels")), duration(b.number("duration")) {}
  void output(const Point&, double* y) const override { *y = levels[k]; }
  double next() const override { return k + 1 < levels.size() ? static_cast<double>(k + 1) * duration : never; }
  void arrive(double t) override {
    while (next() <= t + same_instant) ++k;
  }

 private:
  std::vector<double> levels;
  double duration;
  std::size_t k = 0;
};

class Chirp : public Source {
 public:
  explicit Chirp(const Block& b)
      : a(b.number("amplitude")),
        o(b.number("offset", 0)),
        from(b.number("from")),
        to(b.number("to")),
        duration(b.number("duration")),
        phi(b.number("phase", 0)),
        logarithmic(b.text("sweep", "linear") == "logarithmic") {}
  void output(const Point& p, double* y) const override { *y = o + a * std::sin(2 * pi * cycles(p.t) + phi); }
  double next() const override { return ended ? never : duration; }
  void arrive(double t) override { ended = ended || duration <= t + same_instant; }
  double fastest() const override { return 1 / (2 * pi * std::max(from, to)); }

 private:
  double cycles(double t) const {
    const double s = std::min(t, duration), r = to / from;
    const double swept = logarithmic
                             ? (from == to ? from * s : from * duration / std::log(r) * (std::pow(r, s / duration) - 1))
                             : from * s + (to - from) * s * s / (2 * duration);
    return swept + to * (t - s);
  }
  double a, o, from, to, duration, phi;
  bool logarithmic, ended = false;
};

class Recorded : public Source {
 public:
  explicit Recorded(const Block& b) : t(b.instants), v(b.samples), hold(b.text("between_samples", "linear") == "hold") {
    if (b.text("between_samples", "linear") == "smooth") throw Unknown("the spline's ends are not documented");
    if (t.empty() || t.size() != v.size()) throw Unknown("a recording without samples");
  }
  int roughness() const override { return hold ? 0 : 1; }
  void output(const Point& p, double* y) const override {
    if (k == 0)
      *y = v[0];
    else if (hold || k == t.size())
      *y = v[k - 1];
    else
      *y = v[k - 1] + (v[k] - v[k - 1]) * (p.t - t[k - 1]) / (t[k] - t[k - 1]);
  }
  double next() const override { return k < t.size() ? t[k] : never; }
  void arrive(double now) override {
    while (next() <= now + same_instant) ++k;
  }

 private:
  std::vector<double> t, v;
  bool hold;
  std::size_t k = 0;  ///< samples that have been reached
};

}  // namespace

LawPointer make_source(const Block& b) {
  if (b.type == "constant") return std::make_unique<Constant>(b);
  if (b.type == "sine") return std::make_unique<Sine>(b);
  if (b.type == "triangle") return std::make_unique<Triangle>(b);
  if (b.type == "step") return std::make_unique<Step>(b);
  if (b.type == "staircase") return std::make_unique<Staircase>(b);
  if (b.type == "chirp") return std::make_unique<Chirp>(b);
  if (b.type == "recorded") return std::make_unique<Recorded>(b);
  return nullptr;
}

}  // namespace reference
