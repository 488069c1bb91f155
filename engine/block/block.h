// Decides how a block is written: static functions over plain structs (fixed size), or over a View (size from the
// shapes). The signature is the declaration: which functions a block has, and which arguments they take, tells the
// engine what feeds through, what has states, what wants the rate of its inputs, what remembers, what is sampled and
// what has modes.
//
// Fixed form: struct templates Params<T>, In<T>, Out<T>, State<T>, Memory<T>, each holding only members of type T, and
//   output(p, s)          no feedthrough           output(p, in) / output(p, s, in)   every input feeds through
//   output(p, Time<T>)    a source                 output(p, m, in) + advance         m is always the advanced memory
//   derivative(p, s, in)  dx/dt                    derivative(p, s, in, rate)         wants du/dt of its inputs
//   advance(p, m, in)     what m becomes if `in` is accepted; pure
//   update(p, s, in)      what s becomes after a sampling instant: the block is sampled, State holds sampled states,
//   and
//                         Params ends with period and offset (BlockSpec::sampled). A sampled block without State says
//                         `static constexpr bool is_sampled = true`.
//   update(p, s, in, out) the same from the outputs of this instant, for laws that cost too much to be computed twice
// With modes, every function may take a Mode as last argument (output, derivative), and the block has
//   guard(p, s, in, Mode) -> T        positive while the mode may stay; or guard(p, in, Mode), guard(p, s, in, rate,
//   Mode) next(p, s, in, Mode) -> Mode      the mode that follows; same arguments as guard, all double reset(p, s, in,
//   Mode before, Mode after) -> State<T>   optional: states at the beginning of the mode `after` initial_mode(p) or
//   initial_mode(p, s) -> Mode   optional: the one to try first at states that somebody else set
// A law that has kinks or jumps without modes (a limit, an absolute value, a level) names them:
//   kinks(p, in) or kinks(p, s, in) -> std::array<double, N>, all double: each number changes its sign at one of them.
//   Sized form: kinks(View<double>), and Sizes::kinks says how many. The integrators locate them (zero_crossings.h).
// Sized form: static Sizes sizes(const Shape&) and functions of View<T>: output, derivative, advance, update, guard,
//   reset (templates); next_mode, initial_mode, prepare, rest, initial_states, initial_memory, given_memory,
//   check_memory, next_breakpoint, pace, reach_back, check (on View<double>); rows(const RowsView&) where the block
//   knows better than the loop over rows that is made of its advance, derivative and output otherwise (rows.h).
// Both: struct OwnStep, where the block knows its states behind a row of straight inputs better than Runge-Kutta does:
//   made from Params<double> or a View<double>; takes(h) says whether it steps through a row of that length [s], or
//   share of a jump; the call (state, from, to, h) -> State, or (double* x, from, to, h), does, `from` and `to` being
//   the inputs at its ends. With it a fixed block with modes can be advanced row by row, too, if it takes all rows:
//   then its modes change inside its own step, and its output is one of (p, s).
#pragma once

#include <algorithm>
#include <array>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

#include "engine/block/block_forms.h"
#include "engine/block/block_lanes.h"
#include "engine/block/kernel.h"
#include "engine/block/rows.h"

namespace hysteron {
namespace block_detail {

/// The arguments of a fixed block, loaded from a view.
template <class B, class T>
struct Arguments {
  using Y = Types<B, T>;
  typename Y::P p;
  typename Y::S s;
  typename Y::I in;
  explicit Arguments(const View<T>& v)
      : p(load<T>(typename Y::P{}, v.p)), s(load<T>(typename Y::S{}, v.x)), in(load<T>(typename Y::I{}, v.u)) {}
};

template <class B, class T>
void fixed_output(const View<T>& v) {
  using F = Forms<B>;
  using Y = Types<B, T>;
  const auto p = load<T>(typename Y::P{}, v.p);
  [[maybe_unused]] const auto s = [&] { return load<T>(typename Y::S{}, v.x); };
  [[maybe_unused]] const auto in = [&] { return load<T>(typename Y::I{}, v.u); };
  typename Y::O o{};
  if constexpr (F::output_time)
    o = B::output(p, Time<T>{v.t, v.branch});
  else if constexpr (F::output_state)
    o = B::output(p, s());
  else if constexpr (F::output_in)
    o = B::output(p, in());
  else if constexpr (F::output_state_in)
    o = B::output(p, s(), in());
  else if constexpr (F::output_memory)
    o = B::output(p, load<T>(typename Y::M{}, v.m), in());
  else if constexpr (F::output_mode)
    o = B::output(p, in(), Mode{v.mode});
  else if constexpr (F::output_state_mode)
    o = B::output(p, s(), Mode{v.mode});
  else
    o = B::output(p, s(), in(), Mode{v.mode});
  store<T>(o, v.out);
}

template <class B, class T>
void fixed_derivative(const View<T>& v) {
  using F = Forms<B>;
  const Arguments<B, T> a(v);
  [[maybe_unused]] const auto rate = [&] { return load<T>(typename Types<B, T>::I{}, v.du); };
  if constexpr (F::derivative_rate)
    store<T>(B::derivative(a.p, a.s, a.in, rate()), v.out);
  else if constexpr (F::derivative_rate_mode)
    store<T>(B::derivative(a.p, a.s, a.in, rate(), Mode{v.mode}), v.out);
  else if constexpr (F::derivative_mode)
    store<T>(B::derivative(a.p, a.s, a.in, Mode{v.mode}), v.out);
  else
    store<T>(B::derivative(a.p, a.s, a.in), v.out);
}

template <class B, class T>
void fixed_update(const View<T>& v) {
  const Arguments<B, T> a(v);
  if constexpr (Forms<B>::update_out) {
    using O = typename Types<B, T>::O;
    std::array<T, static_cast<std::size_t>(count<T, O>())> own;
    View<T> with_outputs = v;
    if (v.y == nullptr) {
      with_outputs.out = own.data();
      fixed_output<B, T>(with_outputs);
      with_outputs.y = own.data();
    }
    store<T>(B::update(a.p, a.s, a.in, load<T>(O{}, with_outputs.y)), v.out);
  } else {
    store<T>(B::update(a.p, a.s, a.in), v.out);
  }
}

template <class B, class T>
void fixed_advance(const View<T>& v) {
  using Y = Types<B, T>;
  store<T>(B::advance(load<T>(typename Y::P{}, v.p), load<T>(typename Y::M{}, v.m), load<T>(typename Y::I{}, v.u)),
           v.out);
}

template <class B, class T>
void fixed_guard(const View<T>& v) {
  using F = Forms<B>;
  const Arguments<B, T> a(v);
  if constexpr (F::guard_rate)
    v.out[0] = B::guard(a.p, a.s, a.in, load<T>(typename Types<B, T>::I{}, v.du), Mode{v.mode});
  else if constexpr (F::guard_state)
    v.out[0] = B::guard(a.p, a.s, a.in, Mode{v.mode});
  else
    v.out[0] = B::guard(a.p, a.in, Mode{v.mode});
}

template <class B>
int fixed_next_mode(const View<double>& v) {
  using F = Forms<B>;
  const Arguments<B, double> a(v);
  if constexpr (F::guard_rate)
    return B::next(a.p, a.s, a.in, load<double>(typename Types<B, double>::I{}, v.du), Mode{v.mode}).is;
  else if constexpr (F::guard_state)
    return B::next(a.p, a.s, a.in, Mode{v.mode}).is;
  else
    return B::next(a.p, a.in, Mode{v.mode}).is;
}

template <class B, class T>
void fixed_reset(const View<T>& v) {
  const Arguments<B, T> a(v);
  store<T>(B::reset(a.p, a.s, a.in, Mode{v.mode_before}, Mode{v.mode}), v.out);
}

template <class B>
int fixed_initial_mode(const View<double>& v) {
  using Y = Types<B, double>;
  const auto p = load<double>(typename Y::P{}, v.p);
  if constexpr (requires(typename Y::S s) { B::initial_mode(p, s); })
    return B::initial_mode(p, load<double>(typename Y::S{}, v.x)).is;
  else
    return B::initial_mode(p).is;
}

template <class B>
bool fixed_is_affine_in_modes(const View<double>& v) {
  return B::is_affine_in_modes(load<double>(typename Types<B, double>::P{}, v.p));
}

/// What a fixed block with modes says of them, in numbers.
template <class B>
void take_modes(Kernel& k) {
  using Y = Types<B, double>;
  k.next_mode = &fixed_next_mode<B>;
  if constexpr (requires(typename Y::P p) { B::is_affine_in_modes(p); })
    k.is_affine_in_modes = &fixed_is_affine_in_modes<B>;
  if constexpr (
      requires(typename Y::P p) { B::initial_mode(p); } ||
      requires(typename Y::P p, typename Y::S s) { B::initial_mode(p, s); })
    k.initial_mode = &fixed_initial_mode<B>;
}

/// The functions of a fixed block for the scalar T.
template <class B, class T>
void fixed_functions(Functions<T>& f) {
  using F = Forms<B>;
  using Y = Types<B, T>;
  f.output = &fixed_output<B, T>;
  f.output_rate = &fixed_output<B, DualOf<T>>;
  if constexpr (F::states && !F::sampled) f.derivative = &fixed_derivative<B, T>;
  if constexpr (F::update) f.update = &fixed_update<B, T>;
  if constexpr (F::advance) {
    f.advance = &fixed_advance<B, T>;
    f.advance_rate = &fixed_advance<B, DualOf<T>>;
  }
  if constexpr (F::modes) f.guard = &fixed_guard<B, T>;
  if constexpr (requires(typename Y::P p, typename Y::S s, typename Y::I i, Mode k) { B::reset(p, s, i, k, k); })
    f.reset = &fixed_reset<B, T>;
}

/// The functions of a sized block for the scalar T.
template <class B, class T>
void sized_functions(Functions<T>& f) {
  f.output = &B::template output<T>;
  f.output_rate = &B::template output<DualOf<T>>;
  if constexpr (requires(const View<T>& v) { B::template derivative<T>(v); }) f.derivative = &B::template derivative<T>;
  if constexpr (requires(const View<T>& v) { B::template update<T>(v); }) f.update = &B::template update<T>;
  if constexpr (requires(const View<T>& v) { B::template guard<T>(v); }) f.guard = &B::template guard<T>;
  if constexpr (requires(const View<T>& v) { B::template reset<T>(v); }) f.reset = &B::template reset<T>;
  if constexpr (requires(const View<T>& v) { B::template advance<T>(v); }) {
    f.advance = &B::template advance<T>;
    f.advance_rate = &B::template advance<DualOf<T>>;
  }
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
double fixed_next_breakpoint(const View<double>& v) {
  return B::next_breakpoint(load<double>(typename Types<B, double>::P{}, v.p), v.t);
}
template <class B>
double fixed_shortest_period(const View<double>& v) {
  return B::shortest_period(load<double>(typename Types<B, double>::P{}, v.p));
}
/// The kinks of a fixed block, or Nothing if it names none.
template <class B>
auto kinks_of(const View<double>& v) {
  using Y = Types<B, double>;
  const auto p = load<double>(typename Y::P{}, v.p);
  const auto in = load<double>(typename Y::I{}, v.u);
  if constexpr (requires(typename Y::S s) { B::kinks(p, s, in); })
    return B::kinks(p, load<double>(typename Y::S{}, v.x), in);
  else if constexpr (requires { B::kinks(p, in); })
    return B::kinks(p, in);
  else
    return Nothing{};
}
template <class B>
inline constexpr bool has_kinks = !std::is_same_v<decltype(kinks_of<B>(std::declval<View<double>>())), Nothing>;
template <class B>
bool fixed_is_linear_at(const View<double>& v) {
  return B::is_linear_at(load<double>(typename Types<B, double>::P{}, v.p));
}
template <class B>
void fixed_kinks(const View<double>& v) {
  const auto kinks = kinks_of<B>(v);
  std::copy(kinks.begin(), kinks.end(), v.out);
}

template <class B>
std::string fixed_check(const View<double>& v) {
  return B::check(load<double>(typename Types<B, double>::P{}, v.p));
}

template <class B>
std::string fixed_check_memory(const View<double>& v) {
  using Y = Types<B, double>;
  return B::check_memory(load<double>(typename Y::P{}, v.p), load<double>(typename Y::M{}, v.m));
}

template <class B>
Sizes fixed_sizes(const Shape&) {
  using Y = Types<B, double>;
  using F = Forms<B>;
  Sizes s;
  (F::sampled ? s.sampled_states : s.states) = count<double, typename Y::S>();
  s.memory = count<double, typename Y::M>();
  s.outputs = count<double, typename Y::O>();
  s.feedthrough = F::output_in || F::output_state_in || F::output_memory || F::output_mode || F::output_state_in_mode;
  if constexpr (requires { B::smoothness; }) s.smoothness = B::smoothness;
  if constexpr (has_kinks<B>) s.kinks = static_cast<int>(std::tuple_size_v<decltype(kinks_of<B>(View<double>{}))>);
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
  /// Declares the block's period and offset, the last members of Params.
  void sampled(double Y::P::*period, double Y::P::*offset) {
    in_order(index(period), parameters.size());
    in_order(index(offset), parameters.size() + 1);
    Declaration::sampled();
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
    sized_functions<B, double>(k);
    sized_functions<B, Jet>(k.jet);
    if constexpr (requires { B::wants_rate; }) k.derivative_wants_rate = B::wants_rate;
    if constexpr (requires { B::guard_wants_rate; }) k.guard_wants_rate = B::guard_wants_rate;
    if constexpr (requires(const View<double>& v) { B::next_mode(v); }) k.next_mode = &B::next_mode;
    if constexpr (requires(const View<double>& v) { B::initial_mode(v); }) k.initial_mode = &B::initial_mode;
    if constexpr (requires(const View<double>& v) { B::prepare(v); }) k.prepare = &B::prepare;
    if constexpr (requires(const View<double>& v) { B::rest(v); }) k.rest = &B::rest;
    if constexpr (requires(const View<double>& v) { B::initial_states(v); }) k.initial_states = &B::initial_states;
    if constexpr (requires(const View<double>& v) { B::initial_memory(v); }) k.initial_memory = &B::initial_memory;
    if constexpr (requires(const View<double>& v) { B::next_breakpoint(v); }) k.next_breakpoint = &B::next_breakpoint;
    if constexpr (requires(const View<double>& v) { B::shortest_period(v); }) k.shortest_period = &B::shortest_period;
    if constexpr (requires(const View<double>& v) { B::reach_back(v); }) k.reach_back = &B::reach_back;
    if constexpr (requires(const View<double>& v) { B::check(v); }) k.check = &B::check;
    if constexpr (requires(const View<double>& v) { B::given_memory(v); }) k.given_memory = &B::given_memory;
    if constexpr (requires(const View<double>& v) { B::check_memory(v); }) k.check_memory = &B::check_memory;
    if constexpr (requires { B::uses_time; }) k.uses_time = B::uses_time;
    if constexpr (requires(const View<double>& v) { B::kinks(v); }) k.kinks = &B::kinks;
    if constexpr (requires(const View<double>& v) { B::is_linear_at(v); }) k.is_linear_at = &B::is_linear_at;
    if constexpr (requires(const RowsView& r) { B::rows(r); })
      k.rows = &B::rows;
    else if (k.update == nullptr && k.guard == nullptr)
      k.rows = &sized_rows<B>;
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
    using F = Forms<B>;
    if (F::sampled != d.is_sampled)
      throw std::logic_error("block " + d.type + ": a block is sampled by its functions and by its declaration");
    fixed_functions<B, double>(k);
    fixed_functions<B, Jet>(k.jet);
    k.uses_time = F::output_time;
    if constexpr (has_fixed_rows<B>()) k.rows = &fixed_rows<B>;
    if constexpr (!F::sampled && !F::modes) k.lanes = fixed_lanes<B>();
    k.derivative_wants_rate = F::derivative_rate || F::derivative_rate_mode;
    k.guard_wants_rate = F::guard_rate;
    if constexpr (F::modes) take_modes<B>(k);
    if constexpr (has_kinks<B>) k.kinks = &fixed_kinks<B>;
    if constexpr (requires(typename Y::P p) { B::is_linear_at(p); }) k.is_linear_at = &fixed_is_linear_at<B>;
    if constexpr (requires(typename Y::P p, typename Y::I i) { B::rest(p, i); }) k.rest = &fixed_rest<B>;
    if constexpr (requires(typename Y::P p) { B::initial(p); }) k.initial_states = &fixed_initial_states<B>;
    if constexpr (requires(typename Y::P p) { B::start(p); }) k.initial_memory = &fixed_initial_memory<B>;
    if constexpr (requires(typename Y::P p) { B::next_breakpoint(p, 0.0); })
      k.next_breakpoint = &fixed_next_breakpoint<B>;
    if constexpr (requires(typename Y::P p) { B::shortest_period(p); }) k.shortest_period = &fixed_shortest_period<B>;
    if constexpr (requires(typename Y::P p) { B::check(p); }) k.check = &fixed_check<B>;
    if constexpr (requires(typename Y::P p, typename Y::M m) { B::check_memory(p, m); })
      k.check_memory = &fixed_check_memory<B>;
  }
  return k;
}

}  // namespace hysteron
