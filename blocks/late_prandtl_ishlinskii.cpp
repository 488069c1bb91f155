#include "blocks/late_prandtl_ishlinskii.h"

namespace hysteron::blocks {

void LatePrandtlIshlinskii::describe(Declaration& d) {
  PrandtlIshlinskii::describe(d);
  d.variations.clear();
  d.name("late_prandtl_ishlinskii", "hysteresis of play operators that follows late").in_group("hysteresis");
  d.law(
       "y = sum weights[i] w_i - share (H - h), time dh/dt = H - h; operators: H = sum of weights[i] w_i with a "
       "threshold, gap: H = sum weights[i] (w_i - u); w_i as in prandtl_ishlinskii")
      .from(
          "relaxation of first order of the switched part: Smith, Smart Material Systems (2005), section 2.6; for slow "
          "motion the same as thresholds that grow with the rate, Al Janaideh, Krejci, Appl. Math. 68 (2023)");
  d.remark("At share 0 nothing comes late: it is prandtl_ishlinskii.");
  d.state("h", "$b", "the late part");
  d.parameter("time", "s", "time constant with which the late part follows").optional("1 ms").positive();
  d.parameter("share", "", "of that part which comes late").optional("1");
  d.text("part", {"operators", "gap"},
         "what comes late: the operators themselves, or how far they are behind the input");
}

Sizes LatePrandtlIshlinskii::sizes(const Shape& shape) {
  Sizes s = PrandtlIshlinskii::sizes(shape);
  s.states = 1;
  return s;
}

void LatePrandtlIshlinskii::rows(const RowsView& r) {
  for (int lane = 0; lane < r.lanes; ++lane) {
    View<double> v = r.views[lane];
    const auto threshold = v.list(thresholds);
    const double tau = v.parameter(time);
    double* m = r.m + lane * v.n_m;
    double h = r.x[lane];
    v.m = m;
    v.x = &h;
    const auto late = [&](double u) { return late_part(v, u, [&](std::size_t i) { return m[i]; }); };
    double before = late(r.u[0][lane - r.lanes]);
    for (std::ptrdiff_t k = 0; k < r.count; ++k) {
      const double u = r.u[0][k * r.lanes + lane];
      for (std::size_t i = 0; i < threshold.size(); ++i) m[i] = play::follow(sides_of(v), threshold[i], m[i], u);
      const double now = late(u);
      h = late::after_ramp(tau, h, before, now, r.h[k]);
      before = now;
      v.u = &u;
      v.out = r.y[0] + k * r.lanes + lane;
      output(v);
    }
    r.x[lane] = h;
  }
}

void LatePrandtlIshlinskii::initial_memory(const View<double>& v) { PrandtlIshlinskii::initial_memory(v); }
std::string LatePrandtlIshlinskii::check_memory(const View<double>& v) { return PrandtlIshlinskii::check_memory(v); }

Kernel late_prandtl_ishlinskii_block() { return kernel<LatePrandtlIshlinskii>(); }

}  // namespace hysteron::blocks
