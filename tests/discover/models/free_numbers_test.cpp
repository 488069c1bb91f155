// Which numbers of a candidate are free, and where they begin.
#include "discover/models/free_numbers.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "discover/placement/add.h"
#include "discover/placement/places.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class FreeNumbers : public Discoveries {};

TEST_F(FreeNumbers, OfSingleRecordingsBeginWhereTheyWereFound) {
  // A line whose phase is another one in each recording: where it is not found by linear least squares any more, a
  // start that is one for all lies in another valley.
  const Effect& effect = effects.get("mains_interference");
  const Place place = place_at(plain_gain(), registry, "stage");
  Excitation at;
  at.longest_recording = 1;
  const Law law = effect.laws(at).front();
  const Added added = add_effect(plain_gain(), registry, effect, law, place);
  CandidateModel c;
  c.diagram = added.diagram;
  c.program = compile(c.diagram, registry);
  c.placed.push_back({&effect, law, place, added.name, {}});
  const std::vector<int> recordings{0, 2};
  std::vector<std::string> own;
  for (const auto& p : law.free)
    if (p.per_recording) own.push_back(parameter_path(added.name, law, p));
  ASSERT_FALSE(own.empty());
  const auto value = [](std::size_t k, int recording) { return 0.01 * static_cast<double>(k + 1) + 0.1 * recording; };
  for (std::size_t k = 0; k < own.size(); ++k)
    for (const int r : recordings) c.of_recordings.push_back({own[k], r, value(k, r)});
  FitContext context;
  context.registry = &registry;
  const auto starts = [&](int fresh) {
    std::map<std::pair<std::string, int>, double> list;
    for (const auto& f : free_of(context, c, {true}, fresh, recordings))
      if (f.recording >= 0)
        list[{c.program->parameters[static_cast<std::size_t>(f.parameter)].path, f.recording}] = f.start;
    return list;
  };
  const auto again = starts(-1), anew = starts(0);
  ASSERT_EQ(again.size(), own.size() * recordings.size());
  for (std::size_t k = 0; k < own.size(); ++k)
    for (const int r : recordings) {
      EXPECT_DOUBLE_EQ(again.at({own[k], r}), value(k, r)) << own[k] << " in " << r;
      EXPECT_NE(anew.at({own[k], r}), value(k, r)) << "a law that is new begins as it says";
    }
}

}  // namespace
}  // namespace hysteron
