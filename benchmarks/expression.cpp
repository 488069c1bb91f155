// What a law costs that the diagram writes, against the same law as a block in C++: one evaluation, 100 000 rows, and
// 128 sets of its numbers side by side.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "benchmarks/diagrams.h"
#include "benchmarks/workloads.h"
#include "engine/block/block.h"
#include "engine/lanes/lanes.h"

namespace hysteron::benchmarks {
namespace {

constexpr int evaluations = 1000, rows = 100'000;

/// y = a sin(b u) + max(u, 0) sqrt(1 + u^2)/c
struct WrittenInC {
  template <class T>
  struct Params {
    T a, b, c;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<WrittenInC>& spec) {
    spec.name("by_hand", "");
    spec.input(&In<double>::u, "u", "", "");
    spec.output(&Out<double>::y, "y", "", "");
    spec.param(&Params<double>::a, "a", "", "");
    spec.param(&Params<double>::b, "b", "", "");
    spec.param(&Params<double>::c, "c", "", "");
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    using std::max;
    using std::sin;
    using std::sqrt;
    return {p.a * sin(p.b * in.u) + max(in.u, T(0.0)) * sqrt(1.0 + in.u * in.u) / p.c};
  }
};

ProgramPointer program_of(Diagram d, const char* type) {
  Node law = node(type, {{"a", 0.7}, {"b", 1.3}, {"c", 2.0}}, {"u"});
  if (std::string(type) == "expression") law.parameters["y"] = "a*sin(b*u) + max(u, 0)*sqrt(1 + u^2)/c";
  d.blocks["law"] = law;
  d.record = {"law"};
  static const Registry registry = [] {
    Registry all = all_blocks();
    all.add(kernel<WrittenInC>());
    return all;
  }();
  return compile(d, registry);
}

/// The block alone in a program, its numbers laid out as the engine does it.
struct Alone {
  explicit Alone(const char* type) {
    Diagram d;
    d.inputs["u"] = {};
    program = program_of(d, type);
    run = start(*program);
    view = view_of(*program, run, program->block_index("law"));
  }
  const Kernel& law() const { return *program->blocks[static_cast<std::size_t>(program->block_index("law"))].kernel; }
  ProgramPointer program;
  Run run;
  View<double> view;
};

void one_by_one(benchmark::State& state, const char* type) {
  Alone alone(type);
  const Kernel& law = alone.law();
  double u = 0, y = 0;
  alone.view.u = &u;
  alone.view.out = &y;
  for (auto _ : state)
    for (int k = 0; k < evaluations; ++k) {
      u = 1e-3 * k - 0.5;
      law.output(alone.view);
      benchmark::DoNotOptimize(y);
    }
}

void many_rows(benchmark::State& state, const char* type) {
  Alone alone(type);
  std::vector<double> u(rows + 1), y(rows), h(rows, 1e-3), scratch(64);
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = std::sin(1e-3 * static_cast<double>(k));
  const double* in = u.data() + 1;
  double* out = y.data();
  RowsView r;
  r.count = rows;
  r.views = &alone.view;
  r.u = &in;
  r.y = &out;
  r.h = h.data();
  r.scratch = scratch.data();
  for (auto _ : state) {
    alone.law().rows(r);
    benchmark::DoNotOptimize(y.data());
    benchmark::ClobberMemory();
  }
}

void side_by_side(benchmark::State& state, const char* type) {
  Diagram d;
  d.blocks["u"] = node("sine", {{"amplitude", 1.0}, {"frequency", "5 Hz"}});
  const auto program = program_of(d, type);
  std::vector<int> varied;
  for (const char* name : {"law.a", "law.b", "law.c"})
    varied.push_back(static_cast<int>(program->find_parameter(name) - program->parameters.data()));
  Lanes lanes(program, start(*program), {.until = 1, .every = 1e-3}, varied);
  std::vector<double> values;
  for (int l = 0; l < Lanes::width; ++l)
    for (const double of_law : {0.7, 1.3, 2.0}) values.push_back(of_law * (1 + 1e-3 * l));
  double sum = 0;
  for (auto _ : state) lanes(values, [&](long, double, const double* y) { sum += y[Lanes::width - 1]; });
  benchmark::DoNotOptimize(sum);
}

}  // namespace

void register_expression() {
  for (const auto& [name, type] : {std::pair{"by hand", "by_hand"}, std::pair{"expression", "expression"}}) {
    const char* of = type;
    benchmark::RegisterBenchmark((std::string("a law, 1000 evaluations/") + name).c_str(),
                                 [of](benchmark::State& state) { one_by_one(state, of); });
    benchmark::RegisterBenchmark((std::string("a law, 100 000 rows/") + name).c_str(),
                                 [of](benchmark::State& state) { many_rows(state, of); });
    benchmark::RegisterBenchmark((std::string("a law, 128 lanes of 1000 rows/") + name).c_str(),
                                 [of](benchmark::State& state) { side_by_side(state, of); });
  }
}

}  // namespace hysteron::benchmarks
