// Writes a model description: version 2 in attributes and a type element, version 3 in the element itself.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>

#include "io/fmi/fmi_description.h"

namespace hysteron {
namespace {

/// The shortest text that is read as the same number.
std::string number(double value) { return fmt::format("{}", value); }

template <class Optional>
void set_number(pugi::xml_node& node, const char* name, const Optional& value) {
  if (value) node.append_attribute(name) = number(*value).c_str();
}

void set_flag(pugi::xml_node& node, const char* name, bool value) { node.append_attribute(name) = value; }

void set_text(pugi::xml_node& node, const char* name, const std::string& value) {
  if (!value.empty()) node.append_attribute(name) = value.c_str();
}

class Writer {
 public:
  explicit Writer(const FmiDescription& d) : d_(d) {
    for (std::size_t i = 0; i < d.variables.size(); ++i) index_[d.variables[i].reference] = i + 1;
  }

  std::string text() {
    auto declaration = document_.append_child(pugi::node_declaration);
    set_text(declaration, "version", "1.0");
    set_text(declaration, "encoding", "UTF-8");
    root_ = document_.append_child("fmiModelDescription");
    set_text(root_, "fmiVersion", two() ? "2.0" : "3.0");
    root_.append_attribute("modelName") = d_.name.c_str();
    root_.append_attribute(two() ? "guid" : "instantiationToken") = d_.token.c_str();
    set_text(root_, "description", d_.description);
    set_text(root_, "generationTool", d_.tool);
    set_text(root_, "variableNamingConvention", "flat");
    if (two()) set_text(root_, "numberOfEventIndicators", "0");
    put_capabilities();
    put_units();
    put_category();
    put_experiment();
    put_variables();
    put_structure();
    std::ostringstream out;
    document_.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
    return out.str();
  }

 private:
  bool two() const { return d_.version == 2; }

  void put_capabilities() {
    auto node = root_.append_child("CoSimulation");
    set_text(node, "modelIdentifier", d_.identifier);
    set_flag(node, "canHandleVariableCommunicationStepSize", d_.variable_step);
    set_flag(node, two() ? "canGetAndSetFMUstate" : "canGetAndSetFMUState", d_.copies_state);
    set_flag(node, two() ? "canSerializeFMUstate" : "canSerializeFMUState", false);
    set_flag(node, "canBeInstantiatedOnlyOncePerProcess", false);
    if (two()) {
      set_flag(node, "canNotUseMemoryManagementFunctions", true);
      set_flag(node, "canInterpolateInputs", false);
    } else {
      set_flag(node, "canReturnEarlyAfterIntermediateUpdate", false);
      set_flag(node, "hasEventMode", false);
    }
  }

  /// Base units of FMI have no cycle: one is 2 pi rad.
  static void put_base_unit(pugi::xml_node unit, const Unit& u) {
    static constexpr const char* names[] = {"m", "kg", "s", "A", "K", "mol", "cd", "rad"};
    auto node = unit.append_child("BaseUnit");
    auto power = u.dimension.power;
    const int cycles = power[8];
    power[7] = static_cast<std::int8_t>(power[7] + cycles);
    for (const std::size_t i : {1, 0, 2, 3, 4, 5, 6, 7})  // in the order of the schema
      if (power[i] != 0) node.append_attribute(names[i]) = static_cast<int>(power[i]);
    const double factor = u.scale * std::pow(2 * std::numbers::pi, cycles);
    if (factor != 1) node.append_attribute("factor") = number(factor).c_str();
    if (u.offset != 0) node.append_attribute("offset") = number(u.offset).c_str();
  }

  void put_units() {
    if (d_.units.empty()) return;
    auto list = root_.append_child("UnitDefinitions");
    for (const auto& unit : d_.units) {
      auto node = list.append_child("Unit");
      node.append_attribute("name") = unit.name.c_str();
      if (unit.unit) put_base_unit(node, *unit.unit);
    }
  }

  void put_category() {
    auto category = root_.append_child("LogCategories").append_child("Category");
    set_text(category, "name", "logStatusError");
    set_text(category, "description", "what is wrong, and what helps");
  }

  void put_experiment() {
    if (!d_.start && !d_.stop && !d_.tolerance && !d_.step) return;
    auto node = root_.append_child("DefaultExperiment");
    set_number(node, "startTime", d_.start);
    set_number(node, "stopTime", d_.stop);
    set_number(node, "tolerance", d_.tolerance);
    set_number(node, "stepSize", d_.step);
  }

  void put_common(pugi::xml_node& node, const FmiScalar& v) const {
    node.append_attribute("name") = v.name.c_str();
    node.append_attribute("valueReference") = v.reference;
    set_text(node, "description", v.description);
    set_text(node, "causality", v.causality);
    set_text(node, "variability", v.variability);
    // Version 3 has it where it is written besides: inputs and the time have none.
    if (v.causality != "input" && v.causality != "independent") set_text(node, "initial", v.initial);
  }

  static void put_real(pugi::xml_node& node, const FmiScalar& v) {
    set_text(node, "unit", v.unit);
    if (v.relative) node.append_attribute("relativeQuantity") = true;
    set_number(node, "min", v.lower);
    set_number(node, "max", v.upper);
    set_number(node, "nominal", v.nominal);
    set_number(node, "start", v.start);
  }

  void put_variables() {
    auto list = root_.append_child("ModelVariables");
    for (const auto& v : d_.variables) {
      auto node = list.append_child(two() ? "ScalarVariable" : "Float64");
      put_common(node, v);
      if (!two()) {
        put_real(node, v);
        continue;
      }
      auto real = node.append_child("Real");
      put_real(real, v);
    }
  }

  std::string dependencies(const FmiUnknown& unknown) const {
    std::string text;
    for (const unsigned on : *unknown.dependencies)
      text += (text.empty() ? "" : " ") + std::to_string(two() ? index_.at(on) : on);
    return text;
  }

  void put_unknown(pugi::xml_node list, const char* name, const FmiUnknown& unknown) const {
    auto node = list.append_child(name);
    if (two())
      node.append_attribute("index") = static_cast<unsigned>(index_.at(unknown.reference));
    else
      node.append_attribute("valueReference") = unknown.reference;
    if (unknown.dependencies) node.append_attribute("dependencies") = dependencies(unknown).c_str();
  }

  void put_structure() {
    auto node = root_.append_child("ModelStructure");
    if (two()) {
      if (!d_.outputs.empty()) {
        auto outputs = node.append_child("Outputs");
        for (const auto& one : d_.outputs) put_unknown(outputs, "Unknown", one);
      }
      if (!d_.initial_unknowns.empty()) {
        auto unknowns = node.append_child("InitialUnknowns");
        for (const auto& one : d_.initial_unknowns) put_unknown(unknowns, "Unknown", one);
      }
      return;
    }
    for (const auto& one : d_.outputs) put_unknown(node, "Output", one);
    for (const auto& one : d_.initial_unknowns) put_unknown(node, "InitialUnknown", one);
  }

  const FmiDescription& d_;
  std::map<unsigned, std::size_t> index_;  // of version 2, counted from 1
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace

std::string fmi_description_text(const FmiDescription& description) { return Writer(description).text(); }

}  // namespace hysteron
