// Vector signals: lengths are found from the wires, every element is a signal of its own, and a mismatch names both
// ends, both lengths and what fixed them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/engine/compile/problems_of.h"
#include "tests/engine/diagrams_in_code.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using test::node;
using test::numbers;
using tools::compiled;
using tools::problems_of;
using tools::registry;

NumberMatrix matrix(std::initializer_list<std::initializer_list<double>> rows, const std::string& unit = "") {
  NumberMatrix m;
  for (const auto& row : rows) {
    m.rows.emplace_back();
    for (const double v : row) m.rows.back().push_back(unit.empty() ? Number{v, {}} : Number{v, unit});
  }
  return m;
}

/// Three constants 1 V, 2 V, 4 V joined in "u".
Diagram three() {
  Diagram d;
  d.blocks["a"] = node("constant", {}, {{"value", "1 V"}});
  d.blocks["b"] = node("constant", {}, {{"value", "2 V"}});
  d.blocks["c"] = node("constant", {}, {{"value", "4 V"}});
  d.blocks["u"] = node("mux", {"a", "b", "c"});
  return d;
}

/// Values of all signals at t = 0.
struct Values {
  explicit Values(const Diagram& d) : program(compiled(d)), run(start(*program)), work(*program) { read(); }
  void read() { evaluate_values(*program, run, work, 0, run.x.data()); }
  double operator[](const std::string& signal) const {
    return work.y[static_cast<std::size_t>(program->signal(signal))];
  }
  ProgramPointer program;
  Run run;
  Work work;
};

std::vector<std::string> recorded(const Program& program) {
  std::vector<std::string> names;
  for (const int s : program.record_signals) names.push_back(program.signals[static_cast<std::size_t>(s)].path);
  return names;
}

TEST(Vectors, MuxSelectAndDemuxHandOnTheirElements) {
  Diagram d = three();
  d.blocks["picked"] = node("select", {"u"}, {{"indices", numbers({2, 0, 2})}});
  d.blocks["parts"] = node("demux", {"u"}, {{"lengths", numbers({2, 1})}});
  d.record = {"picked", "parts.y0", "parts.y1", "u[1]"};
  const Values y(d);
  EXPECT_EQ(y["picked[0]"], 4);
  EXPECT_EQ(y["picked[1]"], 1);
  EXPECT_EQ(y["picked[2]"], 4);
  EXPECT_EQ(y["parts.y0[0]"], 1);
  EXPECT_EQ(y["parts.y0[1]"], 2);
  EXPECT_EQ(y["parts.y1"], 4);
  EXPECT_EQ(recorded(*y.program), (std::vector<std::string>{"picked[0]", "picked[1]", "picked[2]", "parts.y0[0]",
                                                            "parts.y0[1]", "parts.y1", "u[1]"}));
}

TEST(Vectors, EachElementKeepsItsUnitAndItsSmoothness) {
  Diagram d = three();
  d.blocks["c"] = node("step", {}, {{"before", "0 um"}, {"after", "4 um"}, {"time", "1 s"}});
  d.blocks["picked"] = node("select", {"u"}, {{"indices", numbers({2, 0})}});
  d.record = {"picked"};
  const Values y(d);
  const auto& first = y.program->signals[static_cast<std::size_t>(y.program->signal("picked[0]"))];
  const auto& second = y.program->signals[static_cast<std::size_t>(y.program->signal("picked[1]"))];
  EXPECT_EQ(first.dimension, parse_unit("um").dimension);
  EXPECT_EQ(second.dimension, parse_unit("V").dimension);
  EXPECT_EQ(first.smoothness, Smoothness::jumps);
  EXPECT_EQ(second.smoothness, Smoothness::smooth);
}

TEST(Vectors, ElementwiseBlocksTakeEveryElementAndSingleNumbersGoToAll) {
  Diagram d = three();
  d.blocks["doubled"] = node("gain", {"u"}, {{"gain", "2 um/V"}});
  d.blocks["less"] = node("sum", {"u", "a", "u"}, {{"signs", "+-+"}});
  d.blocks["product"] = node("product", {"u", "b"});
  d.record = {"doubled", "less", "product"};
  const Values y(d);
  const double u[] = {1, 2, 4};
  for (int k = 0; k < 3; ++k) {
    const std::string at = "[" + std::to_string(k) + "]";
    EXPECT_DOUBLE_EQ(y["doubled" + at], 2e-6 * u[k]);
    EXPECT_DOUBLE_EQ(y["less" + at], 2 * u[k] - 1);
    EXPECT_DOUBLE_EQ(y["product" + at], 2 * u[k]);
  }
  EXPECT_EQ(y["doubled.y[1]"], y["doubled[1]"]) << "also by port and element";
}

TEST(Vectors, TheElementsOfABlockShareItsParameters) {
  Diagram d = three();
  d.blocks["play"] = node("play", {"u"}, {{"radius", "0.5 V"}});
  d.record = {"play"};
  Values y(d);
  const ParameterInfo* radius = y.program->find_parameter("play.radius");
  ASSERT_NE(radius, nullptr);
  EXPECT_EQ(radius->slots.size(), 3u);
  EXPECT_EQ(y.program->find_parameter("play[0].radius"), nullptr) << "there is one radius";
  set_parameter(*y.program, y.run, "play.radius", 0.75);
  y.read();
  EXPECT_DOUBLE_EQ(y["play[0]"], 0.25);  // virgin: u - radius
  EXPECT_DOUBLE_EQ(y["play[1]"], 1.25);
  EXPECT_DOUBLE_EQ(y["play[2]"], 3.25);
}

TEST(Vectors, AMatrixGainMixesElementsOfDifferentUnits) {
  Diagram d = three();
  d.blocks["c"] = node("constant", {}, {{"value", "4 A"}});
  NumberMatrix m;
  m.rows = {{{3, "um/V"}, {0, {}}, {1, "um/A"}}, {{0, {}}, {2, {}}, {0, {}}}};
  d.blocks["y"] = node("matrix_gain", {"u"}, {{"matrix", m}});
  d.record = {"y"};
  Values y(d);
  EXPECT_DOUBLE_EQ(y["y[0]"], 7e-6);
  EXPECT_DOUBLE_EQ(y["y[1]"], 4);
  EXPECT_EQ(y.program->signals[static_cast<std::size_t>(y.program->signal("y[0]"))].unit.text, "um");
  EXPECT_EQ(y.program->signals[static_cast<std::size_t>(y.program->signal("y[1]"))].unit.text, "V");
  set_parameter(*y.program, y.run, "y.matrix[0][2]", 0.5e-6);
  y.read();
  EXPECT_DOUBLE_EQ(y["y[0]"], 5e-6);
}

TEST(Vectors, AFeedbackThroughMuxAndDemuxIsNoLoop) {
  // One element feeds the other: x' of the first lag is fed by u, the second reads the first through the same vector.
  Diagram d;
  d.blocks["u"] = node("constant", {}, {{"value", 3.0}});
  d.blocks["pair"] = node("mux", {"u", "parts.y0"});
  d.blocks["doubled"] = node("gain", {"pair"}, {{"gain", 2.0}});
  d.blocks["parts"] = node("demux", {"doubled"}, {{"lengths", numbers({1, 1})}});
  d.record = {"parts.y1"};
  const Values y(d);
  EXPECT_EQ(y["parts.y1"], 12);
}

TEST(Vectors, ALoopThroughOneElementIsStillALoop) {
  Diagram d;
  d.blocks["u"] = node("constant", {}, {{"value", 3.0}});
  d.blocks["pair"] = node("mux", {"u", "doubled[1]"});
  d.blocks["doubled"] = node("gain", {"pair"}, {{"gain", 0.5}});
  d.record = {"doubled"};
  const auto problems = problems_of(d);
  if (problems.empty()) {  // it was solved: y = 0.5 y
    EXPECT_NEAR(Values(d)["doubled[1]"], 0, 1e-12);
    EXPECT_EQ(Values(d)["doubled[0]"], 1.5);
    return;
  }
  EXPECT_EQ(problems[0].code, "algebraic_loop");
  EXPECT_NE(problems[0].what.find("doubled[1]"), std::string::npos) << problems[0].what;
  EXPECT_EQ(problems[0].what.find("doubled[0]"), std::string::npos) << problems[0].what;
}

TEST(Vectors, LengthsAreFoundAroundAFeedback) {
  Diagram d = three();
  d.blocks["error"] = node("sum", {"u", "stage"}, {{"signs", "+-"}});
  d.blocks["stage"] = node("lag", {"error"}, {{"times", numbers({1e-3})}});
  d.record = {"stage"};
  const auto program = compiled(d);
  EXPECT_EQ(program->n_x, 3);
  EXPECT_EQ(program->state_names[2], "stage[2].x");
}

TEST(Vectors, InputsAndOutputsOfADiagramBindElementByElement) {
  Diagram d;
  d.inputs["u"] = {"V", "", 2};
  d.blocks["y"] = node("gain", {"u"}, {{"gain", 3.0}});
  d.outputs["y"] = "y";
  d.outputs["last"] = "y[1]";
  Values y(d);
  EXPECT_EQ(y.program->input_names, (std::vector<std::string>{"u[0]", "u[1]"}));
  EXPECT_EQ(y.program->output_names, (std::vector<std::string>{"y[0]", "y[1]", "last"}));
  bind_input(*y.program, y.run, "u[0]", test::series({0, 1}, {1, 1}));
  bind_input(*y.program, y.run, "u[1]", test::series({0, 1}, {5, 5}));
  y.read();
  EXPECT_EQ(y["y[0]"], 3);
  EXPECT_EQ(y["last"], 15);
}

TEST(Vectors, AnInputThatStatesNoLengthTakesTheOneThatItsReadersNeed) {
  Diagram d;
  d.inputs["u"] = {"V", ""};
  d.blocks["scaled"] = node("gain", {"u"}, {{"gain", 3.0}});
  d.blocks["y"] = node("matrix_gain", {"scaled"}, {{"matrix", matrix({{1, 1, 1}})}});
  d.outputs["y"] = "y";
  const auto program = compiled(d);
  EXPECT_EQ(program->input_names, (std::vector<std::string>{"u[0]", "u[1]", "u[2]"}));
  EXPECT_EQ(program->output_names, std::vector<std::string>{"y"}) << "one row: a single number";
}

TEST(Vectors, NestedDiagramsPassVectorsThrough) {
  auto inner = std::make_shared<Diagram>();
  inner->inputs["u"] = {"V", ""};
  inner->blocks["doubled"] = node("gain", {"u"}, {{"gain", 2.0}});
  inner->outputs["y"] = "doubled";
  inner->outputs["first"] = "doubled[0]";
  Diagram d = three();
  d.blocks["stage"] = node("diagram", {"u"});
  d.blocks["stage"].nested = inner;
  d.blocks["alone"] = node("diagram", {"c"});
  d.blocks["alone"].nested = inner;
  d.blocks["y"] = node("gain", {"stage.y[2]"}, {{"gain", 10.0}});
  d.record = {"stage.y", "stage.first", "alone.y", "y"};
  const Values y(d);
  EXPECT_EQ(recorded(*y.program), (std::vector<std::string>{"stage/doubled[0]", "stage/doubled[1]", "stage/doubled[2]",
                                                            "stage/doubled[0]", "alone/doubled", "y"}));
  EXPECT_EQ(y["y"], 80);
  EXPECT_EQ(y["alone/doubled"], 8);
}

TEST(Vectors, EveryMismatchNamesBothEndsBothLengthsAndACure) {
  struct Case {
    const char* name;
    std::function<void(Diagram&)> spoil;
    const char* code;
    const char* path;
    std::vector<const char*> says;  ///< all must stand in what
  };
  const std::vector<Case> cases{
      {"matrix of other width",
       [](Diagram& d) {
         d.blocks["bad"] = node("matrix_gain", {"u"}, {{"matrix", matrix({{1, 2}})}});
       },
       "wrong_length",
       "/blocks/bad/in",
       {"\"bad\" takes length 2", "1 row and 2 columns", "\"u\" has length 3", "joins 1 + 1 + 1"}},
      {"operands of two lengths",
       [](Diagram& d) {
         d.blocks["two"] = node("mux", {"a", "b"});
         d.blocks["later"] = node("gain", {"two"}, {{"gain", 1.0}});
         d.blocks["bad"] = node("sum", {"u", "later"});
       },
       "wrong_length",
       "/blocks/bad/in",
       {"sum \"bad\"", "\"u\" has length 3", "\"later\" has length 2 (mux \"two\": it joins 1 + 1"}},
      {"a vector into a block of single numbers",
       [](Diagram& d) {
         d.blocks["bad"] = node("sensor_noise", {"u"}, {{"rms", "1 V"}, {"period", "1 s"}});
       },
       "wrong_length",
       "/blocks/bad/in",
       {"sensor_noise \"bad\" takes length 1", "\"u\" has length 3"}},
      {"demux of another sum",
       [](Diagram& d) {
         d.blocks["bad"] = node("demux", {"u"}, {{"lengths", numbers({2, 2})}});
       },
       "wrong_length",
       "/blocks/bad/in",
       {"\"lengths\" says 2 + 2", "\"u\" has length 3"}},
      {"select beyond the end",
       [](Diagram& d) {
         d.blocks["bad"] = node("select", {"u"}, {{"indices", numbers({0, 3})}});
       },
       "wrong_length",
       "/blocks/bad/in",
       {"at least length 4", "it picks [0, 3]", "\"u\" has length 3"}},
      {"an element beyond the end",
       [](Diagram& d) {
         d.blocks["bad"] = node("gain", {"u[3]"}, {{"gain", 1.0}});
       },
       "bad_index",
       "/blocks/bad/in",
       {"\"u[3]\" does not exist", "length 3"}},
      {"no index",
       [](Diagram& d) {
         d.blocks["bad"] = node("gain", {"u[x]"}, {{"gain", 1.0}});
       },
       "bad_index",
       "/blocks/bad/in",
       {"\"u[x]\""}},
      {"an element of an element",
       [](Diagram& d) {
         auto inner = std::make_shared<Diagram>();
         inner->inputs["u"] = {"V", ""};
         inner->blocks["pass"] = node("pass", {"u"});
         inner->outputs["y"] = "pass[0]";
         d.blocks["nested"] = node("diagram", {"u"});
         d.blocks["nested"].nested = inner;
         d.blocks["bad"] = node("gain", {"nested.y[1]"}, {{"gain", 1.0}});
       },
       "bad_index",
       "/blocks/bad/in",
       {"\"nested.y[1]\"", "single number"}},
      {"a recorded element beyond the end",
       [](Diagram& d) { d.record.push_back("u[7]"); },
       "bad_index",
       "/record/1",
       {"\"u[7]\"", "length 3"}},
      {"a nested diagram that states another length",
       [](Diagram& d) {
         auto inner = std::make_shared<Diagram>();
         inner->inputs["u"] = {"V", "", 2};
         inner->blocks["pass"] = node("pass", {"u"});
         inner->outputs["y"] = "pass";
         d.blocks["bad"] = node("diagram", {"u"});
         d.blocks["bad"].nested = inner;
       },
       "wrong_length",
       "/blocks/bad/in",
       {"\"bad/u\" states \"length\": 2", "\"u\" has length 3"}},
      {"a length that grows around a loop",
       [](Diagram& d) {
         d.blocks["bad"] = node("mux", {"a", "later"});
         d.blocks["later"] = node("lag", {"bad"}, {{"times", numbers({1})}});
       },
       "wrong_length",
       "/blocks/bad/in",
       {"\"bad\" would grow without end"}},
      {"a matrix that is no square",
       [](Diagram& d) {
         d.blocks["bad"] =
             node("state_space", {"u"}, {{"a", matrix({{1, 2}})}, {"b", matrix({{1, 2, 3}})}, {"c", matrix({{1}})}});
       },
       "bad_value",
       "/blocks/bad",
       {"\"a\" is 1 x 2"}},
      {"matrices that do not fit",
       [](Diagram& d) {
         d.blocks["bad"] =
             node("state_space", {"u"},
                  {{"a", matrix({{-1}})}, {"b", matrix({{1, 2, 3}})}, {"c", matrix({{1}})}, {"d", matrix({{1, 2}})}});
       },
       "bad_value",
       "/blocks/bad",
       {"\"d\" is 1 x 2", "\"b\" is 1 x 3"}},
      {"a unit that the wire does not have",
       [](Diagram& d) {
         d.blocks["bad"] =
             node("state_space", {"u"},
                  {{"a", matrix({{-1}})}, {"b", matrix({{1, 2, 3}})}, {"c", matrix({{1}})}, {"input_unit", "V, A, V"}});
       },
       "wrong_unit",
       "/blocks/bad",
       {"input u", "in V", "expected in A"}},
      {"rows of several lengths",
       [](Diagram& d) {
         d.blocks["bad"] = node("matrix_gain", {"u"}, {{"matrix", matrix({{1, 2, 3}, {1, 2}})}});
       },
       "bad_value",
       "/blocks/bad/matrix",
       {"row 2", "has 2 numbers"}},
      {"a list for a matrix",
       [](Diagram& d) {
         d.blocks["bad"] = node("matrix_gain", {"u"}, {{"matrix", numbers({1, 2, 3})}});
       },
       "wrong_type",
       "/blocks/bad/matrix",
       {"is a matrix, found a list"}},
      {"half an index",
       [](Diagram& d) {
         d.blocks["bad"] = node("select", {"u"}, {{"indices", numbers({0.5})}});
       },
       "bad_value",
       "/blocks/bad/indices",
       {"no whole number"}},
      {"an output that demux does not have",
       [](Diagram& d) {
         d.blocks["parts"] = node("demux", {"u"}, {{"lengths", numbers({2, 1})}});
         d.blocks["bad"] = node("gain", {"parts.y2"}, {{"gain", 1.0}});
       },
       "unknown_signal",
       "/blocks/bad/in",
       {"no output \"y2\""}},
      {"elements of different units in one operand",
       [](Diagram& d) {
         d.blocks["b"] = node("constant", {}, {{"value", "2 A"}});
         d.blocks["bad"] = node("sum", {"u", "a"});
       },
       "wrong_unit",
       "/blocks/bad",
       {"bad[1]"}}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.name);
    Diagram d = three();
    d.record = {"u"};
    c.spoil(d);
    if (d.blocks.find("bad") != nullptr && d.blocks.find("bad")->type == "demux")
      d.record = {"u", "bad.y0"};
    else if (d.blocks.find("bad") != nullptr)
      d.record.push_back("bad");
    bool found = false;
    std::string all;
    for (const auto& p : problems_of(d)) {
      all += p.code + " at " + p.path + ": " + p.what + "\n";
      EXPECT_FALSE(p.cure.empty());
      bool right = p.code == c.code && p.path == c.path;
      for (const char* text : c.says) right = right && p.what.find(text) != std::string::npos;
      found = found || right;
    }
    EXPECT_TRUE(found) << all;
  }
}

}  // namespace
}  // namespace hysteron
