// Reads a model description of either version. What concerns model exchange alone is passed over.
#include <fmt/format.h>

#include <charconv>
#include <map>
#include <pugixml.hpp>
#include <sstream>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "io/fmi/fmi_description.h"

namespace hysteron {
namespace {

class Reader {
 public:
  Reader(const std::string& text, std::string file) : file_(std::move(file)) {
    const auto result = document_.load_buffer(text.data(), text.size());
    if (!result) refuse("modelDescription.xml", fmt::format("is no XML: {}", result.description()));
    root_ = document_.child("fmiModelDescription");
    if (!root_) refuse("modelDescription.xml", "has no element fmiModelDescription");
  }

  FmiDescription description() {
    const std::string version = root_.attribute("fmiVersion").value();
    if (version.starts_with("2."))
      d_.version = 2;
    else if (version.starts_with("3."))
      d_.version = 3;
    else
      refuse("fmiVersion", fmt::format("is \"{}\"", version), "export it for FMI 2.0 or 3.0");
    d_.name = root_.attribute("modelName").value();
    d_.token = root_.attribute(d_.version == 2 ? "guid" : "instantiationToken").value();
    d_.description = root_.attribute("description").value();
    d_.tool = root_.attribute("generationTool").value();
    read_capabilities();
    read_experiment();
    read_units();
    read_variables();
    read_structure();
    return std::move(d_);
  }

 private:
  [[noreturn]] void refuse(const std::string& where, const std::string& what,
                           const std::string& cure = "export it again with a tool that keeps to the standard") const {
    throw Error(Fault::input, {{"bad_fmu", where, "the model description " + what, cure, file_, 0}});
  }

  std::optional<double> number(pugi::xml_node node, const char* name) const {
    const auto attribute = node.attribute(name);
    if (!attribute) return {};
    double value = 0;
    const std::string_view text = attribute.value();
    if (read_number(text, value) != text.size() || text.empty())
      refuse(where(node) + "/" + name, fmt::format("has \"{}\" where a number was expected", text));
    return value;
  }

  unsigned whole(pugi::xml_node node, const char* name) const {
    const std::string_view text = node.attribute(name).value();
    unsigned value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size())
      refuse(where(node) + "/" + name, fmt::format("has \"{}\" where a whole number was expected", text));
    return value;
  }

  static std::string where(pugi::xml_node node) {
    const std::string name = node.attribute("name").value();
    return name.empty() ? node.name() : name;
  }

  void read_capabilities() {
    const auto node = root_.child("CoSimulation");
    d_.identifier = node.attribute("modelIdentifier").value();
    d_.variable_step = node.attribute("canHandleVariableCommunicationStepSize").as_bool();
    d_.copies_state = node.attribute(d_.version == 2 ? "canGetAndSetFMUstate" : "canGetAndSetFMUState").as_bool();
    d_.needs_tool = node.attribute("needsExecutionTool").as_bool();
  }

  void read_experiment() {
    const auto node = root_.child("DefaultExperiment");
    d_.start = number(node, "startTime");
    d_.stop = number(node, "stopTime");
    d_.tolerance = number(node, "tolerance");
    d_.step = number(node, "stepSize");
  }

  void read_units() {
    static constexpr const char* names[] = {"m", "kg", "s", "A", "K", "mol", "cd", "rad"};
    for (const auto node : root_.child("UnitDefinitions").children("Unit")) {
      FmiUnit unit{node.attribute("name").value(), {}};
      if (const auto base = node.child("BaseUnit")) {
        Unit u;
        u.text = unit.name;
        for (std::size_t i = 0; i < std::size(names); ++i)
          u.dimension.power[i] = static_cast<std::int8_t>(base.attribute(names[i]).as_int());
        u.scale = number(base, "factor").value_or(1);
        u.offset = number(base, "offset").value_or(0);
        if (!(u.scale != 0)) refuse(where(node), "has a unit with the factor 0");
        unit.unit = u;
      }
      d_.units.push_back(std::move(unit));
    }
    for (const auto node : root_.child("TypeDefinitions").children()) {  // types carry units as well
      const char* name = node.attribute("name").value();
      const auto real = d_.version == 2 ? node.child("Real") : node;
      if (const auto unit = real.attribute("unit")) units_of_types_.emplace(name, unit.value());
    }
  }

  std::string unit_of(pugi::xml_node real) const {
    if (const auto unit = real.attribute("unit")) return unit.value();
    const auto type = units_of_types_.find(real.attribute("declaredType").value());
    return type == units_of_types_.end() ? "" : type->second;
  }

  void read_variable(pugi::xml_node node, pugi::xml_node typed, std::string type) {
    FmiScalar v;
    v.name = node.attribute("name").value();
    if (v.name.empty()) refuse(node.name(), "has a variable without a name");
    v.type = std::move(type);
    v.reference = whole(node, "valueReference");
    v.description = node.attribute("description").value();
    const bool real = v.type == "Real";
    v.causality = node.attribute("causality").as_string("local");
    v.variability = node.attribute("variability").as_string(real ? "continuous" : "discrete");
    v.initial = node.attribute("initial").value();
    v.is_array = static_cast<bool>(node.child("Dimension"));
    if (real) {
      v.unit = unit_of(typed);
      v.relative = typed.attribute("relativeQuantity").as_bool();
      v.lower = number(typed, "min"), v.upper = number(typed, "max"), v.nominal = number(typed, "nominal");
      if (!v.is_array) v.start = number(typed, "start");
    }
    d_.variables.push_back(std::move(v));
  }

  void read_variables() {
    const auto list = root_.child("ModelVariables");
    for (const auto node : list.children()) {
      if (node.type() != pugi::node_element) continue;
      if (d_.version == 3) {
        const std::string type = node.name();
        read_variable(node, node, type == "Float64" ? "Real" : type);
        continue;
      }
      for (const char* type : {"Real", "Integer", "Boolean", "String", "Enumeration"})
        if (const auto typed = node.child(type)) read_variable(node, typed, type);
    }
    if (d_.variables.empty()) refuse("ModelVariables", "has no variables");
  }

  unsigned reference_of(pugi::xml_node node) const {
    if (d_.version == 3) return whole(node, "valueReference");
    const unsigned index = whole(node, "index");
    if (index < 1 || index > d_.variables.size()) refuse("ModelStructure", fmt::format("names variable {}", index));
    return d_.variables[index - 1].reference;
  }

  FmiUnknown unknown_of(pugi::xml_node node) const {
    FmiUnknown unknown{reference_of(node), {}};
    const auto attribute = node.attribute("dependencies");
    if (!attribute) return unknown;
    std::istringstream text(attribute.value());
    unknown.dependencies.emplace();
    for (unsigned on = 0; text >> on;) {
      if (d_.version == 2 && (on < 1 || on > d_.variables.size()))
        refuse("ModelStructure", fmt::format("names variable {}", on));
      unknown.dependencies->push_back(d_.version == 2 ? d_.variables[on - 1].reference : on);
    }
    return unknown;
  }

  void read_structure() {
    const auto node = root_.child("ModelStructure");
    const auto outputs = d_.version == 2 ? node.child("Outputs") : node;
    for (const auto one : outputs.children(d_.version == 2 ? "Unknown" : "Output"))
      d_.outputs.push_back(unknown_of(one));
    const auto unknowns = d_.version == 2 ? node.child("InitialUnknowns") : node;
    for (const auto one : unknowns.children(d_.version == 2 ? "Unknown" : "InitialUnknown"))
      d_.initial_unknowns.push_back(unknown_of(one));
  }

  std::string file_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  FmiDescription d_;
  std::map<std::string, std::string> units_of_types_;
};

}  // namespace

FmiDescription read_fmi_description(const std::string& text, const std::string& file) {
  return Reader(text, file).description();
}

}  // namespace hysteron
