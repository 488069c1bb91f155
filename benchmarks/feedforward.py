#!/usr/bin/env python3
"""The feed-forward comparison of chapter 2 in NumPy and SciPy, against hysteron; needs python3-scipy.

usage: benchmarks/feedforward.py build/app/hysteron [repetitions]

Both do the same: three inverses and none, sine and triangle, 1.4 s at 10 kHz, in front of the surrogate actuator S1; the
error over the last period, its peaks and its spectrum. CPU times of whole processes, interleaved. The script's import of
SciPy is timed apart and left out; hysteron's start, its traces and its pages are counted.
"""
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete

CHAPTER = Path(__file__).resolve().parent.parent / "diagrams" / "chapter2"
RATE, PERIODS = 10_000, 7
T = np.arange(int(1.4 * RATE) + 1) / RATE
HALF = RATE // 10  # samples between two turning points


def number(text):
    return float(str(text).split()[0])


def parameters(name):
    values = json.loads((CHAPTER.parent / "parameters" / f"{name}.json").read_text())
    return {k: np.array(v["value"]) if isinstance(v, dict) else number(v) for k, v in values.items()
            if k not in ("format", "title", "source", "remark")}


def reference(wave):
    if wave == "sine":
        return 3 - 3 * np.cos(2 * np.pi * 5 * T)
    return 12 * np.abs(5 * T - np.floor(5 * T + 0.5))


def along_branches(slope, r, state):
    """State driven by r, d state/d r = slope(r, state, sign), from turning point to turning point."""
    result = np.empty(len(r))
    result[0] = state
    for begin in range(0, len(r) - 1, HALF):
        part = r[begin:begin + HALF + 1]
        way = np.abs(part - part[0])
        sign = np.sign(part[-1] - part[0])
        found = solve_ivp(lambda x, s: sign * slope(part[0] + sign * x, s[0], sign), (0, way[-1]), [state],
                          method="DOP853", rtol=1e-8, atol=1e-10, t_eval=way)
        result[begin:begin + HALF + 1] = found.y[0]
        state = found.y[0, -1]
    return result


def bouc_wen_inverse(r, z0=-1.37104302778):
    p = parameters("s1_bouc_wen")

    def dz_dr(_, z, sign):
        rise = p["alpha"] - sign * p["beta"] * z - p["gamma"] * abs(z)
        return rise / (p["d_p"] - rise)

    return (r - z0 + along_branches(dz_dr, r, z0)) / p["d_p"]


def jiles_atherton_inverse(r, origin=1.40111388105):
    q = parameters("s1_jiles_atherton")

    def du_dr(y, u, sign):
        p = y + origin
        anhysteretic = q["p_s"] * np.tanh((u + q["alpha"] * p) / q["a"])
        apart = anhysteretic - p
        reversible = q["c"] * q["p_s"] / q["a"] * (1 - (anhysteretic / q["p_s"]) ** 2)
        return (1 - q["alpha"] * reversible) / (
            apart / (q["k"] * sign - q["alpha"] / (1 - q["c"]) * apart) + reversible)

    return along_branches(du_dr, r, 0.0)


def plays(u, thresholds, weights):
    """Weighted sum of one-sided play operators, sample by sample."""
    w = np.zeros(len(thresholds))
    y = np.empty(len(u))
    for k, value in enumerate(u):
        w = np.maximum(value - thresholds, np.minimum(value, w))
        y[k] = weights @ w
    return y


def prandtl_ishlinskii_inverse(r):
    p = parameters("s1_prandtl_ishlinskii")
    m = np.cumsum(p["weights"])
    thresholds = np.array([np.sum(p["weights"][:j + 1] * (t - p["thresholds"][:j + 1]))
                           for j, t in enumerate(p["thresholds"])])
    return plays(r, thresholds, np.diff(1 / m, prepend=0))


INVERSES = {"none": lambda r: r, "bouc_wen": bouc_wen_inverse, "jiles_atherton": jiles_atherton_inverse,
            "prandtl_ishlinskii": prandtl_ishlinskii_inverse}


class Surrogate:
    """S1 from its diagram: curve, 80 operators, relaxation, plant; linear between the samples."""

    def __init__(self):
        blocks = json.loads((CHAPTER / "s1.json").read_text())["blocks"]
        self.thresholds = np.array(blocks["operators"]["thresholds"]["value"])
        self.weights = np.array(blocks["operators"]["weights"]["value"])
        self.curve = np.polynomial.Polynomial(blocks["curve"]["coefficients"]["value"])
        num, den = blocks["stage"]["num"], blocks["stage"]["den"]
        a, b = -1 / 5e-3, 1 / 5e-3
        # relaxation x, then the chain of the plant, driven by 0.84 y + 0.16 x; its states scaled to one time unit
        scale = 1e4
        rows = np.zeros((5, 5))
        rows[0, 0] = a
        rows[1:4, 2:5] = np.eye(3) * scale
        rows[4, 1:] = -np.array(den[:0:-1]) / scale ** np.array([3, 2, 1, 0])
        rows[4, 0] = 0.16 * den[-1] / scale ** 3
        into = np.array([[b], [0], [0], [0], [0.84 * den[-1] / scale ** 3]])
        out = np.array([[0, num[0] / den[-1], 0, 0, 0]])
        self.discrete = cont2discrete((rows, into, out, np.zeros((1, 1))), 1 / RATE, method="foh")[:4]

    def __call__(self, u):
        inside = np.clip(u, 0, 6)
        static = self.curve(inside) + self.curve.deriv()(inside) * (u - inside)
        static = static + plays(u, self.thresholds, self.weights)
        a, b, c, d = self.discrete
        x = np.zeros(5)
        y = np.empty(len(u))
        b, c, d = b.ravel(), c.ravel(), d.item()
        for k, value in enumerate(static):
            y[k] = c @ x + d * value
            x = a @ x + b * value
        return y


def comparison():
    stage = Surrogate()
    peaks = {}
    for wave in ("sine", "triangle"):
        r = reference(wave)
        for name, inverse in INVERSES.items():
            error = stage(inverse(r)) - r
            last = error[-2001:] - error[-2001]
            np.abs(np.fft.rfft(last[:-1]))  # the spectrum of the figures
            peaks[wave, name] = last.max(), last.min()
    return peaks


def by_hysteron(program, folder):
    for wave in ("sine", "triangle"):
        for name in INVERSES:
            subprocess.run([program, "run", str(CHAPTER / "feedforward_fitted.json"), "--choose", f"compensator={name}",
                            "--choose", f"reference={wave}", "-o", f"{folder}/{wave}_{name}", "--quiet"],
                           check=True, stdout=subprocess.DEVNULL)


def peaks_of(folder):
    peaks = {}
    for wave in ("sine", "triangle"):
        for name in INVERSES:
            trace = Path(folder) / f"{wave}_{name}" / "traces" / "signals.csv"
            rows = np.genfromtxt(trace, delimiter=",", names=True)
            error = rows[[n for n in rows.dtype.names if n.startswith("deviation")][0]]
            last = error[-2001:] - error[-2001]
            peaks[wave, name] = last.max(), last.min()
    return peaks


def children():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def main():
    program = sys.argv[1]
    repetitions = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    own, ours = [], []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(repetitions):
            begin = time.process_time()
            peaks = comparison()
            own.append(time.process_time() - begin)
            begin = children()
            by_hysteron(program, folder)
            ours.append(children() - begin)
        found = peaks_of(folder)
    for case, (high, low) in peaks.items():
        print(f"{case[0]:9s} {case[1]:19s} {high:8.5f} {low:8.5f} um   apart by "
              f"{max(abs(high - found[case][0]), abs(low - found[case][1])):.1e}")
    print(f"NumPy and SciPy {np.median(own):.2f} s, hysteron {np.median(ours):.2f} s, "
          f"ratio {np.median(np.array(ours) / np.array(own)):.2f}")


main()
