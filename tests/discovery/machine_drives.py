"""What is played into a machine, and what goes on around it meanwhile.

Decides the shape of drives between -1 and 1 and of side signals. Does not decide their size, rate and number (make_machines.py).
"""
import numpy as np

from excitations import holds, multisine

KINDS = ("steps", "prbs", "multisine", "chirp", "triangle", "sine", "hand")


def steps(rng, n, dt, tau):
    count = max(4, int(n * dt / (tau * rng.uniform(8, 16))))
    levels = rng.uniform(-1, 1, count)
    levels[0] = rng.choice([-1, 1])
    return holds(rng, n, levels, max(3, n // 50))


def prbs(rng, n, dt, tau):
    lengths = np.maximum(1, np.round(tau * rng.uniform(0.7, 6, n) / dt).astype(int))
    two = np.repeat(np.tile([1.0, -1.0], n // 2 + 1)[:n], lengths)[:n]
    two[: max(3, n // 50)] = 0
    return two


def chirp(rng, n, dt, tau):
    low, high = 0.015 / tau, min(0.8 / tau, 0.15 / dt)
    rate = np.log(high / low) / (n * dt)
    return np.sin(2 * np.pi * low / rate * (np.exp(rate * dt * np.arange(n)) - 1))


def triangle(rng, n, dt, tau):
    count = max(4, int(n * dt / (tau * rng.uniform(5, 14))))
    turns = np.ravel([[a, -a * rng.uniform(0.5, 1)] for a in rng.uniform(0.15, 1, count // 2 + 1)])
    turns[rng.integers(0, len(turns))] = rng.choice([-1, 1])
    return np.interp(np.linspace(0, len(turns), n), np.arange(len(turns) + 1), np.append(0, turns))


def sine(rng, n, dt, tau):
    f = rng.uniform(0.03, 0.15) / tau
    levels = rng.permutation(np.linspace(0.2, 1, rng.integers(2, 5)))
    periods = np.floor(f * dt * np.arange(n))
    each = max(1.0, np.ceil((periods[-1] + 1) / len(levels)))
    return np.sin(2 * np.pi * f * dt * np.arange(n)) * levels[np.minimum(periods // each, len(levels) - 1).astype(int)]


def hand(rng, n, dt, tau):
    """Somebody turns a knob: moves and rests of uneven length."""
    count = max(5, int(n * dt / (tau * rng.uniform(4, 9))))
    at = np.sort(rng.uniform(0.02, 1, 2 * count)) * n
    levels = np.repeat(rng.uniform(-1, 1, count), 2)
    rough = np.interp(np.arange(n), np.concatenate([[0, 0.02 * n], at]), np.concatenate([[0, 0], levels]))
    width = max(2, int(0.4 * tau / dt))
    return np.convolve(np.concatenate([np.zeros(width - 1), rough]), np.ones(width) / width, "valid")


def drive(rng, kind, n, dt, tau):
    """n rows between -1 and 1, from 0 on; tau: what the machine settles in [s]."""
    if kind == "multisine":
        rise = np.minimum(1, np.arange(n) / (0.04 * (n - 1)))  # as it swells there, about one half
        return 2 * multisine(rng, n, dt, min(rng.uniform(0.3, 0.9) / tau, 0.15 / dt)) - rise * rise * (3 - 2 * rise)
    return np.clip(globals()[kind](rng, n, dt, tau), -1, 1)


def wandering(rng, n, swing):
    """A slow signal of that swing: ramps and a wave, from anywhere in it."""
    x = np.linspace(0, 1, n)
    points = rng.uniform(-0.5, 0.5, 5)
    return swing * (
        np.interp(x, np.linspace(0, 1, 5), points)
        + 0.08 * np.sin(2 * np.pi * (rng.uniform(0.5, 3) * x + rng.uniform()))
    )


def neighbour(rng, n, dt, tau):
    """Another axis, a neighbour's load: held levels that owe nothing to the drive."""
    count = max(4, int(n * dt / (tau * rng.uniform(6, 12))))
    return holds(rng, n, rng.uniform(-1, 1, count), max(3, n // 30))


def spans(rng, n, count, share):
    """Row intervals, apart from each other, together about that share of the recording."""
    begins = (np.arange(count) + rng.uniform(0.1, 0.6, count)) * n / count
    return [(int(b), int(b + share * n / count * rng.uniform(0.6, 1.4))) for b in begins]
