#include "blocks/continuous/slew_limit.h"

namespace hysteron::blocks {

void SlewLimit::describe(Declaration& d) {
  d.name("slew_limit", "slew-rate limit, exact between the rows of a recording")
      .in_group("continuous")
      .elementwise()
      .at("command");
  d.law("dy/dt = max(-fall, min(rise, (u - y)/time))").from("current of a capacitor, I = C dU/dt");
  d.remark("Exact for an input that is linear between the rows of a recording.");
  d.remark(
      "A limit above every rate of the input has no effect: a first-order lag with this time constant "
      "remains.");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the rate-limited signal");
  d.state("y", "$a", "the rate-limited signal");
  d.parameter("rate", "$a/s", "largest rate in both directions, e.g. current/capacitance").positive();
  d.parameter("rise", "$a/s", "largest rising rate; 0 = as \"rate\"").optional("0").not_negative();
  d.parameter("fall", "$a/s", "largest falling rate, as a positive number; 0 = as \"rate\"")
      .optional("0")
      .not_negative();
  d.parameter("time", "s", "time constant of tracking while no limit is active").optional("1 ns").positive();
}

Sizes SlewLimit::sizes(const Shape&) {
  Sizes s;
  s.states = 1;
  s.feedthrough = false;
  s.kinks = 2;
  s.keeps_sides = true;
  return s;
}

void SlewLimit::rows(const RowsView& r) {
  for (int lane = 0; lane < r.lanes; ++lane) {
    const auto p = law(r.views[lane]);
    double y = r.x[lane];
    const double* u = r.u[0] + lane;
    for (std::ptrdiff_t k = 0; k < r.count; ++k) {
      const double before = u[(k - 1) * r.lanes], now = u[k * r.lanes];
      // Where the input jumps no time passes and the follower stays.
      if (r.h[k] > 0) y = now - rate_limiter::gap_after_ramp(p, before - y, (now - before) / r.h[k], r.h[k]);
      r.y[0][k * r.lanes + lane] = y;
    }
    r.x[lane] = y;
  }
}

Kernel slew_limit_block() { return kernel<SlewLimit>(); }

}  // namespace hysteron::blocks
