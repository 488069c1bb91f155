// Decides how a stepper is driven by another program: inputs and signals by number, in their units.
#include <nlohmann/json.hpp>

#include "engine/diagram/index.h"
#include "engine/diagram/stop.h"
#include "engine/diagram/units.h"
#include "interop/c/handles.h"

namespace hysteron::interop {
namespace {

using Json = nlohmann::ordered_json;

/// A time of the options [s].
double seconds_of(const Json& value, const std::string& name) {
  const std::string cure = R"(write {"until": "10 s", "begin": "0 s"})";
  double number = 0;
  std::string unit;
  if (value.is_number()) return value.get<double>();
  if (!value.is_string() || !split_quantity(value.get<std::string>(), number, unit))
    fail("bad_call", "options/" + name, "is no time", cure);
  if (unit.empty()) return number;
  const Unit read = parse_unit(unit, "options/" + name);
  if (!(read.dimension == parse_unit("s").dimension)) fail("bad_call", "options/" + name, "is no time", cure);
  return read.to_si(number);
}

SimulateOptions options_of(const Program& program, const char* options) {
  SimulateOptions settings = simulate_options(program);
  if (options == nullptr || *options == '\0') return settings;
  const Json json = Json::parse(options, nullptr, false);
  if (!json.is_object()) fail("bad_call", "options", "is no JSON object", R"(write {"until": "10 s", "begin": "0 s"})");
  for (const auto& [name, value] : json.items()) {
    if (name == "until")
      settings.until = seconds_of(value, name);
    else if (name == "begin")
      settings.begin = seconds_of(value, name);
    else
      fail("bad_call", "options/" + name, "is not known here", did_you_mean(name, {"until", "begin"}));
  }
  return settings;
}

/// What `action` returns, unless the watch of the stepper ends it.
template <class Action>
auto watched(hy_stepper& stepper, const Action& action) {
  if (stepper.asked == nullptr || !stepper.asked->somebody()) return action();
  stepper.asked->begin(-1, "advance");
  const StopScope scope([asked = stepper.asked.get()] { return asked->stop(); });
  return action();
}

}  // namespace
}  // namespace hysteron::interop

using namespace hysteron;

hy_stepper* hy_stepper_new(const hy_diagram* diagram, const char* options_json, hy_error** error) {
  return interop::guarded<hy_stepper*>(error, nullptr, [&] {
    interop::need(diagram, "diagram");
    return new hy_stepper(diagram->program, interop::options_of(*diagram->program, options_json));
  });
}

int hy_stepper_set(hy_stepper* stepper, int input, double value, hy_error** error) {
  return interop::guarded_code(error, [&] {
    interop::need(stepper, "stepper");
    const auto& units = stepper->stepper.program().input_units;
    const bool known = input >= 0 && at(input) < units.size();
    stepper->stepper.set(input, known ? units[at(input)].to_si(value) : value);  // which says that there is none
  });
}

void hy_stepper_watch(hy_stepper* stepper, hy_watch watch, void* context) {
  if (stepper == nullptr) return;
  interop::guarded_code(nullptr, [&] { stepper->asked = std::make_unique<interop::Asked>(watch, context); });
}

int hy_stepper_advance(hy_stepper* stepper, double until, hy_error** error) {
  return interop::guarded_code(error, [&] {
    interop::need(stepper, "stepper");
    interop::watched(*stepper, [&] { stepper->stepper.advance(until); });
  });
}

int hy_stepper_get(hy_stepper* stepper, int signal, double* value, hy_error** error) {
  return interop::guarded_code(error, [&] {
    interop::need(stepper, "stepper");
    interop::need(value, "value");
    const double si = interop::watched(*stepper, [&] { return stepper->stepper.value(signal); });
    *value = stepper->stepper.program().signals[at(signal)].unit.from_si(si);
  });
}

double hy_stepper_time(const hy_stepper* stepper) { return stepper == nullptr ? 0 : stepper->stepper.t(); }

hy_stepper* hy_stepper_copy(const hy_stepper* stepper, hy_error** error) {
  return interop::guarded<hy_stepper*>(error, nullptr, [&] {
    interop::need(stepper, "stepper");
    return new hy_stepper(stepper->stepper);
  });
}
