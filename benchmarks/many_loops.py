#!/usr/bin/env python3
"""Jiles-Atherton loops in many parameter sets with NumPy, vectorized over the sets: CPU time of a step of one set.

benchmarks/many_loops.py            two periods of 2000 points of 3 - 3 cos, as build/benchmarks/hysteron_loops
benchmarks/many_loops.py --check    the share of draws that the filters of the thesis' Monte Carlo study accept

Needs python3-numpy.
"""
import sys
import time

import numpy as np


def slope(field, p, direction, law):
    p_s, a, alpha, k, c = law
    h = np.tanh((field + alpha * p) / a)
    q = p_s * h - p
    s = c * p_s * (1 - h * h)
    g = direction * (1 - c) * k - alpha * q
    return ((1 - c) * a * q + s * g) / (g * (a - alpha * s))


def loops(law, top, rk4, kept):
    """Polarisation at the rows `kept` of two periods of 2000 points."""
    w, half = 2 * np.pi / 2000, top / 2
    p, rows = np.zeros_like(law[0]), {}
    field = lambda x: half - half * np.cos(w * x)
    rate = lambda x: half * np.sin(w * x) * w

    def f(x, at):
        v = rate(x)
        return v * slope(field(x), at, -1.0 if v < 0 else 1.0, law)

    for i in range(4001):
        if i in kept:
            rows[i] = p.copy()
        if i == 4000:
            break
        k1 = f(i, p)
        if not rk4:
            p = p + k1
            continue
        k2 = f(i + 0.5, p + 0.5 * k1)
        k3 = f(i + 0.5, p + 0.5 * k2)
        k4 = f(i + 1, p + k3)
        p = p + (k1 + 2 * (k2 + k3) + k4) / 6
    return rows


def drawn(n, low, high, seed=1):
    random = np.random.default_rng(seed)
    return [l + (h - l) * random.random(n) for l, h in zip(low, high)]


def main():
    np.seterr(all="ignore")
    if "--check" in sys.argv:
        law = drawn(100000, (1, 1, 0.005, 0.01, 0.001), (100, 100, 0.5, 10, 0.999))
        rows = loops(law, 1.0, True, (1000, 2000, 4000))
        half, one, two = rows[1000], rows[2000], rows[4000]
        passed = [half > 0, one >= 0, one / two > 0.98]
        print("4.6 %.4f, 4.7 %.4f, 4.8 %.4f, all %.4f" % (*[x.mean() for x in passed], np.all(passed, axis=0).mean()))
        return
    law = drawn(1000, (5, 2, 0.01, 0.5, 0.05), (15, 6, 0.2, 3, 0.6))
    for name, rk4 in (("Euler", False), ("RK4", True)):
        times = []
        for _ in range(5):
            begin = time.process_time()
            loops(law, 6.0, rk4, (2000, 3000, 4000))
            times.append(time.process_time() - begin)
        print("%-6s NumPy, 1000 sets at once: %.1f ns a step" % (name, sorted(times)[2] / 4e6 * 1e9))


main()
