#!/usr/bin/env python3
"""Machines of many fields as their users draw them, with something hidden in most: diagram, data set, recordings, truth.

    make_machines.py FOLDER [--only buck,034] [--seed 1] [--check PROGRAM]

writes FOLDER/NNN/ with diagram.json, dataset.json, 01.csv ... and case.json, which no program under test may read. The
machines are integrated in fine steps from the equations of their fields and share nothing with the program's blocks.
--check holds each case against PROGRAM (hysteron): every diagram must be right, and where nothing but numbers is hidden the
true ones must leave the noise and no more.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

import numpy as np

import machine_truth
from machine_lab import Lab
from machines_electric import BUCK, CELL, SPEAKER
from machines_motion import ARM, GALVO, GEARED, HYDRAULIC
from machines_small import PROOF, ROD
from machines_thermal import COOLER, EXCHANGER

MACHINES = {m.name: m for m in (BUCK, CELL, SPEAKER, EXCHANGER, GEARED, GALVO, HYDRAULIC, PROOF, ARM, COOLER, ROD)}
CASES_EACH = 6
STRENGTHS = dict(weak=(0.5, 1.0), medium=(2.0, 8.0), strong=(12.0, 40.0))  # rms over noise, as told in case.json
STARTS = ("rest", "unstated", "rest", "stated", "rest", "unstated")


def specification(number, machine):
    """Group, effects, strength, start and loop of a case, by its place: every third begins in motion and nobody says so."""
    place = list(MACHINES).index(machine.name)
    group, keys, strength, *more = machine.cases[number]
    start = STARTS[(number + place) % len(STARTS)]
    either, only = more if more else ("", "")
    closed = (
        bool(machine.loop)
        and (machine.mostly_closed or (number + place) % 3 == 1)
        and group not in ("starved", "outside")
    )
    return dict(
        group=group,
        keys=keys,
        strength=strength,
        start="rest" if only or (start == "stated" and group == "none") else start,
        closed=closed,
        either=either,
        only=only,
        id="%03d" % (place * CASES_EACH + number + 1),
    )


def hide(lab, spec):
    """-> {key: amount}, or None where these recordings cannot show so much."""
    hidden = {}
    for key in spec["keys"]:
        low, high = STRENGTHS[spec["strength"]]
        amount = lab.amount(key, float(np.exp(lab.rng.uniform(np.log(low * 1.1), np.log(high * 0.9)))), hidden)
        if amount is None:
            return None
        hidden[key] = amount
    return hidden


def write_wrong(rng, machine, numbers):
    """1 to 3 numbers as the user has them: too large or too small by 1.05 to 1.4."""
    names = list(rng.permutation(list(machine.paths)))[: int(rng.integers(1, 4))]
    return {str(n): float("%.3g" % (numbers[n] * rng.uniform(1.05, 1.4) ** rng.choice([-1, 1]))) for n in names}


def make(machine, number, seed):
    """A case in memory: (lab, spec, hidden, wrong, heights); drawn anew until its recordings show what is hidden."""
    spec = specification(number, machine)
    for attempt in range(12):
        rng = np.random.default_rng([seed, number, zlib.crc32(machine.name.encode()), attempt])
        lab = Lab(rng, machine, spec["keys"], spec["start"], spec["closed"], spec["only"])
        hidden = hide(lab, spec)
        if hidden is None:
            continue
        heights = {k: lab.height(hidden, tuple(x for x in hidden if x != k)) for k in hidden}
        low, high = STRENGTHS.get(spec["strength"], (0, 0))
        if "dropped" in hidden:
            low, high = 2.0, 1e3
        if all(0.9 * low <= h <= 1.15 * high for h in heights.values()):
            wrong = write_wrong(rng, machine, lab.numbers) if spec["group"].startswith("wrong") else {}
            return lab, spec, hidden, wrong, heights
    raise RuntimeError(f"{machine.name} case {number}: no recordings in which {spec['keys']} is {spec['strength']}")


def columns(lab, r, played):
    """(header, format, values) of every column but the time."""
    m, (shown, u, _) = lab.machine, played
    found = [(f"{next(iter(m.diagram(lab.numbers)[0]))} [{m.drive[0]}]", f"%.{m.drive[3]}f", u[r.skip :])]
    for o, (name, unit, _) in enumerate(m.outputs):
        digits = max(0, int(np.ceil(-np.log10(lab.noise[o]))) + 1)
        found.append((f"{name} [{unit}]", f"%.{digits}f", shown[:, o]))
    for k, (name, unit, *_) in enumerate(m.sides):
        if name:
            found.append((f"{name} [{unit}]", "%.4f", r.w[r.skip :, k]))
    return found


def write_case(folder, lab, spec, hidden, wrong, heights):
    m, rng = lab.machine, lab.rng
    folder.mkdir(parents=True, exist_ok=True)
    stated = bool(rng.random() < 0.5)
    clean = [lab.run(r, hidden) for r in lab.recordings]
    recordings, written = [], []
    for k, (r, played) in enumerate(zip(lab.recordings, clean)):
        name = "%02d.csv" % (k + 1)
        table = columns(lab, r, played)
        t = ["%.9g" % (i * r.dt) for i in range(r.rows)]
        texts = [t] + [[form % x for x in values] for _, form, values in table]
        lines = [",".join(["t [s]"] + [c[0] for c in table])] + [",".join(row) for row in zip(*texts)]
        (folder / name).write_text("\n".join(lines) + "\n")
        recordings.append(
            {"file": name, "role": r.role} | ({"initial": "per_recording"} if spec["start"] == "stated" else {})
        )
    inputs, blocks, outputs = m.diagram({**lab.numbers, **wrong})
    drive = next(iter(inputs))
    entries = {drive: {"to": drive} | ({"between_samples": "hold"} if lab.hold else {})}
    for o, (name, unit, _) in enumerate(m.outputs):
        entries[name] = {"to": name} | (
            {"noise": {"white": f"{lab.noise[o]:.3g} {'K' if unit == 'degC' else unit}"}} if stated else {}
        )
    for name, _, bound, *_ in m.sides:
        if bound:
            entries[name] = {"to": bound}
    write(
        folder / "diagram.json", {"format": 1, "title": m.title, "inputs": inputs, "blocks": blocks, "outputs": outputs}
    )
    write(folder / "dataset.json", {"format": 1, "title": m.title, "columns": entries, "recordings": recordings})
    write(folder / "case.json", machine_truth.case_json(lab, spec, hidden, wrong, heights, clean, stated))


def write(path, content):
    path.write_text(json.dumps(content, indent=1) + "\n")


# ---- held against the program -------------------------------------------------------------------------------------------------


def put(diagram, path, value):
    """The number at a path such as cell.times[0], its unit kept."""
    block, rest = path.split(".", 1)
    keys = [int(k) if k.isdigit() else k for k in re.findall(r"\w+", rest)]
    holder = diagram["blocks"][block]
    for key in keys[:-1]:
        holder = holder[key]
    old = holder[keys[-1]]
    holder[keys[-1]] = value if not isinstance(old, str) else " ".join([f"{value:.9g}", *old.split(" ", 1)[1:]])


def compare(program, folder, diagram, dataset):
    """The rms of each output on the recordings that judge, as the program tells it."""
    with tempfile.TemporaryDirectory() as place:
        there = pathlib.Path(place)
        for file in folder.glob("*.csv"):
            shutil.copy(file, there)  # a link would lead out of the project
        write(there / "diagram.json", diagram)
        write(there / "dataset.json", dataset)
        for words in (["check", "diagram.json"], ["compare", "diagram.json", "--data", "dataset.json", "-o", "out"]):
            done = subprocess.run([str(program), *words], cwd=there, capture_output=True, text=True)
            if done.returncode:
                raise RuntimeError(f"{folder.name}: {' '.join(words)}: {done.stdout[-600:]}{done.stderr[-600:]}")
        return json.loads((there / "out" / "result.json").read_text())


def rms_of(result):
    return {
        m["output"]: m["rms"] for m in result["facts"]["metrics"] if (m["recording"], m["role"]) == ("all", "validate")
    }


def check(program, folder):
    """-> text of one line; raises where the program refuses, or where the truth does not leave the noise."""
    case, diagram, dataset = (
        json.loads((folder / f).read_text()) for f in ("case.json", "diagram.json", "dataset.json")
    )
    told = rms_of(compare(program, folder, diagram, dataset))
    ratios = [told[o] / s for o, s in zip(case["outputs"], case["noise_floor"])]
    text = f"{case['id']} {case['device']:10} {case['group']:10} as drawn " + " ".join("%.3f" % x for x in ratios)
    if case["group"] in ("none", "wrong"):
        for w in case["wrong_numbers"]:
            put(diagram, w["path"], w["true"])
        for r in dataset["recordings"]:
            if any(case["moving"]):
                r["initial"] = "per_recording"
        told = rms_of(compare(program, folder, diagram, dataset))
        ratios = [told[o] / s for o, s in zip(case["outputs"], case["noise_floor"])]
        text += "; truth " + " ".join("%.4f" % x for x in ratios)
        # A thousand rows and more: their rms is within 3 % of the noise's, what starts take of it included.
        if not all(0.96 < x < 1.03 for x in ratios):
            raise RuntimeError(text + ": the truth does not leave the noise")
    return text


def chosen(only):
    """The cases (machine, number) that names of machines or numbers of cases with commas mean."""
    every = {specification(k, m)["id"]: (m, k) for m in MACHINES.values() for k in range(len(m.cases))}
    cases = []
    for word in only.split(","):
        found = [every[word]] if word in every else [c for c in every.values() if c[0].name == word]
        if not found:
            raise ValueError(
                f"there is no machine or case {word!r}; known: {', '.join(MACHINES)}, 001 to {len(every):03}"
            )
        cases += found
    return cases


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("folder", type=pathlib.Path)
    words.add_argument("--only", default=",".join(MACHINES), help="names of machines or numbers of cases, with commas")
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--check", metavar="PROGRAM", type=pathlib.Path)
    words.add_argument("--checked", action="store_true", help="with --check: of what lies in FOLDER, nothing is made")
    wish = words.parse_args()
    try:
        cases = chosen(wish.only)
    except ValueError as wrong:
        words.error(str(wrong))
    bad = 0
    for machine, number in cases:
        folder = wish.folder / specification(number, machine)["id"]
        if not wish.checked:
            write_case(folder, *make(machine, number, wish.seed))
        if wish.check:
            try:
                print(check(wish.check, folder), flush=True)
            except RuntimeError as wrong:
                bad += 1
                print(wrong, flush=True)
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
