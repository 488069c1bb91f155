#!/usr/bin/python3
"""Instructions that the program takes for a dozen workloads, counted by valgrind and held against those written down.

    benchmarks/instructions.py PROGRAM [--only NAME ...] [--write]

A count is the same whatever else the machine does, so what grew by a twentieth grew. One that fell by as much is to be
written down as well (--write), or the next change could lose it unseen. Counts belong to a compiler and an
architecture: with another the script says so and ends with 77 (skipped). Exit code 1: a count is further than 5 % from
what benchmarks/instructions.json says.
"""

import argparse
import json
import math
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
WRITTEN = HERE / "instructions.json"
DIAGRAMS = HERE.parent / "diagrams"
NEAR = 0.05  # of what is written down
SKIPPED = 77


def diagram(title, blocks, output, until="", every="", solver=None, **more):
    d = {"format": 1, "title": title, "blocks": blocks, "outputs": {"y": output}, **more}
    if until:
        d["simulate"] = {"until": until, "every": every, **({"solver": solver} if solver else {})}
    return d


def chain(n, block):
    blocks = {"u": {"type": "sine", "amplitude": 1, "frequency": "3 Hz"}}
    last = "u"
    for i in range(n):
        blocks[f"b{i}"] = {**block, "in": last}
        last = f"b{i}"
    return blocks, last


def recording(file, rows):
    """A drive of two sines and what a lag of 20 ms makes of it, held between rows of 1 ms."""
    keep, y = math.exp(-0.05), 0.0
    with open(file, "w") as out:
        out.write("t [s],u [V],y [V]\n")
        for k in range(rows):
            u = math.sin(0.0071 * k) + 0.5 * math.sin(0.031 * k)
            out.write(f"{k / 1000:.3f},{u:.7g},{y:.7g}\n")
            y = keep * y + (1 - keep) * u


def data_set(train, validate):
    return {"format": 1, "title": "Two recordings", "columns": {"u": {"to": "u", "between_samples": "hold"}, "y": {"to": "y"}},
            "recordings": [{"file": train, "role": "train"}, {"file": validate, "role": "validate"}]}


def workloads(folder):
    """Name -> words of the command line; what they read is written into `folder`."""
    write = lambda name, content: (folder / name).write_text(json.dumps(content))
    gains, last = chain(1000, {"type": "gain", "gain": 1.001})
    write("gains.json", diagram("1000 gains", gains, last, "10 ms", "1 ms"))
    lags, last = chain(100, {"type": "lag", "times": "2 ms"})
    write("lags.json", diagram("100 lags", lags, last, "0.2 s", "1 ms", {"method": "bdf"}))
    plays, last = chain(1, {"type": "prandtl_ishlinskii", "thresholds": [0.012 * k for k in range(80)],
                            "weights": [1.0] + [0.01] * 79})
    write("plays.json", diagram("80 plays", plays, last, "2 s", "0.1 ms"))
    mass = {"u": {"type": "sine", "amplitude": "1 N", "frequency": "9 Hz"},
            "m": {"type": "mass_spring_damper", "mass": "0.1 kg", "damping": "2 N s/m", "stiffness": "1000 N/m", "in": "u"}}
    write("fixed.json", diagram("Fixed steps", mass, "m.position", "1 s", "1 ms", {"method": "rk4", "step": "50 us"}))
    rubbing = {**mass, "m": {"type": "mass_with_friction", "mass": "0.1 kg", "damping": "2 N s/m", "stiffness": "1000 N/m",
                             "coulomb": "0.3 N", "breakaway": "0.4 N", "in": "u"}}
    write("events.json", diagram("Stick and slip", rubbing, "m.position", "2 s", "1 ms"))
    for name, rows in (("train", 20000), ("validate", 20000)):
        recording(folder / f"{name}.csv", rows)
    lag = {"lag": {"type": "lag", "times": "$tau", "in": "u"}}
    for name, tau, free in (("lag", "25 ms", True), ("off", "0.02 s", False)):
        write(f"{name}.json", diagram("A lag", lag, "lag", inputs={"u": {"unit": "V"}},
                                      parameters={"tau": {"value": tau, **({"free": True} if free else {})}}))
    write("data.json", data_set("train.csv", "validate.csv"))
    for name in ("short_train", "short_validate"):
        recording(folder / f"{name}.csv", 1500)
    write("short.json", data_set("short_train.csv", "short_validate.csv"))
    at = lambda name: str(folder / name)
    return {
        "check: 1000 gains": ["check", at("gains.json")],
        "run: 1000 gains": ["run", at("gains.json")],
        "run: 100 lags, bdf": ["run", at("lags.json")],
        "run: 80 plays, 20 000 rows": ["run", at("plays.json")],
        "run: fixed steps, 20 000": ["run", at("fixed.json")],
        "run: stick and slip": ["run", at("events.json")],
        "run: closed loop, continuous": ["run", str(DIAGRAMS / "chapter2" / "feedback_continuous.json"), "--until", "0.1 s"],
        "run: closed loop, sampled at 10 kHz": ["run", str(DIAGRAMS / "chapter2" / "feedback_sampled.json"), "--until", "0.1 s"],
        "compare: two recordings of 20 000 rows": ["compare", at("off.json"), "--data", at("data.json")],
        "fit: a time constant, 20 000 rows": ["fit", at("lag.json"), "--data", at("data.json")],
        "diagnose: a lag, 1500 rows": ["diagnose", at("off.json"), "--data", at("short.json"), "--threads", "1"],
        "study: 2000 draws": ["study", str(DIAGRAMS / "study" / "tolerance.json"), "--threads", "1"],
    }


def built_with():
    compiler = subprocess.run(["c++", "-dumpfullversion"], capture_output=True, text=True, check=False).stdout.strip()
    return {"compiler": f"g++ {compiler}", "architecture": platform.machine()}


def count(program, words):
    """Instructions; stops where the program fails, for a count of a failure is none."""
    run = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, *words],
                         capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"instructions.py: {' '.join(words)} ended with {run.returncode}:\n{run.stdout[-600:]}\n{run.stderr[-1200:]}")
    return int(re.search(r"Collected\s*:\s*(\d+)", run.stderr).group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--only", nargs="*", default=[], help="workloads whose name contains one of these")
    parser.add_argument("--write", action="store_true", help="write the counts down")
    given = parser.parse_args()
    if shutil.which("valgrind") is None:
        print("skipped: no valgrind on this machine (Debian's package valgrind)")
        return SKIPPED
    known = json.loads(WRITTEN.read_text()) if WRITTEN.exists() else {"counts": {}}
    if not given.write and known.get("built_with") != built_with():
        print(f"skipped: counts were written down with {known.get('built_with')}, this is {built_with()}")
        return SKIPPED
    further = []
    with tempfile.TemporaryDirectory() as folder:
        for number, (name, words) in enumerate(workloads(pathlib.Path(folder)).items()):
            if given.only and not any(part in name for part in given.only):
                continue
            if words[0] != "check":
                words = [*words, "-o", f"{folder}/found_{number}"]
            now, before = count(given.program, words), known["counts"].get(name)
            change = (now / before - 1) if before else math.nan
            print(f"{name:45} {now / 1e6:12.1f} million  {change:+8.2%}", flush=True)
            if given.write:
                known["counts"][name] = now
            elif not abs(change) <= NEAR:
                further.append(name)
    if given.write:
        WRITTEN.write_text(json.dumps({"built_with": built_with(), "counts": known["counts"]}, indent=1) + "\n")
    if further:
        print(f"further than {NEAR:.0%} from what is written down: {', '.join(further)}.\nWhere that is meant: {sys.argv[0]} PROGRAM --write")
    return 1 if further else 0


if __name__ == "__main__":
    sys.exit(main())
