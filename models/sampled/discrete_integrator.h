// Decides sums over samples that stand for an integral over time, by three rules. Does not decide when samples come.
#pragma once

namespace hysteron::discrete_integrator {

/// forward: y_k = y_(k-1) + T u_(k-1), the area of the held samples; backward: y_k = y_(k-1) + T u_k; trapezoidal:
/// y_k = y_(k-1) + T (u_k + u_(k-1))/2. The state is what does not hang on u_k.
/// Source: Franklin, Powell, Workman, Digital Control of Dynamic Systems, 3rd ed. (1998), section 6.1.
enum class Rule { forward, backward, trapezoidal };

/// Share of the present sample's area that counts at once.
constexpr double at_once(Rule rule) { return rule == Rule::forward ? 0 : rule == Rule::backward ? 1 : 0.5; }

template <class T>
T output(Rule rule, const T& period, const T& state, const T& u) {
  return state + at_once(rule) * (period * u);
}
/// Behind the instant the whole area counts.
template <class T>
T update(const T& period, const T& state, const T& u) {
  return state + period * u;
}

}  // namespace hysteron::discrete_integrator
