#include "blocks/hysteresis/late_prandtl_ishlinskii.h"

#include <cmath>
#include <vector>

namespace hysteron::blocks {

void LatePrandtlIshlinskii::describe(Declaration& d) {
  PrandtlIshlinskii::describe(d);
  d.variations.clear();
  d.name("late_prandtl_ishlinskii", "Prandtl-Ishlinskii hysteresis with relaxation (rate-dependent)")
      .in_group("hysteresis");
  d.law(
       "y = sum weights[i] (w_i - share (q_i - h_i)), q_i = w_i - ahead u, time_i dh_i/dt = q_i - h_i, time_i = time "
       "(thresholds[i]/largest)^spread, operators with a threshold only; w_i as in prandtl_ishlinskii")
      .from(
          "relaxation of first order of the switched part: Smith, Smart Material Systems (2005), section 2.6; for slow "
          "motion the same as thresholds that grow with the rate, Al Janaideh, Krejci, Appl. Math. 68 (2023)");
  d.remark("With share 0 nothing is delayed: the block equals prandtl_ishlinskii.");
  d.remark("With ahead 0 the operator outputs relax; with ahead 1 their difference from the input relaxes.");
  d.state("h", "$a", "relaxed part of each operator");
  d.parameter("time", "s", "time constant of the operator with the largest threshold").optional("1 ms").positive();
  d.parameter("share", "", "fraction of the hysteretic part that relaxes, 0 .. 1").optional("1");
  d.parameter("ahead", "", "fraction of the input that is subtracted from each operator before the relaxation")
      .optional("0");
  d.parameter("spread", "", "exponent of the threshold in the time constants; 0 = all equal").optional("0");
}

Sizes LatePrandtlIshlinskii::sizes(const Shape& shape) {
  Sizes s = PrandtlIshlinskii::sizes(shape);
  s.states = s.memory;
  return s;
}

void LatePrandtlIshlinskii::rows(const RowsView& r) {
  for (int lane = 0; lane < r.lanes; ++lane) {
    View<double> v = r.views[lane];
    const auto threshold = v.list(thresholds);
    double* m = r.m + lane * v.n_m;
    double* x = r.x + lane * v.n_x;
    v.m = m;
    v.x = x;
    std::vector<double> times, keeps(threshold.size());
    for (std::size_t i = 0; i < threshold.size(); ++i) times.push_back(threshold[i] > 0 ? time_of(v, i) : 0);
    double row = 0;  // how long the rows are for which `keeps` holds
    for (std::ptrdiff_t k = 0; k < r.count; ++k) {
      if (r.h[k] != row) {
        row = r.h[k];
        for (std::size_t i = 0; i < times.size(); ++i) keeps[i] = std::exp(-row / times[i]);
      }
      const double u = r.u[0][k * r.lanes + lane], u_before = r.u[0][(k - 1) * r.lanes + lane];
      for (std::size_t i = 0; i < threshold.size(); ++i) {
        const double before = m[i];
        m[i] = play::follow(sides_of(v), threshold[i], before, u);
        if (threshold[i] > 0)
          x[i] = late::after_row(times[i], x[i], v.parameter(ahead), before, m[i], u_before, u, row, keeps[i]);
      }
      v.u = &u;
      v.out = r.y[0] + k * r.lanes + lane;
      output(v);
    }
  }
}

void LatePrandtlIshlinskii::initial_memory(const View<double>& v) { PrandtlIshlinskii::initial_memory(v); }
std::string LatePrandtlIshlinskii::check_memory(const View<double>& v) { return PrandtlIshlinskii::check_memory(v); }

Kernel late_prandtl_ishlinskii_block() { return kernel<LatePrandtlIshlinskii>(); }

}  // namespace hysteron::blocks
