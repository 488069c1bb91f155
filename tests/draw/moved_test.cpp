// Blocks that were moved by hand: they stand where they were put, and wires go around them.
#include "draw/moved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "blocks/register_all.h"
#include "draw/drawing.h"
#include "draw/layout.h"
#include "engine/compile/compile.h"
#include "tests/draw/picture.h"

namespace hysteron::draw {
namespace {

Node block(const std::string& type, const std::vector<std::string>& in, const std::string& key = "",
           const Value& value = Value(1.0)) {
  Node node;
  node.type = type;
  for (const auto& from : in) node.in.push_back({"", from});
  if (!key.empty()) node.parameters[key] = value;
  return node;
}

/// A loop with a feed-forward, a sum on each side, and an output.
Diagram loop() {
  Diagram d;
  d.blocks["reference"] = block("constant", {}, "value");
  d.blocks["error"] = block("sum", {"reference", "plant"}, "signs", Value("+-"));
  d.blocks["controller"] = block("gain", {"error"}, "gain");
  d.blocks["forward"] = block("gain", {"reference"}, "gain");
  d.blocks["drive"] = block("sum", {"controller", "forward"}, "signs", Value("++"));
  d.blocks["plant"] = block("lag", {"drive"}, "times", Value(NumberList{{1, "ms"}}));
  d.outputs["y"] = "plant";
  return d;
}

class MovedBlocks : public testing::Test {
 protected:
  MovedBlocks() : program_(compile(diagram_, blocks_)) {}
  Sheet sheet() const {
    Sheet sheet = sheet_of(diagram_, *program_, blocks_, 0);
    lay_out(sheet);
    return sheet;
  }
  std::string svg(const Places& places) const { return diagram_svg(diagram_, *program_, blocks_, {0, {}, places}); }
  static const Item& item(const Sheet& sheet, const std::string& name) {
    return *std::find_if(sheet.items.begin(), sheet.items.end(), [&](const Item& i) { return i.name == name; });
  }

  Registry blocks_ = all_blocks();
  Diagram diagram_ = loop();
  ProgramPointer program_;
};

TEST_F(MovedBlocks, StandWhereTheyWerePutAndLeaveTheOthersAlone) {
  const Sheet before = sheet();
  Sheet after = sheet();
  move_items(after, {{"plant", {200, 90}}, {"nobody", {1, 1}}});
  EXPECT_EQ(item(after, "plant").x, 200 * grid);
  EXPECT_EQ(item(after, "plant").y, 90 * grid);
  for (const char* name : {"reference", "error", "controller", "forward", "drive"}) {
    EXPECT_EQ(item(after, name).x, item(before, name).x) << name;
    EXPECT_EQ(item(after, name).y, item(before, name).y) << name;
  }
}

TEST_F(MovedBlocks, KeepTheWaysOfWiresThatTheyDoNotConcern) {
  const Sheet before = sheet();
  Sheet after = sheet();
  move_items(after, {{"plant", {200, 90}}});
  for (std::size_t w = 0; w < before.wires.size(); ++w)
    if (before.wires[w].signal == "reference" &&
        before.items[static_cast<std::size_t>(before.wires[w].to)].name == "forward") {
      EXPECT_EQ(after.wires[w].path, before.wires[w].path);
    }
}

TEST_F(MovedBlocks, NoPlaceAtAllChangesNothing) { EXPECT_EQ(svg({}), diagram_svg(diagram_, *program_, blocks_)); }

TEST_F(MovedBlocks, ComeToTheHeightOfTheirWireWhereLessThanHalfAStepIsMissing) {
  Sheet after = sheet();
  const Item before = item(after, "controller");
  // A whole step of the grid beside the place of the layout, which need not lie on the grid.
  const int x = static_cast<int>(before.x / grid) + 1, y = static_cast<int>(std::lround(before.y / grid));
  move_items(after, {{"controller", {x, y}}});
  EXPECT_NEAR(item(after, "controller").y, before.y, 1e-9) << "the straight wire from the sum stays straight";
}

TEST_F(MovedBlocks, WiresGoAroundEverythingWhereverBlocksStand) {
  std::mt19937 random(7);
  const std::vector<std::string> names{"reference", "error", "controller", "forward", "drive", "plant", "y"};
  for (int round = 0; round < 60; ++round) {
    // Cells of 200 x 140 pixels, in which every block with its caption finds room beside its wires.
    std::vector<std::array<int, 2>> cells;
    for (int column = -2; column < 3; ++column)
      for (int row = -1; row < 3; ++row) cells.push_back({50 * column, 35 * row});
    std::shuffle(cells.begin(), cells.end(), random);
    Places places;
    for (std::size_t i = 0; i < names.size(); ++i) {
      places[names[i]] = cells[i];
      places[names[i]][0] += static_cast<int>(random() % 9);
      places[names[i]][1] += static_cast<int>(random() % 9);
    }
    const auto violations = picture::violations(picture::read(svg(places)));
    EXPECT_TRUE(violations.empty()) << "round " << round << ": " << violations.front();
  }
}

TEST_F(MovedBlocks, ABlockOnAWireSendsItAround) {
  Sheet after = sheet();
  const Item &controller = item(after, "controller"), &drive = item(after, "drive");
  // Onto the middle of the wire between them, which is made long enough for it.
  constexpr int further = 60;
  const double x =
      (controller.x + controller.width() + drive.x + grid * further) / 2 - item(after, "reference").width() / 2;
  const double y = controller.y + controller.height() / 2 - item(after, "reference").height() / 2;
  const int to = static_cast<int>(drive.x / grid) + further, line = static_cast<int>(drive.y / grid);
  move_items(after, {{"reference", {static_cast<int>(x / grid), static_cast<int>(y / grid)}},
                     {"drive", {to, line}},
                     {"plant", {to + further, line}},
                     {"y", {to + 2 * further, line}}});
  const Item& in_the_way = item(after, "reference");
  for (const auto& wire : after.wires)
    if (wire.signal == "controller")
      for (std::size_t i = 1; i < wire.path.size(); ++i) {
        const auto [top, bottom] = std::minmax(wire.path[i - 1].y, wire.path[i].y);
        const auto [left, right] = std::minmax(wire.path[i - 1].x, wire.path[i].x);
        EXPECT_FALSE(right > in_the_way.x && left < in_the_way.x + in_the_way.width() && bottom > in_the_way.y &&
                     top < in_the_way.y + in_the_way.height());
      }
}

TEST_F(MovedBlocks, ThePictureHoldsAllOfThem) {
  const auto picture = picture::read(svg({{"reference", {-100, -80}}, {"plant", {300, 200}}}));
  for (const auto& outline : picture.outlines) {
    EXPECT_GE(outline.left, 0) << outline.path;
    EXPECT_GE(outline.top, 0) << outline.path;
    EXPECT_LE(outline.right, picture.width) << outline.path;
    EXPECT_LE(outline.bottom, picture.height) << outline.path;
  }
}

}  // namespace
}  // namespace hysteron::draw
