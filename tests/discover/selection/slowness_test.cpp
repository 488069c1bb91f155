// Which laws wait for a quicker one of their effect.
#include "discover/selection/slowness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/discover/discoveries.h"
#include "tests/discover/synthetic.h"

namespace hysteron {
namespace {

using namespace testing;

class Slowness : public Discoveries {
 protected:
  /// u [N] -> a mass -> y [m]; `looped`: a spring of the diagram pulls it back.
  static Diagram guide(bool looped) {
    Diagram d;
    d.title = "guide";
    d.inputs["u"].unit = "N";
    Node& mass = d.blocks["mass"];
    mass.type = "mass_spring_damper";
    mass.parameters["mass"] = Value("1 kg");
    mass.parameters["damping"] = Value("4 N s/m");
    mass.parameters["stiffness"] = Value(looped ? "0 N/m" : "100 N/m");
    mass.in = {{"", looped ? "net" : "u"}};
    if (looped) {
      Node& net = d.blocks["net"];
      net.type = "sum";
      net.parameters["signs"] = Value("+-");
      net.in = {{"", "u"}, {"", "spring"}};
      Node& spring = d.blocks["spring"];
      spring.type = "gain";
      spring.parameters["gain"] = Value("100 N/m");
      spring.in = {{"", "mass.position"}};
    }
    d.outputs["y"] = "mass.position";
    return d;
  }

  /// Of the laws of friction in the mass those that stop in a loop, by name.
  std::vector<std::string> stopping(const Diagram& d) {
    std::vector<Recording> list;
    for (const Role role : {Role::train, Role::validate}) {
      const auto t = rows(400, 0.02);
      const auto u = several_sines(t, 1, {0.7, 2.1});
      list.push_back(recording(std::to_string(list.size()) + ".csv", role, t, u, noise(t.size(), 1e-3, 0, 7)));
      list.back().units["u"] = parse_unit("N");
    }
    const DataSet data = data_set(std::move(list), 1e-3, 0);
    DiscoverOptions options;
    options.only = {"friction"};
    SearchState state(d, data, registry, effects, options);
    fit_base(state);
    std::vector<std::string> names;
    for (const auto& t : list_candidates(state, 1))
      for (const auto& law : t.laws)
        if (t.place.at == "mass" && stops_in_a_loop(state, t, law)) names.push_back(law.name);
    return names;
  }
};

TEST_F(Slowness, DryFrictionWaitsInALoopAlone) {
  EXPECT_TRUE(stopping(guide(false)).empty()) << "a mass by itself turns and stops exactly, row by row";
  const auto names = stopping(guide(true));
  EXPECT_NE(std::find(names.begin(), names.end(), "dry (Coulomb)"), names.end());
  for (const auto& name : names) EXPECT_TRUE(name.starts_with("dry")) << name;
}

}  // namespace
}  // namespace hysteron
