#include "discover/structure/residual_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "blocks/register_all.h"
#include "engine/program/program.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

TEST(ResidualParts, AreOfTheSizeOfTheNoiseWhereEachRecordingHasAZeroOfItsOwn) {
  // Constants before a free zero say nothing: no weight of the constant column may be made of what rounding leaves.
  const double white = 1e-3, zeros[] = {-42, 0.3, 17};  // [m]
  std::vector<Recording> list;
  for (int r = 0; r < 3; ++r) {
    const auto t = rows(900, 0.01);
    const auto u = several_sines(t, 1, {0.13 + 0.02 * r, 0.31});
    auto y = noise(t.size(), white, 0, 60 + static_cast<std::uint64_t>(r));
    for (std::size_t k = 0; k < t.size(); ++k) y[k] += u[k] + zeros[r];
    list.push_back(recording(std::to_string(r) + ".csv", r < 2 ? Role::train : Role::validate, t, u, y));
  }
  DataSet data = data_set(list, white, 0);
  data.notes["y"].zero_per_recording = true;
  const Registry registry = all_blocks();
  DataModel model(compile(plain_gain(), registry), std::make_shared<const DataSet>(data));
  const Evidence evidence(model);
  const ResidualParts parts(evidence, model.predict({}, evidence.recordings()), 0);
  ASSERT_EQ(parts.list().size(), 3u);
  for (const auto& p : parts.list()) {
    const double mean = std::accumulate(p.e.begin(), p.e.end(), 0.0) / static_cast<double>(p.e.size());
    double squares = 0;
    for (const double e : p.e) squares += (e - mean) * (e - mean);
    // 900 rows of white noise tell their rms to 1/sqrt(1800) = 2.4 %; four times that.
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(p.e.size())), white, 0.1 * white);
    EXPECT_LT(std::abs(mean), white);  // the free zero takes it: a thirtieth of the noise is left by 900 rows
  }
}

}  // namespace
}  // namespace hysteron
