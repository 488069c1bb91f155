// Decides how a block type says what it is in C: statements over placeholders, and the functions that they call. It
// stands in the source of the block, as `CLaw name_c() {`, where the build finds it. Does not write files (export/).
//
// Placeholders of statements:
//   $in.u  $out.y   an input, an output: by the name of its port, or by its number ($in.0)
//   $p.gain         a number among the parameters; of a list or matrix the table that holds it
//   $n.weights      how many numbers such a list has
//   $s.z            a state or a remembered number, by its declared name
//   $x              all of them, as a table that can be written
//   $t.name         a table of CCode::tables; $n.name its length
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/block/kernel.h"

namespace hysteron {

/// What a block that is to be written knows of itself: its numbers in SI.
struct CBlock {
  const Shape& shape;
  const View<double>& view;

  /// By the name of the parameter. A text is the index of its choice.
  double number(const std::string& parameter) const { return list(parameter).front(); }
  std::span<const double> list(const std::string& parameter) const {
    return view.list(shape.declaration->parameter_index(parameter));
  }
  int choice(const std::string& parameter) const { return static_cast<int>(number(parameter)); }
};

/// Numbers that follow from the parameters, worked out when the code is written [SI].
struct CTable {
  std::string name, meaning;
  std::vector<double> values;
};

/// What one block is in C. The engine's own operations in the engine's own order, so that the bits are the same: its
/// max(a, b) is larger(a, b), min(a, b) is smaller(a, b).
struct CCode {
  /// Whole C functions in double, those first that others call. Every one is written once, however many blocks use it.
  std::vector<std::string> functions{};
  /// Statements at an instant: outputs, and what can be remembered at once.
  std::string output{};
  /// Statements behind the outputs of all blocks, where the inputs are only known then.
  std::string update{};
  std::vector<CTable> tables{};
  /// While one input moves one way and the others stand still, the output moves one way (or stands still). Linear
  /// blocks need not say it.
  bool is_monotone = false;
  std::string refusal{};  ///< not empty: why this block cannot be written, and the cure
};

/// A block type in C.
struct CLaw {
  std::string type;
  CCode (*code)(const CBlock&) = nullptr;
  /// Of a continuous block: the sampled type with the same parameters, ports and law that stands for it in a
  /// controller.
  std::string sampled_type{};
  /// The type that undoes it, with the parameters of the same names; its first input is the wanted output.
  std::string inverse_type{};
};

/// C functions that several rooms call.
namespace c_functions {
inline constexpr char larger[] = R"(static double larger(double a, double b)
{
    return a < b ? b : a;
}
)";
inline constexpr char smaller[] = R"(static double smaller(double a, double b)
{
    return b < a ? b : a;
}
)";
}  // namespace c_functions

}  // namespace hysteron
