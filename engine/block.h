// Decides how a block is written: static functions over plain structs (fixed size), or over a View (size from the
// shapes). The signature is the declaration: which functions a block has, and which arguments they take, tells the
// engine what feeds through, what has states, what wants the rate of its inputs, and what remembers.
//
// Fixed form: struct templates Params<T>, In<T>, Out<T>, State<T>, Memory<T>, each holding only members of type T, and
//   output(p, s)          no feedthrough             output(p, in) / output(p, s, in)   every input feeds through
//   output(p, Time<T>)    a source                    output(p, m, in) + advance         m is always the advanced
//   memory derivative(p, s, in)  dx/dt                       derivative(p, s, in, rate)         wants du/dt of its
//   inputs advance(p, m, in)     what m becomes if `in` is accepted; pure
// Sized form: static Sizes sizes(const Shape&) and functions of View<T>: output, derivative, advance (templates);
//   prepare, rest, initial_states, initial_memory, next_corner, pace, reach_back, check (on View<double>).
#pragma once

#include <concepts>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "engine/kernel.h"

namespace hysteron {

/// Time, as a type of its own so that a source cannot be mistaken for a static block.
template <class T>
struct Time {
  T t{};
  double branch = 0;  ///< decides which smooth piece applies
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

template <class B>
struct Forms {
  using D = Types<B, double>;
  using P = typename D::P;
  using I = typename D::I;
  using S = typename D::S;
  using M = typename D::M;
  static constexpr bool output_time = requires(P p, Time<double> t) { B::output(p, t); };
  static constexpr bool output_state = !std::is_empty_v<S> && requires(P p, S s) { B::output(p, s); };
  static constexpr bool output_in = !std::is_empty_v<I> && requires(P p, I i) { B::output(p, i); };
  static constexpr bool output_state_in = !std::is_empty_v<S> && requires(P p, S s, I i) { B::output(p, s, i); };
  static constexpr bool output_memory = !std::is_empty_v<M> && requires(P p, M m, I i) { B::output(p, m, i); };
  static constexpr bool derivative = !std::is_empty_v<S> && requires(P p, S s, I i) { B::derivative(p, s, i); };
  static constexpr bool derivative_rate = !std::is_empty_v<S> && requires(P p, S s, I i) { B::derivative(p, s, i, i); };
  static constexpr bool advance = !std::is_empty_v<M> && requires(P p, M m, I i) { B::advance(p, m, i); };
  static_assert(output_time + output_state + output_in + output_state_in + output_memory == 1,
                "exactly one of output(p, Time), output(p, s), output(p, in), output(p, s, in), output(p, m, in)");
  static_assert(derivative + derivative_rate == (std::is_empty_v<S> ? 0 : 1),
                "a block with State has exactly one of derivative(p, s, in), derivative(p, s, in, rate)");
  static_assert(advance == !std::is_empty_v<M>, "a block with Memory has advance(p, m, in), and only such a block");
};

template <class B, class T>
void fixed_output(const View<T>& v) {
  using F = Forms<B>;
  using Y = Types<B, T>;
  const auto p = load<T>(typename Y::P{}, v.p);
  typename Y::O o{};
  if constexpr (F::output_time)
    o = B::output(p, Time<T>{v.t, v.branch});
  else if constexpr (F::output_state)
    o = B::output(p, load<T>(typename Y::S{}, v.x));
  else if constexpr (F::output_in)
    o = B::output(p, load<T>(typename Y::I{}, v.u));
  else if constexpr (F::output_state_in)
    o = B::output(p, load<T>(typename Y::S{}, v.x), load<T>(typename Y::I{}, v.u));
  else
    o = B::output(p, load<T>(typename Y::M{}, v.m), load<T>(typename Y::I{}, v.u));
  store<T>(o, v.out);
}

template <class B>
void fixed_derivative(const View<double>& v) {
  using F = Forms<B>;
  using Y = Types<B, double>;
  const auto p = load<double>(typename Y::P{}, v.p);
  const auto s = load<double>(typename Y::S{}, v.x);
  const auto in = load<double>(typename Y::I{}, v.u);
  if constexpr (F::derivative_rate)
    store<double>(B::derivative(p, s, in, load<double>(typename Y::I{}, v.du)), v.out);
  else
    store<double>(B::derivative(p, s, in), v.out);
}

template <class B, class T>
void fixed_advance(const View<T>& v) {
  using Y = Types<B, T>;
  store<T>(B::advance(load<T>(typename Y::P{}, v.p), load<T>(typename Y::M{}, v.m), load<T>(typename Y::I{}, v.u)),
           v.out);
}

template <class B>
void fixed_rest(const View<double>& v) {
  using Y = Types<B, double>;
  store<double>(B::rest(load<double>(typename Y::P{}, v.p), load<double>(typename Y::I{}, v.u)), v.out);
}

template <class B>
void fixed_initial_states(const View<double>& v) {
  store<double>(B::initial(load<double>(typename Types<B, double>::P{}, v.p)), v.out);
}
template <class B>
void fixed_initial_memory(const View<double>& v) {
  store<double>(B::start(load<double>(typename Types<B, double>::P{}, v.p)), v.out);
}
template <class B>
double fixed_next_corner(const View<double>& v) {
  return B::next_corner(load<double>(typename Types<B, double>::P{}, v.p), v.t);
}
template <class B>
double fixed_pace(const View<double>& v) {
  return B::pace(load<double>(typename Types<B, double>::P{}, v.p));
}
template <class B>
std::string fixed_check(const View<double>& v) {
  return B::check(load<double>(typename Types<B, double>::P{}, v.p));
}

template <class B>
Sizes fixed_sizes(const Shape&) {
  using Y = Types<B, double>;
  using F = Forms<B>;
  Sizes s;
  s.states = count<double, typename Y::S>();
  s.memory = count<double, typename Y::M>();
  s.outputs = count<double, typename Y::O>();
  s.feedthrough = F::output_in || F::output_state_in || F::output_memory;
  if constexpr (requires { B::smoothness; }) s.smoothness = B::smoothness;
  return s;
}

}  // namespace block_detail

/// The declaration of a fixed-size block: names are bound to members by pointer, so that they cannot drift.
template <class B>
class BlockSpec : public Declaration {
  using Y = block_detail::Types<B, double>;

  template <class S>
  static int index(double S::*member) {
    static S probe{};
    return static_cast<int>(&(probe.*member) - reinterpret_cast<double*>(&probe));
  }
  static void in_order(int index, std::size_t declared) {
    if (index != static_cast<int>(declared))
      throw std::logic_error("members of a block must be declared in the order in which its struct holds them");
  }

 public:
  using Declaration::input;
  using Declaration::output;
  using Declaration::state;

  PortDeclaration& input(double Y::I::*member, std::string port, UnitExpression unit, std::string meaning) {
    in_order(index(member), inputs.size());
    return Declaration::input(std::move(port), std::move(unit), std::move(meaning));
  }
  PortDeclaration& output(double Y::O::*member, std::string port, UnitExpression unit, std::string meaning) {
    in_order(index(member), outputs.size());
    return Declaration::output(std::move(port), std::move(unit), std::move(meaning));
  }
  StateDeclaration& state(double Y::S::*member, std::string key, UnitExpression unit, std::string meaning) {
    in_order(index(member), states.size());
    return Declaration::state(std::move(key), std::move(unit), std::move(meaning));
  }
  ParameterDeclaration& param(double Y::P::*member, std::string key, UnitExpression unit, std::string meaning) {
    in_order(index(member), parameters.size());
    return parameter(std::move(key), std::move(unit), std::move(meaning));
  }
  void memory(double Y::M::*member, std::string key) {
    in_order(index(member), memory_names.size());
    memory_names.push_back(std::move(key));
  }
};

/// The table of functions of a block type. Call it once per block, in the block's .cpp.
template <class B>
Kernel kernel() {
  using namespace block_detail;
  Kernel k;
  if constexpr (Sized<B>) {
    Declaration d;
    B::describe(d);
    k.declaration = std::move(d);
    k.sizes = &B::sizes;
    k.output = &B::template output<double>;
    k.output_rate = &B::template output<Dual>;
    if constexpr (requires(const View<double>& v) { B::derivative(v); }) k.derivative = &B::derivative;
    if constexpr (requires { B::wants_rate; }) k.derivative_wants_rate = B::wants_rate;
    if constexpr (requires(const View<double>& v) { B::template advance<double>(v); }) {
      k.advance = &B::template advance<double>;
      k.advance_rate = &B::template advance<Dual>;
    }
    if constexpr (requires(const View<double>& v) { B::prepare(v); }) k.prepare = &B::prepare;
    if constexpr (requires(const View<double>& v) { B::rest(v); }) k.rest = &B::rest;
    if constexpr (requires(const View<double>& v) { B::initial_states(v); }) k.initial_states = &B::initial_states;
    if constexpr (requires(const View<double>& v) { B::initial_memory(v); }) k.initial_memory = &B::initial_memory;
    if constexpr (requires(const View<double>& v) { B::next_corner(v); }) k.next_corner = &B::next_corner;
    if constexpr (requires(const View<double>& v) { B::pace(v); }) k.pace = &B::pace;
    if constexpr (requires(const View<double>& v) { B::reach_back(v); }) k.reach_back = &B::reach_back;
    if constexpr (requires(const View<double>& v) { B::check(v); }) k.check = &B::check;
    if constexpr (requires { B::uses_time; }) k.uses_time = B::uses_time;
  } else {
    using Y = Types<B, double>;
    BlockSpec<B> spec;
    B::describe(spec);
    k.declaration = spec;
    const auto& d = k.declaration;
    if (static_cast<int>(d.parameters.size()) != count<double, typename Y::P>() ||
        static_cast<int>(d.inputs.size()) != count<double, typename Y::I>() ||
        static_cast<int>(d.outputs.size()) != count<double, typename Y::O>() ||
        static_cast<int>(d.states.size()) != count<double, typename Y::S>() ||
        static_cast<int>(d.memory_names.size()) != count<double, typename Y::M>())
      throw std::logic_error("block " + d.type + ": every member of its structs must be declared, and nothing else");
    k.sizes = &fixed_sizes<B>;
    k.output = &fixed_output<B, double>;
    k.output_rate = &fixed_output<B, Dual>;
    k.uses_time = Forms<B>::output_time;
    if constexpr (!std::is_empty_v<typename Y::S>) k.derivative = &fixed_derivative<B>;
    k.derivative_wants_rate = Forms<B>::derivative_rate;
    if constexpr (Forms<B>::advance) {
      k.advance = &fixed_advance<B, double>;
      k.advance_rate = &fixed_advance<B, Dual>;
    }
    if constexpr (requires(typename Y::P p, typename Y::I i) { B::rest(p, i); }) k.rest = &fixed_rest<B>;
    if constexpr (requires(typename Y::P p) { B::initial(p); }) k.initial_states = &fixed_initial_states<B>;
    if constexpr (requires(typename Y::P p) { B::start(p); }) k.initial_memory = &fixed_initial_memory<B>;
    if constexpr (requires(typename Y::P p) { B::next_corner(p, 0.0); }) k.next_corner = &fixed_next_corner<B>;
    if constexpr (requires(typename Y::P p) { B::pace(p); }) k.pace = &fixed_pace<B>;
    if constexpr (requires(typename Y::P p) { B::check(p); }) k.check = &fixed_check<B>;
  }
  return k;
}

}  // namespace hysteron
