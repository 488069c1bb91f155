// Decides what a sample of a block is, and finds those that stand beside the tests of the blocks.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <ostream>
#include <string>
#include <vector>

#include "tests/blocks/bench.h"

namespace hysteron::bench {

/// A block type with parameters that make sense, for laws that hold for all blocks.
struct Sample {
  std::string type;
  Bench::Values values;
  int inputs = -1;
  int index = 0;  ///< among the samples of its type
};
inline void PrintTo(const Sample& s, std::ostream* out) { *out << s.type; }

/// At namespace scope in any source of these tests, this makes known: const Samples mine{{"gain", {{"gain", {2}}}}};
struct Samples {
  Samples(std::initializer_list<Sample> some);
};

/// All of them, by type.
std::vector<Sample> samples();

/// The samples for which a law is meant, so that no test is skipped for a block that it does not concern.
template <class Wanted>
std::vector<Sample> samples_where(Wanted wanted) {
  std::vector<Sample> list;
  for (const auto& s : samples())
    if (wanted(Bench(s.type, s.values, s.inputs))) list.push_back(s);
  return list;
}
bool any_parameter(const Bench& b, bool ParameterDeclaration::*flag);
std::string sample_name(const testing::TestParamInfo<Sample>& made);

}  // namespace hysteron::bench
