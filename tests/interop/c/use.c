// hysteron.h as a program in C uses it: a verb, its columns, an error, a stepper, the watch, and all of that in several
// threads at once. Argument: the folder of the sources.
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "interop/c/hysteron.h"

static char folder[1024], stage[1200];

#define CHECK(what)                                                          \
  do {                                                                       \
    if (!(what)) {                                                           \
      fprintf(stderr, "%s:%d: %s is not true\n", __FILE__, __LINE__, #what); \
      exit(1);                                                               \
    }                                                                        \
  } while (0)

static double last_of_run(double gain) {
  char set[64];
  snprintf(set, sizeof set, "gain.gain=%.17g", gain);
  const char* words[] = {stage, "--set", set};
  hy_error* error = NULL;
  hy_result* result = hy_verb("run", 3, words, NULL, NULL, &error);
  if (result == NULL) fprintf(stderr, "%s\n", hy_error_json(error));
  CHECK(result != NULL && error == NULL);
  const double* y = NULL;
  const int64_t rows = hy_result_column(result, "signals.csv", "y", &y);
  CHECK(rows == 1001);
  const double last = y[rows - 1];
  CHECK(hy_result_column(result, "signals.csv", "nothing", &y) == -1 && y == NULL);
  CHECK(strstr(hy_result_json(result), "\"verb\":\"run\"") != NULL);
  CHECK(strstr(hy_result_figure(result, 0), "<svg") != NULL);
  CHECK(hy_result_figure(result, 1000) == NULL);
  hy_free(result);
  return last;
}

static void errors_are_told(void) {
  hy_error* error = NULL;
  const char* words[] = {"no_such_file.json"};
  CHECK(hy_verb("run", 1, words, NULL, NULL, &error) == NULL);
  CHECK(error != NULL && hy_error_code(error) == HY_BAD_INPUT);
  CHECK(strstr(hy_error_json(error), "\"cure\"") != NULL && strstr(hy_error_json(error), "no_such_file.json") != NULL);
  hy_free(error);
  CHECK(hy_verb("fly", 0, NULL, NULL, NULL, &error) == NULL && hy_error_code(error) == HY_BAD_INPUT);
  hy_free(error);
  CHECK(hy_load(NULL, NULL, &error) == NULL && hy_error_code(error) == HY_BAD_INPUT);
  hy_free(error);
  CHECK(hy_load(stage, "{\"sett\": 1}", &error) == NULL && strstr(hy_error_json(error), "overrides/sett") != NULL);
  hy_free(error);
  CHECK(hy_load("no_such_file.json", NULL, NULL) == NULL);  // whoever does not ask is not told
  hy_free(NULL);
}

// dx/dt = (gain u - x) / T, u held: closed form.
static double stepped(double gain) {
  char overrides[128];
  snprintf(overrides, sizeof overrides, "{\"set\": {\"gain.gain\": \"%.17g um/V\"}}", gain);
  hy_error* error = NULL;
  char path[1200];
  snprintf(path, sizeof path, "%s/tests/interop/driven.json", folder);
  hy_diagram* diagram = hy_load(path, overrides, &error);
  if (diagram == NULL) fprintf(stderr, "%s\n", hy_error_json(error));
  CHECK(diagram != NULL);
  CHECK(strstr(hy_diagram_json(diagram), "\"inputs\":[{\"name\":\"u\",\"unit\":\"V\"}]") != NULL);
  const char* at = strstr(hy_diagram_json(diagram), "\"signal\":");
  CHECK(at != NULL);
  const int y = atoi(at + strlen("\"signal\":"));
  hy_stepper* stepper = hy_stepper_new(diagram, "{\"until\": \"1 s\"}", &error);
  CHECK(stepper != NULL);
  hy_free(diagram);  // the stepper keeps what it needs
  double value = 0, expected = 0;
  for (int k = 0; k < 100; ++k) {
    const double u = sin(0.1 * k);
    CHECK(hy_stepper_set(stepper, 0, u, NULL) == HY_DONE);
    CHECK(hy_stepper_advance(stepper, 0.01 * (k + 1), &error) == HY_DONE && error == NULL);
    expected = gain * u + (expected - gain * u) * exp(-0.01 / 0.02);
    CHECK(hy_stepper_get(stepper, y, &value, NULL) == HY_DONE);
    CHECK(fabs(value - expected) < 1e-7);  // um; the diagram asks for 1e-9
  }
  CHECK(fabs(hy_stepper_time(stepper) - 1) < 1e-12);
  hy_stepper* copy = hy_stepper_copy(stepper, &error);
  CHECK(copy != NULL && hy_stepper_time(copy) == hy_stepper_time(stepper));
  CHECK(hy_stepper_advance(copy, 0.5, &error) == HY_BAD_INPUT && strstr(hy_error_json(error), "cure") != NULL);
  hy_free(error);
  CHECK(hy_stepper_set(copy, 7, 0, &error) == HY_BAD_INPUT);
  hy_free(error);
  CHECK(hy_stepper_get(copy, 1000, &value, NULL) == HY_BAD_INPUT);
  hy_free(copy);
  hy_free(stepper);
  return value;
}

static int asked_before_the_end(void* context, double fraction, const char* what) {
  ++*(int*)context;
  CHECK(what != NULL && fraction <= 1);
  return 1;
}

static void the_watch_ends_work(void) {
  // Ten thousand seconds of it take much longer than the 50 ms after which the watch is asked.
  const char* words[] = {stage, "--until", "10000 s", "--every", "1 ms"};
  int asked = 0;
  hy_error* error = NULL;
  CHECK(hy_verb("run", 5, words, asked_before_the_end, &asked, &error) == NULL);
  CHECK(asked == 1 && hy_error_code(error) == HY_INTERRUPTED);
  CHECK(strstr(hy_error_json(error), "interrupted") != NULL);
  hy_free(error);
}

static void* in_a_thread(void* argument) {
  const double gain = *(const double*)argument;
  double* both = malloc(2 * sizeof *both);
  both[0] = last_of_run(gain);
  both[1] = stepped(gain);
  errors_are_told();
  return both;
}

int main(int argc, char** argv) {
  CHECK(argc == 2 && strlen(argv[1]) < sizeof folder);
  strcpy(folder, argv[1]);
  snprintf(stage, sizeof stage, "%s/tests/interop/stage.json", folder);
  CHECK(strlen(hy_version()) > 0);

  errors_are_told();
  double alone[4][2], gains[4] = {1, 2, 3, 4};
  for (int i = 0; i < 4; ++i) {
    alone[i][0] = last_of_run(gains[i]);
    alone[i][1] = stepped(gains[i]);
  }
  pthread_t threads[4];
  for (int i = 0; i < 4; ++i) CHECK(pthread_create(&threads[i], NULL, in_a_thread, &gains[i]) == 0);
  for (int i = 0; i < 4; ++i) {
    void* both = NULL;
    CHECK(pthread_join(threads[i], &both) == 0);
    CHECK(memcmp(both, alone[i], sizeof alone[i]) == 0);  // the same bits
    free(both);
  }
  the_watch_ends_work();
  return 0;
}
