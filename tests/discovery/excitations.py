"""What a laboratory plays into a device: drives, temperatures, hours and cycle counts of the recordings of a case.

Decides the shape, length and step of a recording; every drive starts at 0.
Does not decide which recordings a hidden effect needs (hidden.py).
"""
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Recording:
    word: str
    role: str
    h: float                 # s between rows
    u: list                  # drives, one per axis [V]
    temperature: np.ndarray  # true, [degC]; for B5 the ambient
    start_h: float = 0.0
    cycles_before: int = 0
    index: int = 0
    extra: dict = field(default_factory=dict)

    @property
    def t(self):
        return self.h * np.arange(len(self.u[0]))


# ---- shapes between 0 and 1 (s: seconds of a row, n: rows) --------------------------------------------------------------

def sines(rng, n, h, frequency, amplitudes):
    phase = 2 * np.pi * frequency * h * np.arange(n)
    which = np.minimum((phase / (2 * np.pi * max(1, round(phase[-1] / 2 / np.pi / len(amplitudes))))).astype(int),
                       len(amplitudes) - 1)
    return np.asarray(amplitudes)[which] * (1 - np.cos(phase)) / 2


def triangle(rng, n, levels):
    """Up to each level and back to below its half; every flank takes the same time."""
    turns = [0.0]
    for level in levels:
        turns += [level, level * rng.uniform(0, 0.5)]
    return np.interp(np.linspace(0, len(turns) - 1, n), np.arange(len(turns)), turns)


def segments(rng, n, h, frequencies):
    """Whole periods of one frequency after the other, the last one at full height."""
    pieces = []
    share = n * h / len(frequencies)
    for f in frequencies:
        periods = max(1, round(share * f))
        count = max(4, round(periods / f / h))
        height = 1 if f == frequencies[-1] else rng.uniform(0.6, 1)
        pieces.append(height * (1 - np.cos(2 * np.pi * periods * np.arange(count) / count)) / 2)
    return np.concatenate(pieces)[:max(n, 500)]


def holds(rng, n, levels, rest):
    """Rest, then one level after the other; each jump takes one row."""
    cuts = np.sort(rng.uniform(0.75, 1.25, len(levels)).cumsum())
    cuts = rest + (cuts / cuts[-1] * (n - rest)).astype(int)
    u = np.zeros(n)
    start = rest
    for level, stop in zip(levels, cuts):
        u[start:stop] = level
        start = stop
    return u


def multisine(rng, n, h, highest, lines=40):
    t = h * np.arange(n)
    f = np.unique(np.round(np.geomspace(3 / (n * h), highest, lines) * n * h)) / (n * h)
    x = sum(np.cos(2 * np.pi * q * t + rng.uniform(0, 2 * np.pi)) for q in f)
    rise = np.minimum(1, t / (0.04 * t[-1]))
    rise = rise * rise * (3 - 2 * rise)
    return rise * (0.5 + 0.5 * x / np.abs(x).max())


def chirp(rng, n, h, low, high):
    t = h * np.arange(n)
    rate = np.log(high / low) / t[-1]
    return (1 - np.cos(2 * np.pi * low / rate * (np.exp(rate * t) - 1))) / 2


# ---- recordings of an actuator (B1, B2, B3) -------------------------------------------------------------------------------

def actuator_drive(rng, word, n, h, high):
    if word == "sine_multiamp":
        up = np.linspace(rng.uniform(0.1, 0.3), 1, rng.integers(4, 9))
        u = high * sines(rng, n, h, rng.uniform(0.008, 0.02) / h, up if rng.random() < 0.7 else rng.permutation(up))
    elif word == "triangle":
        u = high * triangle(rng, n, np.append(1.0, rng.uniform(0.2, 1, rng.integers(4, 10))))
    elif word == "freq_low":
        u = high * segments(rng, n, h, np.geomspace(3, 60, 3) / (n * h))
    elif word == "freq_high":
        u = high * segments(rng, n, h, np.geomspace(0.008, rng.uniform(0.03, 0.06), rng.integers(3, 6)) / h)
    elif word in ("step_hold", "steps"):
        levels = rng.uniform(0.2, 1, rng.integers(2, 4) if word == "step_hold" else rng.integers(6, 14))
        levels[0] = 1  # the same first jump in every recording of this kind
        u = high * holds(rng, n, levels, int(rng.integers(10, 40)))
    elif word == "multisine":
        u = high * multisine(rng, n, h, rng.uniform(0.12, 0.2) / h)
        if rng.random() < 0.6:
            tail = n // 4
            u[-tail:] = high * holds(rng, tail, rng.uniform(0, 1, 5), 4)
    elif word == "chirp":
        u = high * chirp(rng, n, h, 3 / (n * h), rng.uniform(0.05, 0.12) / h)
    else:  # temperature courses: a slow sine throughout
        u = high * sines(rng, n, h, 1 / (h * rng.uniform(60, 150)), [1.0])
    return u


STEP_S = dict(sine_multiamp=(2e-3, 8e-3), triangle=(3e-3, 8e-3), freq_low=(8e-3, 2e-2), freq_high=(1.6e-4, 4e-4),
              step_hold=(0.03, 0.1), steps=(2.5e-4, 1e-3), multisine=(1.6e-4, 2.6e-4), chirp=(2e-4, 5e-4),
              temp_staircase=(0.6, 2), temp_ramp=(0.6, 2))


def rows_of(rng):
    """500 .. 20000 rows; mostly 1000 .. 2500, now and then a long recording."""
    return int(rng.uniform(5000, 20000)) if rng.random() < 0.02 else int(rng.uniform(900, 2400))


def temperature_course(rng, word, t, rest=22.0):
    x = t / t[-1]
    start = rest + rng.uniform(-0.25, 0.25)
    if word == "temp_staircase":
        levels = np.linspace(start, rng.uniform(35, 70), rng.integers(3, 6))
        if rng.random() < 0.5:
            levels = np.append(levels, levels[1])
        steps = np.interp(x * len(levels), np.ravel([[k, k + 0.85] for k in range(len(levels))]), np.repeat(levels, 2))
        return steps
    if word == "temp_ramp":
        high = rng.uniform(30, 65)
        return np.interp(x, [0, 0.08, rng.uniform(0.4, 0.7), 1], [start, start, high, rng.uniform(start, high)])
    return start + rng.uniform(-0.05, 0.05) * x + 0.02 * np.sin(2 * np.pi * x * rng.uniform(0.5, 2) + rng.uniform(0, 6)) * x


def actuator_recording(rng, word, role, top, axes, habits):
    """habits: what the laboratory does alike each time it plays a word, the row's step and the height."""
    if word not in habits:
        habits[word] = float("%.2g" % np.exp(rng.uniform(*np.log(STEP_S[word])))), rng.uniform(0.65, 1)
    h, height = habits[word]
    n = rows_of(rng)
    u = [actuator_drive(rng, word, n, h, top * height)]
    if axes == 2:
        other = word if rng.random() < 0.5 or word.startswith("temp") else rng.choice(["sine_multiamp", "triangle", "steps"])
        u.append(actuator_drive(rng, other, n, h, top * rng.uniform(0.6, 1)))
    n = min(map(len, u))
    u = [np.round(np.clip(x[:n], 0, top), 4) for x in u]
    for x in u:
        x[0] = 0
    return Recording(word, role, h, u, temperature_course(rng, word, h * np.arange(n)))


# ---- recordings of a mass on a spring (B4): around zero, times in periods of the free swing -------------------------------

def mass_recording(rng, word, role, frequency, habits):
    period = 1 / frequency
    per_row = dict(triangle=0.2, sine_multiamp=0.06, steps=0.022, step_hold=0.7, multisine=0.035, chirp=0.022)[word]
    h = habits.setdefault(word, float("%.2g" % (period * per_row * rng.uniform(0.7, 1.4))))
    n = rows_of(rng)
    sign = 1 if rng.random() < 0.5 else -1
    if word == "triangle":
        turns = np.concatenate([[0], np.ravel([[a, -a * rng.uniform(0.6, 1)] for a in rng.uniform(0.15, 1, 6)])])
        u = np.interp(np.linspace(0, len(turns) - 1, n), np.arange(len(turns)), turns)
    elif word == "sine_multiamp":
        levels = np.linspace(0.15, 1, rng.integers(5, 9))
        u = np.sin(2 * np.pi * h * np.arange(n) * frequency * rng.uniform(0.2, 0.5)) * \
            levels[np.minimum((np.arange(n) * len(levels) // n), len(levels) - 1)]
    elif word in ("steps", "step_hold"):
        u = holds(rng, n, rng.uniform(-1, 1, 8 if word == "steps" else 3), max(20, n // 10))
    elif word == "multisine":
        u = 2 * multisine(rng, n, h, 2.5 * frequency) - 1
        u *= np.minimum(1, np.arange(n) / (0.05 * n))
    else:
        u = np.sin(2 * np.pi * 0.15 * frequency / (r := np.log(15) / (n * h)) * (np.exp(r * h * np.arange(n)) - 1))
    u[0] = 0
    return Recording(word, role, h, [sign * u], temperature_course(rng, word, h * np.arange(n)))


# ---- recordings of a heater (B5) ------------------------------------------------------------------------------------------

def heater_recording(rng, word, role, time_constant):
    h = float("%.2g" % (time_constant / rng.uniform(25, 60)))
    n = rows_of(rng)
    rest = int(rng.integers(20, 70))
    if word == "step":
        u = holds(rng, n, [rng.uniform(6, 10), 0], rest)
    elif word == "staircase":
        u = holds(rng, n, np.append(np.linspace(2, 10, 5), 5.0), rest)
    elif word == "steps":
        u = holds(rng, n, np.append(10, rng.uniform(0, 10, 4)), rest)
    elif word == "prbs":
        u = np.repeat(rng.uniform(0, 10, n // 20 + 1), rng.integers(20, 60, n // 20 + 1))[:n]
        u[:rest] = 0
        u[rest:2 * rest] = 10
    else:
        u = 5 * (1 - np.cos(2 * np.pi * np.arange(n) * h / (time_constant * rng.uniform(1.5, 6))))
    x = np.linspace(0, 1, n)
    ambient = rng.uniform(20, 24) + 0.7 * np.sin(2 * np.pi * (x * rng.uniform(0.5, 2) + rng.uniform()))
    return Recording(word, role, h, [np.round(u, 4)], np.round(ambient, 4))


# ---- dates and cycle counts ----------------------------------------------------------------------------------------------

def date(rng, recordings):
    """Hours and drive cycles before each recording; pauses in which the rig cycles on, some of them long."""
    hour, cycles = rng.uniform(0.2, 1), 0
    for k, r in enumerate(recordings):
        r.index, r.start_h, r.cycles_before = k + 1, round(hour, 3), int(cycles)
        busy = max(1, int(np.abs(np.diff(r.u[0])).sum() / (2 * max(np.abs(r.u[0]).max(), 1e-9))))
        pause = rng.uniform(0.03, 0.1) if rng.random() < 0.5 else rng.uniform(0.1, 1)
        hour += len(r.u[0]) * r.h / 3600 + pause
        cycles += busy + (rng.uniform(10, 1500) if pause < 0.1 else rng.uniform(3000, 60000) * pause)
