// Integrals that stop or begin anew, and the rate behind a lag.
#include <algorithm>

#include "tests/reference/stepwise.h"

namespace reference {
namespace {

/// It stops at a limit while its input presses against it.
class LimitedIntegrator : public Law {
 public:
  explicit LimitedIntegrator(const Block& b)
      : lower(b.number("lower", -never)), upper(b.number("upper", never)), initial(b.number("initial", 0)) {}
  int states() const override { return 1; }
  bool direct() const override { return false; }
  void start(double* v) const override { v[x] = initial; }
  void output(const Point& p, double* y) const override { *y = p.x[x]; }
  void rates(const Point& p, double* dx) const override { dx[x] = side == 0 ? u(p) : 0; }
  long branch(const Point& p) const override {
    if (side != 0) return side * u(p) < 0;  // it is drawn away
    return p.x[x] > upper ? 1 : p.x[x] < lower ? -1 : 0;
  }
  bool change(const Point& p, double* values) override {
    const long now = branch(p);
    if (now == 0) return false;
    if (side == 0) values[x] = now > 0 ? upper : lower;
    side = side == 0 ? static_cast<int>(now) : 0;
    return true;
  }

 protected:
  double lower, upper, initial;
  int side = 0;  ///< at which limit it stands
};

class IntegratorWithReset : public Law {
 public:
  explicit IntegratorWithReset(const Block& b)
      : initial(b.number("initial", 0)), when(b.text("reset_at", "rising")), edges(when) {
    if (b.numbers.contains("lower") || b.numbers.contains("upper")) throw Unknown("a reset between limits");
  }
  std::vector<std::string> inputs() const override { return {"u", "reset", "start"}; }
  int states() const override { return 1; }
  bool direct() const override { return true; }
  int roughness() const override { return 0; }
  void start(double* v) const override { v[x] = initial; }
  void output(const Point& p, double* y) const override { *y = p.x[x]; }
  void rates(const Point& p, double* dx) const override { dx[x] = when == "while_on" && edges.was_true() ? 0 : u(p); }
  long branch(const Point& p) const override { return is_true(u(p, 1)); }
  bool change(const Point& p, double* values) override {
    const bool is = is_true(u(p, 1));
    const bool begins_on = !edges.is_known() && is && when != "falling";
    const bool again = edges.at(is) || begins_on;
    edges.take(is);
    if (again) values[x] = u(p, 2);
    return again;
  }

 private:
  double initial;
  std::string when;
  Edges edges;
};

class FilteredDerivative : public Law {
 public:
  explicit FilteredDerivative(const Block& b) : time(b.number("time")) {}
  int states() const override { return 1; }
  void output(const Point& p, double* y) const override { *y = (u(p) - p.x[x]) / time; }
  void rates(const Point& p, double* dx) const override { dx[x] = (u(p) - p.x[x]) / time; }
  double fastest() const override { return time; }

 private:
  double time;
};

}  // namespace

LawPointer make_integral(const Block& b) {
  if (b.type == "limited_integrator") return std::make_unique<LimitedIntegrator>(b);
  if (b.type == "integrator_with_reset") return std::make_unique<IntegratorWithReset>(b);
  if (b.type == "filtered_derivative") return std::make_unique<FilteredDerivative>(b);
  return nullptr;
}

}  // namespace reference
