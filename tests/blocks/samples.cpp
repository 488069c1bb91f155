#include "tests/blocks/samples.h"

#include <algorithm>
#include <map>

namespace hysteron::bench {
namespace {

std::vector<Sample>& known() {
  static std::vector<Sample> all;
  return all;
}

}  // namespace

Samples::Samples(std::initializer_list<Sample> some) { known().insert(known().end(), some.begin(), some.end()); }

std::vector<Sample> samples() {
  std::vector<Sample> list = known();
  std::stable_sort(list.begin(), list.end(), [](const Sample& a, const Sample& b) { return a.type < b.type; });
  std::map<std::string, int> seen;
  for (auto& sample : list) sample.index = seen[sample.type]++;
  return list;
}

bool any_parameter(const Bench& b, bool ParameterDeclaration::*flag) {
  for (const auto& p : b.kernel.declaration.parameters)
    if (p.*flag && p.kind != ParameterKind::text) return true;
  return false;
}

std::string sample_name(const testing::TestParamInfo<Sample>& made) {
  return made.param.type + "_" + std::to_string(made.param.index);
}

}  // namespace hysteron::bench
