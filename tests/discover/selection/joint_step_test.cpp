// What is believed to be the most that a model reaches once all of it is fitted together, against what it reaches.
#include "discover/selection/joint_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "discover/selection/addition.h"
#include "discover/selection/null_model.h"
#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class JointStep : public Discoveries {};

/// What a mass on a spring says with other numbers, and noise.
DataSet moved(const Registry& registry, std::uint64_t seed, double off) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> part(-off, off);
  Diagram truth = mass_on_spring();
  truth.blocks["stage"].parameters["stiffness"] = Value(Number{400 * (1 + part(engine)), "N/m"});
  truth.blocks["stage"].parameters["damping"] = Value(Number{4 * (1 + part(engine)), "N s/m"});
  truth.blocks["force"].parameters["gain"] = Value(Number{10 * (1 + part(engine)), "N/V"});
  const auto program = compile(truth, registry);
  std::vector<Recording> list;
  for (int r = 0; r < 2; ++r) {
    const auto t = rows(600, 0.01);
    const auto u = several_sines(t, 1, {0.7 + 0.4 * r, 2.1});
    list.push_back(recording(std::to_string(r), r == 0 ? Role::train : Role::validate, t, u, Rows(t.size(), 0.0)));
    list.back().start_is_stated = true;
  }
  DataSet data = data_set(std::move(list), 1e-4, 0);
  DataModel model(program, std::make_shared<const DataSet>(data));
  const int both[] = {0, 1};
  const Prediction p = model.predict({}, both);
  for (std::size_t r = 0; r < 2; ++r) {
    const auto n = noise(600, 1e-4, 0, 100 * seed + r);
    for (std::size_t k = 0; k < 600; ++k) data.recordings[r].columns["y"][k] = p.y[r][0][k] + n[k];
  }
  return data;
}

TEST_F(JointStep, FitsReachNoMoreThanWasBelieved) {
  int fitted = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const DataSet data = moved(registry, seed, 0.03);
    DiscoverOptions options;
    const Diagram diagram = mass_on_spring();
    SearchState state(diagram, data, registry, effects, options);
    fit_base(state);
    FitSetting setting(state, numbers_not_exact(state));
    const Nulls nulls = fit_nulls(setting);
    setting.score = std::make_shared<const BlockScore>(*state.evidence,
                                                       std::vector<LeftSums>{nulls.written.left, nulls.let_go.left});
    ASSERT_TRUE(nulls.let_go.ok());
    // The null itself, as it is written, and with one effect of each kind beside it.
    const double most = most_by_joint_fit(setting, state.context, nulls.written, Numbers::let_go);
    const double reached = score_of(*setting.score, nulls.let_go);
    EXPECT_GE(most, reached) << "seed " << seed;
    EXPECT_LT(most_by_joint_fit(setting, state.context, nulls.let_go, Numbers::let_go), reached + 0.5)
        << "seed " << seed << ": nothing is left to be gained";
    for (const auto& t : list_candidates(state, 1)) {
      if (t.effect->id != "sensor_lag" && t.effect->id != "quadratic_drag" && t.effect->id != "dead_time") continue;
      Addition rival;
      rival.tried = t;
      const TableModel f = with_term(setting, state.context, nulls.written, term_of(rival, 0), 0, Effort::full);
      if (!f.ok()) continue;
      const double believed = most_by_joint_fit(setting, state.context, f, Numbers::let_go);
      const TableModel together = refitted(setting, state.context, f, Numbers::let_go);
      if (!together.ok()) continue;
      ++fitted;
      EXPECT_GE(believed, score_of(*setting.score, together)) << t.effect->id << ", seed " << seed;
    }
  }
  EXPECT_GE(fitted, 12);
}

}  // namespace
}  // namespace hysteron
