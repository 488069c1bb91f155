#!/usr/bin/env python3
"""Makes pwm_motor.csv, the trace that diagrams/motion/pwm_motor.json is held against: between the edges of the pulses,
which stand in closed form, current and speed move by a matrix exponential. Uses nothing of the program."""

from math import floor

SUPPLY, BRIDGE = 24.0, 0.1  # V, ohm
RESISTANCE, INDUCTANCE = 1.4, 1.1e-3  # ohm, H
CONSTANT = 0.046  # V s/rad = N m/A
INERTIA, FRICTION = 2.1e-5, 3e-5  # kg m^2, N m s/rad
CARRIER = 0.5e-3  # s, one period
DUTIES, DURATION = [0.6, -0.3, 0.1], 20e-3  # s


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def exponential(a):
    """Series of a/2^12, squared twelve times."""
    term = [[float(i == j) for j in range(3)] for i in range(3)]
    total = [row[:] for row in term]
    small = [[x / 4096 for x in row] for row in a]
    for n in range(1, 12):
        term = [[x / n for x in row] for row in product(term, small)]
        total = [[x + y for x, y in zip(p, q)] for p, q in zip(total, term)]
    for _ in range(12):
        total = product(total, total)
    return total


def moved(state, voltage, h):
    """Current and speed h later under a constant voltage."""
    a = [[-(RESISTANCE + BRIDGE) / INDUCTANCE, -CONSTANT / INDUCTANCE, voltage / INDUCTANCE],
         [CONSTANT / INERTIA, -FRICTION / INERTIA, 0.0],
         [0.0, 0.0, 0.0]]
    e = exponential([[x * h for x in row] for row in a])
    return [e[r][0] * state[0] + e[r][1] * state[1] + e[r][2] for r in range(2)]


def gate(duty, share):
    """Of a bridge whose legs switch by themselves, at a share of the period of a triangle that begins at -1."""
    carrier = 1 - 4 * abs(share - 0.5)
    return int(duty > carrier) - int(-duty > carrier)


def pieces(until):
    """(end, gate) of the stretches between the edges."""
    for k in range(round(until / CARRIER)):
        duty = DUTIES[min(floor(k * CARRIER / DURATION + 1e-9), len(DUTIES) - 1)]
        edges = sorted({(1 + duty) / 4, 1 - (1 + duty) / 4, (1 - duty) / 4, 1 - (1 - duty) / 4, 1.0})
        begin = 0.0
        for end in edges:
            yield (k + end) * CARRIER, gate(duty, (begin + end) / 2)
            begin = end


def main():
    until, every = 60e-3, 0.37e-3
    rows, state, t = [], [0.0, 0.0], 0.0
    for end, switched in pieces(until):
        while (next_row := len(rows) * every) <= end and next_row <= until:
            rows.append([next_row, *moved(state, SUPPLY * switched, next_row - t)])
        state, t = moved(state, SUPPLY * switched, end - t), end
    with open("pwm_motor.csv", "w") as file:
        file.write("t,motor.current,motor.velocity\n")
        for row in rows:
            file.write(",".join(f"{x:.10g}" for x in row) + "\n")


main()
