// Decides the stages between a diagram and a program: resolve values, build the graph, check units, order the steps.
// Internal to the engine; compile() calls the stages one after the other, each reports all its problems.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// A number on its way into Run::p, with what its unit says.
struct ResolvedNumber {
  double si = 0;
  std::optional<Dimension> dimension{};  ///< as written; absent = no unit (fits a declared unit; zero fits any)
  Unit unit{};                           ///< as written
  bool has_unit = false;
  std::string parameter{};  ///< name of the diagram parameter that it came from ("" = written at the block)
  std::string origin{};
  std::optional<double> known_to{};  ///< see Value
};

struct ResolvedParameter {
  std::vector<ResolvedNumber> numbers;  ///< one, or the elements of a list or matrix (row by row), or characters
  bool list = false;
  int columns = 0;  ///< of a matrix
};

/// A diagram inside a diagram, while names are looked up.
struct Scope {
  const Diagram* diagram = nullptr;
  std::string prefix;  ///< "stage/", "" at the top
  const Scope* parent = nullptr;
  const Node* node = nullptr;  ///< the block of the parent that holds this diagram
};

struct GraphParameter {  ///< a parameter of some diagram scope that a block has asked for
  std::string path{};    ///< "kp", "stage/kp"
  const DiagramParameter* given = nullptr;
  std::string stands_for{};  ///< the parameter of this diagram, or of the one around it, that it refers to, if any
};

/// Place of one number in the vector that its port carries.
struct PortElement {
  int port = 0;      ///< index of the declared port
  int element = -1;  ///< -1: the port is no vector
};

/// The flat diagram: leaf blocks with values and wires, every wire one number.
struct GraphBlock {
  std::string path, origin;
  std::string owner;  ///< whose parameters these are: the path without the index of an element
  const Kernel* kernel = nullptr;
  Shape shape;
  Sizes sizes;
  std::vector<ResolvedParameter> parameters;  ///< per declared parameter
  SeriesPointer series;
  int enabling = -1;                ///< into Graph::enablings
  bool unit_known = false;          ///< recorded: its signal has the unit of the column
  std::vector<int> source;          ///< per input number: signal
  std::vector<PortElement> input;   ///< per input number
  std::vector<PortElement> output;  ///< per output number
  int first_signal = 0;
};

struct Graph {
  std::vector<GraphBlock> blocks;
  std::vector<Enabling> enablings;     ///< blocks: of this graph; what is inside is not listed yet
  std::vector<KernelPointer> kernels;  ///< those that blocks have of their own
  std::vector<SignalInfo> signals;
  std::vector<std::pair<std::string, int>> inputs, outputs;  ///< name, signal
  std::vector<std::pair<std::string, int>> open;  ///< the same of inputs whose units are those of what reads them
  std::vector<int> record;
  std::vector<Unit> input_units;
  std::vector<GraphParameter> parameters;
  Ordered<std::vector<std::string>> places;
};

/// Choices, nested diagrams, wires (flatten.h), lengths, and every vector taken apart into numbers.
Graph build_graph(const Diagram& diagram, const Registry& registry);

}  // namespace hysteron
