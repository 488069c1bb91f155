#!/usr/bin/env python3
"""Makes hydraulic_axis.csv, the trace that diagrams/motion/hydraulic_axis.json is held against: classical Runge-Kutta of
25 us, on which all corners of what is wanted lie; halving the step changes no digit that counts. Uses nothing of the
program."""

from math import pi, sqrt

AREA, MASS, DAMPING = 8e-4, 60.0, 800.0  # m^2, kg, N s/m
RATED_FLOW, RATED, SUPPLY, TANK = 0.01 / 60, 35e5, 100e5, 1e5  # m^3/s, Pa
BULK, HALF, LEAKAGE = 1.2e9, 120e-6, 2e-5 / 60  # Pa, m^3, m^3/s
VALVE, VALVE_DAMPING = 2 * pi * 60, 0.8  # rad/s
GAIN = 80.0  # 1/m
STEP, EVERY, END = 25e-6, 5e-3, 1.5  # s


def wanted(t):
    return 0.06 * max(0.0, min(1.0, (t - 0.05) / 0.3, (1.05 - t) / 0.3))


def rates(t, s):
    y, v, pa, pb, x, dx = s
    command = max(-1.0, min(1.0, GAIN * (wanted(t) - y)))
    drops = (SUPPLY - pa, pb - TANK) if x > 0 else (pa - TANK, SUPPLY - pb)
    qa, qb = (RATED_FLOW * x * (d / RATED) / sqrt(abs(d / RATED) + 0.001) for d in drops)
    leak = LEAKAGE * (pa - pb) / RATED
    return (v, (AREA * (pa - pb) - DAMPING * v) / MASS, BULK / (HALF + AREA * y) * (qa - AREA * v - leak),
            BULK / (HALF - AREA * y) * (-qb + AREA * v + leak), dx, VALVE**2 * (command - x) - 2 * VALVE_DAMPING * VALVE * dx)


def moved(s, h, k):
    return [a + h * b for a, b in zip(s, k)]


def main():
    s = [0.0, 0.0, 50e5, 50e5, 0.0, 0.0]
    with open(__file__.replace(".py", ".csv"), "w") as f:
        f.write("t,wanted,mass.position,spool,chamber_a,chamber_b\n")
        for k in range(round(END / STEP) + 1):
            t = k * STEP
            if k % round(EVERY / STEP) == 0:
                f.write(",".join(f"{x:.10g}" for x in (t, wanted(t), s[0], s[4], s[2], s[3])) + "\n")
            k1 = rates(t, s)
            k2 = rates(t + STEP / 2, moved(s, STEP / 2, k1))
            k3 = rates(t + STEP / 2, moved(s, STEP / 2, k2))
            k4 = rates(t + STEP, moved(s, STEP, k3))
            s = [a + STEP / 6 * (p + 2 * (q + r) + w) for a, p, q, r, w in zip(s, k1, k2, k3, k4)]


if __name__ == "__main__":
    main()
