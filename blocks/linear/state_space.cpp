#include "blocks/linear/state_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "blocks/vectors/element_units.h"
#include "models/linear/linear_system.h"

namespace hysteron::blocks {

void StateSpace::describe(Declaration& spec) {
  spec.name("state_space", "linear state-space system with vector ports").in_group("linear").linear();
  spec.law("dx/dt = A x + B u, y = C x + D u, x(0) = initial").from("definition");
  spec.remark(
      "The matrices are plain numbers for t in s, u in \"input_unit\" and y in \"output_unit\": with \"input_unit\": "
      "\"V\" and \"output_unit\": \"um\", C x is in um. Several units, one per element, are separated by commas: "
      "\"V, A\".");
  describe_matrices(spec);
}

void Matrices::describe_matrices(Declaration& spec) {
  spec.remark(
      "Without \"d\" there is no direct feedthrough, so the block can close any loop; the same holds for "
      "an output whose row of D is zero.");
  spec.remark("Rows as lists: \"a\": [[0, 1], [-400, -4]], \"b\": [[0], [400]], \"c\": [[1, 0]].");
  spec.input("u", "$u", "the inputs, one per column of B").vector();
  spec.output("y", "$y", "the outputs, one per row of C").vector();
  spec.state("x", "", "states, in the units of the matrices");
  spec.matrix("a", "", "A, one row and column per state");
  spec.matrix("b", "", "B, one row per state, one column per input");
  spec.matrix("c", "", "C, one row per output, one column per state").linear();
  spec.matrix("d", "", "D, one row per output, one column per input").optional("").linear();
  spec.list("initial", "", "initial states, zero if left out").optional("");
  spec.text("input_unit", {}, "unit of the inputs that the matrices refer to").optional("");
  spec.text("output_unit", {}, "unit of the outputs that the matrices refer to").optional("");
}

Sizes Matrices::sizes_of(const Shape& shape) {
  Sizes s;
  const auto size = [&](const char* name) {
    return fmt::format("\"{}\" is {} x {}", name, shape.rows_of(name), shape.columns_of(name));
  };
  const int n = shape.rows_of("a"), m = shape.columns_of("b"), p = shape.rows_of("c");
  s.outputs = p;
  s.constants = 2 * (m + p);
  s.feedthrough = shape.rows_of("d") > 0;
  s.input_lengths = {m};
  s.output_lengths = {p};
  s.lengths_from = fmt::format("{}, {}", size("b"), size("c"));
  if (shape.columns_of("a") != n)
    s.error = fmt::format("{}; make it square, one row per state", size("a"));
  else if (shape.rows_of("b") != n)
    s.error = fmt::format("{}, but {}; give both as many rows", size("b"), size("a"));
  else if (shape.columns_of("c") != n)
    s.error = fmt::format("{}, but {}; give C as many columns as A", size("c"), size("a"));
  else if (s.feedthrough && (shape.rows_of("d") != p || shape.columns_of("d") != m))
    s.error = fmt::format("{}, but {} and {}; make D {} x {}, or leave it out", size("d"), size("b"), size("c"), p, m);
  else if (const int k = shape.length("initial"); k != 0 && k != n)
    s.error = fmt::format("\"initial\" has {} numbers for {} states; write one per state", k, n);
  if (!s.error.empty()) return s;
  s.input_units = units_of_elements(shape.free_text("input_unit"), m);
  s.output_units = units_of_elements(shape.free_text("output_unit"), p);
  s.error = wrong_units(s.input_units, m, "input_unit");
  if (s.error.empty()) s.error = wrong_units(s.output_units, p, "output_unit");
  return s;
}

Sizes StateSpace::sizes(const Shape& shape) {
  Sizes s = sizes_of(shape);
  s.states = shape.rows_of("a");
  return s;
}

void Matrices::prepare(const View<double>& v) {
  note_scales(v, output_unit, v.n_y, note_scales(v, input_unit, v.n_u, v.out));
}

void Matrices::initial_states(const View<double>& v) {
  const auto given = v.list(initial);
  for (int k = 0; k < v.n_x; ++k) v.out[k] = given.empty() ? 0.0 : given[static_cast<std::size_t>(k)];
}

void StateSpace::rest(const View<double>& v) {
  const auto n = static_cast<std::size_t>(v.n_x);
  const std::vector<double> none(n, 0.0);
  auto at_zero = v;
  at_zero.x = none.data();
  derivative(at_zero);  // B u
  std::vector<double> right(v.out, v.out + n);
  for (auto& r : right) r = -r;
  std::vector<double> matrix(v.list(a).begin(), v.list(a).end());
  if (!linear_system::solve(matrix, right))
    std::fill(right.begin(), right.end(), std::numeric_limits<double>::quiet_NaN());
  std::copy(right.begin(), right.end(), v.out);
}

Kernel state_space_block() { return kernel<StateSpace>(); }

}  // namespace hysteron::blocks
