// Decides how a diagram is loaded for another program, and what it is told of it.
#include "app/cli/load.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/target.h"
#include "interop/c/handles.h"
#include "io/diagram/diagram_file.h"
#include "report/pages/numbers.h"

namespace hysteron::interop {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail_overrides(const std::string& path, const std::string& what) {
  fail("bad_call", "overrides" + path, what,
       R"(write {"set": {"kp": "0.5 V/um"}, "choose": {"compensator": "none"}, "allow": ["/folder"]})");
}

/// "kp=0.5 V/um" of {"kp": "0.5 V/um"}.
std::vector<std::string> assignments(const Json& members, const std::string& path) {
  if (!members.is_object()) fail_overrides(path, "is no object");
  std::vector<std::string> list;
  for (const auto& [name, value] : members.items()) {
    if (!value.is_string() && !value.is_number()) fail_overrides(path + "/" + name, "is neither a text nor a number");
    list.push_back(name + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
  }
  return list;
}

std::vector<std::string> texts(const Json& list, const std::string& path) {
  const auto is_text = [](const Json& item) { return item.is_string(); };
  if (!list.is_array() || !std::all_of(list.begin(), list.end(), is_text)) fail_overrides(path, "is no list of texts");
  return list.get<std::vector<std::string>>();
}

Arguments arguments_of(const char* path, const char* overrides) {
  Arguments arguments;
  arguments.set("diagram", {path});
  if (overrides == nullptr || *overrides == '\0') return arguments;
  const Json json = Json::parse(overrides, nullptr, false);
  if (!json.is_object()) fail_overrides("", "is no JSON object");
  for (const auto& [name, value] : json.items()) {
    if (name == "set" || name == "choose")
      arguments.set("--" + name, assignments(value, "/" + name));
    else if (name == "allow")
      arguments.set("--allow", texts(value, "/allow"));
    else
      fail_overrides("/" + name, "is not known here");
  }
  return arguments;
}

Json name_and_unit(const std::string& name, const Unit& unit) { return {{"name", name}, {"unit", unit_text(unit)}}; }

Json inputs_of(const Program& program) {
  Json list = Json::array();
  for (std::size_t i = 0; i < program.input_names.size(); ++i)
    list.push_back(name_and_unit(program.input_names[i], program.input_units[i]));
  return list;
}

Json outputs_of(const Program& program) {
  Json list = Json::array();
  for (std::size_t i = 0; i < program.output_names.size(); ++i) {
    const int signal = program.output_signals[i];
    list.push_back(name_and_unit(program.output_names[i], program.signals[static_cast<std::size_t>(signal)].unit));
    list.back()["signal"] = signal;
  }
  return list;
}

Json signals_of(const Program& program) {
  Json list = Json::array();
  for (const auto& signal : program.signals) list.push_back(name_and_unit(signal.path, signal.unit));
  return list;
}

Json parameters_of(const Program& program) {
  Json list = Json::array();
  for (const auto& p : program.parameters) {
    const double value = p.difference ? p.unit.difference_from_si(p.value) : p.unit.from_si(p.value);
    list.push_back({{"name", p.path}, {"value", value}, {"unit", unit_text(p.unit)}, {"free", p.free}});
  }
  return list;
}

std::string facts_of(const Program& program, const std::vector<std::string>& warnings) {
  const Json json{{"title", program.title},
                  {"inputs", inputs_of(program)},
                  {"outputs", outputs_of(program)},
                  {"signals", signals_of(program)},
                  {"parameters", parameters_of(program)},
                  {"states", program.state_names},
                  {"warnings", warnings}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace
}  // namespace hysteron::interop

using namespace hysteron;

hy_diagram* hy_load(const char* path, const char* overrides_json, hy_error** error) {
  return interop::guarded<hy_diagram*>(error, nullptr, [&] {
    interop::need(path, "path");
    auto loaded = std::make_unique<hy_diagram>();
    std::vector<std::string> notes;
    Watch watch;
    watch.note = [&](const std::string& what) { notes.push_back(what); };
    loaded->diagram = load_diagram(interop::arguments_of(path, overrides_json), watch);
    loaded->program = compile_file(loaded->diagram);
    loaded->json = interop::facts_of(*loaded->program, notes);
    return loaded.release();
  });
}

const char* hy_diagram_json(const hy_diagram* diagram) { return diagram == nullptr ? "{}" : diagram->json.c_str(); }

int hy_diagram_save(const hy_diagram* diagram, const char* path, hy_error** error) {
  return interop::guarded_code(error, [&] {
    interop::need(diagram, "diagram");
    interop::need(path, "path");
    check_diagram_target("path", path, diagram->diagram);
    write_diagram(path, diagram->diagram);
  });
}
