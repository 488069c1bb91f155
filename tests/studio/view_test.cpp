// What is drawn of a diagram, right or not, and which wires may be drawn in it.
#include "studio/view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "blocks/register_all.h"
#include "tests/io/temporary_folder.h"

namespace hysteron::studio {
namespace {

using Json = nlohmann::ordered_json;

class StudioView : public testing::Test {
 protected:
  std::string write(const std::string& text) const { return folder_.write("d.json", text); }
  Json view(const std::string& text) const { return view_of(write(text), blocks_, {}); }
  static Json item(const Json& view, const std::string& name) {
    for (const auto& i : view["sheet"]["items"])
      if (i["name"] == name) return i;
    return nullptr;
  }
  static Json problem(const Json& view, const std::string& code) {
    for (const auto& p : view["problems"])
      if (p["code"] == code) return p;
    return nullptr;
  }
  static std::string text_of(const Json& view) {
    std::string text;
    for (const auto& line : view["lines"]) text += (text.empty() ? "" : "\n") + line.get<std::string>();
    return text;
  }
  Registry blocks_ = all_blocks();
  TemporaryFolder folder_;
};

constexpr char good[] = R"({"format": 1,
  "blocks": {
    "drive": {"type": "sine", "amplitude": "2 V", "frequency": "5 Hz"},
    "stage": {"type": "gain", "gain": "3 um/V", "in": "drive"}
  },
  "outputs": {"y": "stage"}
})";

TEST_F(StudioView, HoldsItemsWiresAndUnits) {
  const Json v = view(good);
  EXPECT_EQ(v["problems"].size(), 0U);
  EXPECT_EQ(text_of(v), good);
  EXPECT_EQ(item(v, "stage")["out"][0]["unit"], "um");
  EXPECT_EQ(item(v, "stage")["in"][0]["reads"], "drive");
  ASSERT_EQ(v["sheet"]["wires"].size(), 2U);
  EXPECT_GE(v["sheet"]["wires"][0]["path"].size(), 2U);
}

TEST_F(StudioView, AnUnfinishedDiagramIsDrawnWithOpenPorts) {
  const Json v = view(R"({"format": 1, "blocks": {
    "a": {"type": "gain", "gain": 1},
    "b": {"type": "sum", "in": "nowhere"},
    "c": {"type": "no_such_type", "in": "a"}}})");
  ASSERT_TRUE(v["sheet"].is_object());
  EXPECT_EQ(item(v, "a")["in"][0]["reads"], "");
  EXPECT_EQ(item(v, "b")["in"][0]["reads"], "nowhere");
  EXPECT_EQ(item(v, "c")["symbol"]["text"][0], "no_such_type");
  EXPECT_EQ(v["sheet"]["wires"].size(), 1U) << "a to c; a wire that begins nowhere is left out";
  EXPECT_EQ(problem(v, "unknown_block")["line"], 4);
  EXPECT_FALSE(v["warnings"].empty()) << "a reads nothing yet";
}

TEST_F(StudioView, AUnitThatIsWantedIsNotGivenByABlockThatIsWrong) {
  const Json v = view(R"({"format": 1, "blocks": {
    "drive": {"type": "sine", "amplitude": "2 V", "frequency": "5 mm"},
    "force": {"type": "constant", "value": "1 N"},
    "total": {"type": "sum", "in": ["drive", "force"]}}, "record": ["total"]})");
  EXPECT_EQ(item(v, "drive")["out"][0]["unit"], "");
  EXPECT_EQ(item(v, "force")["out"][0]["unit"], "N");
}

TEST_F(StudioView, BlocksStandWhereTheyWereMovedTo) {
  (void)folder_.write("d.layout.json", R"({"format": 1, "blocks": {"stage": [100, 50]}})");
  const Json v = view(good);
  EXPECT_EQ(item(v, "stage")["x"], 400);
  EXPECT_NEAR(item(v, "stage")["y"].get<double>(), 200, 2);  // half a step of the grid, to be level with its wire
  EXPECT_EQ(v["places"]["stage"], Json::array({100, 50}));
  EXPECT_EQ(text_of(v), good);
}

TEST_F(StudioView, AWrongLayoutFileMovesNothingAndIsTold) {
  (void)folder_.write("d.layout.json", R"({"format": 1, "blocks": {"stage": ["left", 50]}})");
  const Json v = view(good);
  EXPECT_TRUE(v["sheet"].is_object());
  ASSERT_EQ(v["problems"].size(), 1U);
  EXPECT_EQ(v["problems"][0]["path"], "/blocks/stage");
}

TEST_F(StudioView, WhatIsNoDiagramIsToldInItsLine) {
  const Json v = view("{\"format\": 1,\n \"blocks\": {\"a\": }}");
  EXPECT_TRUE(v["sheet"].is_null());
  EXPECT_EQ(v["problems"][0]["code"], "bad_json");
  EXPECT_EQ(v["problems"][0]["line"], 2);
}

TEST_F(StudioView, AWireFitsWhereItsUnitDoes) {
  const std::string file = write(R"({"format": 1, "blocks": {
    "force": {"type": "constant", "value": "1 N"},
    "drive": {"type": "constant", "value": "1 V"},
    "stage": {"type": "saturation", "lower": "0 V", "upper": "10 V", "in": "drive"},
    "open":  {"type": "saturation", "lower": "0 V", "upper": "10 V"}}})");
  const auto why = [&](const std::string& signal, const std::string& block) -> std::string {
    const Json v = view_of(file, blocks_, {});
    for (const auto& fit : fits_of(file, signal, blocks_, {}))
      if (v["sheet"]["items"][fit["item"].get<std::size_t>()]["name"] == block) return fit["why"];
    return "not told";
  };
  EXPECT_EQ(why("drive", "open"), "");
  EXPECT_NE(why("force", "open").find("N"), std::string::npos) << why("force", "open");
  EXPECT_NE(why("force", "stage"), "");
}

}  // namespace
}  // namespace hysteron::studio
