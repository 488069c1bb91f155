// What is common to both ways, and what is wrong in a description. Written by write_fmi_description.cpp, read by
// read_fmi_description.cpp.
#include "io/fmi/fmi_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hysteron {

const FmiScalar* FmiDescription::find(const std::string& wanted) const {
  const auto found = std::find_if(variables.begin(), variables.end(), [&](const auto& v) { return v.name == wanted; });
  return found == variables.end() ? nullptr : &*found;
}

std::string fmi_binary_name(const FmiDescription& description) {
  return fmt::format("binaries/{}/{}.so", description.version == 2 ? "linux64" : "x86_64-linux",
                     description.identifier);
}

namespace {

using Faults = std::vector<std::string>;

bool is_c_name(const std::string& text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

void find_faults_of(const FmiScalar& v, const std::set<std::string>& units, Faults& faults) {
  const auto fault = [&](const std::string& what) {
    faults.push_back(fmt::format("variable \"{}\" {}", v.name, what));
  };
  if (!v.unit.empty() && !units.contains(v.unit))
    fault(fmt::format("has the unit \"{}\", which is not defined", v.unit));
  if (v.lower && v.upper && *v.lower > *v.upper) fault(fmt::format("has min {} above max {}", *v.lower, *v.upper));
  if (v.start && ((v.lower && *v.start < *v.lower) || (v.upper && *v.start > *v.upper)))
    fault(fmt::format("starts at {}, outside of its range", *v.start));
  if (v.nominal && !(*v.nominal > 0)) fault(fmt::format("has the nominal value {}, which is not positive", *v.nominal));
  const bool needs_start = v.causality == "input" || v.causality == "parameter" || v.initial == "exact";
  if (needs_start && !v.start && v.type == "Real") fault("needs a start value");
  if (v.initial == "calculated" && v.start) fault("is calculated and has a start value");
  if (v.causality == "parameter" && v.variability == "continuous") fault("is a parameter and continuous");
}

void find_faults_of_structure(const FmiDescription& d, Faults& faults) {
  std::map<unsigned, const FmiScalar*> known;  // of aliases the first
  for (const auto& v : d.variables) known.emplace(v.reference, &v);
  std::set<unsigned> listed;
  for (const auto& output : d.outputs) {
    const auto v = known.find(output.reference);
    if (v == known.end() || v->second->causality != "output")
      faults.push_back(fmt::format("the structure lists {} as an output, which is none", output.reference));
    if (!listed.insert(output.reference).second)
      faults.push_back(fmt::format("the structure lists output {} twice", output.reference));
    for (const unsigned on : output.dependencies.value_or(std::vector<unsigned>{}))
      if (!known.contains(on))
        faults.push_back(fmt::format("output {} depends on {}, which is no variable", output.reference, on));
  }
  for (const auto& v : d.variables)
    if (v.causality == "output" && !listed.contains(v.reference))
      faults.push_back(fmt::format("output \"{}\" is missing in the structure", v.name));
}

}  // namespace

Faults fmi_description_faults(const FmiDescription& d) {
  Faults faults;
  if (d.name.empty()) faults.emplace_back("the model has no name");
  if (d.token.empty()) faults.emplace_back(d.version == 2 ? "guid is empty" : "instantiationToken is empty");
  if (!d.identifier.empty() && !is_c_name(d.identifier))
    faults.push_back(fmt::format("modelIdentifier \"{}\" is no name of C", d.identifier));
  std::set<std::string> units, names;
  for (const auto& unit : d.units)
    if (!units.insert(unit.name).second) faults.push_back(fmt::format("unit \"{}\" is defined twice", unit.name));
  std::map<unsigned, std::string> references;
  for (const auto& v : d.variables) {
    if (!names.insert(v.name).second) faults.push_back(fmt::format("variable \"{}\" is there twice", v.name));
    const auto [place, is_new] = references.emplace(v.reference, v.name);
    if (!is_new && d.version == 3)  // an alias in FMI 2
      faults.push_back(
          fmt::format("\"{}\" and \"{}\" have the same value reference {}", place->second, v.name, v.reference));
    find_faults_of(v, units, faults);
  }
  find_faults_of_structure(d, faults);
  return faults;
}

}  // namespace hysteron
