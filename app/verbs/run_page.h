// Decides what is told of simulations: traces, figures, ranges, statistics, times. Does not simulate (run.cpp).
#pragma once

#include <string>

#include "engine/simulate/simulate.h"
#include "io/results/result.h"
#include "report/pages/facts.h"

namespace hysteron {

/// What result.json says of each trace, and what it does not say: where the time went.
struct RunFacts {
  Facts traces, statistics;
  Phases phases{};
  double seconds = 0;
};

/// Adds one simulation to the document and to the facts; `name`: of its trace, `type`: of the file that it goes into.
/// Takes the rows out of `traces`, which may be most of the memory.
void add_traces(Document& document, RunFacts& facts, const Program& program, Traces traces, const std::string& name,
                const std::string& type);

/// "time: load and compile 3.1 ms, set up 0.2 ms, steps 10 ms, events 0.5 ms, output 1.2 ms"
std::string times_text(double loading, const RunFacts& facts);

}  // namespace hysteron
