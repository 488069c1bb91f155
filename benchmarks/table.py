#!/usr/bin/python3
"""What hysteron costs, as one table: ratios to programs written by hand, diagrams of many blocks, recordings of many rows.

    benchmarks/table.py BUILD [--repetitions 5] [--blocks 1000 10000 31000] [--rows 1000000] [--only ratios sizes rows]

BUILD is a build folder with -DHYSTERON_BENCHMARKS=ON. Prints Markdown with the processor, the compiler and the load
before and after, for a ratio without its processor is no figure. Times are CPU times of whole processes but for the
ratios, which are medians of repetitions that are interleaved at random in one run.
"""

import argparse
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

# Group and name of hysteron's entry beside "by hand"; what it is to reach.
RATIOS = [
    ("closed loop", "hysteron", "closed loop, CVODE, 2 s", 0.65),
    ("closed loop, rk4 of 10 us", "hysteron", "the same, Runge-Kutta of order 4", 1.5),
    ("open loop, 10 operators", "hysteron advance", "10 plays, rows in memory", 1.1),
    ("open loop, 10 operators", "hysteron simulate", "10 plays through `simulate`", 1.5),
    ("open loop, 80 operators", "hysteron advance", "80 plays, rows in memory", 1.1),
    ("open loop, 80 operators", "hysteron simulate", "80 plays through `simulate`", 1.5),
    ("chain of   10 lags", "hysteron", "chain of 10 lags", 0.5),
    ("chain of  100 lags", "hysteron", "chain of 100 lags", 0.4),
    ("chain of 1000 lags", "hysteron", "chain of 1000 lags", 0.35),
    ("plant and creep, 20000 rows", "hysteron advance", "plant and creep, 20 000 recorded rows", 1.1),
    ("sampled loop, 10 kHz", "hysteron", "sampled loop, 10 kHz, 10 s", 2),
]


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown processor"


def load():
    return " ".join(f"{x:.1f}" for x in os.getloadavg())


def timed(words, folder):
    """CPU seconds and peak memory in MB of a process that must succeed."""
    with open(folder / "printed.txt", "w") as printed:
        process = subprocess.Popen(words, stdout=printed, stderr=subprocess.STDOUT, cwd=folder)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"table.py: {' '.join(words)} ended with {process.returncode}:\n" + (folder / "printed.txt").read_text()[-1500:])
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def apart(make):
    """Calls make() in a process of its own: what a process has held stands in the peak of those that it starts."""
    if (child := os.fork()) == 0:
        try:
            make()
        except BaseException as error:  # nothing of the parent's goes on in the child
            print(error, file=sys.stderr)
            os._exit(1)
        os._exit(0)
    if os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) != 0:
        sys.exit("table.py: the files to be measured could not be written")


def ratios(build, repetitions, folder):
    out = folder / "ratios.json"
    groups = sorted({group for group, *_ in RATIOS})
    subprocess.run([build / "benchmarks" / "hysteron_benchmarks", f"--benchmark_filter=^({'|'.join(groups)})/",
                    f"--benchmark_repetitions={repetitions}", "--benchmark_enable_random_interleaving=true",
                    f"--benchmark_out={out}"], check=True, stdout=subprocess.DEVNULL)
    times = {}
    for run in json.loads(out.read_text())["benchmarks"]:
        if run["run_type"] == "iteration":
            times.setdefault(run["name"].split("/repeats")[0], []).append(run["cpu_time"])
    print("| work | by hand, ms | hysteron | from | to | reach |\n|---|---|---|---|---|---|")
    for group, name, what, reach in RATIOS:
        own = next((t for n, t in times.items() if n == f"{group}/{name}"), None)
        hand = next((t for n, t in times.items() if n == f"{group}/by hand"), None)
        if own is None or hand is None:
            print(f"| {what} | not in this build | | | | {reach} |")
            continue
        base = statistics.median(hand)
        print(f"| {what} | {base / 1e6:.3g} | **{statistics.median(own) / base:.2f}** | {min(own) / base:.2f} | "
              f"{max(own) / base:.2f} | {reach} |", flush=True)


def gains(n):
    blocks = {"u": {"type": "sine", "amplitude": 1, "frequency": "3 Hz"}}
    for k in range(n - 1):
        blocks[f"b{k}"] = {"type": "gain", "gain": 1.0001, "in": f"b{k - 1}" if k else "u"}
    return blocks, f"b{n - 2}"


def lags(n):
    """A sum, a lag and a gain for each state, each coupled to both neighbours."""
    blocks, states = {"u": {"type": "sine", "amplitude": 1, "frequency": "3 Hz"}}, n // 3
    for k in range(states):
        blocks[f"s{k}"] = {"type": "sum", "in": [f"g{k - 1}" if k else "u", f"x{(k + 1) % states}"]}
        blocks[f"x{k}"] = {"type": "lag", "times": "2 ms", "in": f"s{k}"}
        blocks[f"g{k}"] = {"type": "gain", "gain": 0.3, "in": f"x{k}"}
    return blocks, f"g{states - 1}"


def sizes(program, counts, folder):
    print("| diagram | blocks | check, us a block | KiB a block | run 1 ms, us a block | KiB a block | explain, us a block |\n"
          "|---|---|---|---|---|---|---|")
    for name, make in (("gains in a chain", gains), ("coupled lags", lags)):
        apart(lambda: (folder / "small.json").write_text(json.dumps(described(*make(6)))))
        empty = {verb: timed([program, verb, "small.json", *more], folder) for verb, more in VERBS.items()}
        for n in counts:
            apart(lambda: (folder / "many.json").write_text(json.dumps(described(*make(n)))))
            cells = []
            for verb, more in VERBS.items():
                seconds, memory = timed([program, verb, "many.json", *more], folder)
                cells.append(f"{(seconds - empty[verb][0]) / n * 1e6:.1f}")
                if verb != "explain":
                    cells.append(f"{(memory - empty[verb][1]) / n * 1024:.1f}")
            print(f"| {name} | {n} | " + " | ".join(cells) + " |", flush=True)


VERBS = {"check": [], "run": ["-o", "found"], "explain": []}


def described(blocks, output):
    return {"format": 1, "title": "many blocks", "blocks": blocks, "outputs": {"y": output},
            "simulate": {"until": "1 ms", "every": "1 ms"}}


def recording(file, rows, tones):
    """Five sines, held between rows of 1 ms, and what a lag of 20 ms makes of them."""
    keep, y = math.exp(-0.05), 0.0
    with open(file, "w") as out:
        out.write("t [s],u [V],y [V]\n")
        for k in range(rows):
            u = sum(math.sin(2 * math.pi * f * k * 1e-3 + i) for i, f in enumerate(tones))
            out.write(f"{k / 1000:.3f},{u:.7g},{y:.7g}\n")
            y = keep * y + (1 - keep) * u


def rows(program, n, folder):
    tones = [0.7, 1.3, 2.9, 5.3, 11.1]
    for role, stretch in (("train", 1.0), ("validate", 1.1)):
        recording(folder / f"{role}.csv", n, [f * stretch for f in tones])
    lag = {"lag": {"type": "lag", "times": "21 ms", "in": "u"}}
    (folder / "lag.json").write_text(json.dumps(
        {"format": 1, "title": "a lag", "inputs": {"u": {"unit": "V"}}, "blocks": lag, "outputs": {"y": "lag"}}))
    (folder / "data.json").write_text(json.dumps(
        {"format": 1, "title": "two", "columns": {"u": {"to": "u", "between_samples": "hold"}, "y": {"to": "y"}},
         "recordings": [{"file": f"{role}.csv", "role": role} for role in ("train", "validate")]}))
    blocks = {"u": {"type": "sine", "amplitude": "1 V", "frequency": "3 Hz"}, **lag,
              "twice": {"type": "gain", "gain": 2, "in": "lag"}}
    (folder / "three.json").write_text(json.dumps(
        {"format": 1, "title": "three signals", "blocks": blocks, "outputs": {"u": "u", "y": "lag", "z": "twice"},
         "simulate": {"until": f"{n / 1000} s", "every": "1 ms"}}))
    print(f"| {n} rows | CPU, s | peak, MB | reach |\n|---|---|---|---|")
    for what, words, reach in (
            ("two recordings: compare", ["compare", "lag.json", "--data", "data.json"], "2 s, 250 MB"),
            ("the same, `--traces f64`", ["compare", "lag.json", "--data", "data.json", "--traces", "f64"], ""),
            ("`run` that writes three signals", ["run", "three.json"], "0.6 s"),
            ("the same, `--traces f64`", ["run", "three.json", "--traces", "f64"], "0.1 s")):
        seconds, memory = timed([program, *words, "-o", words[0]], folder)
        print(f"| {what} | {seconds:.2f} | {memory:.0f} | {reach} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--blocks", type=int, nargs="*", default=[1000, 10000, 31000])
    parser.add_argument("--rows", type=int, default=1000000)
    parser.add_argument("--only", nargs="*", choices=["ratios", "sizes", "rows"], default=["ratios", "sizes", "rows"])
    given = parser.parse_args()
    build = given.build.resolve()
    program = str(build / "app" / "hysteron")
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True, check=False).stdout.splitlines()[0]
    print(f"{processor()}, {os.cpu_count()} processors; {compiler}; load {load()} before\n", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for part, print_it in (("ratios", lambda: ratios(build, given.repetitions, folder)),
                               ("sizes", lambda: sizes(program, given.blocks, folder)),
                               ("rows", lambda: rows(program, given.rows, folder))):
            if part in given.only:
                print_it()
                print()
    print(f"load {load()} after")


if __name__ == "__main__":
    main()
