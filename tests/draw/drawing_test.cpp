// The picture of a diagram, read back from its SVG.
#include "draw/drawing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>

#include "blocks/register_all.h"
#include "engine/diagram/error.h"
#include "tests/draw/picture.h"

namespace hysteron {
namespace {

using picture::Outline;
using picture::Picture;

Node block(const std::string& type, const std::vector<std::string>& in = {}) {
  Node node;
  node.type = type;
  for (const auto& from : in) node.in.push_back({"", from});
  return node;
}

Node gain(const std::string& value, const std::string& in) {
  Node node = block("gain", {in});
  node.parameters["gain"] = Value(value);
  return node;
}

Node sum(const std::string& signs, const std::vector<std::string>& in) {
  Node node = block("sum", in);
  node.parameters["signs"] = Value(signs);
  return node;
}

Node lag(const std::string& in) {
  Node node = block("lag", {in});
  node.parameters["times"] = Value(NumberList{{1, "ms"}});
  return node;
}

/// A reference, a controller with a feed-forward beside it, a plant; two sums.
Diagram loop() {
  Diagram d;
  d.title = "Loop";
  d.parameters["kp"].value = Value(Number{1.207, "V/um"});
  Node reference = block("sine");
  reference.parameters["amplitude"] = Value("3 um");
  reference.parameters["frequency"] = Value("5 Hz");
  d.blocks["reference"] = reference;
  d.blocks["error"] = sum("+-", {"reference", "plant"});
  Node controller = block("pi_controller", {"error"});
  controller.parameters["kp"] = Value(Reference{"kp"});
  controller.parameters["ki"] = Value("700 V/(um s)");
  d.blocks["controller"] = controller;
  Node compensator;
  compensator.choose = "straight";
  compensator.in = {{"", "reference"}};
  compensator.from["none"] = gain("0 V/um", "reference");
  compensator.from["straight"] = gain("0.8 V/um", "reference");
  for (auto& [name, candidate] : compensator.from) candidate.in.clear();
  d.blocks["compensator"] = compensator;
  d.blocks["drive"] = sum("++", {"controller", "compensator"});
  Node plant = block("transfer_function", {"drive"});
  plant.parameters["num"] = Value(NumberList{{1, {}}});
  plant.parameters["den"] = Value(NumberList{{0.001, {}}, {1, {}}});
  plant.parameters["gain"] = Value("1 um/V");
  d.blocks["plant"] = plant;
  d.outputs["y"] = "plant";
  d.record = {"error", "plant"};
  return d;
}

/// A stage with a loop inside, and a diagram around it that also reads a signal from inside.
Diagram nested() {
  auto inner = std::make_shared<Diagram>();
  inner->parameters["stiffness"].value = Value(Number{2, {}});
  inner->inputs["u"].unit = "V";
  inner->inputs["d"].unit = "V";
  inner->blocks["force"] = sum("++-", {"u", "d", "spring"});
  inner->blocks["mass"] = lag("force");
  inner->blocks["spring"] = gain("1", "mass");
  inner->blocks["spring"].parameters["gain"] = Value(Reference{"stiffness"});
  inner->outputs["position"] = "mass";
  inner->outputs["push"] = "force";
  Diagram d;
  Node source = block("constant");
  source.parameters["value"] = Value("2 V");
  d.blocks["source"] = source;
  Node stage = block("diagram", {"source", "source"});
  stage.nested = inner;
  stage.file = "stages/p753.json";
  stage.parameters["stiffness"] = Value(3.0);
  d.blocks["stage"] = stage;
  d.blocks["watch"] = gain("2", "stage/spring");
  d.blocks["seen"] = gain("3", "stage.position");
  d.record = {"watch", "seen", "stage.push"};
  return d;
}

const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

std::string svg(const Diagram& d, int depth = 0) {
  return diagram_svg(d, *compile(d, registry()), registry(), {depth});
}

Picture drawn(const Diagram& d, int depth = 0) { return picture::read(svg(d, depth)); }

std::string faults(const Picture& p) {
  std::string text;
  for (const auto& v : picture::violations(p)) text += v + "\n";
  return text;
}

/// "from to input" of every wire as the diagram has it.
std::multiset<std::string> wires_of(const Diagram& d) {
  std::multiset<std::string> list;
  const auto head = [](const std::string& signal) { return signal.substr(0, signal.find_first_of("./")); };
  for (const auto& [name, node] : d.blocks)
    for (std::size_t i = 0; i < node.in.size(); ++i)
      list.insert(fmt::format("{} {} {}", head(node.in[i].from), name, i));
  for (const auto& [name, signal] : d.outputs) list.insert(fmt::format("{} {} 0", head(signal), name));
  return list;
}

std::multiset<std::string> wires_of(const Picture& p) {
  std::multiset<std::string> list;
  for (const auto& w : p.wires) list.insert(fmt::format("{} {} {}", w.from, w.to, w.input));
  return list;
}

const picture::Wire* find_wire(const Picture& p, const std::string& from, const std::string& to) {
  for (const auto& w : p.wires)
    if (w.from == from && w.to == to) return &w;
  return nullptr;
}

/// Paths of the blocks that are set off, when `added` are said to be new.
std::set<std::string> set_off(const Diagram& d, const std::vector<std::string>& added, int depth) {
  const Picture p = picture::read(diagram_svg(d, *compile(d, registry()), registry(), {depth, added}));
  EXPECT_EQ(faults(p), "");
  std::set<std::string> list;
  for (const auto& o : p.outlines) {
    if (o.is_new) list.insert(o.path);
    EXPECT_EQ(o.is_new, o.texts.find("new\n") != std::string::npos) << o.path;  // not by colour alone
  }
  return list;
}

TEST(Drawing, SetsOffWhatIsNew) {
  EXPECT_EQ(set_off(loop(), {}, 0), std::set<std::string>{});
  EXPECT_EQ(set_off(loop(), {"controller", "error"}, 0), (std::set<std::string>{"controller", "error"}));
}

TEST(Drawing, SetsOffTheClosedBoxOfWhatIsNewInsideIt) {
  EXPECT_EQ(set_off(nested(), {"stage/spring"}, 0), std::set<std::string>{"stage"});
  EXPECT_EQ(set_off(nested(), {"stage/spring"}, 1), std::set<std::string>{"stage/spring"});
}

TEST(Drawing, ShowsEveryBlockAndEveryWireOnce) {
  const Diagram d = loop();
  const Picture p = drawn(d);
  std::multiset<std::string> blocks, expected{"y"};
  for (const auto& o : p.outlines) blocks.insert(o.path);
  for (const auto& name : d.blocks.names()) expected.insert(name);
  EXPECT_EQ(blocks, expected);
  EXPECT_EQ(wires_of(p), wires_of(d));
}

TEST(Drawing, OfALoopKeepsTheLawsOfAPicture) {
  EXPECT_EQ(faults(drawn(loop())), "");
  EXPECT_EQ(faults(drawn(nested(), 0)), "");
  EXPECT_EQ(faults(drawn(nested(), 1)), "");
}

TEST(Drawing, SignalsFlowToTheRightAndFeedbackReturnsBelowIntoTheSum) {
  const Picture p = drawn(loop());
  double lowest = 0;
  for (const auto& w : p.wires) {
    const Outline *from = p.find(w.from), *to = p.find(w.to, w.to == "y");
    EXPECT_EQ(w.feedback, w.from == "plant" && w.to == "error") << w.from << " " << w.to;
    EXPECT_TRUE(w.feedback || from->right < to->left) << w.from << " " << w.to;
  }
  for (const auto& o : p.outlines) lowest = std::max(lowest, o.bottom);
  const picture::Wire* back = find_wire(p, "plant", "error");
  ASSERT_NE(back, nullptr);
  double row = 0;
  for (const auto& place : back->path) row = std::max(row, place.y);
  EXPECT_GT(row, lowest);
  const auto& end = back->path.back();
  EXPECT_EQ(end.x, back->path[back->path.size() - 2].x);
  EXPECT_LT(end.y, back->path[back->path.size() - 2].y) << "it comes from below";
}

TEST(Drawing, TheMainPathIsOneStraightLine) {
  const Picture p = drawn(loop());
  for (const auto& [from, to] : {std::pair{"reference", "error"},
                                 {"error", "controller"},
                                 {"controller", "drive"},
                                 {"drive", "plant"},
                                 {"plant", "y"}}) {
    const picture::Wire* w = find_wire(p, from, to);
    ASSERT_NE(w, nullptr);
    EXPECT_EQ(w->path.size(), 2U) << from << " " << to;
  }
}

TEST(Drawing, ASignalThatBranchesHasADotThere) {
  // The reference is read by the sum and the compensator, the plant by the sum and the output; nothing else branches.
  const Picture p = drawn(loop());
  EXPECT_EQ(p.branches.size(), 2U);
  for (const auto& dot : p.branches) {
    const auto main = p.find("reference");
    EXPECT_EQ(dot.y, (main->top + main->bottom) / 2);
  }
}

TEST(Drawing, NamesValuesUnitsAndSignsAreShown) {
  const Picture p = drawn(loop());
  EXPECT_EQ(p.find("reference")->texts, "reference\namplitude 3 um\nfrequency 5 Hz\num\n");
  EXPECT_EQ(p.find("controller")->texts, "kp + ki/s\ncontroller\nkp 1.207 V/um\nki 700 V/(um s)\nV\n");
  EXPECT_EQ(p.find("plant")->texts, "1\n0.001 s + 1\nplant\ngain 1 um/V\num\n");
  EXPECT_EQ(p.find("error")->texts, "+\n−\nerror\num\n");
  EXPECT_EQ(p.find("error")->shape, "circle");
  EXPECT_EQ(p.find("compensator")->shape, "polygon");
}

TEST(Drawing, AChoiceShowsItsCandidateAndThatThereAreOthers) {
  Diagram d = loop();
  EXPECT_EQ(drawn(d).find("compensator")->texts, "0.8 V/um\ncompensator\nstraight (1 of 2)\nV\n");
  EXPECT_NE(svg(d).find("choice: straight of none, straight"), std::string::npos);
  apply_settings(d, {}, {{"compensator", "none"}});
  EXPECT_EQ(drawn(d).find("compensator")->texts, "0 V/um\ncompensator\nnone (1 of 2)\nV\n");
}

TEST(Drawing, ValuesAreThoseOfTheRun) {
  Diagram d = loop();
  apply_settings(d, {{"kp", "0.5 V/um"}}, {});
  EXPECT_NE(drawn(d).find("controller")->texts.find("kp 0.5 V/um"), std::string::npos);
}

TEST(Drawing, ANestedDiagramIsABoxWithItsPortsUntilItIsOpened) {
  const Diagram d = nested();
  const Picture closed = drawn(d);
  ASSERT_NE(closed.find("stage"), nullptr);
  EXPECT_FALSE(closed.find("stage")->open);
  EXPECT_EQ(closed.find("stage/mass"), nullptr);
  // Title, ports (a signal that is read from inside is one), name, the value given from outside, units of read outputs.
  EXPECT_EQ(closed.find("stage")->texts, "p753\nu\nd\nposition\npush\nspring\nstage\nstiffness 3\nV\nV\n");
  EXPECT_EQ(wires_of(closed), wires_of(d));

  const Picture open = drawn(d, 1);
  EXPECT_TRUE(open.find("stage")->open);
  const Outline* frame = open.find("stage");
  for (const auto& o : open.outlines)
    if (o.path.starts_with("stage/")) {
      EXPECT_TRUE(frame->holds({o.left, o.top}) && frame->holds({o.right, o.bottom})) << o.path;
    }
  for (const char* name : {"stage/force", "stage/mass", "stage/spring"}) EXPECT_NE(open.find(name), nullptr) << name;
  // $stiffness is 2 in the diagram and 3 where it is used: the gain is drawn with 3.
  EXPECT_TRUE(open.find("stage/spring")->texts.starts_with("3\n")) << open.find("stage/spring")->texts;
  EXPECT_TRUE(find_wire(open, "stage/spring", "stage/force")->feedback);
}

TEST(Drawing, WhatEnablesANestedDiagramIsAPortOfItsOwn) {
  Diagram d = nested();
  d.blocks["on"] = block("constant");
  d.blocks["on"].parameters["value"] = Value(1.0);
  d.blocks["stage"].runs = RunsWhen{.enable = "on", .resets_states = true};
  const Picture closed = drawn(d);
  EXPECT_EQ(closed.find("stage")->texts, "p753\nu\nd\nenable\nposition\npush\nspring\nstage\nstiffness 3\nV\nV\n");
  EXPECT_NE(find_wire(closed, "on", "stage"), nullptr);
  for (const int depth : {0, 1}) EXPECT_EQ(faults(drawn(d, depth)), "");
  const Picture open = drawn(d, 1);
  EXPECT_NE(svg(d, 1).find("data-block=\"stage/enable\""), std::string::npos);
  EXPECT_NE(find_wire(open, "on", "stage"), nullptr);
  EXPECT_NE(svg(d).find("runs while on is true; else its outputs stay, and its states begin anew"), std::string::npos);
}

TEST(Drawing, AVectorIsAThickWireWithItsLength) {
  Diagram d;
  for (const char* name : {"a", "b"}) {
    d.blocks[name] = block("constant");
    d.blocks[name].parameters["value"] = Value("2 V");
  }
  d.blocks["both"] = block("mux", {"a", "b"});
  d.blocks["twice"] = gain("2", "both");
  d.blocks["one"] = gain("3", "twice[1]");
  d.record = {"one"};
  const Picture p = drawn(d);
  EXPECT_EQ(faults(p), "");
  EXPECT_EQ(p.wires.size(), 4U);
  EXPECT_NE(p.find("both")->texts.find("V [2]"), std::string::npos) << p.find("both")->texts;
  EXPECT_EQ(p.find("a")->texts.find("["), std::string::npos);
  const std::string text = svg(d);
  const auto thick = [&](const std::string& signal) {
    return text.find("class=\"wire vector\" data-signal=\"" + signal + "\"") != std::string::npos;
  };
  EXPECT_TRUE(thick("both"));
  EXPECT_FALSE(thick("a"));
}

TEST(Drawing, FeedbackStaysNearTheBlocksThatItPasses) {
  // Only the caption of the deepest block, a gap and the row lie below the blocks of this loop.
  Diagram d = loop();
  d.blocks.erase("compensator");
  d.blocks["drive"] = sum("+", {"controller"});
  const Picture p = drawn(d);
  double row = 0, lowest = 0;
  for (const auto& place : find_wire(p, "plant", "error")->path) row = std::max(row, place.y);
  for (const auto& o : p.outlines) lowest = std::max(lowest, o.bottom);
  EXPECT_LT(row - lowest, 110) << "a caption of six lines is 90 px";
}

TEST(Drawing, OfTheSameDiagramIsTheSameText) { EXPECT_EQ(svg(nested(), 1), svg(nested(), 1)); }

TEST(Drawing, TextsOfAnyKindStayTexts) {
  Diagram d = loop();
  d.title = "a < b & \"c\" </svg><script>";
  const std::string text = svg(d);
  EXPECT_EQ(text.find("<script"), std::string::npos);
  EXPECT_EQ(drawn(d).outlines.size(), 7U);
}

/// A diagram of gains, lags, sums and products that read each other at random; loops only through lags.
Diagram at_random(unsigned seed) {
  std::mt19937 generator(seed);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(generator() % n); };
  Diagram d;
  const std::size_t n = 3 + below(14);
  const auto name = [](std::size_t i) { return "block_" + std::to_string(i); };
  std::vector<bool> keeps(n);  // a lag: what it reads may come later
  for (std::size_t i = 0; i < n; ++i) keeps[i] = i > 0 && below(3) == 0;
  d.inputs["u"].unit = "";
  for (std::size_t i = 0; i < n; ++i) {
    const auto any = [&]() -> std::string {
      const std::size_t k = below(i + 1);
      return k == 0 ? "u" : name(k - 1);
    };
    Node node;
    if (keeps[i]) {
      node = lag(name(below(n)));
    } else {
      const std::size_t kind = below(4);
      std::vector<std::string> in;
      for (std::size_t k = 0; k < 1 + below(4); ++k) in.push_back(any());
      if (kind == 0) node = gain("2", any());
      if (kind == 1) node = sum(std::string(in.size(), '+'), in);
      if (kind == 2) node = block("product", {any(), any()});
      if (kind == 3) {
        // A sum may read any lag, earlier or later: that closes loops.
        for (std::size_t k = 0; k < n; ++k)
          if (keeps[k] && in.size() < 5 && below(3) == 0) in.push_back(name(k));
        node = sum(std::string(in.size(), '+'), in);
      }
    }
    d.blocks[name(i)] = node;
    d.outputs["y" + std::to_string(i)] = name(i);
  }
  return d;
}

TEST(Drawing, OfDiagramsAtRandomKeepsTheLaws) {
  int drawn_ones = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    Diagram d = at_random(seed);
    if (seed % 2 == 1) {  // outputs for all, or for the last block only (then all are recorded)
      d.record = d.blocks.names();
      d.record.push_back("u");
      const std::string last = d.blocks.names().back();
      d.outputs = {};
      d.outputs["y"] = last;
    } else {
      d.record.push_back("u");
    }
    ProgramPointer program;
    try {
      program = compile(d, registry());
    } catch (const Error&) {
      continue;  // a loop through a lag that reads itself only, or one that the engine refuses
    }
    ++drawn_ones;
    const Picture p = picture::read(diagram_svg(d, *program, registry()));
    EXPECT_EQ(wires_of(p), wires_of(d)) << seed;
    EXPECT_EQ(faults(p), "") << seed;
  }
  EXPECT_GT(drawn_ones, 80);
}

TEST(Drawing, TheLawsSeeWhatIsWrong) {
  Picture p = drawn(loop());
  Picture moved = p;
  moved.outlines[0].left -= 300, moved.outlines[1].left -= 300;
  EXPECT_NE(faults(moved), "");
  moved = p;
  moved.wires[0].path.back().x -= 1;
  EXPECT_NE(faults(moved).find("does not end on the border"), std::string::npos);
  moved = p;
  moved.wires[1].path = p.wires[0].path, moved.wires[1].path.front().x += 1;
  EXPECT_NE(faults(moved).find("lie on each other"), std::string::npos);
}

/// Nothing is found on its path while it lives, dot of Graphviz neither.
class EmptyPath {
 public:
  EmptyPath() { setenv("PATH", "/nowhere", 1); }
  ~EmptyPath() { setenv("PATH", path_.c_str(), 1); }
  EmptyPath(const EmptyPath&) = delete;
  EmptyPath& operator=(const EmptyPath&) = delete;

 private:
  const std::string path_ = std::getenv("PATH");
};

TEST(Drawing, WithoutGraphvizSaysHowToGetIt) {
  Diagram d = loop();
  for (const char* more : {"one", "two", "three"}) {  // no other test draws it
    d.blocks[more] = lag("plant");
    d.record.push_back(more);
  }
  const ProgramPointer program = compile(d, registry());
  const EmptyPath nothing;
  try {
    diagram_svg(d, *program, registry());
    ADD_FAILURE() << "drawn without dot";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.at(0).code, "no_graphviz");
    EXPECT_NE(error.problems.at(0).cure.find("apt install graphviz"), std::string::npos);
  }
}

TEST(Drawing, GraphvizIsNotAskedAgainWhereOnlyNumbersDiffer) {
  Diagram d = loop();
  const std::string before = diagram_svg(d, *compile(d, registry()), registry());
  d.blocks["reference"].parameters["amplitude"] = Value("4 um");
  const ProgramPointer program = compile(d, registry());
  const EmptyPath nothing;
  const std::string after = diagram_svg(d, *program, registry());
  EXPECT_NE(after, before);
  EXPECT_NE(after.find("4 um"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
