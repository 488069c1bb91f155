#!/usr/bin/env python3
"""Cases for the discovery of missing effects, as many as one likes, in the layout of the hidden-effect cases.

    make_cases.py FOLDER --seeds 1-10                      every kind: 60 singles, 6 pairs, 2 triples, 10 with nothing
                                                           hidden, 4 outside the list, 4 starved, per seed
    make_cases.py FOLDER --seeds 3 --kind pairs --count 15
    make_cases.py FOLDER --seeds 1 --kind singles --effects creep,hysteresis --strength weak

FOLDER/NNNNNNN/ holds task.json (all that a tool may read), case.json (the truth) and the recordings. The number is two
digits of seed, one of kind, three of count; a case depends on these three and on the code alone, not on what else is made.

Strength, as rms of the effect over rms of the noise in the recording that shows it most: weak 0.3 to 0.4, medium 1 to 5,
strong 12 to 120. What else would explain the same recordings (chi2 gap below 9) stands in acceptable_alternatives.

--campaign: 11 recordings of an actuator, 12 of a mass, 6 of a heater, each of a kind of its own, as a laboratory makes them
that means to know its device; otherwise 2 to 8.
--wrong-parameters: the base model's gains and weights are off by 0.5 to 3 % as well. "free": the user leaves them free
(task.json: base_parameters_free), a calibration is no effect then, and strength is that of what is left of an effect beside
the free numbers; "held": they stand there as if they were right (task.json: base_parameters_exact false).
"""
import argparse
import copy
import multiprocessing
import sys
from pathlib import Path

import numpy as np

import case_files
import cases
import hidden
from plants import UNCERTAIN, simulate


def number_of(seed, kind, index):
    return "%02d%d%03d" % (seed, cases.KINDS.index(kind), index)


def rms(parts):
    flat = np.concatenate([np.ravel(p) for p in parts])
    return float(np.sqrt(np.mean(flat * flat)))


def digits(x, count):
    return float("%.*g" % (count, x))


def truth_of_effects(case):
    """Per effect: strength and how high it stands above the noise."""
    entries = []
    sigma = case_files.total(case.sensor)
    for e in case.effects:
        trace = hidden.traces(case.plant, case.recordings, e)
        entries.append(dict(
            effect=e.name, strength=e.strength, axes=list(e.axes),
            height_over_noise={role: digits(rms(cases.by_role(case.recordings, trace, role)) / sigma, 3)
                               for role in ("train", "validate")},
            rms_by_file={"%02d.csv" % r.index: digits(h, 3) for r, h in zip(case.recordings, hidden.heights(trace))},
            amount=digits(e.amount, 6)))
    return entries


def write(folder, case, rng, name, wrong_parameters):
    """The recordings, measured once, and the two JSON files."""
    folder.mkdir(parents=True, exist_ok=True)
    plant = case.plant
    with_force = plant.base == "B4" and rng.random() < 0.4
    thermal = {"thermal_expansion", "temperature_gain", "creep"} & set(case.expected["effects"])
    with_temperature = bool(thermal) or rng.random() > 0.08
    known = copy.deepcopy(plant)
    if wrong_parameters:
        cases.perturbed(rng, known.task)
    floor, before = [], []
    for r in case.recordings:
        true, force = simulate(plant, r, case.effects)
        measured = [case_files.measure(rng, case.sensor, y) for y in true]
        case_files.write_csv(folder / ("%02d.csv" % r.index), r, case_files.columns_of(
            rng, plant, r, measured, force if with_force else None, with_temperature))
        if r.role == "validate":
            floor.append(np.array(measured) - np.array(true))
            before.append(np.array(measured) - np.array(simulate(known, r)[0]))
    task = dict(id=name, base=plant.base, base_parameters=known.task, outputs=plant.outputs,
                sensor=case_files.sensor_entry(rng, case.sensor),
                files=[dict(file="%02d.csv" % r.index, role=r.role, excitation=r.word, start_h=r.start_h,
                            cycles_before=r.cycles_before) for r in case.recordings])
    if wrong_parameters == "held":
        task["base_parameters_exact"] = False
    if wrong_parameters == "free":
        task["base_parameters_free"] = [k for k in UNCERTAIN if k in known.task or k in known.task.get("axes", [{}])[0]]
    case_files.write_json(folder / "task.json", task)
    case_files.write_json(folder / "case.json", dict(
        task, group=case.group, hidden=truth_of_effects(case), wrong_parameters=wrong_parameters or False,
        noise_rms=dict(white=digits(case.sensor["white"], 4), flicker=digits(case.sensor["flicker"], 4),
                       total=digits(case_files.total(case.sensor), 4)),
        expected=dict(case.expected, noise_floor_rms=digits(rms(floor), 5), validation_rms_before=digits(rms(before), 5))))


def make(job):
    folder, seed, kind, index, what, offered, strengths, wrong_parameters, layout = job
    case, rng = cases.build(seed, kind, index, what, offered, strengths, layout)
    name = number_of(seed, kind, index)
    write(folder / name, case, rng, name, wrong_parameters)
    effects = ", ".join("%s %s" % (e.strength, e.name) for e in case.effects) or "nothing"
    return "%s  %s  %d recordings, %d rows: %s" % (
        name, case.plant.base, len(case.recordings), sum(len(r.u[0]) for r in case.recordings), effects)


def seeds_of(text):
    seeds = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        seeds += range(int(first), int(last or first) + 1)
    return seeds


def choice_of(text, allowed, what):
    names = list(allowed) if text == "all" else text.split(",")
    for n in names:
        if n not in allowed:
            sys.exit("%s \"%s\" is not known; known: %s" % (what, n, ", ".join(allowed)))
    return names


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("folder", type=Path)
    ap.add_argument("--seeds", default="1", help="3, 1-10, 1,5,7-9")
    ap.add_argument("--kind", default="all", help=", ".join(cases.KINDS) + "; several with commas")
    ap.add_argument("--effects", default="all", help="names for singles, pairs and triples")
    ap.add_argument("--strength", default="all", help="weak,medium,strong (pairs and triples: medium and strong)")
    ap.add_argument("--count", type=int, help="cases per kind and seed")
    ap.add_argument("--wrong-parameters", choices=("held", "free"))
    ap.add_argument("--campaign", action="store_true")
    ap.add_argument("--jobs", type=int, default=1)
    a = ap.parse_args()
    layout = cases.Layout(a.campaign, a.wrong_parameters == "free")
    offered = layout.offered(choice_of(a.effects, hidden.EFFECTS, "the effect"))
    strengths = choice_of(a.strength, hidden.STRENGTHS, "the strength")
    jobs = [(a.folder, seed, kind, index, what, offered, strengths, a.wrong_parameters, layout)
            for seed in seeds_of(a.seeds) for kind in choice_of(a.kind, cases.KINDS, "the kind")
            for index, what in enumerate(cases.wanted(kind, offered, strengths, a.count))]
    try:
        if a.jobs > 1:
            with multiprocessing.Pool(a.jobs) as pool:
                for line in pool.imap(make, jobs):
                    print(line, flush=True)
        else:
            for job in jobs:
                print(make(job), flush=True)
    except cases.Impossible as e:
        raise SystemExit("make_cases.py: %s" % e)


if __name__ == "__main__":
    main()
