#include "blocks/vectors/vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace hysteron::blocks {

void Mux::describe(Declaration& d) {
  d.name("mux", "joins signals into a vector").in_group("vectors").linear();
  d.law("y = (u_1, u_2, ...)").from("definition");
  d.remark("The inputs may be scalars and vectors. Each element keeps its own unit.");
  d.inputs_any("in", "$a[i]", "the signals, in the order of the elements").vector();
  d.output("y", "$a[i]", "vector of all their elements, in order").vector();
}

Sizes Mux::sizes(const Shape& shape) {
  Sizes s;
  const auto& lengths = shape.input_lengths;
  s.outputs = std::accumulate(lengths.begin(), lengths.end(), 0);
  s.output_lengths = {s.outputs};
  s.route.resize(static_cast<std::size_t>(s.outputs));
  std::iota(s.route.begin(), s.route.end(), 0);
  s.lengths_from = fmt::format("it joins {} element{}", fmt::join(lengths, " + "), s.outputs == 1 ? "" : "s");
  return s;
}

void Demux::describe(Declaration& d) {
  d.name("demux", "splits a vector into parts").in_group("vectors").linear();
  d.law("u = (y0, y1, ...)").from("definition");
  d.remark("\"lengths\": [2, 1] makes the outputs y0 (two elements) and y1 (one), for a vector of length 3.");
  d.remark("For one element no block is needed: \"in\": \"tilt[1]\" reads the second element of \"tilt\".");
  d.input("u", "$a[i]", "the vector").vector();
  d.outputs_any("y", "$a[i]", "its parts: y0, y1, ...").vector();
  d.list("lengths", "", "number of elements of each output").structural().positive();
}

Sizes Demux::sizes(const Shape& shape) {
  Sizes s;
  s.output_lengths = shape.whole_numbers("lengths");
  s.outputs = std::accumulate(s.output_lengths.begin(), s.output_lengths.end(), 0);
  s.input_lengths = {s.outputs};
  s.route.resize(static_cast<std::size_t>(s.outputs));
  std::iota(s.route.begin(), s.route.end(), 0);
  s.lengths_from = fmt::format("\"lengths\" says {}", fmt::join(s.output_lengths, " + "));
  return s;
}

void Select::describe(Declaration& d) {
  d.name("select", "selects elements of a vector").in_group("vectors").linear();
  d.law("y_k = u[indices_k]").from("definition");
  d.remark("Elements are numbered from 0. An element may be selected several times, in any order.");
  d.input("u", "$a[i]", "the vector").vector();
  d.output("y", "$b[i]", "the selected elements").vector();
  d.list("indices", "", "numbers of the elements, e.g. [2, 0]").structural().not_negative();
}

Sizes Select::sizes(const Shape& shape) {
  Sizes s;
  s.route = shape.whole_numbers("indices");
  s.outputs = static_cast<int>(s.route.size());
  s.output_lengths = {s.outputs};
  s.lengths_from = fmt::format("it picks [{}]", fmt::join(s.route, ", "));
  const int highest = s.route.empty() ? 0 : *std::max_element(s.route.begin(), s.route.end());
  s.shortest = {highest + 1};
  return s;
}

Kernel mux_block() { return kernel<Mux>(); }
Kernel demux_block() { return kernel<Demux>(); }
Kernel select_block() { return kernel<Select>(); }

}  // namespace hysteron::blocks
