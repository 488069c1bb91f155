// Laws of what is true or false: comparisons, edges, what they trigger, a state machine of two states.
#include <algorithm>

#include "tests/reference/stepwise.h"

namespace reference {
namespace {

class Compare : public Stepwise {
 public:
  explicit Compare(const Block& b) : is(b.text("is", "less")) {}
  std::vector<std::string> inputs() const override { return {"a", "b"}; }
  void output(const Point& p, double* y) const override { *y = static_cast<double>(at(p)); }

 private:
  long now(const Point& p) const override {
    const double a = u(p, 0), b = u(p, 1);
    if (is == "less") return a < b;
    if (is == "at_most") return a <= b;
    if (is == "at_least") return a >= b;
    if (is == "greater") return a > b;
    return is == "equal" ? a == b : a != b;
  }
  std::string is;
};

class Logic : public Stepwise {
 public:
  explicit Logic(const Block& b) : is(b.text("is", "and")), count(b.in.size()) {}
  std::vector<std::string> inputs() const override { return std::vector<std::string>(count, ""); }
  void output(const Point& p, double* y) const override { *y = static_cast<double>(at(p)); }

 private:
  long now(const Point& p) const override {
    std::size_t n = 0;
    for (std::size_t i = 0; i < count; ++i) n += is_true(u(p, i));
    if (is == "and") return n == count;
    if (is == "nand") return n != count;
    if (is == "or") return n > 0;
    if (is == "xor") return n % 2 == 1;
    return n == 0;  // nor, not
  }
  std::string is;
  std::size_t count;
};

class SampleAndHold : public Law {
 public:
  explicit SampleAndHold(const Block& b) : edges(b.text("edge", "rising")), held(b.number("initial", 0)) {}
  std::vector<std::string> inputs() const override { return {"u", "trigger"}; }
  int roughness() const override { return 0; }
  int smooths() const override { return 9; }
  void output(const Point& p, double* y) const override { *y = value(p); }
  long branch(const Point& p) const override { return is_true(u(p, 1)); }
  void leave(const Point& p) override {
    held = value(p);
    edges.take(is_true(u(p, 1)));
  }

 private:
  double value(const Point& p) const { return p.free && edges.at(is_true(u(p, 1))) ? u(p) : held; }
  Edges edges;
  double held;
};

class Counter : public Law {
 public:
  explicit Counter(const Block& b)
      : edges(b.text("edge", "rising")), initial(b.number("initial", 0)), by(b.number("by", 1)), count(initial) {}
  std::vector<std::string> inputs() const override { return {"u", "reset"}; }
  int roughness() const override { return 0; }
  void output(const Point& p, double* y) const override { *y = value(p); }
  long branch(const Point& p) const override { return is_true(u(p)) + 2 * is_true(u(p, 1)); }
  void leave(const Point& p) override {
    count = value(p);
    edges.take(is_true(u(p)));
  }

 private:
  double value(const Point& p) const {
    if (!p.free) return count;
    if (is_true(u(p, 1))) return initial;
    return edges.at(is_true(u(p))) ? count + by : count;
  }
  Edges edges;
  double initial, by, count;
};

class Timer : public Law {
 public:
  int states() const override { return 1; }
  bool direct() const override { return false; }
  int roughness() const override { return 0; }
  void output(const Point& p, double* y) const override { *y = p.x[x]; }
  void rates(const Point&, double* dx) const override { dx[x] = on ? 1 : 0; }
  long branch(const Point& p) const override { return is_true(u(p)); }
  bool change(const Point& p, double* values) override {
    if (is_true(u(p)) == on) return false;
    on = !on;
    values[x] = 0;
    return true;
  }

 private:
  bool on = false;
};

/// low -> high: u > a; high -> low: u < b and time > dwell.
class TwoStates : public Law {
 public:
  explicit TwoStates(const Block& b)
      : a(b.number("a")), b_(b.number("b")), dwell(b.number("dwell")), levels(b.list("level")) {}
  std::vector<std::string> outputs() const override { return {"state", "level"}; }
  bool direct() const override { return true; }
  int roughness() const override { return 0; }
  int smooths() const override { return 9; }
  void output(const Point&, double* y) const override {
    y[0] = high;
    y[1] = levels[high];
  }
  long branch(const Point& p) const override { return leaves(p) + 2L * high; }
  bool change(const Point& p, double*) override {
    if (!leaves(p)) return false;
    high = 1 - high;
    since = p.t;
    return true;
  }

 private:
  bool leaves(const Point& p) const { return high == 1 ? u(p) < b_ && p.t - since > dwell : u(p) > a; }
  double a, b_, dwell;
  std::vector<double> levels;
  int high = 0;
  double since = 0;
};

LawPointer state_machine(const Block& b) {
  if (b.text("transitions", "") != "low -> high: u > a; high -> low: u < b and time > dwell")
    throw Unknown("state machine " + b.text("transitions", ""));
  return std::make_unique<TwoStates>(b);
}

}  // namespace

LawPointer make_logic(const Block& b) {
  if (b.type == "compare") return std::make_unique<Compare>(b);
  if (b.type == "logic") return std::make_unique<Logic>(b);
  if (b.type == "sample_and_hold") return std::make_unique<SampleAndHold>(b);
  if (b.type == "counter") return std::make_unique<Counter>(b);
  if (b.type == "timer") return std::make_unique<Timer>();
  if (b.type == "state_machine") return state_machine(b);
  return nullptr;
}

}  // namespace reference
