// Decides how an instance is driven through the functions of FMI 2. Variables are real numbers all.
#include "blocks/fmi/fmi2.h"

#include <cstring>
#include <new>

#include "interop/fmi/answered.h"
#include "interop/fmi/fmu_instance.h"
#include "interop/fmi/resource_folder.h"
#include "interop/fmi/state_handle.h"

namespace hysteron::interop {
namespace {

struct Component {
  FmuInstance instance;
  std::string name;
  fmi2CallbackFunctions call;

  void tell(const std::string& text) const {
    if (call.logger != nullptr)
      call.logger(call.componentEnvironment, name.c_str(), fmi2Error, "logStatusError", "%s", text.c_str());
  }
};

template <class Action>
fmi2Status with(fmi2Component c, const Action& action) noexcept {
  if (c == nullptr) return fmi2Error;
  auto& component = *static_cast<Component*>(c);
  return answered(
      fmi2OK, fmi2Error, [&](const std::string& text) { component.tell(text); }, [&] { action(component.instance); });
}

/// For functions of types that no variable has, and for what the description says is not there.
fmi2Status only_none(fmi2Component c, size_t count, const char* what) {
  return with(c, [&](FmuInstance&) {
    if (count > 0)
      fail("bad_call", what, "this FMU has none",
           "see its model description for what it offers; all variables are Real");
  });
}

void need(const void* pointer, size_t count, const char* what) {
  if (pointer == nullptr && count > 0)
    fail("bad_call", what, "NULL was given", "give an array of as many numbers as there are value references");
}

}  // namespace
}  // namespace hysteron::interop

using namespace hysteron;
using interop::FmuInstance;
using interop::with;

const char* fmi2GetTypesPlatform(void) { return "default"; }
const char* fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean, size_t, const fmi2String[]) {
  return with(c, [](FmuInstance&) {});  // what is wrong is told in any case, and nothing else is said
}

fmi2Component fmi2Instantiate(fmi2String instance, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* functions, fmi2Boolean, fmi2Boolean) {
  const fmi2CallbackFunctions call = functions != nullptr ? *functions : fmi2CallbackFunctions{};
  const char* name = instance != nullptr ? instance : "";
  interop::Component* made = nullptr;
  const auto tell = [&](const std::string& text) {
    if (call.logger != nullptr)
      call.logger(call.componentEnvironment, name, fmi2Error, "logStatusError", "%s", text.c_str());
  };
  interop::answered(fmi2OK, fmi2Error, tell, [&] {
    if (type != fmi2CoSimulation)
      fail("bad_call", "fmi2Instantiate", "this FMU is for co-simulation", "import it as fmi2CoSimulation");
    const std::string folder = interop::resource_folder(resources != nullptr ? resources : "");
    made = new interop::Component{FmuInstance(folder, guid != nullptr ? guid : ""), name, call};
  });
  return made;
}

void fmi2FreeInstance(fmi2Component c) { delete static_cast<interop::Component*>(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean with_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean with_stop, fmi2Real stop) {
  return with(c, [&](FmuInstance& i) {
    i.set_up(with_tolerance ? std::optional(tolerance) : std::nullopt, start,
             with_stop ? std::optional(stop) : std::nullopt);
  });
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return with(c, [](FmuInstance& i) { i.enter_initialization(); });
}
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return with(c, [](FmuInstance& i) { i.exit_initialization(); });
}
fmi2Status fmi2Terminate(fmi2Component c) {
  return with(c, [](FmuInstance& i) { i.terminate(); });
}
fmi2Status fmi2Reset(fmi2Component c) {
  return with(c, [](FmuInstance& i) { i.reset(); });
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[]) {
  return with(c, [&](FmuInstance& i) {
    interop::need(vr, count, "value references"), interop::need(value, count, "values");
    for (size_t k = 0; k < count; ++k) value[k] = i.get(vr[k]);
  });
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[]) {
  return with(c, [&](FmuInstance& i) {
    interop::need(vr, count, "value references"), interop::need(value, count, "values");
    for (size_t k = 0; k < count; ++k) i.set(vr[k], value[k]);
  });
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference[], size_t count, fmi2Integer[]) {
  return interop::only_none(c, count, "integers");
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference[], size_t count, fmi2Boolean[]) {
  return interop::only_none(c, count, "booleans");
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference[], size_t count, fmi2String[]) {
  return interop::only_none(c, count, "strings");
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2Integer[]) {
  return interop::only_none(c, count, "integers");
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2Boolean[]) {
  return interop::only_none(c, count, "booleans");
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2String[]) {
  return interop::only_none(c, count, "strings");
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return with(c, [&](FmuInstance& i) { interop::save_state(i, state); });
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return with(c, [&](FmuInstance& i) { interop::restore_state(i, state); });
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return with(c, [&](FmuInstance&) { interop::free_state(state); });
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate, size_t*) {
  return interop::only_none(c, 1, "states as bytes");
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate, fmi2Byte[], size_t) {
  return interop::only_none(c, 1, "states as bytes");
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte[], size_t, fmi2FMUstate*) {
  return interop::only_none(c, 1, "states as bytes");
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference[], size_t, const fmi2ValueReference[],
                                        size_t, const fmi2Real[], fmi2Real[]) {
  return interop::only_none(c, 1, "directional derivatives");
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2Integer[],
                                       const fmi2Real[]) {
  return interop::only_none(c, count, "derivatives of inputs");
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t count, const fmi2Integer[],
                                        fmi2Real[]) {
  return interop::only_none(c, count, "derivatives of outputs");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real from, fmi2Real size, fmi2Boolean) {
  return with(c, [&](FmuInstance& i) { i.step(from, size); });
}
fmi2Status fmi2CancelStep(fmi2Component c) {
  return with(c, [](FmuInstance&) {
    fail("bad_call", "fmi2CancelStep", "no step is under way: each ends before its call returns", "do not cancel it");
  });
}

fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind kind, fmi2Status* value) {
  return with(c, [&](FmuInstance&) {
    if (value == nullptr || kind != fmi2DoStepStatus)
      fail("bad_call", "status", "is not known", "ask for fmi2DoStepStatus");
    *value = fmi2OK;
  });
}
fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real* value) {
  return with(c, [&](FmuInstance& i) {
    if (value == nullptr || kind != fmi2LastSuccessfulTime)
      fail("bad_call", "status", "is not known", "ask for fmi2LastSuccessfulTime");
    *value = i.t();
  });
}
fmi2Status fmi2GetIntegerStatus(fmi2Component c, fmi2StatusKind, fmi2Integer*) {
  return interop::only_none(c, 1, "whole numbers of a status");
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind, fmi2Boolean* value) {
  return with(c, [&](FmuInstance&) {
    if (value == nullptr || kind != fmi2Terminated)
      fail("bad_call", "status", "is not known", "ask for fmi2Terminated");
    *value = fmi2False;
  });
}
fmi2Status fmi2GetStringStatus(fmi2Component c, fmi2StatusKind kind, fmi2String* value) {
  return with(c, [&](FmuInstance&) {
    if (value == nullptr || kind != fmi2PendingStatus)
      fail("bad_call", "status", "is not known", "ask for fmi2PendingStatus");
    *value = "";
  });
}
