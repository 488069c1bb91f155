#!/usr/bin/env python3
"""Devices of the literature made anew from their published equations: recordings, a model as a user would begin with,
and a data set of each, in a folder that `measured FOLDER` goes through.

    make_benches.py FOLDER [--only tanks,coupled_drives]

What each lacks stands in its function. The equations are integrated here by Kutta's formula (or in steps far below the
recordings' own) and share nothing with the program's blocks. Seeds are fixed: a bench depends on this file alone.
"""

import argparse
import json
import pathlib

import numpy as np
from scipy.signal import butter, cheby1, sosfilt


class Bench:
    """One folder entry: recordings NAME_1.csv ..., NAME.json, NAME.data.json."""

    def __init__(self, folder, name):
        self.folder, self.name, self.recordings = folder, name, []

    def record(self, role, t, columns, **notes):
        """columns: {"u [V]": values}, the time column comes first."""
        file = f"{self.name}_{len(self.recordings) + 1}.csv"
        head = ",".join(["t [s]", *columns])
        np.savetxt(self.folder / file, np.column_stack([t, *columns.values()]), delimiter=",", header=head, comments="",
                   fmt="%.10g")
        self.recordings.append({"file": file, "role": role, **notes})

    def finish(self, title, source, model, inputs):
        """inputs: how each moves between its samples; the other columns are outputs."""
        columns = {name: {"to": name, "between_samples": how} for name, how in inputs.items()}
        columns |= {name: {"to": name} for name in model["outputs"]}
        self._write(".json", {"format": 1, "title": title, "source": source, **model})
        self._write(".data.json", {"format": 1, "title": title, "columns": columns, "recordings": self.recordings})

    def _write(self, end, content):
        (self.folder / (self.name + end)).write_text(json.dumps(content, indent=1) + "\n")


def free(value, low=None, high=None):
    parameter = {"value": value, "free": True}
    return parameter if low is None else {**parameter, "bounds": [low, high]}


def multisine(rows, rate, low, high, rms, seed, over=1):
    """Random phases between low and high [Hz], periodic in `rows` samples, `over` times as fine."""
    phases = np.random.default_rng(seed)
    spectrum = np.zeros(rows * over // 2 + 1, complex)
    f = np.arange(len(spectrum)) * rate / rows
    inside = (f >= low) & (f <= high)
    spectrum[inside] = np.exp(2j * np.pi * phases.random(inside.sum()))
    x = np.fft.irfft(spectrum, rows * over)
    return x * rms / np.std(x)


def kutta(rate, x, h, before, after):
    middle = 0.5 * (before + after)
    k1 = rate(x, before)
    k2 = rate(x + 0.5 * h * k1, middle)
    k3 = rate(x + 0.5 * h * k2, middle)
    k4 = rate(x + h * k3, after)
    return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def along(rate, x, fine, h, every):
    """State at every `every`-th of the fine samples; inputs straight between them."""
    states = np.empty((len(fine) // every, len(x)))
    for i in range(len(states) * every):
        if i % every == 0:
            states[i // every] = x
        x = kutta(rate, x, h, fine[i], fine[min(i + 1, len(fine) - 1)])
    return states


def tanks(folder):
    """Lacks: the outflow by the root of the level, in both tanks."""
    bench = Bench(folder, "tanks")
    rows, step, parts = 1024, 4.0, 40
    for seed, role in ((1, "train"), (2, "validate")):
        u = np.maximum(2.0 + multisine(rows, 1 / step, 0.0005, 0.0144, 0.75, seed), 0)
        noise = np.random.default_rng(seed)
        upper = lower = 4.0
        y = np.empty(rows)
        for i in range(rows):
            y[i] = lower
            for _ in range(parts):
                out = 0.05 * np.sqrt(upper)
                upper += step / parts * (0.06 * u[i] - out)
                lower = max(lower + step / parts * (out - 0.05 * np.sqrt(lower)), 0.0)
        bench.record(role, np.arange(rows) * step, {"u [V]": u, "y [V]": y + 0.02 * noise.standard_normal(rows)},
                     initial={})
    tank = {"type": "tank", "area": "1 m^2", "reference": "1 m"}
    bench.finish(
        "Two tanks in a row, linear outlets", "Schoukens, Noel, Cascaded tanks benchmark (2016)",
        {
            "parameters": {
                "pump": free("0.06 m^3/s/V"), "zero": free("0 V"),
                "upper": free("0.03 m^3/s", "1e-4 m^3/s", "1 m^3/s"),
                "lower": free("0.03 m^3/s", "1e-4 m^3/s", "1 m^3/s"),
                "upper_start": free("4 m", "0 m", "20 m"), "lower_start": free("4 m", "0 m", "20 m"),
            },
            "inputs": {"u": {"unit": "V"}},
            "blocks": {
                "pump": {"type": "gain", "gain": "$pump", "in": "u"},
                "tank1": {**tank, "outlet": "$upper", "initial": "$upper_start", "in": "pump"},
                "tank2": {**tank, "outlet": "$lower", "initial": "$lower_start", "in": "tank1.outflow"},
                "sensor": {"type": "calibration", "gain": "1 V/m", "offset": "$zero", "in": "tank2.level"},
            },
            "outputs": {"y": "sensor"},
        }, {"u": "hold"})


def coupled_drives(folder):
    """Lacks: the sensor tells no sign, and the belt a resonance."""
    bench = Bench(folder, "coupled_drives")
    rows, step, parts = 2000, 0.02, 10
    frequency, damping = 8.0, 0.06

    def rate(x, u):
        return np.array([0.4 * (6 * u - x[0]), x[2], frequency**2 * (x[0] - x[1]) - 2 * damping * frequency * x[2]])

    for seed, role, top in ((1, "train", 1.5), (2, "validate", 1.0), (3, "test", 1.2)):
        draws = np.random.default_rng(seed)
        u = draws.uniform(-top, top, rows // 20).repeat(20)
        states = along(rate, np.zeros(3), u.repeat(parts), step / parts, parts)
        y = np.abs(states[:, 1]) + 0.01 * draws.standard_normal(rows)
        bench.record(role, np.arange(rows) * step, {"u [V]": u, "y [V]": y}, initial={})
    bench.finish(
        "Coupled drives: voltage to the speed of the pulley, one lag", "Wigren, Schoukens, Uppsala report 2017-024",
        {
            "parameters": {"gain": free("1 V/V"), "time": free("1 s", "0.01 s", "100 s")},
            "inputs": {"u": {"unit": "V"}},
            "blocks": {
                "drive": {"type": "gain", "gain": "$gain", "in": "u"},
                "pulley": {"type": "lag", "times": "$time", "in": "drive"},
            },
            "outputs": {"y": "pulley"},
        }, {"u": "hold"})


def bouc_wen(folder):
    """Lacks: the hysteresis of the spring."""
    bench = Bench(folder, "bouc_wen")
    rows, rate_of_rows, parts = 8192, 750, 20
    mass, damping, stiffness, alpha, beta, gamma, delta = 2, 10, 5e4, 5e4, 1e3, 0.8, -1.1

    def rate(x, u):
        v, z = x[1], x[2]
        return np.array([v, (u - damping * v - stiffness * x[0] - z) / mass,
                         alpha * v - beta * (gamma * abs(v) * z + delta * v * abs(z))])

    for seed, role in ((1, "train"), (2, "validate")):
        fine = np.tile(multisine(rows, rate_of_rows, 5, 150, 50, seed, parts), 2)
        y = along(rate, np.zeros(3), fine, 1 / rate_of_rows / parts, parts)[rows:, 0]
        y += 8e-6 * np.random.default_rng(seed).standard_normal(rows)
        bench.record(role, np.arange(rows) / rate_of_rows, {"u [N]": fine[rows * parts::parts], "y [m]": y},
                     initial={}, skip="1 s")
    bench.finish(
        "Bouc-Wen oscillator: linear", "Noel, Schoukens, Hysteretic benchmark with a dynamic nonlinearity (2016)",
        {
            "parameters": {"stiffness": free("8e4 N/m", "1e3 N/m", "1e7 N/m"),
                           "damping": free("20 N*s/m", "0.1 N*s/m", "1e4 N*s/m")},
            "inputs": {"u": {"unit": "N"}},
            "blocks": {"body": {"type": "mass_spring_damper", "mass": "2 kg", "stiffness": "$stiffness",
                                "damping": "$damping", "in": "u"}},
            "outputs": {"y": "body.position"},
        }, {"u": "smooth"})


def position_drive(folder):
    """Lacks: friction. In closed loop; judged without it, as two integrations of what is left."""
    bench = Bench(folder, "position_drive")
    step, parts, rows = 1e-3, 20, 24800
    mass, viscous, coulomb, offset = 95.1, 203.5, 20.4, -3.2

    def smoothed(levels):
        fine = np.repeat(levels, rows // len(levels) + 1)[:rows]
        for width in (800, 270):
            sums = np.cumsum(np.concatenate([np.zeros(width), fine]))
            fine = (sums[width:] - sums[:-width]) / width
        return fine

    for seed, role, levels in ((1, "train", [0, 0.1, 0.24, 0.05, 0.2, 0.15, 0.02, 0]),
                               (2, "validate", [0, 0.2, 0.1, 0.22, 0.04, 0.12, 0.24, 0])):
        noise, wanted = np.random.default_rng(seed), smoothed(levels)
        q = v = 0.0
        u, y = np.empty(rows), np.empty(rows)
        for i in range(rows):
            y[i] = np.round(q / 1e-6) * 1e-6
            speed = v + 1e-4 * noise.standard_normal()
            u[i] = np.clip(243.45 * (160.18 * (wanted[i] - y[i]) - speed) / 35.15, -10, 10)
            for _ in range(parts):
                force = 35.15 * u[i] - viscous * v - coulomb * np.tanh(v / 2e-4) - offset
                v += step / parts * force / mass
                q += step / parts * v
        bench.record(role, np.arange(rows) * step, {"u [V]": u, "y [m]": y}, initial={})
    bench.finish(
        "Position drive: a mass with viscous damping", "Janot, Gautier, Brunot, EMPS benchmark (2019)",
        {
            "parameters": {"force": free("35 N/V"), "offset": free("0 N"),
                           "damping": free("200 N*s/m", "0.1 N*s/m", "1e4 N*s/m")},
            "inputs": {"u": {"unit": "V"}},
            "blocks": {
                "drive": {"type": "calibration", "gain": "$force", "offset": "$offset", "in": "u"},
                "body": {"type": "mass_spring_damper", "mass": "95.1 kg", "stiffness": "0 N/m",
                         "damping": "$damping", "in": "drive"},
            },
            "outputs": {"y": "body.position"},
        }, {"u": "hold"})


def motor(folder):
    """Lacks: friction with Stribeck's excess, of the bristles of LuGre."""
    bench = Bench(folder, "motor")
    step, parts, rows = 1e-3, 20, 10000
    inertia, torque, resistance, viscous = 2e-4, 0.05, 1.2, 1e-5
    coulomb, sticking, stribeck, bristle, contact = 0.03, 0.045, 1.5, 8.0, 0.02
    t = np.arange(rows) * step

    def rate(x, u):
        w, z = x
        slides = coulomb + (sticking - coulomb) * np.exp(-((w / stribeck) ** 2))
        moves = w - bristle * abs(w) / slides * z
        friction = bristle * z + contact * moves
        return np.array([(torque * (u - torque * w) / resistance - viscous * w - friction) / inertia, moves])

    for seed, role in ((1, "train"), (2, "validate"), (3, "test")):
        draws = np.random.default_rng(seed)
        u = draws.uniform(-8, 8, rows // 500).repeat(500)
        if role == "validate":
            u = 6 * np.sin(2 * np.pi * (0.3 * t + 0.2 * t * t)) * (1 + 0.2 * np.sin(3 * t))
        w, z, y = 0.0, 0.0, np.empty(rows)
        for i in range(rows):  # bristles are stiff: held input, small steps
            y[i] = w
            for _ in range(parts):
                dw, dz = rate((w, z), u[i])
                w, z = w + step / parts * dw, z + step / parts * dz
        bench.record(role, t, {"u [V]": u, "w [rad/s]": y + 0.3 * draws.standard_normal(rows)}, initial={})
    bench.finish(
        "Motor: voltage to speed, one rotating mass",
        "Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419",
        {
            "remark": "1 m of the circumference is 1 rad",
            "parameters": {"torque": free("0.04 N/V"),
                           "damping": free("0.002 N*s/m", "1e-6 N*s/m", "1 N*s/m")},
            "inputs": {"u": {"unit": "V"}},
            "blocks": {
                "drive": {"type": "gain", "gain": "$torque", "in": "u"},
                "rotor": {"type": "mass_spring_damper", "mass": "0.2 g", "stiffness": "0 N/m",
                          "damping": "$damping", "in": "drive"},
                "speed": {"type": "gain", "gain": "1 rad/m", "in": "rotor.velocity"},
            },
            "outputs": {"w": "speed"},
        }, {"u": "hold"})


def reluctance(folder):
    """Lacks: a force by the square of current over gap: a curve of the command and a spring that softens."""
    bench = Bench(folder, "reluctance")
    rows, rate_of_rows, parts = 10000, 5000, 10
    mass, damping, stiffness, gap, constant = 0.3, 60.0, 6e4, 1e-3, 1.5e-5

    def rate(x, i):
        force = constant * (((1 + i) / (gap - x[0])) ** 2 - 1 / gap**2)
        return np.array([x[1], (force - damping * x[1] - stiffness * x[0]) / mass])

    for seed, role in ((1, "train"), (2, "validate"), (3, "test")):
        fine = multisine(rows, rate_of_rows, 1, 200, 0.07, seed, parts)
        if role == "test":
            t = np.arange(rows * parts) / rate_of_rows / parts
            fine = 0.04 * np.sin(2 * np.pi * (3 * t + 20 * t * t))
        y = along(rate, np.zeros(2), fine, 1 / rate_of_rows / parts, parts)[:, 0]
        y += 2e-7 * np.random.default_rng(seed).standard_normal(rows)
        bench.record(role, np.arange(rows) / rate_of_rows, {"i [A]": fine[::parts], "y [m]": y}, initial={})
    bench.finish(
        "Reluctance actuator about its working point", "Maxwell's pull, F = c (i/gap)^2",
        {
            "parameters": {"force": free("30 N/A"), "stiffness": free("2e4 N/m", "1e3 N/m", "1e6 N/m"),
                           "damping": free("10 N*s/m", "0.01 N*s/m", "500 N*s/m")},
            "inputs": {"i": {"unit": "A"}},
            "blocks": {
                "coil": {"type": "gain", "gain": "$force", "in": "i"},
                "armature": {"type": "mass_spring_damper", "mass": "0.3 kg", "stiffness": "$stiffness",
                             "damping": "$damping", "in": "coil"},
            },
            "outputs": {"y": "armature.position"},
        }, {"i": "smooth"})


def wiener_hammerstein(folder):
    """Lacks: a diode between two filters: no effect of the list enters there."""
    bench = Bench(folder, "wiener_hammerstein")
    rows, rate_of_rows, parts = 16384, 51200, 4
    for seed, role in ((11, "train"), (12, "validate")):
        u = multisine(rows, rate_of_rows, 20, 10000, 0.6, seed, parts)
        before = sosfilt(cheby1(3, 0.5, 4400, fs=rate_of_rows * parts, output="sos"), np.tile(u, 2))
        diode = np.where(before > 0.3, 0.3 + 0.25 * (before - 0.3), before)
        y = sosfilt(butter(3, 5000, fs=rate_of_rows * parts, output="sos"), diode)[rows * parts::parts]
        y = y + 1e-3 * np.random.default_rng(seed).standard_normal(rows)
        bench.record(role, np.arange(rows) / rate_of_rows, {"u [V]": u[::parts], "y [V]": y}, skip="20 ms")
    pair = {"type": "resonance"}
    bench.finish(
        "Two filters in a row", "Schoukens, Suykens, Ljung, Wiener-Hammerstein benchmark (2009)",
        {
            "parameters": {
                "gain": free("0.9 V/V"),
                "real": free("30 us", "1 us", "1 ms"), "pair": free("5 kHz", "1 kHz", "20 kHz"),
                "damping": free("0.3", "0.02", "0.98"),
                "real2": free("32 us", "1 us", "1 ms"), "pair2": free("5 kHz", "1 kHz", "20 kHz"),
                "damping2": free("0.5", "0.02", "0.98"),
            },
            "inputs": {"u": {"unit": "V"}},
            "blocks": {
                "lag1": {"type": "lag", "times": "$real", "in": "u"},
                "filter1": {**pair, "frequency": "$pair", "damping": "$damping", "in": "lag1"},
                "between": {"type": "gain", "gain": "$gain", "in": "filter1"},
                "lag2": {"type": "lag", "times": "$real2", "in": "between"},
                "filter2": {**pair, "frequency": "$pair2", "damping": "$damping2", "in": "lag2"},
            },
            "outputs": {"y": "filter2"},
        }, {"u": "smooth"})


BENCHES = {f.__name__: f for f in (bouc_wen, coupled_drives, motor, position_drive, reluctance, tanks,
                                   wiener_hammerstein)}


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("folder", type=pathlib.Path)
    words.add_argument("--only", default=",".join(BENCHES), help="names with commas")
    wish = words.parse_args()
    wish.folder.mkdir(parents=True, exist_ok=True)
    for name in wish.only.split(","):
        if name not in BENCHES:
            words.error(f"there is no bench {name!r}; known: {', '.join(BENCHES)}")
        BENCHES[name](wish.folder)


if __name__ == "__main__":
    main()
