"""Structure that no effect of the list explains, with the place where it sits.

Decides the disturbances and how the truth states their place (what score.py reads as `location`).
Does not decide their strength above the noise (cases.py).
"""
import numpy as np

from plants import Hidden


def sweep(rng, trace_of):
    """A level that recordings of both roles pass: between the 25th and 75th percentile of each of them."""
    low = max(np.percentile(x, 25) for x in trace_of)
    high = min(np.percentile(x, 75) for x in trace_of)
    return rng.uniform(low, high) if high > low else float(np.median(np.concatenate(trace_of)))


def telegraph(rng, recordings, outputs):
    """A loose contact: two levels, jumps at random instants."""
    jumps = {r.index: np.sort(rng.uniform(0.03, 0.97, rng.integers(5, 16))) * r.t[-1] for r in recordings}
    location = dict(variable="t", jumps={"%02d.csv" % k: [round(float(x), 5) for x in v] for k, v in jumps.items()})
    return lambda y, t, r: 1.0 * (np.searchsorted(jumps[r.index], t) % 2), location


def bursts(rng, recordings, outputs):
    """A neighbour's machine: short trains of vibration, each under half a second; slow recordings miss them."""
    f = rng.uniform(0.05, 0.2)  # of the row rate
    spans = {}
    for r in recordings:
        start = np.sort(rng.uniform(0.03, 0.9, rng.integers(4, 8))) * r.t[-1]
        length = np.minimum(rng.uniform(0.1, 0.35), 0.04 * r.t[-1])
        spans[r.index] = [(a, a + length) for a in start] if length > 8 * r.h else []
    location = dict(variable="t", intervals={"%02d.csv" % k: [[round(float(a), 5), round(float(b), 5)] for a, b in v]
                                             for k, v in spans.items() if v})

    def add(y, t, r):
        on = np.zeros(len(t))
        for a, b in spans[r.index]:
            on[(t >= a) & (t <= b)] = np.sqrt(2)
        return on * np.sin(2 * np.pi * f / r.h * t)
    return add, location


def sensor_periodic(rng, recordings, outputs):
    """A scale's interpolation error: periodic in the position."""
    period = round(float(np.ptp(np.concatenate(outputs)) / rng.uniform(6, 40)), 4)
    phase = rng.uniform(0, 6.28)
    return (lambda y, t, r: np.sin(2 * np.pi * y / period + phase) + 0.25 * np.sin(4 * np.pi * y / period),
            dict(variable="y", period=period))


def drive_periodic(rng, recordings, outputs):
    """A converter's error: periodic in the drive."""
    period = round(float(np.ptp(np.concatenate([r.u[0] for r in recordings])) / rng.uniform(6, 40)), 4)
    phase = rng.uniform(0, 6.28)
    return (lambda y, t, r: np.sin(2 * np.pi * np.interp(t, r.t, r.u[0]) / period + phase), dict(variable="u", period=period))


def pump(rng, recordings, outputs):
    """A pump or compressor: a line in time, its phase new in each recording; some recording of either role shows it."""
    longest = min(max(r.t[-1] for r in recordings if r.role == role) for role in ("train", "validate"))
    rows = [r.h for r in recordings if r.t[-1] >= 0.3 * longest]
    shortest = max(6 * max(rows), longest / 130)
    while True:
        period = float("%.4g" % np.exp(rng.uniform(np.log(shortest), np.log(max(longest / 8, 1.5 * shortest)))))
        if not any(abs(line * period - 1) < 0.1 for line in (50, 60, 100, 120, 150, 180)):  # that would be the mains
            break
    phases = rng.uniform(0, 6.28, 64)
    return (lambda y, t, r: np.sin(2 * np.pi * t / period + phases[r.index]), dict(variable="t", period=period))


def bump(rng, recordings, outputs):
    """A stop that is touched: from a level of the position on, the output steps and leans."""
    level = round(float(sweep(rng, outputs)), 4)
    slope = rng.uniform(0, 1.0) / np.ptp(np.concatenate(outputs))
    return (lambda y, t, r: (y > level) * (1 + slope * (y - level)), dict(variable="y", threshold=level))


def relay(rng, recordings, outputs):
    """A range switch in the amplifier: from a level of the drive on, a step."""
    level = round(float(sweep(rng, [r.u[0] for r in recordings])), 4)
    return lambda y, t, r: 1.0 * (np.interp(t, r.t, r.u[0]) > level), dict(variable="u", threshold=level)


KINDS = dict(telegraph=telegraph, bursts=bursts, sensor_periodic=sensor_periodic, drive_periodic=drive_periodic, pump=pump,
             bump=bump, relay=relay)


def draw(rng, kind, recordings, outputs):
    """The disturbance at unit size, and where it sits. outputs: of the base model, first axis, one per recording."""
    add, location = KINDS[kind](rng, recordings, outputs)
    return Hidden(kind, 1.0, dict(add=add)), location
