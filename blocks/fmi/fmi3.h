// The C interface of the Functional Mock-up Interface 3.0.1 for co-simulation, declared from the text of the standard
// (fmi-standard.org, sections 2.2 and 4). Its names and types are the standard's. interop/fmi defines the functions for
// exported diagrams; who imports an FMU finds them in its binary, and takes the types from here.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FMI3_API __attribute__((visibility("default")))

typedef void* fmi3Instance;
typedef void* fmi3InstanceEnvironment;
typedef void* fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef char fmi3Char;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef const fmi3Char* fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte* fmi3Binary;
typedef bool fmi3Clock;

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                                       fmi3String message);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment environment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment environment, fmi3Float64 time, bool may_set,
                                               bool may_get, bool step_finished, bool may_return_early,
                                               bool* return_early, fmi3Float64* early_time);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3UnlockPreemptionCallback)(void);

FMI3_API const char* fmi3GetVersion(void);
FMI3_API fmi3Status fmi3SetDebugLogging(fmi3Instance c, bool on, size_t count, const fmi3String categories[]);
FMI3_API fmi3Instance fmi3InstantiateCoSimulation(fmi3String instance, fmi3String token, fmi3String resources,
                                                  bool visible, bool logging, bool event_mode, bool early_return,
                                                  const fmi3ValueReference intermediate[], size_t intermediate_count,
                                                  fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                                  fmi3IntermediateUpdateCallback intermediate_update);
FMI3_API fmi3Instance fmi3InstantiateModelExchange(fmi3String instance, fmi3String token, fmi3String resources,
                                                   bool visible, bool logging, fmi3InstanceEnvironment environment,
                                                   fmi3LogMessageCallback log);
FMI3_API fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instance, fmi3String token, fmi3String resources,
                                                        bool visible, bool logging, fmi3InstanceEnvironment environment,
                                                        fmi3LogMessageCallback log,
                                                        fmi3ClockUpdateCallback clock_update,
                                                        fmi3LockPreemptionCallback lock,
                                                        fmi3UnlockPreemptionCallback unlock);
FMI3_API void fmi3FreeInstance(fmi3Instance c);
FMI3_API fmi3Status fmi3EnterInitializationMode(fmi3Instance c, bool with_tolerance, fmi3Float64 tolerance,
                                                fmi3Float64 start, bool with_stop, fmi3Float64 stop);
FMI3_API fmi3Status fmi3ExitInitializationMode(fmi3Instance c);
FMI3_API fmi3Status fmi3EnterEventMode(fmi3Instance c);
FMI3_API fmi3Status fmi3EnterStepMode(fmi3Instance c);
FMI3_API fmi3Status fmi3EnterConfigurationMode(fmi3Instance c);
FMI3_API fmi3Status fmi3ExitConfigurationMode(fmi3Instance c);
FMI3_API fmi3Status fmi3Terminate(fmi3Instance c);
FMI3_API fmi3Status fmi3Reset(fmi3Instance c);

FMI3_API fmi3Status fmi3GetFloat32(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Float32 values[],
                                   size_t value_count);
FMI3_API fmi3Status fmi3SetFloat32(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                   const fmi3Float32 values[], size_t value_count);
FMI3_API fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Float64 values[],
                                   size_t value_count);
FMI3_API fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                   const fmi3Float64 values[], size_t value_count);
FMI3_API fmi3Status fmi3GetInt8(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Int8 values[],
                                size_t value_count);
FMI3_API fmi3Status fmi3SetInt8(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Int8 values[],
                                size_t value_count);
FMI3_API fmi3Status fmi3GetUInt8(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3UInt8 values[],
                                 size_t value_count);
FMI3_API fmi3Status fmi3SetUInt8(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3UInt8 values[],
                                 size_t value_count);
FMI3_API fmi3Status fmi3GetInt16(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Int16 values[],
                                 size_t value_count);
FMI3_API fmi3Status fmi3SetInt16(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Int16 values[],
                                 size_t value_count);
FMI3_API fmi3Status fmi3GetUInt16(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3UInt16 values[],
                                  size_t value_count);
FMI3_API fmi3Status fmi3SetUInt16(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                  const fmi3UInt16 values[], size_t value_count);
FMI3_API fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Int32 values[],
                                 size_t value_count);
FMI3_API fmi3Status fmi3SetInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Int32 values[],
                                 size_t value_count);
FMI3_API fmi3Status fmi3GetUInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3UInt32 values[],
                                  size_t value_count);
FMI3_API fmi3Status fmi3SetUInt32(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                  const fmi3UInt32 values[], size_t value_count);
FMI3_API fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Int64 values[],
                                 size_t value_count);
FMI3_API fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Int64 values[],
                                 size_t value_count);
FMI3_API fmi3Status fmi3GetUInt64(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3UInt64 values[],
                                  size_t value_count);
FMI3_API fmi3Status fmi3SetUInt64(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                  const fmi3UInt64 values[], size_t value_count);
FMI3_API fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Boolean values[],
                                   size_t value_count);
FMI3_API fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                   const fmi3Boolean values[], size_t value_count);
FMI3_API fmi3Status fmi3GetString(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3String values[],
                                  size_t value_count);
FMI3_API fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                  const fmi3String values[], size_t value_count);
FMI3_API fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t count, size_t sizes[],
                                  fmi3Binary values[], size_t value_count);
FMI3_API fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const size_t sizes[],
                                  const fmi3Binary values[], size_t value_count);
FMI3_API fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Clock values[]);
FMI3_API fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Clock values[]);

FMI3_API fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference vr, size_t* count);
FMI3_API fmi3Status fmi3GetVariableDependencies(fmi3Instance c, fmi3ValueReference dependent, size_t of_dependent[],
                                                fmi3ValueReference independents[], size_t of_independents[],
                                                fmi3DependencyKind kinds[], size_t count);
FMI3_API fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* state);
FMI3_API fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state);
FMI3_API fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState* state);
FMI3_API fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t* size);
FMI3_API fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size);
FMI3_API fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState* state);
FMI3_API fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const fmi3ValueReference unknowns[],
                                                 size_t unknown_count, const fmi3ValueReference knowns[],
                                                 size_t known_count, const fmi3Float64 seed[], size_t seed_count,
                                                 fmi3Float64 sensitivity[], size_t sensitivity_count);
FMI3_API fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count,
                                             const fmi3ValueReference knowns[], size_t known_count,
                                             const fmi3Float64 seed[], size_t seed_count, fmi3Float64 sensitivity[],
                                             size_t sensitivity_count);
FMI3_API fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                             const fmi3Int32 orders[], fmi3Float64 values[], size_t value_count);
FMI3_API fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                           fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]);
FMI3_API fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                            fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                            fmi3IntervalQualifier qualifiers[]);
FMI3_API fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                        fmi3Float64 shifts[]);
FMI3_API fmi3Status fmi3GetShiftFraction(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                         fmi3UInt64 counters[], fmi3UInt64 resolutions[]);
FMI3_API fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                           const fmi3Float64 intervals[]);
FMI3_API fmi3Status fmi3SetIntervalFraction(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                            const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]);
FMI3_API fmi3Status fmi3SetShiftDecimal(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                        const fmi3Float64 shifts[]);
FMI3_API fmi3Status fmi3SetShiftFraction(fmi3Instance c, const fmi3ValueReference vr[], size_t count,
                                         const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]);
FMI3_API fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c);
FMI3_API fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, bool* again, bool* terminate, bool* nominals_changed,
                                             bool* values_changed, bool* next_event_defined, fmi3Float64* next_event);
FMI3_API fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 from, fmi3Float64 size, bool never_back, bool* event_needed,
                               bool* terminate, bool* early_return, fmi3Float64* last_time);

#ifdef __cplusplus
}
#endif
