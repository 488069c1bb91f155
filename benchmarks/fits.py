#!/usr/bin/env python3
"""Fits against SciPy on the same data, interleaved; needs python3-scipy and python3-numba.

usage: benchmarks/fits.py build/benchmarks/hysteron_fits [repetitions]
"""
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numba
import numpy as np
from scipy.optimize import least_squares, nnls
from scipy.signal import cont2discrete, lfilter

PROGRAM = sys.argv[1]
REPETITIONS = int(sys.argv[2]) if len(sys.argv) > 2 else 5
TIMES = np.array([.01, .03, .1, .3, 1, 3, 10, 30])  # s
STEP = 1e-3  # s


@numba.njit
def plays(u, thresholds):
    """One column per operator: w <- max(u - r, min(u, w))."""
    columns = np.empty((len(thresholds), len(u)))
    for i, r in enumerate(thresholds):
        w = 0.0
        for k in range(len(u)):
            w = max(u[k] - r, min(u[k], w))
            columns[i, k] = w
    return columns


def fit_operators(u, y):
    matrix = plays(u, .075 * np.arange(80)).T
    weights, length = nnls(matrix, y)
    return length / np.sqrt(len(y))


def first_order(tau):
    """Lag with unit gain for an input that is linear between samples."""
    e = np.exp(-STEP / tau)
    r = tau / STEP * (1 - e)
    return [1 - r, r - e], [1, -e]


RELAXATIONS = [first_order(tau) for tau in TIMES]


def creep(p, u):
    """8 amounts, stiffness, damping; mass 1 kg, 1 N/V; um."""
    total = u.copy()
    for amount, (b, a) in zip(p[:8], RELAXATIONS):
        total = total + amount * lfilter(b, a, u)
    b, a, _ = cont2discrete(([1e6], [1, p[9] * 100, p[8] * 1e5]), STEP, method="foh")
    return lfilter(b.ravel(), a, total)


def fit_creep(u, y):
    def residual(p):
        return np.concatenate([creep(p, u[r]) - y[r] for r in range(len(u))])

    found = least_squares(residual, [.005] * 8 + [.8, 1], bounds=([0] * 8 + [.01, .01], [1] * 8 + [10, 10]), xtol=1e-9, ftol=1e-9)
    return np.sqrt(np.mean(found.fun ** 2))


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PROGRAM, "write", folder], check=True)
        read = lambda name: np.fromfile(Path(folder) / name)
        data = {
            "operators": (fit_operators, read("operators.u"), read("operators.y")),
            "creep": (fit_creep, read("creep.u").reshape(12, -1), read("creep.y").reshape(12, -1)),
        }
    plays(np.zeros(2), np.zeros(1))  # compiled before it is timed
    for name, (fit, u, y) in data.items():
        theirs, ours = [], []
        for _ in range(REPETITIONS):
            begin = time.process_time()
            rms = fit(u, y)
            theirs.append(time.process_time() - begin)
            seconds, runs, own_rms = subprocess.run([PROGRAM, name], check=True, capture_output=True, text=True).stdout.split()
            ours.append(float(seconds))
        a, b = np.median(theirs), np.median(ours)
        print(f"{name:10s} SciPy {a:7.3f} s rms {rms:.6f} um   hysteron {b:7.3f} s rms {own_rms} um, {runs} runs   {a / b:5.1f} times faster")


main()
