#!/usr/bin/env python3
"""The cascade drive of diagrams/motion for 10 s, a row each 0.25 ms (4 kHz), against SciPy's solve_ivp and Xcos, in one run.

    benchmarks/cascade.py build/app/hysteron

The table goes to and fro for all of the 10 s. solve_ivp integrates from corner to corner of the jerk-limited moves, equations in
plain Python; both sides are asked for a relative tolerance of 1e-6. What is exact is LSODA at 1e-11. CPU times, medians of five:
of hysteron the whole program, with reading, compiling and writing, of solve_ivp its calls alone, of Xcos (cascade.sce) what its
simulator takes for a compiled diagram. Needs python3-scipy, and scilab-cli for Xcos, which is left out without it.
"""
import json
import math
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "app" / "motion"))
from reference import Moves  # noqa: E402

PLACES = [0.2, 0.1999, 0.05] * 5
END, ROW = 10.0, 0.25e-3
LEAD = 5e-3 / (2 * math.pi)


def rates(t, x, begin, x0, v0, a0, jerk):
    """States: angle, speed, place of the table, its speed, integral; the move is one piece of constant jerk."""
    s = t - begin
    want = x0 + s * (v0 + s * (a0 / 2 + s * jerk / 6))
    speed = v0 + s * (a0 + s * jerk / 2)
    acceleration = a0 + s * jerk
    angle, w, place, v, integral = x[0], x[1], x[2], x[3], x[4]
    error = (60 * (want - LEAD * angle) + speed) / LEAD - w
    raw = 0.5 * error + integral
    given = max(-10.0, min(10.0, raw))
    ahead, rate = LEAD * angle - place, LEAD * w - v
    force = 0.0
    if ahead > 10e-6:
        force = max(0.0, 50e6 * (ahead - 10e-6) + 5e3 * rate)
    elif ahead < -10e-6:
        force = min(0.0, 50e6 * (ahead + 10e-6) + 5e3 * rate)
    back = force * LEAD
    felt = back * 0.5 * (1 / 0.9 + 0.9) + abs(back) * 0.5 * (1 / 0.9 - 0.9) * math.tanh(w / 0.01)
    return (w, (given + 1.296426 * acceleration - felt - 1e-3 * w) / 1e-3, v, (force - 200 * v) / 50,
            60 * error + (given - raw) * 120)


def integrated(f, pieces, t, method, tolerance):
    """Place of the table at every row."""
    x, place = np.zeros(5), np.zeros(len(t))
    ends = [p[0] for p in pieces[1:]] + [END]
    now = 0.0
    sizes = np.array([300.0, 400.0, 0.2, 0.3, 10.0])
    for piece, end in zip(pieces, ends):
        end = min(end, END)
        if end <= now:
            continue
        inside = (t >= now) & (t <= end)
        grid = np.union1d(t[inside], [end])
        out = solve_ivp(f, (now, end), x, method=method, t_eval=grid, args=piece, rtol=tolerance,
                        atol=1e-2 * tolerance * sizes)
        if not out.success:
            raise RuntimeError(out.message)
        place[inside] = out.y[2][np.isin(grid, t[inside])]
        x, now = out.y[:, -1], end
    return place


def timed(call):
    seconds, result = [], None
    for _ in range(5):
        begin = time.process_time()
        result = call()
        seconds.append(time.process_time() - begin)
    return statistics.median(seconds), result


def cpu_of_programs():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def ours(program, folder):
    diagram = json.loads((ROOT / "diagrams/motion/ball_screw_cascade.json").read_text())
    diagram.pop("$schema")
    diagram["blocks"]["move"]["positions"] = [f"{1e3 * x:g} mm" for x in PLACES]
    diagram["record"] = ["table.position"]
    diagram["simulate"] = {"until": f"{END:g} s", "every": f"{1e3 * ROW:g} ms"}
    (folder / "cascade.json").write_text(json.dumps(diagram))
    seconds = []
    for i in range(5):
        begin = cpu_of_programs()
        subprocess.run([program, "run", "cascade.json", "-o", f"out{i}"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
        seconds.append(cpu_of_programs() - begin)
    csv = next((folder / "out0" / "traces").glob("*.csv"))
    unit = {"m": 1.0, "mm": 1e-3}[re.search(r"table.position \[(\w+)\]", csv.read_text().split("\n", 1)[0]).group(1)]
    return statistics.median(seconds), unit * np.loadtxt(csv, delimiter=",", skiprows=1)[:, 1]


def in_xcos(pieces, folder):
    """Per solver of Xcos: its name, CPU seconds, place of the table at every row but the last, which Xcos leaves out."""
    rows = [*pieces, (END + 1, *pieces[-1][1:])]
    (folder / "pieces.csv").write_text("\n".join(",".join(f"{x:.17g}" for x in row) for row in rows) + "\n")
    subprocess.run(["scilab-cli", "-nb", "-f", str(ROOT / "benchmarks" / "cascade.sce")], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL, timeout=300)
    seconds = np.loadtxt(folder / "seconds.csv")
    return [(name, seconds[i], np.loadtxt(folder / f"place{i}.csv")) for i, name in enumerate(("LSODAR", "CVODE BDF"))]


def main():
    pieces = Moves(0.05, PLACES, 0.3, 5.0, 200.0, 0.1).pieces
    pieces[0] = (0.0, 0.0, 0.0, 0.0, 0.0)
    t = np.arange(round(END / ROW) + 1) * ROW
    exact = integrated(rates, pieces, t, "LSODA", 1e-11)
    with tempfile.TemporaryDirectory() as folder:
        seconds, place = ours(str(Path(sys.argv[1]).resolve()), Path(folder))
        xcos = in_xcos(pieces, Path(folder)) if shutil.which("scilab-cli") else []
    scale = 1e6  # um
    print(f"hysteron: {seconds:.3g} s, largest error {scale * np.max(np.abs(place - exact)):.3g} um")
    for method in ("LSODA", "RK45"):
        seconds, place = timed(lambda: integrated(rates, pieces, t, method, 1e-6))
        print(f"solve_ivp, {method}: {seconds:.3g} s, largest error {scale * np.max(np.abs(place - exact)):.3g} um",
              flush=True)
    for name, seconds, place in xcos:
        print(f"Xcos, {name}: {seconds:.3g} s, largest error {scale * np.max(np.abs(place - exact[:-1])):.3g} um")
    if not xcos:
        print("Xcos: left out, scilab-cli is not there")


if __name__ == "__main__":
    main()
