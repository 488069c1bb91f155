// Decides the blocks "asymmetric_prandtl_ishlinskii" and its inverse: the TAPI law at one temperature, with the numbers
// that then remain. Does not decide the law: models/hysteresis/tapi.h.
#pragma once

#include <string>

#include "blocks/hysteresis/tapi.h"
#include "engine/block/block.h"

namespace hysteron::blocks {

namespace asymmetric {
/// P_s tanh(u/bend): the TAPI law where P_s(T) and a T do not change. Any t_c above `now` does, since beta is 0.
inline constexpr double now = 1, t_c = 2;
template <class T>
tapi::Params<T> law(const T& saturation, const T& bend) {
  return {saturation, T{t_c}, T{0}, bend / T{now}};
}
}  // namespace asymmetric

struct AsymmetricPrandtlIshlinskii {
  enum Parameter { thresholds, weights, saturation, bend, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  template <class T>
  static void advance(const View<T>& v) {
    prandtl_ishlinskii::advance(play::Sides::one, v.list(thresholds), v.memory(), v.u[0], v.out);
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = tapi::output(asymmetric::law(v.parameter(saturation), v.parameter(bend)), v.list(weights), v.memory(),
                            v.u[0], T{asymmetric::now});
  }
  static void initial_memory(const View<double>& v);
  static std::string check_memory(const View<double>& v);
};

struct SampledAsymmetricInverse {
  enum Parameter { thresholds, weights, saturation, bend, before, iterations };

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
    return tapi_command(asymmetric::law(v.parameter(saturation), v.parameter(bend)), v.list(thresholds),
                        v.list(weights), v.states(), v.u[0], T{asymmetric::now}, v.choice(iterations));
  }
};

Kernel asymmetric_prandtl_ishlinskii_block();
Kernel sampled_asymmetric_inverse_block();

}  // namespace hysteron::blocks
