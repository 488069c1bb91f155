#!/usr/bin/python3
"""What it costs outside of the program: a step of C code and of an FMU against a row of `run`, a call from Python and from C.

    benchmarks/out_of_program.py BUILD      (configured with -DHYSTERON_LIBRARY=ON)

Steps are told in instructions, which do not depend on what else the machine does: those of a long run without those of a
short one, over the steps between, counted by valgrind. Calls are told in milliseconds, the least of sixty.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
STAGE = ROOT / "tests" / "interop" / "stage.json"

# What is undone: ten play operators, creep by twelve relaxations, an offset.
MODEL = {
    "format": 1, "title": "A stack with creep", "inputs": {"u": {"unit": "V"}},
    "blocks": {
        "stack": {"type": "prandtl_ishlinskii", "in": "u",
                  "thresholds": {"value": [0.5 * k for k in range(10)], "unit": "V"},
                  "weights": {"value": [0.8] + [0.03] * 9, "unit": "um/V"}},
        "creep": {"type": "creep", "in": "stack", "amounts": [0.004] * 12,
                  "times": {"value": [0.01 * 2.2**k for k in range(12)], "unit": "s"}},
        "sensor": {"type": "calibration", "gain": 1.02, "offset": "0.3 um", "in": "creep"}},
    "outputs": {"y": "sensor"}}

FMU_DRIVER = r"""
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include "blocks/fmi/fmi2.h"
static void logger(fmi2ComponentEnvironment e, fmi2String i, fmi2Status s, fmi2String c, fmi2String m, ...) {
  (void)e, (void)i, (void)s, (void)c, fprintf(stderr, "%s\n", m);
}
int main(int argc, char** argv) { /* binary token resources reference steps */
  void* so = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  const fmi2ValueReference y = (unsigned)atoi(argv[4]);
  const fmi2CallbackFunctions calls = {logger, calloc, free, NULL, NULL};
  const long steps = atol(argv[5]);
  fmi2Component (*make)(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions*, int, int);
  fmi2Status (*setup)(fmi2Component, int, double, double, int, double), (*enter)(fmi2Component),
      (*leave)(fmi2Component), (*get)(fmi2Component, const fmi2ValueReference*, size_t, double*),
      (*step)(fmi2Component, double, double, int);
  double value = 0;
  if (argc != 6 || so == NULL) return 1;
  *(void**)&make = dlsym(so, "fmi2Instantiate"), *(void**)&setup = dlsym(so, "fmi2SetupExperiment");
  *(void**)&enter = dlsym(so, "fmi2EnterInitializationMode"), *(void**)&leave = dlsym(so, "fmi2ExitInitializationMode");
  *(void**)&get = dlsym(so, "fmi2GetReal"), *(void**)&step = dlsym(so, "fmi2DoStep");
  fmi2Component c = make("one", fmi2CoSimulation, argv[2], argv[3], &calls, 0, 0);
  if (c == NULL || setup(c, 0, 0, 0, 1, 1e-3 * (double)steps) || enter(c) || leave(c)) return 1;
  for (long k = 0; k < steps; ++k)
    if (step(c, 1e-3 * (double)k, 1e-3, 1) || get(c, &y, 1, &value)) return 1;
  printf("%.17g\n", value);
  return 0;
}
"""

C_CALLS = r"""
#include <hysteron.h>
#include <stdio.h>
#include <time.h>
int main(int argc, char** argv) {
  double least = 1e9;
  for (int k = 0; k < 60; ++k) {
    struct timespec a, b;
    const char* words[] = {argv[1]};
    clock_gettime(CLOCK_MONOTONIC, &a);
    hy_result* r = hy_verb("run", 1, words, NULL, NULL, NULL);
    clock_gettime(CLOCK_MONOTONIC, &b);
    if (argc != 2 || r == NULL) return 1;
    hy_free(r);
    const double ms = 1e3 * (double)(b.tv_sec - a.tv_sec) + 1e-6 * (double)(b.tv_nsec - a.tv_nsec);
    if (ms < least) least = ms;
  }
  printf("%.3f\n", least);
  return 0;
}
"""


C_VERB = r"""
#include <stddef.h>
#include <hysteron.h>
int main(int argc, char** argv) {
  hy_result* r = argc < 2 ? NULL : hy_verb(argv[1], argc - 2, (const char* const*)argv + 2, NULL, NULL, NULL);
  hy_free(r);
  return r == NULL;
}
"""


def done(words, folder, **more):
    run = subprocess.run([str(w) for w in words], cwd=folder, capture_output=True, text=True, check=False, **more)
    if run.returncode != 0:
        sys.exit(f"out_of_program.py: {words} ended with {run.returncode}:\n{run.stdout[-600:]}\n{run.stderr[-1200:]}")
    return run


def instructions(words, folder):
    run = done(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *words], folder)
    return int(re.search(r"Collected\s*:\s*(\d+)", run.stderr).group(1))


def per_step(words, folder, short, long):
    """`words(n)` is the command line that takes n steps."""
    return (instructions(words(long), folder) - instructions(words(short), folder)) / (long - short)


def rows_of_run(diagram, step):
    """The same in memory, where nothing is written."""
    return lambda n: ["./verb", "run", diagram, "--until", f"{n * step} s", "--every", f"{step} s"]


def c_code(program, folder):
    (folder / "model.json").write_text(json.dumps(MODEL))
    print(f"C code of the inverse of {MODEL['title'].lower()} (10 play operators, 12 relaxations, an offset)")
    host = {"format": 1, "title": "host", "record": ["inverse.u"],
            "blocks": {"wanted": {"type": "sine", "amplitude": "2 um", "offset": "2.5 um", "frequency": "9 Hz"},
                       "inverse": {"type": "diagram", "file": "float64/comp.json", "in": "wanted"}}}
    (folder / "host.json").write_text(json.dumps(host))
    for number, real in (("float64", "double"), ("float32", "float")):
        done([program, "export", "c", "model.json", "--inverse", "--rate", "10 kHz", "--number", number, "-o", number], folder)
        (folder / number / "size.c").write_text(
            '#include "comp.h"\n#include <stdio.h>\nint main(void) { printf("%zu\\n", sizeof(comp_state)); return 0; }\n')
        done("cc -std=c99 -O2 -o comp_test comp_test.c comp.c -lm".split(), folder / number)
        done("cc -std=c99 -O2 -c comp.c".split(), folder / number)
        done("cc -std=c99 -O2 -o size size.c".split(), folder / number)
        count = per_step(lambda n: ["./comp_test", n], folder / number, 1000, 101000)
        told = done(["./comp_test", 20_000_000 if number == "float64" else 1_000_000], folder / number).stdout
        text = done(["size", "comp.o"], folder / number).stdout.split("\n")[1].split()[0]
        state = done(["./size"], folder / number).stdout.strip()
        print(f"  {real + ', gcc -O2':18} {count:8.0f} instructions a step, {re.search(r'([0-9.]+) ns per step', told).group(1)} ns; "
              f"{text} bytes of code and constants, {state} of state")
    count = per_step(rows_of_run("host.json", 1e-4), folder, 1000, 101000)
    print(f"  {'run of its diagram':18} {count:8.0f} instructions a step and row, driven by a sine")


def fmu(program, folder):
    done([program, "export", "fmu", STAGE, "-o", "stage.fmu"], folder)
    with zipfile.ZipFile(folder / "stage.fmu") as archive:
        archive.extractall(folder / "fmu")
    description = (folder / "fmu" / "modelDescription.xml").read_text()
    token = re.search(r'guid="([^"]*)"', description).group(1)
    outputs = re.search(r"<Outputs>\s*<Unknown index=\"(\d+)\"", description).group(1)
    variable = re.findall(r"<ScalarVariable [^>]*>", description)[int(outputs) - 1]
    reference = re.search(r'valueReference="(\d+)"', variable).group(1)
    binary = next((folder / "fmu" / "binaries").rglob("*.so"))
    (folder / "driver.c").write_text(FMU_DRIVER)
    done(["cc", "-O2", f"-I{ROOT}", "-o", "driver", "driver.c", "-ldl"], folder)
    words = lambda n: ["./driver", binary, token, f"file://{folder}/fmu/resources", reference, n]
    size = (folder / "stage.fmu").stat().st_size
    print(f"FMU of {STAGE.relative_to(ROOT)}, {size / 1e6:.1f} MB, binary {binary.stat().st_size / 1e6:.1f} MB")
    print(f"  a step of 1 ms and its output {per_step(words, folder, 1000, 11000):10.0f} instructions")
    print(f"  a row of run                  {per_step(rows_of_run(STAGE, 1e-3), folder, 1000, 11000):10.0f} instructions")


def calls(build, folder):
    library = build / "interop" / "libhysteron.so"
    of_c = float(done(["./calls", STAGE], folder).stdout)
    os.environ["HYSTERON_LIBRARY"] = str(library)
    sys.path.insert(0, str(ROOT / "interop" / "python"))
    import hysteron

    diagram = hysteron.load(STAGE)
    least = 1e9
    for _ in range(60):
        begin = time.perf_counter()
        diagram.run()["y"]
        least = min(least, time.perf_counter() - begin)
    print(f"run of {STAGE.relative_to(ROOT)}, 1001 rows: from C {of_c:.2f} ms, from Python {1e3 * least:.2f} ms")
    print(f"libhysteron.so {os.stat(library).st_size / 1e6:.1f} MB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    build = parser.parse_args().build.resolve()
    library = build / "interop" / "libhysteron.so"
    if not library.exists():
        sys.exit(f"out_of_program.py: there is no {library}; configure with -DHYSTERON_LIBRARY=ON and build")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("calls", C_CALLS), ("verb", C_VERB)):
            (pathlib.Path(folder) / f"{name}.c").write_text(text)
            done(["cc", "-D_DEFAULT_SOURCE", "-std=c99", "-O2", f"-I{ROOT}/interop/c", "-o", name, f"{name}.c", library,
                  f"-Wl,-rpath,{library.parent}"], folder)
        for measure in (c_code, fmu):
            measure(build / "app" / "hysteron", pathlib.Path(folder))
        calls(build, pathlib.Path(folder))


if __name__ == "__main__":
    main()
