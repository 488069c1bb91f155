#!/usr/bin/python3
"""What the laws of the effect hysteresis leave of Preisach densities drawn at random; needs python3-scipy, python3-numba.

    benchmarks/hysteresis_laws.py [--densities 24] [--seed 5] [--spring]

Each law is fitted to three recordings without noise (weights >= 0 by non-negative least squares, a linear part and a
zero beside them) and judged on two others within the range that was driven. Printed: rms of what is left on these over
rms of the effect (the loops less their line), per density, then median and worst. --spring: of motions about zero, as
of a mass whose spring remembers; the weights of uneven plays are Bernstein's parabolas over the travel.
"""
import argparse
import pathlib
import sys

import numpy as np
from scipy.optimize import nnls

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "discovery"))
import laws  # noqa: E402

ROWS = 2000
SLOPES = (0.1, 0.4, 0.7, 1.0, 1.3, 1.6, 2.0, 2.5)  # of the bent drive at either end, scanned


def drives(rng):
    """Five drives within 0 .. 1: triangles that die away, two sines, steps of smooth noise; the last two judge."""
    x = np.linspace(0, 1, ROWS)
    dying = lambda n: (1 - 0.9 * x) * (1 - np.cos(2 * np.pi * n * x)) / 2
    sines = lambda a, b: 0.5 - 0.25 * (np.cos(2 * np.pi * a * x) + np.cos(2 * np.pi * b * x))
    smooth = np.convolve(rng.normal(size=ROWS + 80), np.hanning(81), "valid")
    walk = (smooth - smooth.min()) / (smooth.max() - smooth.min()) * np.minimum(1, 20 * x)  # begins at rest
    growing = x * (1 - np.cos(2 * np.pi * 9 * x)) / 2
    return [dying(8), sines(3, 7.3), walk, sines(5, 11.7), growing]


@laws.njit
def one_sided(u, r):
    w, out = 0.0, np.empty(len(u))
    for k, now in enumerate(u):
        w = max(now - r, min(now, w))
        out[k] = w
    return out


@laws.njit
def two_sided(u, r):
    w, out = 0.0, np.empty(len(u))
    for k, now in enumerate(u):
        w = max(now - r, min(now + r, w))
        out[k] = w
    return out


@laws.njit
def kernel(rising, falling, w=0.0):
    out = np.empty(len(rising))
    for k in range(len(rising)):
        w = max(rising[k], min(falling[k], w))
        out[k] = w
    return out


def motions(rng):
    """Five motions within -1 .. 1 from rest: sines that grow and die away, two sines, noise; the last two judge."""
    x = np.linspace(0, 1, ROWS)
    swelling = lambda n: 6.75 * x * x * (1 - x) * np.sin(2 * np.pi * n * x)
    sines = lambda a, b: 0.5 * x**0.5 * (np.sin(2 * np.pi * a * x) + np.sin(2 * np.pi * b * x))
    smooth = np.convolve(rng.normal(size=ROWS + 80), np.hanning(81), "valid")
    walk = smooth / np.abs(smooth).max() * np.minimum(1, 20 * x)
    return [swelling(8), sines(3, 7.3), walk, 0.9 * sines(5, 11.7), 0.5 * swelling(13)]


def bernstein(w):
    """Integrals from 0 to w of the three parabolas over -1 .. 1 whose sum is one."""
    p = (w + 1) / 2
    of = lambda p: np.array([p - p**2 + p**3 / 3, p**2 - 2 * p**3 / 3, p**3 / 3])
    return list(2 * (of(p) - of(np.full(1, 0.5))))


def uneven_plays(x):
    return [x] + [column for r in (0.02, 0.08, 0.2, 0.4, 0.6, 0.8) for column in bernstein(two_sided(x, r))]


def relays_about_zero(x, cells):
    part = [np.clip((x + 1) / 2 * cells - i, 0, 1) for i in range(cells)]
    middle = lambda i: min(max(cells / 2 - i, 0), 1)  # part of a cell below zero
    at_rest = lambda i, j: max(middle(i), min(middle(j), float(i + j + 1 < cells)))
    return [x] + [kernel(part[i], part[j], at_rest(i, j)) for i in range(cells) for j in range(i + 1)]


def bent(u, low, high):
    return u**3 * (low + high - 2) + u**2 * (3 - 2 * low - high) + low * u


def plays(u, thresholds):
    return [u] + [one_sided(u, r) for r in thresholds]


def relays(u, cells):
    part = [np.clip(u * cells - i, 0, 1) for i in range(cells)]
    return [u] + [kernel(part[i], part[j]) for i in range(cells) for j in range(i + 1)]


def left(columns, train, judge, loops):
    """rms left on `judge` and on `train` after a fit on `train`."""
    stack = lambda which: np.vstack([np.array(columns(u)).T for u in which])
    of = lambda which: np.concatenate([loops(u) for u in which])
    a = stack(train)
    ones = np.ones((len(a), 1))
    found, missed = nnls(np.hstack([a, ones, -ones]), of(train), maxiter=6000)
    rest = of(judge) - stack(judge) @ found[:-2] - found[-2] + found[-1]
    return np.sqrt(np.mean(rest**2)), missed


def print_rests(table):
    print("  ".join("%s %5.1f %%" % (name, list_[-1]) for name, list_ in table.items()), flush=True)


def of_springs(rng, densities):
    candidates = {"6 plays": lambda x: [x] + [two_sided(x, r) for r in (0.02, 0.05, 0.12, 0.24, 0.44, 0.8)],
                  "18 plays": lambda x: [x] + [two_sided(x, r) for r in np.linspace(0.02, 0.95, 18)],
                  "6 uneven plays": uneven_plays,
                  "relays, 6 cells": lambda x: relays_about_zero(x, 6),
                  "relays, 10 cells": lambda x: relays_about_zero(x, 10)}
    table = {name: [] for name in candidates}
    for _ in range(densities):
        everett, all_motions = laws.everett_table(rng), motions(rng)
        loops = lambda x: laws.preisach(everett, x, -1.02, 1.02)
        stacked = lambda which: np.concatenate([loops(x) for x in which])
        line = np.polyfit(np.concatenate(all_motions[:3]), stacked(all_motions[:3]), 1)[0]
        effect = np.sqrt(np.mean((stacked(all_motions[3:]) - line * np.concatenate(all_motions[3:])) ** 2))
        for name, columns in candidates.items():
            table[name].append(100 * left(columns, all_motions[:3], all_motions[3:], loops)[0] / effect)
        print_rests(table)
    return table


def of_wires(rng, densities):
    table = {"18 plays": [], "10 plays of a bent drive": [], "relays, 6 cells": [], "relays, 10 cells": []}
    for _ in range(densities):
        everett, slope = laws.everett_table(rng), rng.uniform(0.6, 1)
        all_drives = drives(rng)
        train, judge = all_drives[:3], all_drives[3:]
        loops = lambda u: laws.preisach(everett, u, -0.02, 1.02)
        effect = np.sqrt(np.mean(np.concatenate([loops(u) - slope * u for u in judge]) ** 2))
        bends = [left(lambda u: plays(bent(u, a, b), np.linspace(0.03, 0.9, 10)) + [u], train, judge, loops)
                 for a in SLOPES for b in SLOPES]
        rests = [left(lambda u: plays(u, np.linspace(0.03, 0.9, 18)), train, judge, loops)[0],
                 min(bends, key=lambda one: one[1])[0],
                 left(lambda u: relays(u, 6), train, judge, loops)[0],
                 left(lambda u: relays(u, 10), train, judge, loops)[0]]
        for name, rest in zip(table, rests):
            table[name].append(100 * rest / effect)
        print_rests(table)
    return table


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--densities", type=int, default=24)
    parser.add_argument("--seed", type=int, default=5)
    parser.add_argument("--spring", action="store_true")
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    table = of_springs(rng, given.densities) if given.spring else of_wires(rng, given.densities)
    for name, list_ in table.items():
        print("%-26s median %5.1f %%  worst %5.1f %%" % (name, np.median(list_), max(list_)))


if __name__ == "__main__":
    main()
