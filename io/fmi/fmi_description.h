// Decides what the model description of an FMU says (modelDescription.xml of the Functional Mock-up Interface, versions
// 2.0.4 and 3.0.1, fmi-standard.org), as a plain value for both ways: written for co-simulation, read of whatever
// others wrote. In write_fmi_description.cpp and read_fmi_description.cpp. Does not unpack archives (zip_archive.h) nor
// load binaries.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/diagram/units.h"

namespace hysteron {

struct FmiUnit {
  std::string name;
  std::optional<Unit> unit{};  ///< absent: it says no base units
};

/// One variable, as the description has it.
struct FmiScalar {
  std::string name, description{};
  std::string type = "Real";  ///< as FMI 2 calls it: "Real", "Integer", "Boolean", "String", "Enumeration"; else as is
  unsigned reference = 0;
  std::string causality = "local", variability = "continuous", initial{};
  std::string unit{};
  bool relative = false;  ///< a difference: the offset of its unit does not count
  std::optional<double> start{}, lower{}, upper{}, nominal{};
  bool is_array = false;  ///< FMI 3: has dimensions
};

/// An output, and what it depends on; references.
struct FmiUnknown {
  unsigned reference = 0;
  std::optional<std::vector<unsigned>> dependencies{};  ///< absent: may depend on all
};

struct FmiDescription {
  int version = 2;  ///< 2 or 3
  std::string name, description{}, token{}, tool{};
  std::string identifier{};  ///< of the co-simulation binary; "": offers none
  bool copies_state = false, variable_step = true, needs_tool = false;
  std::optional<double> start{}, stop{}, tolerance{}, step{};
  std::vector<FmiUnit> units{};
  std::vector<FmiScalar> variables{};
  std::vector<FmiUnknown> outputs{}, initial_unknowns{};

  const FmiScalar* find(const std::string& name) const;  ///< null if there is none
};

std::string fmi_description_text(const FmiDescription& description);

/// Reads a model description; `file` is for messages. Throws Error "bad_fmu" where it is no XML, of another version,
/// or lacks what the standard demands of every variable.
FmiDescription read_fmi_description(const std::string& text, const std::string& file);

/// Where the binary of this machine lies in the archive: "binaries/linux64/stage.so", "binaries/x86_64-linux/stage.so".
std::string fmi_binary_name(const FmiDescription& description);

/// What the standard forbids and what a user would stumble over, one sentence each.
std::vector<std::string> fmi_description_faults(const FmiDescription& description);

}  // namespace hysteron
