// Decides which functions a fixed block has, read off the signatures of its static functions (block.h tells how they
// are written), and how its structs are filled from plain numbers.
#pragma once

#include <concepts>
#include <cstring>
#include <type_traits>

#include "engine/block/kernel.h"

namespace hysteron {

/// Time, as a type of its own so that a source cannot be mistaken for a static block.
template <class T>
struct Time {
  T t{};
  double branch = 0;  ///< decides which smooth piece applies
};

/// Which branch of its law a block follows; changes at events only.
struct Mode {
  int is = 0;
  friend bool operator==(Mode, Mode) = default;
};

struct Nothing {};

namespace block_detail {

template <class B, class T>
auto params_of() {
  if constexpr (requires { typename B::template Params<T>; })
    return typename B::template Params<T>{};
  else
    return Nothing{};
}
template <class B, class T>
auto in_of() {
  if constexpr (requires { typename B::template In<T>; })
    return typename B::template In<T>{};
  else
    return Nothing{};
}
template <class B, class T>
auto out_of() {
  return typename B::template Out<T>{};
}
template <class B, class T>
auto state_of() {
  if constexpr (requires { typename B::template State<T>; })
    return typename B::template State<T>{};
  else
    return Nothing{};
}
template <class B, class T>
auto memory_of() {
  if constexpr (requires { typename B::template Memory<T>; })
    return typename B::template Memory<T>{};
  else
    return Nothing{};
}

template <class T, class S>
constexpr int count() {
  if constexpr (std::is_empty_v<S>)
    return 0;
  else {
    static_assert(std::is_standard_layout_v<S> && std::is_trivially_copyable_v<S> && sizeof(S) % sizeof(T) == 0,
                  "Params, In, Out, State and Memory hold only members of their scalar type T");
    return static_cast<int>(sizeof(S) / sizeof(T));
  }
}
template <class T, class S>
S load(S s, const T* from) {
  if constexpr (!std::is_empty_v<S>) std::memcpy(static_cast<void*>(&s), from, sizeof(S));
  return s;
}
template <class T, class S>
void store(const S& s, T* to) {
  if constexpr (!std::is_empty_v<S>) std::memcpy(static_cast<void*>(to), &s, sizeof(S));
}

template <class B, class T>
struct Types {
  using P = decltype(params_of<B, T>());
  using I = decltype(in_of<B, T>());
  using O = decltype(out_of<B, T>());
  using S = decltype(state_of<B, T>());
  using M = decltype(memory_of<B, T>());
};

template <class B>
concept Sized = requires(const Shape& s) {
  { B::sizes(s) } -> std::same_as<Sizes>;
};

template <class B, class T = double>
struct Forms {
  using D = Types<B, T>;
  using P = typename D::P;
  using I = typename D::I;
  using S = typename D::S;
  using M = typename D::M;
  static constexpr bool states = !std::is_empty_v<S>;
  static constexpr bool inputs = !std::is_empty_v<I>;
  static constexpr bool output_time = requires(P p, Time<T> t) { B::output(p, t); };
  static constexpr bool output_state = states && requires(P p, S s) { B::output(p, s); };
  static constexpr bool output_in = inputs && requires(P p, I i) { B::output(p, i); };
  static constexpr bool output_state_in = states && requires(P p, S s, I i) { B::output(p, s, i); };
  static constexpr bool output_memory = !std::is_empty_v<M> && requires(P p, M m, I i) { B::output(p, m, i); };
  static constexpr bool output_mode = !states && requires(P p, I i, Mode k) { B::output(p, i, k); };
  static constexpr bool output_state_mode = states && requires(P p, S s, Mode k) { B::output(p, s, k); };
  static constexpr bool output_state_in_mode = states && requires(P p, S s, I i, Mode k) { B::output(p, s, i, k); };
  static constexpr bool derivative = states && requires(P p, S s, I i) { B::derivative(p, s, i); };
  static constexpr bool derivative_rate = states && requires(P p, S s, I i) { B::derivative(p, s, i, i); };
  static constexpr bool derivative_mode = states && requires(P p, S s, I i, Mode k) { B::derivative(p, s, i, k); };
  static constexpr bool derivative_rate_mode = states && requires(P p, S s, I i, Mode k) {
    B::derivative(p, s, i, i, k);
  };
  static constexpr bool update_out = states && requires(P p, S s, I i, typename D::O o) { B::update(p, s, i, o); };
  static constexpr bool update = update_out || (states && requires(P p, S s, I i) { B::update(p, s, i); });
  static constexpr bool advance = !std::is_empty_v<M> && requires(P p, M m, I i) { B::advance(p, m, i); };
  static constexpr bool guard = requires(P p, I i, Mode k) { B::guard(p, i, k); };
  static constexpr bool guard_state = states && requires(P p, S s, I i, Mode k) { B::guard(p, s, i, k); };
  static constexpr bool guard_rate = states && requires(P p, S s, I i, Mode k) { B::guard(p, s, i, i, k); };
  static constexpr bool modes = guard || guard_state || guard_rate;
  static constexpr bool sampled = update || requires { requires B::is_sampled; };
  static_assert(output_time + output_state + output_in + output_state_in + output_memory + output_mode +
                        output_state_mode + output_state_in_mode ==
                    1,
                "exactly one of output(p, Time), output(p, s), output(p, in), output(p, s, in), output(p, m, in), or "
                "with a Mode behind them");
  static_assert(derivative + derivative_rate + derivative_mode + derivative_rate_mode + update == (states ? 1 : 0),
                "a block with State has exactly one of derivative(p, s, in), derivative(p, s, in, rate), each maybe "
                "with a Mode behind it, and update(p, s, in), which may take the outputs too");
  static_assert(advance == !std::is_empty_v<M>, "a block with Memory has advance(p, m, in), and only such a block");
  static_assert(guard + guard_state + guard_rate <= 1,
                "at most one of guard(p, in, Mode), guard(p, s, in, Mode), guard(p, s, in, rate, Mode)");
};

}  // namespace block_detail
}  // namespace hysteron
