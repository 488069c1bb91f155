// Diagrams of very many blocks: each would take hours if any stage looked at all blocks for each of them, or run out of
// stack if it went along the wires by recursion. What is told of them is what is told of small ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/program/program.h"
#include "tests/engine/compile/problems_of.h"
#include "tests/engine/diagrams_in_code.h"
#include "tests/engine/event_blocks.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using test::node;
using tools::problems_of;
using tools::registry;

constexpr int many = 200'000;

/// A source and gains one behind the other, written from the last one to the first.
Diagram chain_written_backwards(int gains, const Node& source) {
  Diagram d;
  for (int i = gains - 1; i >= 0; --i)
    d.blocks[fmt::format("g{}", i)] = node("gain", {i == 0 ? "u" : fmt::format("g{}", i - 1)}, {{"gain", 1.0}});
  d.blocks["u"] = source;
  d.record = {fmt::format("g{}", gains - 1)};
  return d;
}

TEST(ManyBlocks, UnitsAndOrderGoAlongAChainThatIsWrittenBackwards) {
  const Diagram d = chain_written_backwards(many, node("sine", {}, {{"amplitude", "2 V"}, {"frequency", "1 Hz"}}));
  const auto program = compile(d, registry());
  const auto last = static_cast<std::size_t>(program->signal(d.record.front()));
  EXPECT_EQ(program->signals[last].unit.text, "V");
  EXPECT_EQ(program->all_values.size(), static_cast<std::size_t>(many) + 1);
  EXPECT_EQ(program->blocks[static_cast<std::size_t>(program->all_values.front().block)].path, "u");
  EXPECT_EQ(program->blocks[static_cast<std::size_t>(program->all_values.back().block)].path, d.record.front());
}

TEST(ManyBlocks, AJumpGoesAlongTheChainToTheLawThatItDrives) {
  Diagram d = chain_written_backwards(many, node("step", {}, {{"after", "1 V"}, {"time", "1 s"}}));
  d.blocks["law"] = node("test_rate_squared", d.record);
  d.record = {"law"};
  try {
    compile(d, test::registry_with_events());
    FAIL() << "its result would depend on how fast the jump is";
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 1U);
    EXPECT_EQ(e.problems.front().code, "jump_into_rate");
    EXPECT_NE(e.problems.front().what.find("step \"u\""), std::string::npos) << e.problems.front().what;
  }
}

TEST(ManyBlocks, EachInputKnowsWhomItsJumpsReach) {
  Diagram d;
  for (int i = 0; i < 20'000; ++i) {
    d.inputs[fmt::format("u{}", i)] = {"V", ""};
    d.blocks[fmt::format("a{}", i)] = node("gain", {fmt::format("u{}", i)}, {{"gain", 1.0}});
    if (i % 2 == 0) d.blocks[fmt::format("law{}", i)] = node("test_rate_squared", {fmt::format("a{}", i)});
  }
  const auto program = compile(d, test::registry_with_events());
  ASSERT_EQ(program->input_jump_reaches.size(), 20'000U);
  EXPECT_EQ(program->input_jump_reaches[18], "law18");
  EXPECT_EQ(program->input_jump_reaches[19], "");
}

TEST(ManyBlocks, AsManyParametersHaveTheirBoundsAndNames) {
  Diagram d;
  d.inputs["u"] = {"V", ""};
  for (int i = 0; i < 100'000; ++i) {
    DiagramParameter& k = d.parameters[fmt::format("k{}", i)];
    k.value = Value(static_cast<double>(i));
    k.upper = Number{i + 0.5, {}};
    d.blocks[fmt::format("g{}", i)] = node("gain", {"u"}, {{"gain", Reference{fmt::format("k{}", i)}}});
  }
  const auto program = compile(d, registry());
  const ParameterInfo* info = program->find_parameter("k99999");
  ASSERT_NE(info, nullptr);
  EXPECT_EQ(info->value, 99999.0);
  EXPECT_EQ(info->upper, 99999.5);
  EXPECT_EQ(info, program->find_parameter("g99999.gain"));
  EXPECT_EQ(program->block_index("g99999"), 100'000);
  EXPECT_EQ(program->find_signal("g99999.y"), program->find_signal("g99999"));
}

TEST(ManyBlocks, WhereEveryWireIsWrongAllAreTold) {
  Diagram d;
  for (int i = 0; i < 50'000; ++i)
    d.blocks[fmt::format("g{}", i)] = node("gain", {fmt::format("h{}", i)}, {{"gain", 1.0}});
  const auto problems = problems_of(d);
  ASSERT_EQ(problems.size(), 50'000U);
  EXPECT_EQ(problems[0].code, "unknown_signal");
  EXPECT_NE(problems[0].cure.find("Did you mean"), std::string::npos);
  EXPECT_NE(problems.back().cure, "");
}

}  // namespace
}  // namespace hysteron
