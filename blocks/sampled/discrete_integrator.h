// Decides the block "discrete_integrator". Does not decide its law: models/sampled/discrete_integrator.h.
#pragma once

#include "engine/block/block.h"
#include "models/sampled/discrete_integrator.h"

namespace hysteron::blocks {

struct DiscreteIntegrator {
  enum Parameter { rule, initial, period };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static void initial_states(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    const auto by = discrete_integrator::Rule(v.choice(rule));
    // By the forward rule the input may not be known yet when the output is asked for.
    const T u = by == discrete_integrator::Rule::forward ? T{0} : v.u[0];
    v.out[0] = discrete_integrator::output(by, v.parameter(period), v.x[0], u);
  }
  template <class T>
  static void update(const View<T>& v) {
    v.out[0] = discrete_integrator::update(v.parameter(period), v.x[0], v.u[0]);
  }
};

Kernel discrete_integrator_block();

}  // namespace hysteron::blocks
