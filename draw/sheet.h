// Decides what stands on a picture: items with their symbols, ports and captions, and the wires between them.
// Does not decide where (layout.h) nor how it is written (svg.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "draw/symbol.h"
#include "engine/block/kernel.h"
#include "engine/program/program.h"

namespace hysteron::draw {

/// Pixels, y downwards.
struct Point {
  double x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

/// Where a wire meets the symbol of a sum: the side is chosen when its wires are laid.
enum class Side { left, top, bottom };

struct Sheet;

/// A block, a port of the sheet, or a nested diagram.
struct Item {
  std::string path;                      ///< "stage/play"; ports of a sheet: "stage/u"
  std::string name;                      ///< what stands below it
  std::string type;                      ///< block type; "input", "output" and "diagram" for the others
  std::string tip;                       ///< what a browser shows when the mouse rests on it
  Symbol symbol;                         ///< how it looks; its size
  std::vector<std::string> caption{};    ///< lines below the name: key values with units
  std::vector<std::string> in{}, out{};  ///< names of the ports, one per wire that can end there
  std::vector<std::string> reads{};      ///< per input: the signal, as it is written; "" where there is none
  std::vector<std::string> out_units{};  ///< per output: "um", "" = dimensionless, "um [3]" of a vector
  std::vector<int> out_lengths{};        ///< per output: elements
  int candidates = 0;                    ///< > 0: the chosen one of so many
  std::string chosen{};                  ///< its name
  bool is_new = false;                   ///< set off from the others
  std::shared_ptr<Sheet> inside{};       ///< a nested diagram that is open

  int column = 0;
  double x = 0, y = 0;       ///< upper left corner of the symbol
  std::vector<Side> side{};  ///< per input
  double width() const { return symbol.width; }
  double height() const { return symbol.height; }
  bool is_port() const { return type == "input" || type == "output"; }
};

struct Wire {
  int from = -1, out = 0;  ///< item and its output
  int to = -1, in = 0;     ///< item and its input
  std::string signal;      ///< path of what it carries
  bool feedback = false;   ///< closes a loop: returns below the blocks
  std::vector<Point> path{};
};

struct Sheet {
  std::vector<Item> items;
  std::vector<Wire> wires;
  double width = 0, height = 0;
};

/// The sheet of a diagram, with nested diagrams open down to `depth` levels. Nothing is placed yet.
Sheet sheet_of(const Diagram& diagram, const Program& program, const Registry& registry, int depth);

/// The same of a diagram that is still being written: every declared input has a port, also where nothing is wired to
/// it; what cannot be read is a box with its name; wires that begin nowhere are left out. `program`: as much of it as
/// compiles (engine/compile/draft.h), or null.
Sheet draft_sheet(const Diagram& diagram, const Program* program, const Registry& registry, int depth);

/// Places of the ports from the upper left corner of the symbol.
Point in_port(const Item& item, int port);
Point out_port(const Item& item, int port);

/// What an item needs around the middle of its symbol, caption and all.
struct Room {
  double left = 0, right = 0, below = 0;  ///< below: from the lower edge of the symbol
};
Room room_of(const Item& item);

/// The name of a sum stands beside it, because a loop comes up below it: from the middle of the circle.
inline constexpr double sum_name_offset = 20;

/// Room for the name of an open diagram, above its blocks.
inline constexpr double header_height = 22;

}  // namespace hysteron::draw
