// Decides how a block passes many rows at once: a loop over rows around its inlined functions, for fixed and sized
// blocks, with one lane or RowsView::most_lanes. States that are not linear follow the classical Runge-Kutta formula of
// order four, one step a row, inputs moving in a straight line. Does not decide what a row is: advance_rows.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "engine/block/block_forms.h"

namespace hysteron::block_detail {

/// One step of length h: x moves along slope(c, x, dx), c = 0, 1/2, 1 the place inside the step. work: 5 n numbers.
/// Source: Kutta, Z. Math. Phys. 46 (1901) 435-453.
template <class Slope>
inline void runge_kutta(int n, double* x, double h, double* work, const Slope& slope) {
  double *k1 = work, *k2 = k1 + n, *k3 = k2 + n, *k4 = k3 + n, *moved = k4 + n;
  slope(0.0, x, k1);
  for (int i = 0; i < n; ++i) moved[i] = x[i] + 0.5 * h * k1[i];
  slope(0.5, moved, k2);
  for (int i = 0; i < n; ++i) moved[i] = x[i] + 0.5 * h * k2[i];
  slope(0.5, moved, k3);
  for (int i = 0; i < n; ++i) moved[i] = x[i] + h * k3[i];
  slope(1.0, moved, k4);
  for (int i = 0; i < n; ++i) x[i] += h / 6 * (k1[i] + 2 * (k2[i] + k3[i]) + k4[i]);
}

/// States over one row: a step of h, or, where h = 0 and the inputs differ, `path_steps` along their jump (path.h).
/// move(begin, end, length, duration): one Runge-Kutta step from `begin` to `end` (shares of the way of the inputs)
/// that takes `length`; the rates of the inputs are their way over `duration`.
template <class Move>
inline void follow_row(double h, bool jumps, int path_steps, const Move& move) {
  if (h > 0) return move(0.0, 1.0, h, h);
  if (!jumps) return;
  for (int i = 0; i < path_steps; ++i)
    move(static_cast<double>(i) / path_steps, (i + 1.0) / path_steps, jump_duration / path_steps, jump_duration);
}

/// Does the block step through a row on its own where it knows better than Runge-Kutta: B::OwnStep, made from the
/// parameters of a run, with takes(h) and a call that moves its states from one row to the next (block.h).
template <class B>
concept StepsOnItsOwn = requires {
  typename B::OwnStep;
};

template <class B>
auto own_step(const auto& parameters) {
  if constexpr (StepsOnItsOwn<B>)
    return typename B::OwnStep(parameters);
  else
    return Nothing{};
}

template <class B, std::size_t lanes>
void fixed_rows_of(const RowsView& r) {
  using F = Forms<B>;
  using Y = Types<B, double>;
  using P = typename Y::P;
  using I = typename Y::I;
  using O = typename Y::O;
  using S = typename Y::S;
  using M = typename Y::M;
  constexpr auto n_u = static_cast<std::size_t>(count<double, I>());
  constexpr auto n_y = static_cast<std::size_t>(count<double, O>());
  constexpr auto n_x = static_cast<std::size_t>(count<double, S>());
  constexpr auto n_m = static_cast<std::size_t>(count<double, M>());
  std::array<const double*, n_u> u;
  std::array<double*, n_y> y;
  std::copy_n(r.u, n_u, u.begin());
  std::copy_n(r.y, n_y, y.begin());
  std::array<P, lanes> p;
  using Own = decltype(own_step<B>(std::declval<P>()));
  std::array<std::optional<Own>, lanes> own;
  [[maybe_unused]] std::array<S, lanes> s{};
  [[maybe_unused]] std::array<M, lanes> m{};
  for (std::size_t l = 0; l < lanes; ++l) {
    p[l] = load<double>(P{}, r.views[l].p);
    own[l].emplace(own_step<B>(p[l]));
    if constexpr (n_x > 0) s[l] = load<double>(S{}, r.x + l * n_x);
    if constexpr (n_m > 0) m[l] = load<double>(M{}, r.m + l * n_m);
  }
  const auto inputs = [&](std::ptrdiff_t place) {
    std::array<double, n_u> values;
    for (std::size_t i = 0; i < n_u; ++i) values[i] = u[i][place];
    return values;
  };
  for (int k = 0; k < r.count; ++k)
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::ptrdiff_t place = k * static_cast<std::ptrdiff_t>(lanes) + static_cast<std::ptrdiff_t>(l);
      const auto now = inputs(place);
      if constexpr (F::derivative || F::derivative_rate || StepsOnItsOwn<B>) {
        const auto before = inputs(place - static_cast<std::ptrdiff_t>(lanes));
        const auto move = [&](double begin, double end, double length, double duration) {
          std::array<double, n_u> from, to, middle, rate;
          for (std::size_t i = 0; i < n_u; ++i) {
            const double way = now[i] - before[i];
            from[i] = before[i] + begin * way;
            to[i] = end == 1 ? now[i] : before[i] + end * way;
            middle[i] = 0.5 * (from[i] + to[i]);
            rate[i] = way / duration;
          }
          if constexpr (StepsOnItsOwn<B>) {
            if (own[l]->takes(length)) {
              s[l] = (*own[l])(s[l], load<double>(I{}, from.data()), load<double>(I{}, to.data()), length);
              return;
            }
          }
          if constexpr (F::derivative || F::derivative_rate) {
            std::array<double, n_x> x;
            std::array<double, 5 * n_x> work;
            store<double>(s[l], x.data());
            runge_kutta(
                static_cast<int>(n_x), x.data(), length, work.data(), [&](double c, const double* at, double* dx) {
                  const auto in = load<double>(I{}, (c == 0 ? from : c == 1 ? to : middle).data());
                  if constexpr (F::derivative_rate)
                    store<double>(B::derivative(p[l], load<double>(S{}, at), in, load<double>(I{}, rate.data())), dx);
                  else
                    store<double>(B::derivative(p[l], load<double>(S{}, at), in), dx);
                });
            s[l] = load<double>(S{}, x.data());
          }
        };
        follow_row(r.h[k], now != before, r.path_steps, move);
      }
      const auto in = load<double>(I{}, now.data());
      std::array<double, n_y> out;
      if constexpr (F::output_memory) {
        m[l] = B::advance(p[l], m[l], in);
        store<double>(B::output(p[l], m[l], in), out.data());
      } else if constexpr (F::output_state) {
        store<double>(B::output(p[l], s[l]), out.data());
      } else if constexpr (F::output_state_in) {
        store<double>(B::output(p[l], s[l], in), out.data());
      } else {
        store<double>(B::output(p[l], in), out.data());
      }
      for (std::size_t i = 0; i < n_y; ++i) y[i][place] = out[i];
    }
  for (std::size_t l = 0; l < lanes; ++l) {
    if constexpr (n_x > 0) store<double>(s[l], r.x + l * n_x);
    if constexpr (n_m > 0) store<double>(m[l], r.m + l * n_m);
  }
}

template <class B>
void fixed_rows(const RowsView& r) {
  r.lanes == 1 ? fixed_rows_of<B, 1>(r) : fixed_rows_of<B, RowsView::most_lanes>(r);
}

/// Is there a loop over rows: outputs follow from parameters, states, memory and inputs, without modes. A block with
/// modes has one if it steps through every row on its own, whatever its mode, and its outputs do not tell it.
template <class B>
constexpr bool has_fixed_rows() {
  using F = Forms<B>;
  if constexpr (F::modes) return F::inputs && F::output_state && StepsOnItsOwn<B>;
  return F::inputs && !F::sampled && !F::modes &&
         (F::output_memory || F::output_in ||
          ((F::output_state || F::output_state_in) && (F::derivative || F::derivative_rate)));
}

template <class B>
void sized_rows_of_lane(const RowsView& r, int lane) {
  constexpr bool has_states = requires(const View<double>& v) { B::template derivative<double>(v); };
  constexpr bool has_memory = requires(const View<double>& v) { B::template advance<double>(v); };
  View<double> v = r.views[lane];
  const int n_u = v.n_u, n_x = v.n_x, n_m = v.n_m, n_y = v.n_y;
  double* now = r.scratch;
  double* middle = now + n_u;
  double* rate = middle + n_u;
  double* until = rate + n_u;
  double* work = until + n_u;
  double* next = work + 5 * n_x;
  double* own = r.m + lane * n_m;
  double* out = next + n_m;
  double* x = r.x + lane * n_x;
  [[maybe_unused]] auto own_law = own_step<B>(v);
  const auto gather = [&](std::ptrdiff_t row, double* to) {
    for (int i = 0; i < n_u; ++i) to[i] = r.u[i][row * r.lanes + lane];
  };
  for (int k = 0; k < r.count; ++k) {
    if (r.t != nullptr) v.t = v.branch = r.t[k];
    v.u = now;
    if constexpr (has_states) {
      if (n_x > 0) {
        gather(k, now);
        gather(k - 1, rate);  // first the way of the inputs
        bool jumps = false;
        for (int i = 0; i < n_u; ++i) {
          rate[i] = now[i] - rate[i];
          jumps = jumps || rate[i] != 0;
        }
        follow_row(r.h[k], jumps, r.path_steps, [&](double begin, double end, double length, double duration) {
          if constexpr (StepsOnItsOwn<B>) {
            if (own_law.takes(length)) {
              for (int i = 0; i < n_u; ++i) {
                middle[i] = now[i] - (1 - begin) * rate[i];
                until[i] = now[i] - (1 - end) * rate[i];
              }
              own_law(x, middle, until, length);
              return;
            }
          }
          v.u = middle;
          for (int i = 0; i < n_u; ++i) rate[i] /= duration;
          v.du = rate;
          runge_kutta(n_x, x, length, work, [&](double c, const double* at, double* dx) {
            const double to_end = 1 - (begin + c * (end - begin));
            for (int i = 0; i < n_u; ++i) middle[i] = now[i] - to_end * (rate[i] * duration);
            v.x = at;
            v.out = dx;
            B::template derivative<double>(v);
          });
          for (int i = 0; i < n_u; ++i) rate[i] *= duration;
        });
        v.u = now;
      }
    }
    gather(k, now);
    v.x = x;
    if constexpr (has_memory) {
      v.m = own;
      v.out = next;
      B::template advance<double>(v);
      std::swap(own, next);
      v.m = own;
    }
    if (n_y == 1 && r.lanes == 1) {
      v.out = r.y[0] + k;
      B::template output<double>(v);
    } else {
      v.out = out;
      B::template output<double>(v);
      for (int i = 0; i < n_y; ++i) r.y[i][static_cast<std::ptrdiff_t>(k) * r.lanes + lane] = out[i];
    }
  }
  if constexpr (has_memory)
    if (own != r.m + lane * n_m) std::copy_n(own, n_m, r.m + lane * n_m);
}

template <class B>
void sized_rows(const RowsView& r) {
  for (int lane = 0; lane < r.lanes; ++lane) sized_rows_of_lane<B>(r, lane);
}

}  // namespace hysteron::block_detail
