#include "io/diagram/diagram_file.h"

#include <gtest/gtest.h>

#include "blocks/register_all.h"
#include "engine/diagram/error.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"
#include "tests/io/temporary_folder.h"

namespace hysteron {
namespace {

const char* full_diagram = R"json({
  "$schema": "../schema/diagram.schema.json", "format": 1,
  "title": "Feedback with hysteresis feed-forward",
  "source": "thesis Fig. 2.23",
  "remark": "a \"quoted\" remark",
  "parameters": {
    "amplitude": {"value": 3, "unit": "um"},
    "kp": {"value": 1.207, "unit": "V/um", "bounds": [0, 10], "free": false},
    "ki": {"value": 7009, "bounds": [null, "8000 V/(um s)"], "free": true, "remark": "from the data sheet"},
    "plain": 5, "text": "2 V", "weights": [1, 2]
  },
  "inputs": {"u": {"unit": "V"}, "temperature": {"unit": "degC", "remark": "of the room"}},
  "blocks": {
    "reference": {"type": "sine", "amplitude": "$amplitude", "frequency": "5 Hz", "phase": "-90 deg"},
    "error": {"type": "sum", "signs": "+-", "in": ["reference", "stage.displacement"]},
    "creep": {"type": "creep", "amounts": [0.004, 0.01, 0.012], "times": {"value": [0.3, 3, 30, 300, 3000], "unit": "s"}, "in": "u"},
    "compensator": {"choose": "big", "effect": "hysteresis", "in": "reference",
                    "from": {"none": {"type": "gain", "gain": {"value": 0, "unit": "V/um"}},
                             "set": {"type": "bouc_wen", "parameters": "sets/table.json", "alpha": 2},
                             "big": {"type": "prandtl_ishlinskii", "thresholds": ["0 V", "1 V"], "weights": [1e-8, 2e20]}}},
    "many": {"type": "sum", "in": {"u": ["u", "error"], "offset": "creep"}},
    "stage": {"type": "diagram", "file": "stages/stage.json", "controller.kp": "0.5 V/um", "in": "compensator"}
  },
  "outputs": {"y": "stage.displacement"},
  "record": ["reference", "error"],
  "places": {"command": "reference", "measured": ["stage", "many"]},
  "simulate": {"until": "1 s", "every": "0.1 ms", "solver": {"method": "bdf", "relative_tolerance": 1e-8, "absolute_tolerance": 0.01, "max_step": 0.5}}
}
)json";
const char* stage =
    R"({"format": 1, "inputs": {"u": {"unit": "V"}}, "blocks": {"displacement": {"type": "gain", "gain": "2 um/V", "in": "u"}},
"outputs": {"displacement": "displacement"}})";

/// A folder with the diagram above and all that it names.
struct Project {
  Project() {
    folder.write("stages/stage.json", stage);
    folder.write(
        "sets/table.json",
        R"({"title": "Table 2.1", "alpha": "0.6187 um/V", "beta": {"value": 0.24, "unit": "1/V", "std": 0.01}})");
    folder.write("d.json", full_diagram);
  }
  TemporaryFolder folder;
};

std::string text_of(const Value& v) {
  std::string text;
  if (const auto* n = std::get_if<Number>(&v.content)) return std::to_string(n->value) + "|" + n->unit.value_or("-");
  if (const auto* list = std::get_if<NumberList>(&v.content)) {
    for (const auto& n : *list) text += text_of(Value(n)) + ";";
    return text;
  }
  if (const auto* r = std::get_if<Reference>(&v.content)) return "$" + r->name;
  if (const auto* t = std::get_if<std::string>(&v.content)) return "'" + *t + "'";
  for (const double x : std::get<SeriesPointer>(v.content)->v) text += std::to_string(x) + ",";
  return text;
}

/// Everything that a diagram says, without origins and places on the disk, so that two can be compared.
std::string told(const Node& node) {
  std::string text =
      node.type + " " + node.choose + " " + node.effect + " " + node.file + " " + node.parameter_file + "\n";
  for (const auto& [name, value] : node.parameters) text += name + "=" + text_of(value) + "\n";
  for (const auto& [name, value] : node.parameters_from_file) text += name + "<=" + text_of(value) + "\n";
  for (const auto& wire : node.in) text += wire.port + "<-" + wire.from + "\n";
  for (const auto& [name, candidate] : node.from) text += name + ": " + told(candidate);
  return text;
}

std::string told(const Diagram& d) {
  std::string text = d.schema + d.title + d.source + d.remark + "\n";
  const auto number = [](const std::optional<Number>& n) { return n ? text_of(Value(*n)) : std::string("none"); };
  for (const auto& [name, p] : d.parameters)
    text += name + text_of(p.value) + number(p.lower) + number(p.upper) + (p.free ? (*p.free ? "free" : "fixed") : "") +
            p.remark + "\n";
  for (const auto& [name, i] : d.inputs) text += name + i.unit + i.remark + "\n";
  for (const auto& [name, node] : d.blocks) text += name + ": " + told(node);
  for (const auto& [name, signal] : d.outputs) text += name + signal + "\n";
  for (const auto& name : d.record) text += name + "\n";
  for (const auto& [kind, wires] : d.places)
    for (const auto& wire : wires) text += kind + wire + "\n";
  const auto& s = d.simulate;
  text += number(s.until) + number(s.every) + number(s.max_step) + s.method.value_or("-");
  return text + std::to_string(s.relative_tolerance.value_or(-1)) + std::to_string(s.absolute_tolerance.value_or(-1));
}

TEST(JsonText, MayBeginWithAByteOrderMarkAndLinesAndColumnsStayThose) {
  const TemporaryFolder folder;
  const std::string mark = "\xEF\xBB\xBF";
  const std::string good = folder.write("good.json", mark + stage);
  EXPECT_EQ(read_diagram(good).outputs.names(), (std::vector<std::string>{"displacement"}));
  const auto problem_of = [&](const std::string& text) {
    const std::string file = folder.write("bad.json", mark + text);
    try {
      read_diagram(file);
    } catch (const Error& error) {
      return error.problems.front();
    }
    return Problem{};
  };
  EXPECT_EQ(problem_of("{\"format\": 1,\n\"blocks\": {},\n\"outptus\": {}}").line, 3);
  EXPECT_EQ(problem_of("{\"format\" 1}").path, "column 11");
  EXPECT_EQ(problem_of("").code, "empty_file");
}

TEST(DiagramFile, EveryPartOfTheFormatIsRead) {
  const Project project;
  const Diagram d = read_diagram(project.folder.path("d.json"));
  EXPECT_EQ(d.title, "Feedback with hysteresis feed-forward");
  EXPECT_EQ(d.blocks.names(),
            (std::vector<std::string>{"reference", "error", "creep", "compensator", "many", "stage"}));
  EXPECT_EQ(d.parameters.find("kp")->upper, (Number{10, {}}));
  EXPECT_EQ(d.parameters.find("ki")->upper, (Number{8000, "V/(um s)"}));
  EXPECT_FALSE(d.parameters.find("ki")->lower);
  EXPECT_EQ(d.parameters.find("ki")->free, true);
  EXPECT_EQ(std::get<Reference>(d.blocks.find("reference")->parameters.find("amplitude")->content).name, "amplitude");
  const Node& creep = *d.blocks.find("creep");
  EXPECT_EQ(std::get<NumberList>(creep.parameters.find("times")->content)[1], (Number{3, "s"}));
  const Node& choice = *d.blocks.find("compensator");
  EXPECT_EQ(choice.choose, "big");
  EXPECT_EQ(choice.effect, "hysteresis");
  EXPECT_EQ(choice.from.names(), (std::vector<std::string>{"none", "set", "big"}));
  const Node& set = *choice.from.find("set");
  EXPECT_EQ(std::get<Number>(set.parameters_from_file.find("beta")->content), (Number{0.24, "1/V"}));
  const Node& many = *d.blocks.find("many");
  ASSERT_EQ(many.in.size(), 3U);
  EXPECT_EQ(many.in[1].port, "u");
  EXPECT_EQ(many.in[1].from, "error");
  const Node& nested = *d.blocks.find("stage");
  ASSERT_TRUE(nested.nested);
  EXPECT_EQ(nested.nested->outputs.names(), (std::vector<std::string>{"displacement"}));
  EXPECT_TRUE(nested.parameters.find("controller.kp") != nullptr);
  EXPECT_EQ(d.simulate.every, (Number{0.1, "ms"}));
  EXPECT_EQ(d.simulate.relative_tolerance, 1e-8);
  EXPECT_EQ(d.places.find("measured")->size(), 2U);
}

TEST(DiagramFile, ListsComeFromTheColumnsOfATable) {
  const TemporaryFolder folder;
  folder.write("curve.csv", "at [mm],values [N]\n0,1\n2,1.5\n5,0\n");
  const Diagram d = read_diagram(folder.write(
      "d.json",
      R"({"format": 1, "inputs": {"x": {"unit": "m"}}, "blocks": {"force": {"type": "lookup", "parameters": "curve.csv", "in": "x"}}})"));
  const Node& force = *d.blocks.find("force");
  EXPECT_EQ(force.parameter_file, "curve.csv");
  EXPECT_EQ(std::get<NumberList>(force.parameters_from_file.find("at")->content)[1], (Number{2, "mm"}));
  EXPECT_EQ(std::get<NumberList>(force.parameters_from_file.find("values")->content).size(), 3U);
  EXPECT_EQ(force.parameters_from_file.find("values")->origin, folder.path("curve.csv") + "#values");
}

TEST(DiagramFile, PointsOverTimeComeFromTheColumnsOfATable) {
  const TemporaryFolder folder;
  const std::string diagram = folder.write("d.json", R"({"format": 1, "record": ["way"], "blocks":
          {"way": {"type": "time_table", "parameters": "way.csv"}}})");
  folder.write("way.csv", "times [ms],values [mV]\n0,0\n10,1000\n30,3000\n");
  const Registry registry = all_blocks();
  const auto program = compile(read_diagram(diagram), registry);
  const auto traces = simulate(*program, start(*program), {.until = 0.04, .every = 0.005});
  for (std::size_t i = 0; i < traces.t.size(); ++i)
    EXPECT_NEAR(traces.values[0][i], std::min(100 * traces.t[i], 3.0), 1e-12) << traces.t[i];  // rounding
  EXPECT_TRUE(program->find_parameter("way.values[1]")->linear);
  folder.write("way.csv", "times [ms],values [mV]\n0,0\n10,1000\n10,3000\n");
  EXPECT_THROW(compile(read_diagram(diagram), registry), Error);  // instants rise
}

TEST(DiagramFile, WhenANestedDiagramRunsIsReadAndWritten) {
  const TemporaryFolder folder;
  folder.write("part.json", R"({"format": 1, "inputs": {"u": {}}, "outputs": {"y": "same"},
          "blocks": {"same": {"type": "gain", "gain": 1, "in": "u"}}})");
  const auto with = [&](const std::string& runs) {
    return read_diagram(folder.write("d.json", R"({"format": 1, "blocks": {"on": {"type": "constant", "value": 1},
          "part": {"type": "diagram", "file": "part.json", "in": "on", )" +
                                                   runs + "}}}"));
  };
  for (const std::string runs :
       {R"("enable": "on")", R"("trigger": "on")", R"("enable": "on", "trigger": {"in": "on", "edge": "either"})",
        R"("enable": {"in": "on", "states": "reset"})",
        R"("enable": {"in": "on", "states": "reset", "outputs": "zero"})",
        R"("trigger": {"in": "on", "edge": "falling"})"})
    EXPECT_NE(diagram_text(with(runs)).find(runs), std::string::npos) << diagram_text(with(runs));
  const RunsWhen runs =
      *with(R"("enable": {"in": "on", "outputs": "zero"}, "trigger": {"in": "on"})").blocks.find("part")->runs;
  EXPECT_EQ(runs.enable, "on");
  EXPECT_TRUE(runs.zeroes_outputs);
  EXPECT_FALSE(runs.resets_states);
  EXPECT_EQ(runs.trigger, "on");
  EXPECT_EQ(runs.edge, "rising");
  EXPECT_FALSE(with(R"("remark": "always")").blocks.find("part")->runs);
  const auto told = [&](const std::string& text) {
    try {
      with(text);
    } catch (const Error& error) {
      return error.problems.front().code + " " + error.problems.front().path;
    }
    return std::string("nothing");
  };
  EXPECT_EQ(told(R"("enable": {"in": "on", "states": "rest"})"), "bad_value /blocks/part/enable/states");
  EXPECT_EQ(told(R"("enable": {"states": "reset"})"), "missing_key /blocks/part/enable");
  EXPECT_EQ(told(R"("trigger": {"in": "on", "edges": "rising"})"), "unknown_key /blocks/part/trigger/edges");
  EXPECT_EQ(told(R"("enable": 1)"), "wrong_type /blocks/part/enable");
}

TEST(DiagramFile, ATableOverTwoAxesIsAGridWhateverTheOrderOfItsRows) {
  const TemporaryFolder folder;
  const std::string diagram = folder.write("d.json",
                                           R"({"format": 1, "inputs": {"x": {"unit": "m"}, "i": {"unit": "A"}},
          "blocks": {"force": {"type": "lookup", "parameters": "map.csv", "in": ["x", "i"]}}})");
  folder.write("map.csv", "at_2 [A],at [mm],values [N]\n1,0,4\n0,0,1\n0,5,2\n3,5,8\n3,0,6\n1,5,5\n");
  const Node force = *read_diagram(diagram).blocks.find("force");
  EXPECT_EQ(std::get<NumberList>(force.parameters_from_file.find("at")->content), (NumberList{{0, "mm"}, {5, "mm"}}));
  EXPECT_EQ(std::get<NumberList>(force.parameters_from_file.find("at_2")->content).size(), 3U);
  EXPECT_EQ(std::get<NumberList>(force.parameters_from_file.find("values")->content),
            (NumberList{{1, "N"}, {4, "N"}, {6, "N"}, {2, "N"}, {5, "N"}, {8, "N"}}));
  const auto told = [&](const std::string& rows) {
    folder.write("map.csv", "at,at_2,values\n" + rows);
    try {
      read_diagram(diagram);
    } catch (const Error& error) {
      return error.problems.front().what;
    }
    return std::string("nothing");
  };
  EXPECT_EQ(told("0,0,1\n0,1,2\n1,0,3\n"), "the table has 3 rows, its axes make a grid of 4 points");
  EXPECT_EQ(told("0,0,1\n0,1,2\n1,1,3\n0,0,4\n"), "lines 2 and 5 are the same point of the grid");
}

TEST(DiagramFile, ATextThatGoesOnBehindANumberIsNoQuantity) {
  for (const char* text : {"2*u", "2 * u", "3 - u", "1e3+u", "2^u", "0.5 > u"})
    EXPECT_EQ(std::get<std::string>(Value(text).content), text);
  EXPECT_EQ(std::get<Number>(Value("2 /s").content), (Number{2, "/s"}));
  EXPECT_EQ(std::get<Number>(Value("2 (V/s)").content), (Number{2, "(V/s)"}));
}

TEST(DiagramFile, EveryValueKnowsWhereItWasWritten) {
  const Project project;
  const Diagram d = read_diagram(project.folder.path("d.json"));
  EXPECT_EQ(d.blocks.find("creep")->origin, "/blocks/creep");
  EXPECT_EQ(d.blocks.find("creep")->parameters.find("times")->origin, "/blocks/creep/times");
  EXPECT_EQ(d.parameters.find("kp")->value.origin, "/parameters/kp");
  const Node& choice = *d.blocks.find("compensator");
  EXPECT_EQ(choice.from.find("none")->origin, "/blocks/compensator/from/none");
  EXPECT_EQ(choice.from.find("set")->parameters_from_file.find("beta")->origin,
            project.folder.path("sets/table.json") + "#/beta");
  EXPECT_EQ(d.blocks.find("stage")->nested->blocks.find("displacement")->origin,
            project.folder.path("stages/stage.json") + "#/blocks/displacement");
}

TEST(DiagramFile, WhatWasWrittenReadsBackAsTheSameDiagram) {
  const Project project;
  const Diagram before = read_diagram(project.folder.path("d.json"));
  project.folder.write("e.json", diagram_text(before));
  const Diagram after = read_diagram(project.folder.path("e.json"));
  EXPECT_EQ(told(after), told(before));
  EXPECT_EQ(diagram_text(after), diagram_text(before));
}

TEST(DiagramFile, TheTextHasOneBlockPerLineInTheOrderOfTheFormat) {
  const Project project;
  const std::string text = diagram_text(read_diagram(project.folder.path("d.json")));
  EXPECT_EQ(text, R"json({
  "$schema": "../schema/diagram.schema.json", "format": 1,
  "title": "Feedback with hysteresis feed-forward",
  "source": "thesis Fig. 2.23",
  "remark": "a \"quoted\" remark",
  "parameters": {
    "amplitude": {"value": 3, "unit": "um"},
    "kp":        {"value": 1.207, "unit": "V/um", "bounds": [0, 10], "free": false},
    "ki":        {"value": 7009, "bounds": [null, "8000 V/(um s)"], "free": true, "remark": "from the data sheet"},
    "plain":     5,
    "text":      {"value": 2, "unit": "V"},
    "weights":   [1, 2]
  },
  "inputs": {"u": {"unit": "V"}, "temperature": {"unit": "degC", "remark": "of the room"}},
  "blocks": {
    "reference":   {"type": "sine", "amplitude": "$amplitude", "frequency": "5 Hz", "phase": "-90 deg"},
    "error":       {"type": "sum", "signs": "+-", "in": ["reference", "stage.displacement"]},
    "creep":       {"type": "creep", "amounts": [0.004, 0.01, 0.012], "times": {"value": [0.3, 3, 30, 300, 3000], "unit": "s"}, "in": "u"},
    "compensator": {"choose": "big", "effect": "hysteresis", "in": "reference",
                    "from": {"none": {"type": "gain", "gain": "0 V/um"},
                             "set":  {"type": "bouc_wen", "parameters": "sets/table.json", "alpha": 2},
                             "big":  {"type": "prandtl_ishlinskii", "thresholds": ["0 V", "1 V"], "weights": [1e-8, 2e20]}}},
    "many":        {"type": "sum", "in": {"u": ["u", "error"], "offset": "creep"}},
    "stage":       {"type": "diagram", "file": "stages/stage.json", "controller.kp": "0.5 V/um", "in": "compensator"}
  },
  "outputs": {"y": "stage.displacement"},
  "record": ["reference", "error"],
  "places": {"command": "reference", "measured": ["stage", "many"]},
  "simulate": {"until": "1 s", "every": "0.1 ms", "solver": {"method": "bdf", "relative_tolerance": 1e-8, "absolute_tolerance": 0.01, "max_step": 0.5}}
}
)json");
}

TEST(DiagramFile, WhatIsSaidOfAlgebraicLoopsIsReadAndWritten) {
  const TemporaryFolder folder;
  const std::string settings = R"("simulate": {"loops": "solve", "guess": {"error": "1 um", "stage/sum": 2.5}})";
  const Diagram d = read_diagram(folder.write("d.json", R"({"format": 1, "blocks": {}, )" + settings + "}"));
  EXPECT_EQ(d.simulate.loops, "solve");
  EXPECT_EQ(*d.simulate.guess.find("error"), (Number{1, "um"}));
  EXPECT_EQ(*d.simulate.guess.find("stage/sum"), (Number{2.5, {}}));
  EXPECT_NE(diagram_text(d).find(settings), std::string::npos) << diagram_text(d);
}

TEST(DiagramFile, HowWellNumbersAreKnownIsReadAndWritten) {
  const std::string text = R"json({
  "format": 1,
  "parameters": {
    "k": {"value": 400, "unit": "N/m", "known_to": "2 %", "bounds": [1, null]},
    "c": {"value": 4, "known_to": 0.1}
  },
  "blocks": {
    "force": {"type": "gain", "gain": {"value": 10, "unit": "N/V", "known_to": 0}, "in": "u"},
    "plays": {"type": "prandtl_ishlinskii", "thresholds": {"value": [0, 1], "known_to": "0.5 %"}, "weights": [1, 2], "in": "force"}}})json";
  const TemporaryFolder folder;
  const Diagram d = read_diagram(folder.write("d.json", text));
  EXPECT_EQ(d.parameters.find("k")->value.known_to, 0.02);
  EXPECT_EQ(d.parameters.find("c")->value.known_to, 0.1);
  EXPECT_EQ(d.blocks.find("force")->parameters.find("gain")->known_to, 0);
  EXPECT_EQ(d.blocks.find("plays")->parameters.find("thresholds")->known_to, 0.005);
  EXPECT_FALSE(d.blocks.find("plays")->parameters.find("weights")->known_to.has_value());
  const Diagram again = read_diagram(folder.write("e.json", diagram_text(d)));
  EXPECT_EQ(diagram_text(again), diagram_text(d));
  for (const char* part : {R"({"value": 400, "unit": "N/m", "known_to": "2 %", "bounds": [1, null]})",
                           R"({"value": 4, "known_to": "10 %"})", R"({"value": 10, "unit": "N/V", "known_to": "0 %"})",
                           R"({"value": [0, 1], "known_to": "0.5 %"})"})
    EXPECT_NE(diagram_text(d).find(part), std::string::npos) << part << "\n" << diagram_text(d);
}

TEST(DiagramFile, StartPastAndFixedStepAreReadAndWritten) {
  const std::string settings =
      R"("simulate": {"start": "steady", "past": {"core": ["0 V", "10 V", 3]}, "solver": {"method": "rk4", "step": "10 us"}})";
  const TemporaryFolder folder;
  const Diagram d = read_diagram(folder.write("d.json", R"({"format": 1, "blocks": {}, )" + settings + "}"));
  EXPECT_EQ(d.simulate.start, "steady");
  EXPECT_EQ(*d.simulate.past.find("core"), (NumberList{{0, "V"}, {10, "V"}, {3, {}}}));
  EXPECT_EQ(d.simulate.step, (Number{10, "us"}));
  EXPECT_NE(diagram_text(d).find(R"("start": "steady", "past": {"core": ["0 V", "10 V", 3]})"), std::string::npos)
      << diagram_text(d);
  EXPECT_NE(diagram_text(d).find(R"("step": "10 us")"), std::string::npos);
}

TEST(DiagramFile, GivenMemoryIsReadAndWritten) {
  const std::string settings = R"("simulate": {"memory": {"core": ["0 V", "-0.2 V"], "stage/gap": [3]}})";
  const TemporaryFolder folder;
  const Diagram d = read_diagram(folder.write("d.json", R"({"format": 1, "blocks": {}, )" + settings + "}"));
  EXPECT_EQ(*d.simulate.memory.find("core"), (NumberList{{0, "V"}, {-0.2, "V"}}));
  EXPECT_EQ(*d.simulate.memory.find("stage/gap"), (NumberList{{3, {}}}));
  EXPECT_NE(diagram_text(d).find(settings), std::string::npos) << diagram_text(d);
}

TEST(DiagramFile, LongBlocksAreWrappedUnderTheirFirstKey) {
  Diagram d;
  Node& node = d.blocks["a"];
  node.type = "prandtl_ishlinskii";
  NumberList numbers;
  for (int i = 0; i < 20; ++i) numbers.push_back({i + 0.125, "V"});
  node.parameters["thresholds"] = Value(numbers);
  node.parameters["weights"] = Value(numbers);
  const std::string text = diagram_text(d);
  EXPECT_NE(text.find("    \"a\": {\"type\": \"prandtl_ishlinskii\",\n          \"thresholds\": {"), text.npos) << text;
  EXPECT_NE(text.find(",\n          \"weights\": {"), text.npos) << text;
}

TEST(DiagramFile, MatricesAndLengthsAreReadAndWrittenBack) {
  const TemporaryFolder folder;
  const std::string file = folder.write("d.json", R"({"format": 1,
    "inputs": {"u": {"unit": "V", "length": 2}},
    "blocks": {"y": {"type": "matrix_gain", "in": "u", "matrix": [["1 um/V", 0], [0.5, "2 urad/V"]]},
               "z": {"type": "matrix_gain", "in": "u[1]", "matrix": {"value": [[1], [2]], "unit": "um/V"}}},
    "outputs": {"y": "y", "z": "z[1]"}})");
  const Diagram first = read_diagram(file);
  EXPECT_EQ(first.inputs.find("u")->length, 2);
  const NumberMatrix expected{{{{1, "um/V"}, {0, {}}}, {{0.5, {}}, {2, "urad/V"}}}};
  EXPECT_EQ(std::get<NumberMatrix>(first.blocks.find("y")->parameters.find("matrix")->content), expected);
  write_diagram(folder.path("again.json"), first);
  const Diagram again = read_diagram(folder.path("again.json"));
  EXPECT_EQ(diagram_text(again), diagram_text(first));
  EXPECT_EQ(again.inputs.find("u")->length, 2);
  for (const char* block : {"y", "z"})
    EXPECT_EQ(std::get<NumberMatrix>(again.blocks.find(block)->parameters.find("matrix")->content),
              std::get<NumberMatrix>(first.blocks.find(block)->parameters.find("matrix")->content));
}

TEST(DiagramFile, TheTipTiltStageOfTheProjectIsThreeStacksOfOneKind) {
  const Diagram d = read_diagram(std::string(HYSTERON_SOURCE_DIR) + "/diagrams/stages/tip_tilt.json");
  const Registry registry = all_blocks();  // the program points to its blocks
  const auto program = compile(d, registry);
  EXPECT_EQ(program->record_signals.size(), 9U);
  EXPECT_EQ(program->find_parameter("stacks.weights[1]")->slots.size(), 3U);
  EXPECT_EQ(program->signals[static_cast<std::size_t>(program->signal("pose[0]"))].unit.text, "urad");
  EXPECT_EQ(program->signals[static_cast<std::size_t>(program->signal("pose[2]"))].unit.text, "um");
}

TEST(DiagramFile, AParameterCalledFromIsNoChoice) {
  const TemporaryFolder folder;
  const Diagram d =
      read_diagram(folder.write("d.json", R"({"format": 1, "blocks": {"a": {"type": "chirp", "from": "1 Hz"}}})"));
  EXPECT_EQ(d.blocks.find("a")->type, "chirp");
  EXPECT_TRUE(d.blocks.find("a")->from.empty());
}

TEST(DiagramFile, InputsAndOutputsMayBeCalledAsColumnsAre) {
  // A discovery that finds an effect of the recorded column T gives the diagram an input T: it must be read again.
  const TemporaryFolder folder;
  folder.write("d.json",
               R"({"format": 1, "inputs": {"T": {"unit": "degC"}}, "blocks": {"a": {"type": "pass", "in": "T"}},
"outputs": {"F1": "a"}})");
  const Diagram d = read_diagram(folder.path("d.json"));
  EXPECT_EQ(d.inputs.names(), std::vector<std::string>{"T"});
  EXPECT_EQ(*d.outputs.find("F1"), "a");
  folder.write("again.json", diagram_text(d));
  EXPECT_EQ(diagram_text(read_diagram(folder.path("again.json"))), diagram_text(d));
  const Registry registry = all_blocks();  // the program points to its blocks
  EXPECT_EQ(compile(d, registry)->input_names, std::vector<std::string>{"T"});
}

TEST(DiagramFile, NumbersSurviveToTheLastBitWhateverTheirUnit) {
  const TemporaryFolder folder;
  Diagram d;
  d.blocks["a"].type = "gain";
  NumberList list;
  for (const double v :
       {0.1, 1.0 / 3, 6.02214076e23, -1e-300, 5e-324, 1.7976931348623157e308, 0.0, 123456789012345678.0})
    for (const auto& unit : std::vector<std::optional<std::string>>{{}, "um/V", "1/s", "%", "", "V/(um s)"})
      list.push_back({v, unit});
  d.blocks["a"].parameters["list"] = Value(list);
  d.blocks["a"].parameters["one"] = Value(Number{0.1, ""});
  const Diagram back = read_diagram(folder.write("d.json", diagram_text(d)));
  EXPECT_EQ(std::get<NumberList>(back.blocks.find("a")->parameters.find("list")->content), list);
  EXPECT_EQ(std::get<Number>(back.blocks.find("a")->parameters.find("one")->content), (Number{0.1, ""}));
}

TEST(DiagramFile, ARecordedInputBringsItsSamplesInSIAndIsWrittenAsItWasRead) {
  const TemporaryFolder folder;
  folder.write("lab.csv", "t [ms],5 V [mV],u [mV]\n0,9,1000\n10,9,2000\n");
  const char* text =
      R"({"format": 1, "blocks": {"drive": {"type": "recorded", "file": "lab.csv", "column": "u", "between_samples": "hold"},
          "odd": {"type": "recorded", "file": "lab.csv", "column": "5 V"}}})";
  const Diagram d = read_diagram(folder.write("d.json", text));
  const auto& drive = d.blocks.find("drive")->parameters;
  const auto series = std::get<SeriesPointer>(drive.find("samples")->content);
  EXPECT_EQ(series->t, (std::vector<double>{0, 0.01}));  // 10 * 0.001 is 0.01 to the last bit
  EXPECT_EQ(series->v, (std::vector<double>{1, 2}));
  EXPECT_EQ(series->between, Between::hold);
  EXPECT_EQ(std::get<std::string>(drive.find("column")->content), "u");
  const std::string written = diagram_text(d);
  EXPECT_NE(written.find(R"({"type": "recorded", "file": "lab.csv", "column": "u", "between_samples": "hold"})"),
            written.npos);
  EXPECT_NE(written.find(R"("column": "5 V")"), written.npos);
}

TEST(DiagramFile, ARecordedSignalThatMovesSmoothlyIsASpline) {
  const TemporaryFolder folder;
  folder.write("lab.csv", "t [s],u [V]\n0,0\n1,1\n2,8\n3,27\n4,64\n");
  const Diagram d = read_diagram(folder.write(
      "d.json",
      R"({"format": 1, "blocks": {"drive": {"type": "recorded", "file": "lab.csv", "column": "u", "between_samples": "smooth"}}})"));
  const auto series = std::get<SeriesPointer>(d.blocks.find("drive")->parameters.find("samples")->content);
  EXPECT_NEAR(series->value(3.5, 3.5), 3.5 * 3.5 * 3.5, 6 * 3.5 / 144 + 1e-12);  // t^3, and a hair beside it
}

TEST(DiagramFile, ARecordedSignalHasTheUnitOfItsColumn) {
  const TemporaryFolder folder;
  folder.write("lab.csv", "t [s],u [um]\n0,1\n1,2\n");
  const Registry registry = all_blocks();  // the programs point to its blocks
  const auto compiled = [&](const std::string& radius) {
    return compile(read_diagram(folder.write("d.json", R"({"format": 1, "blocks": {
      "drive": {"type": "recorded", "file": "lab.csv", "column": "u"},
      "play": {"type": "play", "radius": ")" + radius + R"(", "in": "drive"}}, "record": ["play"]})")),
                   registry);
  };
  const auto program = compiled("1 nm");
  EXPECT_EQ(program->signals[static_cast<std::size_t>(program->signal("drive"))].unit.text, "um");
  EXPECT_THROW(compiled("1 V"), Error);
}

TEST(DiagramFile, ADiagramWrittenElsewhereStillFindsWhatItNames) {
  const Project project;
  project.folder.write("hysteron.project", "");
  project.folder.write("lab.csv", "t [s],u [V]\n0,1\n1,2\n");
  Diagram d = read_diagram(project.folder.path("d.json"));
  Node& drive = d.blocks["drive"];
  drive.type = "recorded";
  drive.parameters["file"].content = std::string("lab.csv");
  drive.parameters["column"].content = std::string("u");
  std::filesystem::create_directories(project.folder.path("out/deep"));
  write_diagram(project.folder.path("out/deep/e.json"), d);
  const Diagram moved = read_diagram(project.folder.path("out/deep/e.json"));
  EXPECT_EQ(moved.schema, "../../../schema/diagram.schema.json");
  EXPECT_EQ(moved.blocks.find("stage")->file, "../../stages/stage.json");
  EXPECT_EQ(moved.blocks.find("compensator")->from.find("set")->parameter_file, "../../sets/table.json");
  EXPECT_TRUE(moved.blocks.find("drive")->parameters.find("samples") != nullptr);
}

TEST(DiagramFile, ADiagramWithoutASchemaGetsTheNearestOne) {
  const TemporaryFolder folder;
  folder.write("schema/diagram.schema.json", "{}");
  std::filesystem::create_directories(folder.path("a/b"));
  Diagram d;
  d.blocks["a"].type = "pass";
  write_diagram(folder.path("a/b/d.json"), d);
  EXPECT_EQ(read_diagram(folder.path("a/b/d.json")).schema, "../../schema/diagram.schema.json");
}

TEST(DiagramFile, WhatCannotStandInAFileIsRefusedAndNothingIsWritten) {
  const TemporaryFolder folder;
  Diagram d;
  d.blocks["a"].type = "recorded";
  d.blocks["a"].parameters["samples"] = Value(std::make_shared<const Series>());
  EXPECT_THROW(write_diagram(folder.path("d.json"), d), Error);
  Diagram nested;
  nested.blocks["a"].type = "diagram";
  nested.blocks["a"].nested = std::make_shared<const Diagram>();
  EXPECT_THROW(write_diagram(folder.path("d.json"), nested), Error);
  Diagram infinite;
  infinite.blocks["a"].parameters["gain"] = Value(std::numeric_limits<double>::infinity());
  EXPECT_THROW(write_diagram(folder.path("d.json"), infinite), Error);
  EXPECT_EQ(folder.count(), 0U);
}

TEST(DiagramFile, AFullDiskFailsWhenADiagramIsWritten) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  Diagram d;
  d.blocks["a"].type = "pass";
  try {
    write_diagram("/dev/full", d);
    FAIL() << "a full disk went unnoticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "cannot_write");
  }
}

TEST(LocateProblems, PointersAndBlockPathsGetFileAndLineAndOthersStayAsTheyAre) {
  const Project project;
  const std::string file = project.folder.path("d.json"), nested = project.folder.path("stages/stage.json");
  Error error(Fault::input, {{"a", "/blocks/creep/times", "w", "c", {}, 0},
                             {"b", "stage/displacement.y", "w", "c", {}, 0},
                             {"c", nested + "#/outputs/displacement", "w", "c", {}, 0},
                             {"d", "--set a=5", "w", "c", {}, 0},
                             {"e", "nothing.of_that_name", "w", "c", {}, 0},
                             {"f", "/x", "w", "c", "other.json", 7}});
  locate_problems(error, file);
  EXPECT_EQ(error.problems[0].line, 16);
  EXPECT_EQ(error.problems[0].file, file);
  EXPECT_EQ(error.problems[1].line, 22);
  EXPECT_EQ(error.problems[2].line, 2);
  EXPECT_EQ(error.problems[2].file, nested);
  EXPECT_EQ(error.problems[2].path, "/outputs/displacement");
  EXPECT_EQ(error.problems[3].line, 0);
  EXPECT_EQ(error.problems[4].line, 0);
  EXPECT_EQ(error.problems[5].line, 7);
  EXPECT_NE(std::string(error.what()).find(file + ":16: /blocks/creep/times"), std::string::npos);
}

}  // namespace
}  // namespace hysteron
