// Decides the blocks "coupled_tapi" and "sampled_coupled_tapi_inverse": n axes that hang on each other. Does not decide
// their law: models/hysteresis/coupled_tapi.h.
#pragma once

#include <array>
#include <string>

#include "blocks/hysteresis/plain_list.h"
#include "engine/block/block.h"
#include "models/hysteresis/coupled_tapi.h"

namespace hysteron::blocks {

struct CoupledTapi {
  enum Parameter { thresholds, weights, p_s, t_c, beta, a };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  static std::string check_memory(const View<double>& v);
  template <class T>
  static coupled_tapi::Params<T> law(const View<T>& v) {
    return {v.list(thresholds), v.list(weights), v.list(p_s), v.list(beta), v.list(a), v.parameter(t_c)};
  }
  /// The operators of all inputs, axis by axis.
  template <class T>
  static void advance_to(const View<T>& v, std::span<const T> before, const T* u, T* after) {
    const auto r = v.list(thresholds);
    for (std::size_t at = 0; at < before.size(); ++at)
      after[at] = play::follow_one_sided(r[at % r.size()], before[at], u[at / r.size()]);
  }
  // Inputs: one per axis, then the temperature.
  template <class T>
  static void advance(const View<T>& v) {
    advance_to(v, v.memory(), v.u, v.out);
  }
  template <class T>
  static void output(const View<T>& v) {
    const auto n = static_cast<std::size_t>(v.n_y);
    coupled_tapi::outputs(law(v), v.memory(), v.inputs().first(n), v.u[n], v.out);
  }
};

struct SampledCoupledTapiInverse {
  enum Parameter { thresholds, weights, p_s, t_c, beta, a, axes };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    command(v, v.out);
  }
  template <class T>
  static void update(const View<T>& v) {
    std::array<T, coupled_tapi::most_axes> own;
    const T* u = v.y;
    if (u == nullptr) {
      command(v, own.data());
      u = own.data();
    }
    CoupledTapi::advance_to(v, v.states(), u, v.out);
  }

 private:
  /// The answer in plain numbers; for scalars that carry derivatives one step of Newton's method adds them.
  template <class T>
  static void command(const View<T>& v, T* u) {
    using coupled_tapi::most_axes;
    const auto n = static_cast<std::size_t>(v.n_y);
    const auto r = plain_list(v.list(thresholds)), c = plain_list(v.list(weights)), s = plain_list(v.list(p_s)),
               b = plain_list(v.list(beta)), bend = plain_list(v.list(a)), memory = plain_list(v.states()),
               y = plain_list(v.inputs());
    const coupled_tapi::Params<double> law{r, c, s, b, bend, plain(v.parameter(t_c))};
    const auto how = coupled_tapi::Axes(v.choice(axes));
    std::array<double, most_axes> found{};
    for (std::size_t i = 0; i < n; ++i)
      found[i] = memory[i * r.size()];  // the operator of threshold 0 is the last input
    coupled_tapi::input_for(law, memory, std::span<const double>(y).first(n), y[n], how, found.data());
    for (std::size_t i = 0; i < n; ++i) u[i] = T{found[i]};
    if constexpr (!std::is_same_v<T, double>) refine(v, law, std::span<const double>(memory), y[n], how, u);
  }
  /// u <- u - J^-1 (H(u) - y): adds the derivatives and no more than rounding.
  template <class T>
  static void refine(const View<T>& v, const coupled_tapi::Params<double>& numbers, std::span<const double> memory,
                     double temperature, coupled_tapi::Axes how, T* u) {
    const std::size_t n = numbers.axes();
    std::array<double, coupled_tapi::most_axes * coupled_tapi::most_axes> slopes{};
    std::array<T, coupled_tapi::most_axes> miss;
    const auto law = CoupledTapi::law(v);
    for (std::size_t j = 0; j < n; ++j) {
      miss[j] = -v.u[j];
      for (std::size_t i = 0; i < n; ++i) {
        if (i != j && how == coupled_tapi::Axes::single) continue;
        miss[j] += coupled_tapi::branch_at(law, j, i, coupled_tapi::operators_of(law, v.states(), i), T{u[i]}, v.u[n]);
        slopes[j * n + i] = coupled_tapi::slope_at(numbers, j, i, coupled_tapi::operators_of(numbers, memory, i),
                                                   plain(u[i]), temperature);
      }
    }
    coupled_tapi::eliminate(n, slopes.data(), miss.data());
    for (std::size_t i = 0; i < n; ++i) u[i] = u[i] - miss[i];
  }
};

Kernel coupled_tapi_block();
Kernel sampled_coupled_tapi_inverse_block();

}  // namespace hysteron::blocks
