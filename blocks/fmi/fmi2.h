// The C interface of the Functional Mock-up Interface 2.0.4 for co-simulation, declared from the text of the standard
// (fmi-standard.org, sections 2.1 and 4.2). Its names and types are the standard's. interop/fmi defines the functions
// for exported diagrams; who imports an FMU finds them in its binary, and takes the types from here.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FMI2_API __attribute__((visibility("default")))

typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char* fmi2String;
typedef char fmi2Byte;

enum { fmi2False = 0, fmi2True = 1 };
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                                   fmi2String category, fmi2String message, ...);
typedef void* (*fmi2CallbackAllocateMemory)(size_t objects, size_t size);
typedef void (*fmi2CallbackFreeMemory)(void* object);
typedef void (*fmi2StepFinished)(fmi2ComponentEnvironment environment, fmi2Status status);
typedef struct {
  fmi2CallbackLogger logger;
  fmi2CallbackAllocateMemory allocateMemory;
  fmi2CallbackFreeMemory freeMemory;
  fmi2StepFinished stepFinished;
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

FMI2_API const char* fmi2GetTypesPlatform(void);
FMI2_API const char* fmi2GetVersion(void);
FMI2_API fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[]);

FMI2_API fmi2Component fmi2Instantiate(fmi2String instance, fmi2Type type, fmi2String guid, fmi2String resources,
                                       const fmi2CallbackFunctions* functions, fmi2Boolean visible,
                                       fmi2Boolean logging);
FMI2_API void fmi2FreeInstance(fmi2Component c);
FMI2_API fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean with_tolerance, fmi2Real tolerance, fmi2Real start,
                                        fmi2Boolean with_stop, fmi2Real stop);
FMI2_API fmi2Status fmi2EnterInitializationMode(fmi2Component c);
FMI2_API fmi2Status fmi2ExitInitializationMode(fmi2Component c);
FMI2_API fmi2Status fmi2Terminate(fmi2Component c);
FMI2_API fmi2Status fmi2Reset(fmi2Component c);

FMI2_API fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[]);
FMI2_API fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Integer value[]);
FMI2_API fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Boolean value[]);
FMI2_API fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2String value[]);
FMI2_API fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[]);
FMI2_API fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                   const fmi2Integer value[]);
FMI2_API fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                   const fmi2Boolean value[]);
FMI2_API fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                  const fmi2String value[]);

FMI2_API fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state);
FMI2_API fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state);
FMI2_API fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state);
FMI2_API fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t* size);
FMI2_API fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size);
FMI2_API fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate* state);
FMI2_API fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[],
                                                 size_t unknown_count, const fmi2ValueReference knowns[],
                                                 size_t known_count, const fmi2Real known_change[],
                                                 fmi2Real unknown_change[]);

FMI2_API fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                                const fmi2Integer order[], const fmi2Real value[]);
FMI2_API fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t count,
                                                 const fmi2Integer order[], fmi2Real value[]);
FMI2_API fmi2Status fmi2DoStep(fmi2Component c, fmi2Real from, fmi2Real size, fmi2Boolean never_back);
FMI2_API fmi2Status fmi2CancelStep(fmi2Component c);
FMI2_API fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind kind, fmi2Status* value);
FMI2_API fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real* value);
FMI2_API fmi2Status fmi2GetIntegerStatus(fmi2Component c, fmi2StatusKind kind, fmi2Integer* value);
FMI2_API fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind, fmi2Boolean* value);
FMI2_API fmi2Status fmi2GetStringStatus(fmi2Component c, fmi2StatusKind kind, fmi2String* value);

#ifdef __cplusplus
}
#endif
