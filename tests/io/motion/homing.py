#!/usr/bin/env python3
"""Makes homing.csv, the trace that diagrams/motion/homing.json is held against: the axis in closed form from one state of
the machine to the next, whose instants are found by bisection. Uses nothing of the program."""

from math import exp

LAG, SETTLED = 0.02, 0.15  # s
VELOCITIES = [-40e-3, 10e-3, -2e-3, 0.0]  # m/s
MEETS, LEAVES = 1.7e-3, 1.9e-3  # m: where the switch closes, and where it opens again
EVERY, END = 7e-3, 4.0  # s; no row at a change


def speed(state, t):
    begin, _, v, wanted = state
    return wanted + (v - wanted) * exp(-(t - begin) / LAG)


def place(state, t):
    begin, x, v, wanted = state
    return x + wanted * (t - begin) + LAG * (v - wanted) * (1 - exp(-(t - begin) / LAG))


def first(holds, begin):
    """The first instant behind `begin` from which on it holds, to the last bit."""
    end = begin
    while not holds(end):
        begin, end = end, end + 1e-4
    while begin < (begin + end) / 2 < end:
        middle = (begin + end) / 2
        begin, end = (begin, middle) if holds(middle) else (middle, end)
    return end


def main():
    searching = (0.0, 30e-3, 0.0, VELOCITIES[0])

    def changed(state, t, wanted):
        return (t, place(state, t), speed(state, t), wanted)

    met = first(lambda t: place(searching, t) <= MEETS, 0.0)
    leaving = changed(searching, met, VELOCITIES[1])
    back = first(lambda t: speed(leaving, t) > 0, met)
    left = max(first(lambda t: place(leaving, t) >= LEAVES, back), met + SETTLED)
    approaching = changed(leaving, left, VELOCITIES[2])
    turned = first(lambda t: speed(approaching, t) < 0, left)
    home = first(lambda t: place(approaching, t) <= MEETS, turned)
    states = [searching, leaving, approaching, changed(approaching, home, VELOCITIES[3])]
    with open(__file__.replace(".py", ".csv"), "w") as f:
        f.write("t,machine.state,axis,position\n")
        for k in range(int(END / EVERY) + 1):
            t = k * EVERY
            now = sum(t >= s[0] for s in states[1:])
            x = place(states[now], t)
            f.write(",".join(f"{v:.10g}" for v in (t, now, x, x - MEETS if now == 3 else x)) + "\n")


if __name__ == "__main__":
    main()
