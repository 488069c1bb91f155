// Decides how blocks whose currents move faster than rows come step through a row: in equal shares of it, each short
// against the fastest of their rates. Does not decide that rate.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/block/block_forms.h"
#include "engine/block/rows.h"

namespace hysteron::blocks {

/// Of a fixed block B with fastest(p, in) [1/s]. The classical formula of order four errs by (h rate)^5/120 a step:
/// with a tenth by 1e-7 of what a state has to go.
template <class B>
class SubSteps {
  using P = typename block_detail::Types<B, double>::P;
  using In = typename block_detail::Types<B, double>::I;
  using State = typename block_detail::Types<B, double>::S;

 public:
  explicit SubSteps(const P& p) : p_(p) {}
  bool takes(double h) const { return h > 0; }
  State operator()(const State& s, const In& from, const In& to, double h) const {
    constexpr std::size_t n_u = sizeof(In) / sizeof(double), n_x = sizeof(State) / sizeof(double);
    std::array<double, n_u> a, b, at;
    std::array<double, n_x> x;
    std::array<double, 5 * n_x> work;
    block_detail::store<double>(from, a.data());
    block_detail::store<double>(to, b.data());
    block_detail::store<double>(s, x.data());
    const double rate = std::max(B::fastest(p_, from), B::fastest(p_, to));
    const double steps = std::clamp(std::ceil(h * rate / longest_share), 1.0, most_steps);
    for (int k = 0; k < static_cast<int>(steps); ++k)
      block_detail::runge_kutta(
          static_cast<int>(n_x), x.data(), h / steps, work.data(), [&](double c, const double* state, double* dx) {
            const double share = (k + c) / steps;
            for (std::size_t i = 0; i < n_u; ++i) at[i] = a[i] + share * (b[i] - a[i]);
            block_detail::store<double>(B::derivative(p_, block_detail::load<double>(State{}, state),
                                                      block_detail::load<double>(In{}, at.data())),
                                        dx);
          });
    return block_detail::load<double>(State{}, x.data());
  }

 private:
  static constexpr double longest_share = 0.1, most_steps = 1e5;
  P p_;
};

}  // namespace hysteron::blocks
