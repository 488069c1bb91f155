// Walks an exported FMU through the phases of FMI 2, as a simulator in C does: two instances, reset, states, calls in
// the wrong order, and instances in several threads at once. The FMU is tests/interop/driven.json: y' = (1 um/V u - y)
// / 20 ms. Arguments: the binary, the URI of its resources, its token, and the value references of u, y and gain.gain.
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "blocks/fmi/fmi2.h"

#define CHECK(what)                                                          \
  do {                                                                       \
    if (!(what)) {                                                           \
      fprintf(stderr, "%s:%d: %s is not true\n", __FILE__, __LINE__, #what); \
      exit(1);                                                               \
    }                                                                        \
  } while (0)

static char said[4096];

static void hear(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                 fmi2String message, ...) {
  (void)environment, (void)instance, (void)status, (void)category;
  va_list rest;
  va_start(rest, message);
  vsnprintf(said, sizeof said, message, rest);
  va_end(rest);
}

static void* library;

/* ISO C knows no pointer that is data and function at once. */
static void find(const char* name, void* function) {
  void* symbol = dlsym(library, name);
  if (symbol == NULL) fprintf(stderr, "%s is missing\n", name), exit(1);
  memcpy(function, &symbol, sizeof symbol);
}

static fmi2Component (*instantiate)(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions*,
                                    fmi2Boolean, fmi2Boolean);
static void (*free_instance)(fmi2Component);
static fmi2Status (*set_up)(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
static fmi2Status (*enter)(fmi2Component), (*leave)(fmi2Component), (*terminate)(fmi2Component),
    (*reset)(fmi2Component);
static fmi2Status (*get)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]);
static fmi2Status (*set)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]);
static fmi2Status (*step)(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
static fmi2Status (*save)(fmi2Component, fmi2FMUstate*), (*free_state)(fmi2Component, fmi2FMUstate*);
static fmi2Status (*restore)(fmi2Component, fmi2FMUstate);
static fmi2Status (*get_string)(fmi2Component, const fmi2ValueReference[], size_t, fmi2String[]);
static const char* (*version)(void);

static void load(const char* file) {
  library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) fprintf(stderr, "%s\n", dlerror()), exit(1);
  find("fmi2Instantiate", &instantiate), find("fmi2FreeInstance", &free_instance);
  find("fmi2SetupExperiment", &set_up), find("fmi2EnterInitializationMode", &enter);
  find("fmi2ExitInitializationMode", &leave), find("fmi2Terminate", &terminate), find("fmi2Reset", &reset);
  find("fmi2GetReal", &get), find("fmi2SetReal", &set), find("fmi2DoStep", &step);
  find("fmi2GetFMUstate", &save), find("fmi2SetFMUstate", &restore), find("fmi2FreeFMUstate", &free_state);
  find("fmi2GetString", &get_string), find("fmi2GetVersion", &version);
}

static fmi2ValueReference u, y, gain;

static double value(fmi2Component c, fmi2ValueReference vr) {
  double v = NAN;
  CHECK(get(c, &vr, 1, &v) == fmi2OK);
  return v;
}
static void give(fmi2Component c, fmi2ValueReference vr, double v) { CHECK(set(c, &vr, 1, &v) == fmi2OK); }

static void begin(fmi2Component c, double input) {
  CHECK(set_up(c, fmi2False, 0, 0, fmi2True, 1) == fmi2OK);
  CHECK(enter(c) == fmi2OK);
  give(c, u, input);
  CHECK(value(c, y) == 0);
  CHECK(leave(c) == fmi2OK);
}

/* The step response of a lag; the diagram asks for 1e-9, of which a hundred steps are a hundredfold. */
static int is_response(double found, double input, double t) {
  return fabs(found - input * (1 - exp(-t / 0.02))) < 1e-7 * fabs(input);
}

static void steps(fmi2Component c, double from, double size, int count) {
  for (int k = 0; k < count; ++k) CHECK(step(c, from + k * size, size, fmi2True) == fmi2OK);
}

static void walk_two(fmi2Component a, fmi2Component b) {
  begin(a, 1), begin(b, -3);
  steps(a, 0, 1e-3, 10), steps(b, 0, 2e-3, 5), steps(a, 10e-3, 1e-3, 10);
  CHECK(is_response(value(a, y), 1, 20e-3) && is_response(value(b, y), -3, 10e-3));
  CHECK(value(a, u) == 1 && value(b, u) == -3);
}

static void walk_states(fmi2Component c) {
  fmi2FMUstate state = NULL;
  CHECK(save(c, &state) == fmi2OK && state != NULL);
  const double before = value(c, y);
  give(c, u, 5);
  CHECK(step(c, 20e-3, 5e-3, fmi2False) == fmi2OK);
  const double there = value(c, y);
  CHECK(there != before);
  CHECK(restore(c, state) == fmi2OK && value(c, y) == before && value(c, u) == 1);
  give(c, u, 5);
  CHECK(step(c, 20e-3, 5e-3, fmi2False) == fmi2OK);
  CHECK(fabs(value(c, y) - there) < 1e-7); /* the solver begins anew at a state that was set */
  const double first = value(c, y);
  CHECK(restore(c, state) == fmi2OK);
  give(c, u, 5);
  CHECK(step(c, 20e-3, 5e-3, fmi2False) == fmi2OK && value(c, y) == first); /* each time to the same bits */
  CHECK(free_state(c, &state) == fmi2OK && state == NULL);
}

/* Refused, and it says why. */
#define REFUSED(call, word)                                        \
  do {                                                             \
    said[0] = '\0';                                                \
    CHECK((call) == fmi2Error);                                    \
    if (strstr(said, word) == NULL) {                              \
      fprintf(stderr, "\"%s\" does not say \"%s\"\n", said, word); \
      exit(1);                                                     \
    }                                                              \
  } while (0)

static void walk_in_disorder(fmi2Component c) {
  const fmi2ValueReference nowhere = 1000000;
  double number = 1;
  fmi2String text;
  CHECK(reset(c) == fmi2OK);
  REFUSED(step(c, 0, 1e-3, fmi2True), "before its initialization");
  REFUSED(leave(c), "before its initialization");
  REFUSED(get(c, &y, 1, &number), "before its initialization");
  REFUSED(set_up(c, fmi2False, 0, 2, fmi2True, 1), "does not lie behind the start");
  begin(c, 1);
  REFUSED(enter(c), "between its steps");
  REFUSED(step(c, 0.5, 1e-3, fmi2True), "begin each step where the last one ended");
  REFUSED(step(c, 0, -1e-3, fmi2True), "no size of a step");
  REFUSED(step(c, 0, 2, fmi2True), "stop time");
  REFUSED(get(c, &nowhere, 1, &number), "no such variable");
  REFUSED(set(c, &y, 1, &number), "is computed");
  REFUSED(set(c, &gain, 1, &number), "between its steps");
  REFUSED(get_string(c, &y, 1, &text), "all variables are Real");
  number = NAN;
  REFUSED(set(c, &u, 1, &number), "no value");
  steps(c, 0, 1e-3, 20); /* none of that has moved it */
  CHECK(is_response(value(c, y), 1, 20e-3));
  CHECK(terminate(c) == fmi2OK);
  REFUSED(step(c, 20e-3, 1e-3, fmi2True), "terminated");
  CHECK(step(NULL, 0, 1, fmi2True) == fmi2Error);
}

/* What nobody listens to is not told: `said` is one for all. */
static void hear_nothing(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                         fmi2String category, fmi2String message, ...) {
  (void)environment, (void)instance, (void)status, (void)category, (void)message;
}
static const char *token, *resources;

/* Made, stepped, saved, set back, reset and freed, while others are. */
static void* alone(void* argument) {
  const double input = *(const double*)argument;
  const fmi2CallbackFunctions call = {hear_nothing, calloc, free, NULL, NULL};
  double* reached = malloc(2 * sizeof *reached);
  CHECK(reached != NULL);
  for (int round = 0; round < 3; ++round) {
    fmi2Component c = instantiate("alone", fmi2CoSimulation, token, resources, &call, fmi2False, fmi2False);
    CHECK(c != NULL);
    begin(c, input);
    steps(c, 0, 1e-3, 20);
    fmi2FMUstate state = NULL;
    CHECK(save(c, &state) == fmi2OK);
    reached[0] = value(c, y);
    steps(c, 20e-3, 1e-3, 20);
    CHECK(restore(c, state) == fmi2OK && value(c, y) == reached[0]);
    steps(c, 20e-3, 1e-3, 20);
    reached[1] = value(c, y);
    CHECK(is_response(reached[0], input, 20e-3) && is_response(reached[1], input, 40e-3));
    const double wrong = NAN;
    CHECK(set(c, &u, 1, &wrong) == fmi2Error);
    CHECK(free_state(c, &state) == fmi2OK && reset(c) == fmi2OK);
    free_instance(c);
  }
  return reached;
}

static void walk_in_threads(void) {
  enum { many = 4 };
  const double inputs[many] = {1, -3, 0.5, 7};
  double* once[many];
  for (int i = 0; i < many; ++i) once[i] = alone((void*)&inputs[i]);
  pthread_t threads[many];
  for (int i = 0; i < many; ++i) CHECK(pthread_create(&threads[i], NULL, alone, (void*)&inputs[i]) == 0);
  for (int i = 0; i < many; ++i) {
    void* reached = NULL;
    CHECK(pthread_join(threads[i], &reached) == 0);
    CHECK(memcmp(reached, once[i], 2 * sizeof *once[i]) == 0); /* the same bits */
    free(reached), free(once[i]);
  }
}

int main(int argc, char** argv) {
  CHECK(argc == 7);
  load(argv[1]);
  u = (fmi2ValueReference)atoi(argv[4]), y = (fmi2ValueReference)atoi(argv[5]),
  gain = (fmi2ValueReference)atoi(argv[6]);
  const fmi2CallbackFunctions call = {hear, calloc, free, NULL, NULL};
  CHECK(strcmp(version(), "2.0") == 0);
  CHECK(instantiate("other", fmi2CoSimulation, "{no token}", argv[2], &call, fmi2False, fmi2False) == NULL);
  CHECK(strstr(said, "token of another FMU") != NULL);
  CHECK(instantiate("lost", fmi2CoSimulation, argv[3], "file:///nowhere", &call, fmi2False, fmi2False) == NULL);
  CHECK(strstr(said, "cannot be read") != NULL);
  CHECK(instantiate("me", fmi2ModelExchange, argv[3], argv[2], &call, fmi2False, fmi2False) == NULL);
  fmi2Component a = instantiate("a", fmi2CoSimulation, argv[3], argv[2], &call, fmi2False, fmi2False);
  fmi2Component b = instantiate("b", fmi2CoSimulation, argv[3], argv[2], &call, fmi2False, fmi2False);
  CHECK(a != NULL && b != NULL);
  walk_two(a, b);
  walk_states(a);
  walk_in_disorder(a);
  steps(b, 10e-3, 5e-3, 2);
  CHECK(is_response(value(b, y), -3, 20e-3)); /* the other one has not noticed */
  CHECK(reset(a) == fmi2OK);
  CHECK(value(a, gain) == 1);
  give(a, gain, 2); /* a parameter is set before the start, and reset makes it what it was */
  begin(a, 1);
  steps(a, 0, 1e-3, 20);
  CHECK(is_response(value(a, y), 2, 20e-3));
  CHECK(reset(a) == fmi2OK && value(a, gain) == 1);
  free_instance(a), free_instance(b), free_instance(NULL);
  token = argv[3], resources = argv[2];
  walk_in_threads();
  CHECK(dlclose(library) == 0);
  return 0;
}
