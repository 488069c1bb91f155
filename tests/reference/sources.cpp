// Sources: their corners and jumps are instants that are known beforehand.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reference/law.h"

namespace reference {
namespace {

using std::numbers::pi;

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

/// Straight from before to behind.
class Ramp : public Source {
 public:
  explicit Ramp(const Block& b)
      : slope(b.number("slope")),
        begin(b.number("time", 0)),
        end(begin + b.number("duration", never)),
        initial(b.number("initial", 0)) {}
  void output(const Point& p, double* y) const override {
    *y = initial + slope * (stage == 0 ? 0 : stage == 1 ? p.t - begin : end - begin);
  }
  double next() const override { return stage == 0 ? begin : stage == 1 ? end : never; }
  void arrive(double t) override {
    while (next() <= t + same_instant) ++stage;
  }

 private:
  double slope, begin, end, initial;
  int stage = 0;
};

/// Levels that follow each other after given times, over and over; between them straight lines, or jumps where the two
/// times are one.
class Levels : public Source {
 public:
  Levels(double low_, double begin_, double period_, std::vector<double> at_, std::vector<double> level_)
      : low(low_), begin(begin_), period(period_), at(std::move(at_)), level(std::move(level_)) {
    jumps = at[0] == at[1];
  }
  int roughness() const override { return jumps ? 0 : 1; }
  void output(const Point& p, double* y) const override {
    if (k == 0 || k == at.size()) {
      *y = low;
      return;
    }
    const double width = at[k] - at[k - 1], since = p.t - started() - at[k - 1];
    *y = level[k - 1] + (width > 0 ? (level[k] - level[k - 1]) * since / width : 0);
  }
  double next() const override {
    if (k < at.size()) return started() + at[k];
    return std::isinf(period) ? never : started() + period;
  }
  void arrive(double t) override {
    while (next() <= t + same_instant) {
      if (k == at.size()) {
        k = 0;
        ++round;
      }
      ++k;
    }
  }

 private:
  double started() const { return round == 0 ? begin : begin + round * period; }
  double low, begin, period, round = 0;
  std::vector<double> at, level;
  std::size_t k = 0;  ///< corners of this round that are reached
  bool jumps;
};

LawPointer pulse(const Block& b) {
  const double low = b.number("low", 0), high = b.number("high"), period = b.number("period");
  const double width = period * b.number("duty", 0.5);
  if (b.number("pulses", 0) > 0) throw Unknown("a number of pulses");
  return std::make_unique<Levels>(low, b.number("time", 0), period, std::vector<double>{0, 0, width, width},
                                  std::vector<double>{low, high, high, low});
}

LawPointer trapezoid(const Block& b) {
  const double low = b.number("low", 0), high = b.number("high"), rise = b.number("rise");
  const double top = rise + b.number("top"), end = top + b.number("fall");
  return std::make_unique<Levels>(low, b.number("time", 0), b.number("period", never),
                                  std::vector<double>{0, rise, top, end}, std::vector<double>{low, high, high, low});
}

/// Pieces of constant jerk, one behind the other; the top speed of a short move is found by halving.
class MotionProfile : public Source {
 public:
  explicit MotionProfile(const Block& b)
      : speed(b.number("velocity")), acceleration(b.number("acceleration")), jerk(b.number("jerk", 0)) {
    if (b.text("profile", "s_curve") != "s_curve") throw Unknown("an acceleration that jumps");
    double from = b.number("initial", 0);
    pieces.push_back({b.number("time", 0), from, 0, 0, 0});
    for (const double to : b.list("positions")) {
      move(to - from);
      from = to;
      pieces.back() = {pieces.back().begin, from, 0, 0, 0};
      pieces.push_back({pieces.back().begin + b.number("dwell", 0), from, 0, 0, 0});
    }
  }
  std::vector<std::string> outputs() const override { return {"position", "velocity", "acceleration"}; }
  void output(const Point& p, double* y) const override {
    const Piece& at = pieces[k == 0 ? 0 : k - 1];
    const double s = k == 0 ? 0 : p.t - at.begin;
    y[0] = at.x + s * (at.v + s * (at.a / 2 + s * at.j / 6));
    y[1] = at.v + s * (at.a + s * at.j / 2);
    y[2] = at.a + s * at.j;
  }
  double next() const override { return k < pieces.size() ? pieces[k].begin : never; }
  void arrive(double t) override {
    while (next() <= t + same_instant) ++k;
  }

 private:
  struct Piece {
    double begin, x, v, a, j;
  };
  /// Time of jerk and of even acceleration up to a speed.
  std::pair<double, double> times_to(double v) const {
    const double most = std::min(acceleration, std::sqrt(v * jerk));
    return {most / jerk, v / most - most / jerk};
  }
  void move(double way) {
    const double sign = way < 0 ? -1 : 1, d = std::abs(way);
    if (d == 0) return;
    const auto needed = [&](double v) { return v * (2 * times_to(v).first + times_to(v).second); };
    double lower = 0, upper = speed;
    if (needed(speed) <= d)
      lower = speed;
    else
      for (int i = 0; i < 200; ++i) (needed(0.5 * (lower + upper)) <= d ? lower : upper) = 0.5 * (lower + upper);
    const auto [jerked, even] = times_to(lower);
    const double cruise = std::max(0.0, (d - needed(lower)) / lower);
    const double j = sign * jerk;
    add(j, jerked);
    add(0, even);
    add(-j, jerked);
    add(0, cruise);
    add(-j, jerked);
    add(0, even);
    add(j, jerked);
  }
  void add(double j, double s) {
    Piece& at = pieces.back();
    at.j = j;
    pieces.push_back(
        {at.begin + s, at.x + s * (at.v + s * (at.a / 2 + s * j / 6)), at.v + s * (at.a + s * j / 2), at.a + s * j, 0});
  }
  double speed, acceleration, jerk;
  std::vector<Piece> pieces{};
  std::size_t k = 0;  ///< pieces that have begun
};

/// The same as rows of a file.
Block as_recorded(const Block& b) {
  if (b.text("repeat", "no") == "yes" || b.text("between_points", "linear") == "akima")
    throw Unknown("a table that repeats or is bent");
  Block rows = b;
  rows.instants = b.list("times");
  rows.samples = b.list("values");
  rows.texts["between_samples"] = b.text("between_points", "linear");
  return rows;
}

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
  if (b.type == "ramp") return std::make_unique<Ramp>(b);
  if (b.type == "pulse") return pulse(b);
  if (b.type == "trapezoid") return trapezoid(b);
  if (b.type == "motion_profile") return std::make_unique<MotionProfile>(b);
  if (b.type == "time_table") return std::make_unique<Recorded>(as_recorded(b));
  if (b.type == "recorded") return std::make_unique<Recorded>(b);
  return nullptr;
}

}  // namespace reference
