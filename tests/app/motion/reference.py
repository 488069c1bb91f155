#!/usr/bin/env python3
"""The traces that tests hold the diagrams of diagrams/motion against, from their equations alone: nothing of the program
is used. Writes ball_screw_cascade.csv, heater.csv and belt_drive.csv beside itself:

    python3 tests/app/motion/reference.py

Classical Runge-Kutta of fixed steps (10 us for the drives, 20 ms for the heater) in plain Python; halving the steps
changes no digit that is written, but for the last of some (play: contacts begin within a step).
"""

import math
import os

FOLDER = os.path.dirname(os.path.abspath(__file__))


def write(name, header, rows):
    with open(os.path.join(FOLDER, name), "w") as f:
        f.write(",".join(header) + "\n")
        for row in rows:
            f.write(",".join("%.9g" % x for x in row) + "\n")


class Moves:
    """Jerk-limited moves as pieces of constant jerk; the speed of a short one by halving."""

    def __init__(self, begin, places, v, a, j, dwell):
        self.pieces = [(-1e9, 0.0, 0.0, 0.0, 0.0)]  # begin, x, v, a, j
        t, x = begin, 0.0
        for place in places:
            t = self.move(t, x, place - x, v, a, j) + dwell
            x = place
        self.last = 0

    def move(self, t, x, way, v, a, j):
        sign, d = (-1 if way < 0 else 1), abs(way)

        def times(speed):
            most = min(a, math.sqrt(speed * j))
            return most / j, speed / most - most / j

        def needed(speed):
            jerked, even = times(speed)
            return speed * (2 * jerked + even)

        low, high = 0.0, v
        if needed(v) <= d:
            low = v
        else:
            for _ in range(200):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if needed(middle) <= d else (low, middle)
        jerked, even = times(low)
        cruise = max(0.0, (d - needed(low)) / low)
        speed = acceleration = 0.0
        for jerk, duration in ((j, jerked), (0, even), (-j, jerked), (0, cruise), (-j, jerked), (0, even), (j, jerked)):
            jerk *= sign
            self.pieces.append((t, x, speed, acceleration, jerk))
            s = duration
            x += s * (speed + s * (acceleration / 2 + s * jerk / 6))
            speed += s * (acceleration + s * jerk / 2)
            acceleration += s * jerk
            t += s
        self.pieces.append((t, x, 0.0, 0.0, 0.0))
        return t

    def __call__(self, t):
        while self.last + 1 < len(self.pieces) and self.pieces[self.last + 1][0] <= t:
            self.last += 1
        while self.pieces[self.last][0] > t:
            self.last -= 1
        begin, x, v, a, j = self.pieces[self.last]
        s = t - begin
        return x + s * (v + s * (a / 2 + s * j / 6)), v + s * (a + s * j / 2), a + s * j


def integrate(rates, x, h, steps, each, record):
    rows = [record(0.0, x)]
    for k in range(steps):
        t = k * h
        k1 = rates(t, x)
        k2 = rates(t + h / 2, [a + h / 2 * b for a, b in zip(x, k1)])
        k3 = rates(t + h / 2, [a + h / 2 * b for a, b in zip(x, k2)])
        k4 = rates(t + h, [a + h * b for a, b in zip(x, k3)])
        x = [a + h / 6 * (b + 2 * (c + d) + e) for a, b, c, d, e in zip(x, k1, k2, k3, k4)]
        if (k + 1) % each == 0:
            rows.append(record((k + 1) * h, x))
    return rows


def limited(low, high, x):
    return max(low, min(high, x))


def ball_screw_cascade(h=1e-5):
    r = Moves(0.05, (0.2, 0.1999, 0.05), 0.3, 5.0, 200.0, 0.1)
    lead = 5e-3 / (2 * math.pi)
    kp, ki, top, efficiency = 0.5, 60.0, 10.0, 0.9

    def parts(t, x):
        angle, w, place, v, integral = x
        want, speed, acceleration = r(t)
        error = (60 * (want - lead * angle) + speed) / lead - w
        raw = kp * error + integral
        given = limited(-top, top, raw)
        ahead, rate = lead * angle - place, lead * w - v
        force = 0.0
        if ahead > 10e-6:
            force = max(0.0, 50e6 * (ahead - 10e-6) + 5e3 * rate)
        elif ahead < -10e-6:
            force = min(0.0, 50e6 * (ahead + 10e-6) + 5e3 * rate)
        back = force * lead
        mean, half = 0.5 * (1 / efficiency + efficiency), 0.5 * (1 / efficiency - efficiency)
        felt = back * mean + abs(back) * half * math.tanh(w / 0.01)
        d_integral = ki * error + (given - raw) / (kp / ki)
        dw = (given + 1.296426 * acceleration - felt - 1e-3 * w) / 1e-3
        return given, force, [w, dw, v, (force - 200 * v) / 50, d_integral], want

    def record(t, x):
        given, force, _, want = parts(t, x)
        return t, want, x[2], x[1], given, force

    rows = integrate(lambda t, x: parts(t, x)[2], [0.0] * 5, h, round(2 / h), round(0.01 / h), record)
    write("ball_screw_cascade.csv",
          ["t [s]", "move.position [m]", "table.position [m]", "motor.velocity [rad/s]", "speed [N m]",
           "screw.force [N]"], rows)


def belt_drive(h=1e-5):
    r = Moves(0.1, (0.4, 0.0), 1.0, 8.0, 400.0, 0.2)
    radius, kp, ti, top = 0.02, 0.25, 0.04, 12.0
    w0, z, depth = 2 * math.pi * 57, 0.6, 0.1

    def parts(t, x):
        angle, w, place, v, integral, q, dq = x
        want, speed, _ = r(t)
        error = (25 * (want - radius * angle) + speed) / radius - w
        raw = kp * error + integral
        given = limited(-top, top, raw)
        torque = given - 2 * (1 - depth) * z * w0 * dq  # 1 - 2 (1 - depth) z w0 s/(s^2 + 2 z w0 s + w0^2)
        force = 120e3 * (radius * angle - place) + 40 * (radius * w - v)
        return given, force, [w, (torque - radius * force - 2e-3 * w) / 6e-4, v, (force - 15 * v) / 5,
                              kp / ti * error + (given - raw) / ti, dq, given - 2 * z * w0 * dq - w0 * w0 * q], want

    def record(t, x):
        given, force, _, want = parts(t, x)
        return t, want, x[2], x[1], given, force

    rows = integrate(lambda t, x: parts(t, x)[2], [0.0] * 7, h, round(1.8 / h), round(0.01 / h), record)
    write("belt_drive.csv",
          ["t [s]", "move.position [m]", "carriage.position [m]", "motor.velocity [rad/s]", "speed [N m]",
           "belt.force [N]"], rows)


def heater(h=0.02):
    kp, ki, kd, filtered, period, tracking = 8.0, 0.05, 60.0, 3.0, 1.0, 40.0
    want = lambda t: 298.15 if t < 60 else 353.15 if t < 900 else 323.15
    x = [298.15, 298.15, 298.15]  # heater, plate, sensor [K]
    integral = rate = 0.0
    last, rows = x[2], []
    for k in range(1501):
        measured = x[2]
        rate = (filtered * rate - (measured - last)) / (filtered + period)
        last = measured
        error = want(k) - measured
        raw = kp * error + integral + kd * rate
        power = limited(0.0, 120.0, raw)
        integral += ki * period * error + period / tracking * (power - raw)
        if k % 5 == 0:
            rows.append((float(k), want(k), power, x[1], x[2]))

        def rates(_, y):
            return [(power + 6 * (y[1] - y[0]) + 0.1 * (298.15 - y[0])) / 120,
                    (6 * (y[0] - y[1]) + 1.2 * (298.15 - y[1])) / 400, (y[1] - y[2]) / 6]

        steps = round(period / h)
        x = integrate(rates, x, h, steps, steps, lambda _, y: y)[-1]
    write("heater.csv", ["t [s]", "wanted [K]", "control [W]", "of_plate [K]", "sensor [K]"], rows)


if __name__ == "__main__":
    heater()
    belt_drive()
    ball_screw_cascade()
