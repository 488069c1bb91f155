// Decides how an instance is driven through the functions of FMI 3. Variables are of the type Float64 all.
#include "blocks/fmi/fmi3.h"

#include "interop/fmi/answered.h"
#include "interop/fmi/fmu_instance.h"
#include "interop/fmi/resource_folder.h"
#include "interop/fmi/state_handle.h"

namespace hysteron::interop {
namespace {

struct Driven {
  FmuInstance instance;
  fmi3InstanceEnvironment environment;
  fmi3LogMessageCallback log;

  void tell(const std::string& text) const {
    if (log != nullptr) log(environment, fmi3Error, "logStatusError", text.c_str());
  }
};

template <class Action>
fmi3Status with(fmi3Instance c, const Action& action) noexcept {
  if (c == nullptr) return fmi3Error;
  auto& driven = *static_cast<Driven*>(c);
  return answered(
      fmi3OK, fmi3Error, [&](const std::string& text) { driven.tell(text); }, [&] { action(driven.instance); });
}

fmi3Status only_none(fmi3Instance c, size_t count, const char* what) {
  return with(c, [&](FmuInstance&) {
    if (count > 0)
      fail("bad_call", what, "this FMU has none",
           "see its model description for what it offers; all variables are Float64");
  });
}

void need(const void* pointer, const char* what) {
  if (pointer == nullptr) fail("bad_call", what, "NULL was given", "give what the standard asks for");
}

/// Scalars all: as many values as references.
void need_values(const fmi3ValueReference vr[], size_t count, const void* values, size_t value_count) {
  if (count > 0) need(vr, "value references"), need(values, "values");
  if (value_count != count)
    fail("bad_call", "values", std::to_string(value_count) + " values for " + std::to_string(count) + " references",
         "give one per reference: all variables are scalars");
}

fmi3Instance refused(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  if (log != nullptr) log(environment, fmi3Error, "logStatusError", "this FMU is for co-simulation alone");
  return nullptr;
}

}  // namespace
}  // namespace hysteron::interop

using namespace hysteron;
using interop::FmuInstance;
using interop::only_none;
using interop::with;

const char* fmi3GetVersion(void) { return "3.0"; }

fmi3Status fmi3SetDebugLogging(fmi3Instance c, bool, size_t, const fmi3String[]) {
  return with(c, [](FmuInstance&) {});  // what is wrong is told in any case, and nothing else is said
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String token, fmi3String resources, bool, bool, bool, bool,
                                         const fmi3ValueReference[], size_t, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback) {
  interop::Driven* made = nullptr;
  const auto tell = [&](const std::string& text) {
    if (log != nullptr) log(environment, fmi3Error, "logStatusError", text.c_str());
  };
  interop::answered(fmi3OK, fmi3Error, tell, [&] {
    const std::string folder = interop::resource_folder(resources != nullptr ? resources : "");
    made = new interop::Driven{FmuInstance(folder, token != nullptr ? token : ""), environment, log};
  });
  return made;
}
fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, bool, bool,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  return interop::refused(environment, log);
}
fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, bool, bool,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  return interop::refused(environment, log);
}
void fmi3FreeInstance(fmi3Instance c) { delete static_cast<interop::Driven*>(c); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, bool with_tolerance, fmi3Float64 tolerance, fmi3Float64 start,
                                       bool with_stop, fmi3Float64 stop) {
  return with(c, [&](FmuInstance& i) {
    i.set_up(with_tolerance ? std::optional(tolerance) : std::nullopt, start,
             with_stop ? std::optional(stop) : std::nullopt);
    i.enter_initialization();
  });
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
  return with(c, [](FmuInstance& i) { i.exit_initialization(); });
}
fmi3Status fmi3Terminate(fmi3Instance c) {
  return with(c, [](FmuInstance& i) { i.terminate(); });
}
fmi3Status fmi3Reset(fmi3Instance c) {
  return with(c, [](FmuInstance& i) { i.reset(); });
}

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Float64 values[],
                          size_t value_count) {
  return with(c, [&](FmuInstance& i) {
    interop::need_values(vr, count, values, value_count);
    for (size_t k = 0; k < count; ++k) values[k] = i.get(vr[k]);
  });
}
fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Float64 values[],
                          size_t value_count) {
  return with(c, [&](FmuInstance& i) {
    interop::need_values(vr, count, values, value_count);
    for (size_t k = 0; k < count; ++k) i.set(vr[k], values[k]);
  });
}

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* state) {
  return with(c, [&](FmuInstance& i) { interop::save_state(i, state); });
}
fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  return with(c, [&](FmuInstance& i) { interop::restore_state(i, state); });
}
fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState* state) {
  return with(c, [&](FmuInstance&) { interop::free_state(state); });
}
fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 from, fmi3Float64 size, bool, bool* event_needed, bool* terminate,
                      bool* early_return, fmi3Float64* last_time) {
  return with(c, [&](FmuInstance& i) {
    for (bool* flag : {event_needed, terminate, early_return})
      if (flag != nullptr) *flag = false;
    if (last_time != nullptr) *last_time = i.t();
    i.step(from, size);
    if (last_time != nullptr) *last_time = i.t();
  });
}

// What no diagram has: variables of other types, clocks, modes of events and configuration, derivatives.
fmi3Status fmi3EnterEventMode(fmi3Instance c) { return only_none(c, 1, "mode of events"); }
fmi3Status fmi3EnterStepMode(fmi3Instance c) { return only_none(c, 1, "mode of events"); }
fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) { return only_none(c, 1, "mode of configuration"); }
fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) { return only_none(c, 1, "mode of configuration"); }
fmi3Status fmi3GetFloat32(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Float32[], size_t) {
  return only_none(c, count, "variables of type Float32");
}
fmi3Status fmi3SetFloat32(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Float32[], size_t) {
  return only_none(c, count, "variables of type Float32");
}
fmi3Status fmi3GetInt8(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Int8[], size_t) {
  return only_none(c, count, "variables of type Int8");
}
fmi3Status fmi3SetInt8(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Int8[], size_t) {
  return only_none(c, count, "variables of type Int8");
}
fmi3Status fmi3GetUInt8(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt8[], size_t) {
  return only_none(c, count, "variables of type UInt8");
}
fmi3Status fmi3SetUInt8(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt8[], size_t) {
  return only_none(c, count, "variables of type UInt8");
}
fmi3Status fmi3GetInt16(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Int16[], size_t) {
  return only_none(c, count, "variables of type Int16");
}
fmi3Status fmi3SetInt16(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Int16[], size_t) {
  return only_none(c, count, "variables of type Int16");
}
fmi3Status fmi3GetUInt16(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt16[], size_t) {
  return only_none(c, count, "variables of type UInt16");
}
fmi3Status fmi3SetUInt16(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt16[], size_t) {
  return only_none(c, count, "variables of type UInt16");
}
fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Int32[], size_t) {
  return only_none(c, count, "variables of type Int32");
}
fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Int32[], size_t) {
  return only_none(c, count, "variables of type Int32");
}
fmi3Status fmi3GetUInt32(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt32[], size_t) {
  return only_none(c, count, "variables of type UInt32");
}
fmi3Status fmi3SetUInt32(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt32[], size_t) {
  return only_none(c, count, "variables of type UInt32");
}
fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Int64[], size_t) {
  return only_none(c, count, "variables of type Int64");
}
fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Int64[], size_t) {
  return only_none(c, count, "variables of type Int64");
}
fmi3Status fmi3GetUInt64(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt64[], size_t) {
  return only_none(c, count, "variables of type UInt64");
}
fmi3Status fmi3SetUInt64(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt64[], size_t) {
  return only_none(c, count, "variables of type UInt64");
}
fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Boolean[], size_t) {
  return only_none(c, count, "variables of type Boolean");
}
fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Boolean[], size_t) {
  return only_none(c, count, "variables of type Boolean");
}
fmi3Status fmi3GetString(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3String[], size_t) {
  return only_none(c, count, "variables of type String");
}
fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3String[], size_t) {
  return only_none(c, count, "variables of type String");
}
fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference[], size_t count, size_t[], fmi3Binary[], size_t) {
  return only_none(c, count, "variables of type Binary");
}
fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference[], size_t count, const size_t[], const fmi3Binary[],
                         size_t) {
  return only_none(c, count, "variables of type Binary");
}
fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Clock[]) {
  return only_none(c, count, "variables of type Clock");
}
fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Clock[]) {
  return only_none(c, count, "variables of type Clock");
}
fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference, size_t*) {
  return only_none(c, 1, "dependencies of elements");
}
fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference, size_t[], fmi3ValueReference[], size_t[],
                                       fmi3DependencyKind[], size_t) {
  return only_none(c, 1, "dependencies of elements");
}
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState, size_t*) {
  return only_none(c, 1, "states as bytes");
}
fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState, fmi3Byte[], size_t) {
  return only_none(c, 1, "states as bytes");
}
fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte[], size_t, fmi3FMUState*) {
  return only_none(c, 1, "states as bytes");
}
fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3ValueReference[],
                                        size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t) {
  return only_none(c, 1, "directional derivatives");
}
fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const fmi3ValueReference[], size_t, const fmi3ValueReference[],
                                    size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t) {
  return only_none(c, 1, "adjoint derivatives");
}
fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Int32[],
                                    fmi3Float64[], size_t) {
  return only_none(c, count, "derivatives of outputs");
}
fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Float64[],
                                  fmi3IntervalQualifier[]) {
  return only_none(c, count, "clocks");
}
fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt64[], fmi3UInt64[],
                                   fmi3IntervalQualifier[]) {
  return only_none(c, count, "clocks");
}
fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3Float64[]) {
  return only_none(c, count, "clocks");
}
fmi3Status fmi3GetShiftFraction(fmi3Instance c, const fmi3ValueReference[], size_t count, fmi3UInt64[], fmi3UInt64[]) {
  return only_none(c, count, "clocks");
}
fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Float64[]) {
  return only_none(c, count, "clocks");
}
fmi3Status fmi3SetIntervalFraction(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt64[],
                                   const fmi3UInt64[]) {
  return only_none(c, count, "clocks");
}
fmi3Status fmi3SetShiftDecimal(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3Float64[]) {
  return only_none(c, count, "clocks");
}
fmi3Status fmi3SetShiftFraction(fmi3Instance c, const fmi3ValueReference[], size_t count, const fmi3UInt64[],
                                const fmi3UInt64[]) {
  return only_none(c, count, "clocks");
}
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) { return only_none(c, 1, "mode of events"); }
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, bool*, bool*, bool*, bool*, bool*, fmi3Float64*) {
  return only_none(c, 1, "mode of events");
}
