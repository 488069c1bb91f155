// hysteron.h as a program in C uses it: a verb, its columns, an error, a stepper, the watch, and all of that in several
// threads at once. Argument: the folder of the sources.
#define _DEFAULT_SOURCE
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

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

// Whatever a verb keeps of what it was at, and whatever it waits for.
static void the_watch_ends_every_kind_of_work(void) {
  hy_error* error = NULL;
  char from[1200], job[1200];
  snprintf(from, sizeof from, "%s/diagrams", folder);
  const char* words[] = {"all", "--from", from};
  int asked = 0;
  CHECK(hy_verb("reproduce", 3, words, asked_before_the_end, &asked, &error) == NULL);
  CHECK(asked == 1 && hy_error_code(error) == HY_INTERRUPTED);
  hy_free(error);
  // Somebody else writes into the folder, and does not end.
  char place[] = "/tmp/hysteron_use_XXXXXX", hidden[64], lock[96];
  CHECK(mkdtemp(place) != NULL);
  snprintf(hidden, sizeof hidden, "%s/.hysteron", place), snprintf(lock, sizeof lock, "%s/lock", hidden);
  CHECK(mkdir(hidden, 0777) == 0);
  const int held = open(lock, O_RDWR | O_CREAT, 0666);
  CHECK(held >= 0 && flock(held, LOCK_EX) == 0);
  snprintf(job, sizeof job, "%s/tests/interop/stage.json", folder);
  const char* writes[] = {job, "-o", place};
  asked = 0;
  CHECK(hy_verb("run", 3, writes, asked_before_the_end, &asked, &error) == NULL);
  CHECK(asked == 1 && hy_error_code(error) == HY_INTERRUPTED);
  hy_free(error);
  CHECK(unlink(lock) == 0 && close(held) == 0 && rmdir(hidden) == 0 && rmdir(place) == 0);
}

static int asked_until(void* context, double fraction, const char* what) {
  int* left = context;
  CHECK(what != NULL && fraction < 0);  // how far a stepper is going is not known
  return --*left <= 0;
}

static void the_watch_ends_an_advance(void) {
  hy_error* error = NULL;
  hy_diagram* diagram = hy_load(stage, NULL, NULL);
  CHECK(diagram != NULL);
  const char* at = strstr(hy_diagram_json(diagram), "\"signal\":");
  const int y = at != NULL ? atoi(at + strlen("\"signal\":")) : 0;
  hy_stepper* stepper = hy_stepper_new(diagram, "{\"until\": \"10000000 s\"}", &error);
  CHECK(stepper != NULL);
  hy_free(diagram);
  int left = 2;
  hy_stepper_watch(stepper, asked_until, &left);
  CHECK(hy_stepper_advance(stepper, 1e7, &error) == HY_INTERRUPTED);  // of hours
  CHECK(left == 0 && strstr(hy_error_json(error), "interrupted") != NULL);
  hy_free(error);
  const double t = hy_stepper_time(stepper);
  CHECK(t > 0 && t < 1e7);
  // A copy is watched by nobody, and both go on.
  hy_stepper* copy = hy_stepper_copy(stepper, &error);
  CHECK(copy != NULL);
  left = 1000;
  double one = 0, other = 0;
  CHECK(hy_stepper_advance(stepper, t + 1, &error) == HY_DONE && error == NULL);
  CHECK(hy_stepper_advance(copy, t + 1, &error) == HY_DONE && error == NULL);
  CHECK(hy_stepper_get(stepper, y, &one, NULL) == HY_DONE && hy_stepper_get(copy, y, &other, NULL) == HY_DONE);
  CHECK(fabs(one - other) < 1e-6);  // V; the integrator of a copy begins anew
  hy_stepper_watch(stepper, NULL, NULL);
  CHECK(hy_stepper_advance(stepper, t + 2, NULL) == HY_DONE);
  hy_stepper_watch(NULL, NULL, NULL);
  hy_free(copy);
  hy_free(stepper);
}

static void what_starts_the_program_is_refused(void) {
  hy_error* error = NULL;
  const char* words[] = {"no_such_study.json", "--slurm"};
  CHECK(hy_verb("study", 2, words, NULL, NULL, &error) == NULL && hy_error_code(error) == HY_BAD_INPUT);
  CHECK(strstr(hy_error_json(error), "\"--slurm\"") != NULL && strstr(hy_error_json(error), "as a program") != NULL);
  hy_free(error);
  words[1] = "--slurm-dry-run";
  CHECK(hy_verb("study", 2, words, NULL, NULL, &error) == NULL && strstr(hy_error_json(error), "--slurm") != NULL);
  hy_free(error);
  CHECK(hy_verb("studio", 0, NULL, NULL, NULL, &error) == NULL && strstr(hy_error_json(error), "as a program") != NULL);
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
  the_watch_ends_every_kind_of_work();
  the_watch_ends_an_advance();
  what_starts_the_program_is_refused();
  return 0;
}
