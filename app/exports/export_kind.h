// Decides what a kind of "hysteron export" is: a program of another form, made of a diagram. Each kind stands in a
// source of its own (export_c.cpp, export_fmu.cpp) and in the table of export.cpp.
#pragma once

#include <string>
#include <vector>

#include "app/cli/answer.h"
#include "app/cli/shape.h"
#include "app/cli/watch.h"

namespace hysteron {

struct ExportKind {
  std::string name;     ///< the first word: "c"
  std::string summary;  ///< one line
  std::string help;     ///< what it writes, examples
  /// Beside the diagram, -o, --set, --choose and --allow, which all kinds take.
  std::vector<OptionSpec> options;
  Answer (*act)(const Arguments&, const Watch&) = nullptr;
  std::vector<shape::Member> (*shape)() = nullptr;  ///< of --json, beside "kind"
};

/// A co-simulation unit of the Functional Mock-up Interface.
ExportKind export_fmu();

}  // namespace hysteron
