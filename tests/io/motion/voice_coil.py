#!/usr/bin/env python3
"""Makes voice_coil.csv, the trace that diagrams/motion/voice_coil.json is held against: the three equations of coil and
stage by the classical Runge-Kutta formula in steps of 4 us (steps of 8 us change the last of ten digits). Uses
nothing of the program."""

from math import pi, sin

RESISTANCE, INDUCTANCE = 5.2, 2.4e-3  # ohm, H
MASS, DAMPING, STIFFNESS = 0.35, 3.0, 3000.0  # kg, N s/m, N/m
AT = [-6e-3, -4e-3, -2e-3, 0.0, 2e-3, 4e-3, 6e-3]  # m
VALUES = [9.1, 11.4, 12.6, 12.9, 12.5, 11.1, 8.8]  # N/A


def force_constant(x):
    """Straight between the knots, held beyond them."""
    if x <= AT[0]:
        return VALUES[0]
    for k in range(1, len(AT)):
        if x <= AT[k]:
            return VALUES[k - 1] + (x - AT[k - 1]) / (AT[k] - AT[k - 1]) * (VALUES[k] - VALUES[k - 1])
    return VALUES[-1]


def rates(t, s):
    current, position, velocity = s
    k = force_constant(position)
    voltage = 7 * sin(2 * pi * 4 * t)
    return ((voltage - RESISTANCE * current - k * velocity) / INDUCTANCE, velocity,
            (k * current - DAMPING * velocity - STIFFNESS * position) / MASS)


def step(t, s, h):
    def ahead(c, k):
        return tuple(x + c * h * d for x, d in zip(s, k))

    k1 = rates(t, s)
    k2 = rates(t + h / 2, ahead(0.5, k1))
    k3 = rates(t + h / 2, ahead(0.5, k2))
    k4 = rates(t + h, ahead(1.0, k3))
    return tuple(x + h / 6 * (a + 2 * (b + c) + d) for x, a, b, c, d in zip(s, k1, k2, k3, k4))


def main():
    steps, rows = 2500, 60  # per row of 10 ms
    s, h = (0.0, 0.0, 0.0), 10e-3 / 2500
    with open("voice_coil.csv", "w") as file:
        file.write("t,coil,stage.position,stage.velocity\n")
        for row in range(rows + 1):
            file.write(",".join(f"{x:.10g}" for x in (row * 10e-3, *s)) + "\n")
            for i in range(steps):
                s = step((row * steps + i) * h, s, h)


main()
