"""Cases from disk: the user's model and what was measured.

Decides how a case folder becomes a plant and recordings, with the base model's outputs beside the measured ones.
Does not decide what is made of them. Does not read the truth.
"""
import csv
import json

import numpy as np

from excitations import Recording
from plants import Plant, simulate


def read_csv(path):
    with path.open(newline="") as f:
        rows = list(csv.reader(f))
    table = np.array(rows[1:], dtype=float)
    return {name.split(" ")[0]: table[:, k] for k, name in enumerate(rows[0])}


def read_case(folder):
    """Recordings with drive, measured and base outputs; one entry per recording."""
    task = json.loads((folder / "task.json").read_text())
    plant = Plant(task["base"], task["base_parameters"], 10.0)
    recordings = []
    for index, entry in enumerate(task["files"], 1):
        c = read_csv(folder / entry["file"])
        n = len(c["t"])
        temperature = c["Ta"] if plant.base == "B5" else c.get("T", np.full(n, 22.0))
        drives = [c["u"]] + ([c["u2"]] if "u2" in c else [])
        r = Recording(entry["excitation"], entry["role"], (c["t"][-1] - c["t"][0]) / (n - 1), drives, temperature,
                      entry["start_h"], entry["cycles_before"], index)
        r.extra["base"] = simulate(plant, r)[0]
        r.extra["measured"] = [c[name.split(" ")[0]] for name in task["outputs"]]
        recordings.append(r)
    return plant, recordings


