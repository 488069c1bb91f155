// A packed diagram is the diagram: every one of the project compiles to the same numbers, and is packed the same again.
#include "io/diagram/packed_diagram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "blocks/register_all.h"
#include "engine/program/program.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

/// Bits: what is not a number is equal to itself.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return x == y || (std::isnan(x) && std::isnan(y));
         });
}

TEST(PackedDiagram, IsTheDiagram) {
  const Registry blocks = all_blocks();
  int seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(HYSTERON_SOURCE_DIR "/diagrams")) {
    const std::string file = entry.path().string();
    if (!file.ends_with(".json") || !is_diagram_file(file)) continue;
    SCOPED_TRACE(file);
    const Diagram diagram = read_diagram(file);
    const std::string text = packed_diagram({diagram, {parse_unit("um")}});
    EXPECT_EQ(text.find(HYSTERON_SOURCE_DIR), std::string::npos) << "says where it was";
    const PackedDiagram again = unpacked_diagram(text);
    EXPECT_EQ(packed_diagram(again), text);
    EXPECT_EQ(again.units.at(0).scale, 1e-6);
    const auto a = compile(diagram, blocks), b = compile(again.diagram, blocks);
    EXPECT_TRUE(same(a->p, b->p));
    EXPECT_TRUE(same(a->state_initial, b->state_initial));
    EXPECT_EQ(a->state_names, b->state_names);
    EXPECT_EQ(a->output_names, b->output_names);
    ASSERT_EQ(a->series.size(), b->series.size());
    for (std::size_t i = 0; i < a->series.size(); ++i) {
      if (a->series[i] == nullptr || b->series[i] == nullptr) continue;
      EXPECT_TRUE(same(a->series[i]->t, b->series[i]->t) && same(a->series[i]->v, b->series[i]->v));
    }
    ++seen;
  }
  EXPECT_GT(seen, 50);
}

TEST(PackedDiagram, DamageIsRefused) {
  EXPECT_THROW(unpacked_diagram("{}"), Error);
  EXPECT_THROW(unpacked_diagram("no JSON"), Error);
  EXPECT_NE(packed_token("a"), packed_token("b"));
}

TEST(PackedDiagram, AnotherVersionIsRefusedByItsNumber) {
  std::string text = packed_diagram({});
  EXPECT_NO_THROW(unpacked_diagram(text));
  const std::string mine = R"("packed":1)";
  ASSERT_NE(text.find(mine), std::string::npos) << text;
  text.replace(text.find(mine), mine.size(), R"("packed":2)");
  try {
    unpacked_diagram(text);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.problems.front().what.find("its version is 2"), std::string::npos) << error.problems.front().what;
    EXPECT_NE(error.problems.front().cure.find("export it again"), std::string::npos);
  }
}

}  // namespace
}  // namespace hysteron
