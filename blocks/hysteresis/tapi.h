// Decides the blocks of the temperature-dependent asymmetric Prandtl-Ishlinskii model: "tapi" and its inverse
// "sampled_tapi_inverse". Does not decide the law: models/hysteresis/tapi.h.
#pragma once

#include <string>
#include <type_traits>

#include "blocks/hysteresis/plain_list.h"
#include "engine/block/block.h"
#include "models/hysteresis/tapi.h"

namespace hysteron::blocks {

struct Tapi {
  enum Parameter { thresholds, weights, p_s, t_c, beta, a, before };
  enum Input { u, temperature };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  template <class T>
  static tapi::Params<T> law(const View<T>& v) {
    return {v.parameter(p_s), v.parameter(t_c), v.parameter(beta), v.parameter(a)};
  }
  template <class T>
  static void advance(const View<T>& v) {
    prandtl_ishlinskii::advance(play::Sides::one, v.list(thresholds), v.memory(), v.u[u], v.out);
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = tapi::output(law(v), v.list(weights), v.memory(), v.u[u], v.u[temperature]);
  }
  static void initial_memory(const View<double>& v);
  static std::string check_memory(const View<double>& v);
};

/// The input whose output is y: solved for 0 iterations, else so many steps of the thesis. In plain numbers; for
/// scalars that carry derivatives one step of Newton's method adds them, and no more than rounding.
template <class T>
T tapi_command(const tapi::Params<T>& law, std::span<const T> thresholds, std::span<const T> weights,
               std::span<const T> states, const T& y, const T& temperature, int iterations) {
  const tapi::Params<double> numbers{plain(law.p_s), plain(law.t_c), plain(law.beta), plain(law.a)};
  const auto r = plain_list(thresholds), c = plain_list(weights), w = plain_list(states);
  const double hot = plain(temperature);
  const double found = iterations > 0 ? tapi::iterated_input(numbers, r, c, w, plain(y), hot, iterations)
                                      : tapi::input_for(numbers, r, c, w, plain(y), hot);
  if constexpr (std::is_same_v<T, double>) return found;
  const T miss = tapi::output_at(law, thresholds, weights, states, T{found}, temperature) - y;
  return T{found} - (miss - T{plain(miss)}) / T{tapi::slope_at(numbers, r, c, w, found, hot)};
}

/// Finds the input of the actuator at each instant; its states are the operators of the actuator.
struct SampledTapiInverse {
  enum Parameter { thresholds, weights, p_s, t_c, beta, a, before, iterations };
  enum Input { y, temperature };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = command(v);
  }
  template <class T>
  static void update(const View<T>& v) {
    const T command_now = v.y != nullptr ? v.y[0] : command(v);
    prandtl_ishlinskii::advance(play::Sides::one, v.list(thresholds), v.states(), command_now, v.out);
  }
  static void initial_states(const View<double>& v);

 private:
  template <class T>
  static T command(const View<T>& v) {
    return tapi_command({v.parameter(p_s), v.parameter(t_c), v.parameter(beta), v.parameter(a)}, v.list(thresholds),
                        v.list(weights), v.states(), v.u[y], v.u[temperature], v.choice(iterations));
  }
};

/// "" or why these weights are those of no actuator that can be inverted by a drive, and the cure.
std::string check_invertible(std::span<const double> thresholds, std::span<const double> weights);

Kernel tapi_block();
Kernel sampled_tapi_inverse_block();

}  // namespace hysteron::blocks
