#include "blocks/continuous/slew_limit.h"

namespace hysteron::blocks {

void SlewLimit::describe(Declaration& d) {
  d.name("slew_limit", "follows its input, but not faster than a rate upwards and another downwards")
      .in_group("continuous")
      .elementwise()
      .at("command");
  d.law("dy/dt = max(-fall, min(rise, (u - y)/time))").from("current of a capacitor, I = C dU/dt");
  d.remark("Exact for an input that moves in straight lines between the rows of a recording.");
  d.remark("A rate beyond any of the input limits nothing: what stays is a lag of the time constant.");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the follower");
  d.state("y", "$a", "the follower");
  d.parameter("rate", "$a/s", "largest rate both ways: current over capacitance").positive();
  d.parameter("rise", "$a/s", "another one upwards; 0 = rate").optional("0").not_negative();
  d.parameter("fall", "$a/s", "another one downwards; 0 = rate").optional("0").not_negative();
  d.parameter("time", "s", "time constant with which a small gap closes").optional("1 ns").positive();
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
