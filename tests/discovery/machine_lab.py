"""The laboratory of one case: its recordings, the machine run in them with something hidden, and how far that is seen.

Decides which recordings are made, their noise, and the amount of an effect that stands so far above it.
Does not decide what is hidden in which case (make_machines.py) nor how the answer is to look (machine_truth.py).
"""
from dataclasses import dataclass, field

import numpy as np

import machine_drives
import machine_run
from machine import draw_numbers


@dataclass
class Played:
    kind: str
    role: str
    dt: float
    skip: int  # rows before the recording begins
    moving: bool
    u: np.ndarray  # drive, or what the loop aims at; with the rows before
    w: np.ndarray  # temperature, other
    luck: np.ndarray
    seed: int
    events: np.ndarray
    closed: bool
    hold: bool
    kept: dict = field(default_factory=dict)

    @property
    def rows(self):
        return len(self.u) - self.skip


# Ways to enter on any wire: amount -> settings. An amount of 1 is as much as a user would ever have.
WIRES = dict(
    saturation=lambda a, lab: dict(low=lab.low(1 - 0.8 * a), high=lab.high(1 - 0.8 * a)),
    slew_limit=lambda a, lab: dict(rise=lab.half / (8 * a * lab.machine.tau)),
    amplifier_lag=lambda a, lab: dict(lag=a * lab.machine.tau),
    dead_time=lambda a, lab: dict(delay=2 * a * lab.machine.tau),
    backlash=lambda a, lab: dict(gap=0.4 * a * lab.half),
    asymmetry=lambda a, lab: dict(curve=a),
    hysteresis=lambda a, lab: dict(loop=0.3 * a),
    creep=lambda a, lab: dict(creep=0.12 * a, creep_from=2 * lab.machine.dt),
    rectification=lambda a, lab: dict(mix=0.5 * a),
    temperature_gain=lambda a, lab: dict(kelvin=0.02 * a, kelvin_at=lab.machine.sides[0][3]),
    cross_coupling=lambda a, lab: dict(cross=0.5 * a * lab.half / lab.machine.sides[1][4]),
    structural_resonance=lambda a, lab: dict(mode_share=0.4 * a, mode_hz=lab.mode, mode_damping=0.03),
    knocked=lambda a, lab: dict(knock=3 * a),
    dropped=lambda a, lab: {},
    sensor_lag=lambda a, lab: dict(s_lag=a * lab.machine.tau),
    backlash_s=lambda a, lab: dict(s_gap=0.3 * a * lab.half_of(0)),
    saturation_s=lambda a, lab: dict(s_high=lab.ends[0][1] - 0.8 * a * lab.half_of(0)),
    sensor_nonlinearity=lambda a, lab: dict(s_curve=0.6 * a),
    quantization=lambda a, lab: dict(s_step=a * lab.half_of(0)),
    mains_interference=lambda a, lab: dict(
        s_line=a * lab.half_of(0), s_line_hz=50 + 0.2 * (lab.mode * lab.machine.dt - 0.1)
    ),
    sensor_drift=lambda a, lab: dict(s_drift=a * lab.half_of(0) / lab.longest),
    thermal_expansion=lambda a, lab: dict(
        s_expand=0.1 * a * lab.half_of(0),
        s_expand_s=3 * lab.machine.slowest + 5 * lab.machine.tau,
        s_expand_at=lab.machine.sides[0][3],
    ),
    cross_coupling_s=lambda a, lab: dict(s_cross=0.5 * a * lab.half_of(0) / lab.machine.sides[1][4]),
    sensor_periodic=lambda a, lab: dict(s_period=0.1 * a * lab.half_of(0), s_period_of=lab.period),
)
HEAT = ("temperature_gain", "thermal_expansion")


def effect_of(key):
    return key.removesuffix("_s")


def straight(trace, base):
    """Gain and offset by which the one follows the other."""
    a = np.column_stack([base - base.mean(), np.ones(len(base))])
    gain, level = np.linalg.lstsq(a, trace, rcond=None)[0]
    return gain, level - gain * base.mean()


class Lab:
    def __init__(self, rng, machine, keys, start, closed, only=""):
        """keys: of what will be hidden. only: the one kind of drive of all recordings (they shall not tell effects apart)."""
        self.rng, self.machine, self.numbers = rng, machine, draw_numbers(rng, machine)
        self.middle, self.half = machine.drive[1], machine.drive[2]
        self.mode = float("%.3g" % (rng.uniform(0.06, 0.14) / machine.dt))
        self.only, self.hold = only, bool(closed or rng.random() < 0.5)
        swing = rng.uniform(12, 20) if any(k in HEAT for k in keys) else 0.0 if only else None
        count = int(rng.integers(2, 7)) if not only else 3
        if swing:  # a gain at one temperature tells nothing of another
            count = max(count, 5)
        tests = 1 if count < 4 or swing else int(rng.integers(1, 3))
        kinds = [only] * count if only else list(rng.permutation(machine.kinds))
        if {"hysteresis", "backlash", "friction", "stribeck_friction", "backlash_s"} & set(keys):
            kinds = ["triangle", "sine"] + [k for k in kinds if k not in ("triangle", "sine")]
            kinds = kinds[: max(2, count - 1)] + ["triangle"]
            count = len(kinds)
        moving = [start != "rest" and (k == 0 or rng.random() < 0.6) for k in range(count)]
        self.recordings = [
            self.play(kinds[k % len(kinds)], "validate" if k >= count - tests else "train", moving[k], closed, swing, k)
            for k in range(count)
        ]
        if "dropped" in keys or "knocked" in keys:
            for r in self.recordings:
                for a, b in machine_drives.spans(rng, r.rows, int(rng.integers(2, 4)), 0.03):
                    r.events[r.skip + a : r.skip + b] = 1 if "dropped" in keys else 2
        self.longest = max(r.rows * r.dt for r in self.recordings)
        self.noise = np.zeros(len(machine.outputs))
        self.ends = [(0.0, 1.0)] * len(machine.outputs)
        clean = [self.run(r, {})[0] for r in self.recordings]
        self.ends = [
            (min(y[:, o].min() for y in clean), max(y[:, o].max() for y in clean)) for o in range(len(machine.outputs))
        ]
        share = [np.exp(rng.uniform(*np.log(s[2]))) for s in machine.outputs]
        self.noise = np.array([float("%.3g" % (s * max(np.std(y[:, o]) for y in clean))) for o, s in enumerate(share)])
        self.period = float("%.3g" % ((self.ends[0][1] - self.ends[0][0]) / rng.uniform(8, 20)))

    def half_of(self, output):
        if isinstance(output, str):
            output = [o[0] for o in self.machine.outputs].index(output)
        return 0.5 * (self.ends[output][1] - self.ends[output][0])

    def low(self, share):
        return self.middle - share * self.half

    def high(self, share):
        return self.middle + share * self.half

    def play(self, kind, role, moving, closed, swing, place):
        rng, m = self.rng, self.machine
        dt = m.dt * float(rng.choice([0.5, 1, 1, 1, 2]))
        n = (
            int(np.exp(rng.uniform(np.log(600), np.log(5000))))
            if rng.random() > 0.06
            else int(rng.uniform(9000, 16000))
        )
        skip = int(8 * m.slowest / dt) + 2 if not moving else int(m.tau * rng.uniform(6, 12) / dt)
        shape = machine_drives.drive(rng, kind, n, dt, m.tau)
        before = np.zeros(skip) if not moving else machine_drives.drive(rng, "multisine", skip + 3, dt, m.tau)[3:]
        if moving and len(before):
            before = before / max(np.abs(before).max(), 1e-9) * rng.uniform(0.5, 0.9)
            if kind in ("sine", "triangle", "multisine", "hand", "chirp"):  # it was under way already
                keep = min(n // 8, int(4 * m.tau / dt))
                shape, n = shape[keep:], n - keep
        shape = np.concatenate([before, shape]) * rng.uniform(0.6, 1.0) * rng.choice([-1, 1])
        middle, half = m.aims if closed else (m.drive[1], m.drive[2])
        u = np.round(middle + half * shape, m.drive[3] if not closed else 6)
        sides = m.sides
        warm = self.temperatures(n + skip, swing, place)
        other = sides[1][3] + sides[1][4] * (
            machine_drives.neighbour(rng, n + skip, dt, m.tau) if sides[1][4] else np.zeros(n + skip)
        )
        if not moving:
            warm[:skip] = warm[skip]
            other[:skip] = other[skip]
        events = np.zeros(n + skip, np.int64)
        if not moving:
            events[: skip + 2] = 3  # the loop is closed when the recording runs
        elif m.integrates:  # it coasts, for there is no rest under a drive
            events[skip : skip + 2] = 3
            u[skip : skip + 2] = u[skip : skip + 2] if closed else m.drive[1]
        luck = np.array([rng.uniform(0, 6.28), rng.choice([-1, 1]) * rng.uniform(0.4, 1)])
        return Played(
            kind,
            role,
            dt,
            skip,
            moving,
            u,
            np.round(np.column_stack([warm, other]), 4),
            luck,
            int(rng.integers(2**31)),
            events,
            closed,
            self.hold,
        )

    def temperatures(self, n, swing, place):
        """swing None: as of a room; 0: one and the same in all recordings, not that of the numbers; else they span so many kelvin."""
        rng, (_, _, _, middle, usual) = self.rng, self.machine.sides[0]
        if swing == 0:
            return np.full(n, middle + 9.0)
        if swing is None:
            return middle + machine_drives.wandering(rng, n, usual)
        quick = self.machine.tau < 0.05  # nothing warms up while these last
        level = (0.618 * place + 0.1 * rng.random()) % 1 - 0.5  # another in each recording
        return middle + level * swing + machine_drives.wandering(rng, n, swing * (0.03 if quick else 0.5))

    def settings(self, hidden):
        """hidden: key -> amount. -> (of the wires, of the plant)"""
        wires, plant = {}, {}
        for key, amount in hidden.items():
            for name, value in (self.machine.effects.get(key) or WIRES[key])(amount, self).items():
                (wires if name in machine_run.OFF else plant)[name] = value
        wires |= dict(
            middle=self.middle, half=self.half, s_middle=0.5 * sum(self.ends[0]), s_half=max(self.half_of(0), 1e-30)
        )
        return machine_run.settings(wires), plant

    def run(self, r, hidden, numbers=None, drive=None):
        """-> (what is shown, drive, noise) without the rows before. drive: all rows of it, where the loop has been closed before."""
        m = self.machine
        n = numbers or self.numbers
        e, plant = self.settings(hidden)
        noise = self.noise * np.random.default_rng(r.seed).standard_normal((len(r.u), len(self.noise)))
        p = m.plant(n, plant)
        at_rest = m.drive[1]
        x0 = m.start(p, at_rest, r.w[0, 0])
        loop = np.array(
            [*m.loop, m.drive[1], m.drive[1] - 1.3 * m.drive[2], m.drive[1] + 1.3 * m.drive[2], 10.0 ** -m.drive[3]]
        )
        closed = r.closed and drive is None
        u = r.u if drive is None else drive
        if closed:
            u = np.full(len(r.u), at_rest)
        events = r.events if ("dropped" in hidden or "knocked" in hidden) else np.where(r.events == 3, 3, 0)
        shown, u = machine_run.run(
            m.rate,
            m.sense,
            p,
            x0,
            u,
            r.u,
            r.w,
            events,
            e,
            noise if drive is None else 0 * noise,
            r.dt,
            m.parts,
            r.hold,
            loop if closed else np.zeros(0),
            r.luck,
            len(self.noise),
        )
        return shown[r.skip :], u, (noise if drive is None else 0 * noise)[r.skip :]

    def traces(self, hidden, over=()):
        """What all of `hidden` but the effects `over` change, for the drive as it was recorded: one per recording."""
        found = []
        for r in self.recordings:
            shown, u, noise = self.run(r, hidden)
            base = self.without(r, u, {k: hidden[k] for k in over})
            found.append((shown - noise - base, base))
        return found

    def without(self, r, u, beside):
        """Run without what is asked for, the drive played; kept where the drive is the recording's own."""
        key = None if r.closed else repr(sorted(beside.items()))
        if key not in r.kept or key is None:
            r.kept[key] = self.run(r, beside, drive=u)[0]
        return r.kept[key]

    def height(self, hidden, over=()):
        """rms of it over the noise in the output and recording that shows it most, gain and offset taken out.

        Each recording has its own, but where a temperature makes the gain one is the same in all of them. Recordings
        that cannot tell an effect from a gain show all of it."""
        found, most = self.traces(hidden, over), 0.0
        together = bool({*HEAT} & {*hidden} - {*over})
        for o, sigma in enumerate(self.noise):
            pieces = [(trace[:, o], base[:, o]) for trace, base in found]
            if together:
                shared = straight(*(np.concatenate(x) for x in zip(*pieces)))
            for trace, base in pieces:
                gain, offset = (0.0, 0.0) if self.only else shared if together else straight(trace, base)
                most = max(most, float(np.sqrt(np.mean((trace - gain * base - offset) ** 2))) / sigma)
        return most if np.isfinite(most) else np.inf

    def amount(self, key, target, beside=None, accuracy=0.03):
        """The amount at which the effect is `target` times the noise; None where the machine never shows so much."""
        beside = beside or {}
        if key == "dropped":  # there or not
            return 1.0
        low, high, a = None, None, 0.03
        for k in range(24):
            reached = self.height({**beside, key: a}, tuple(beside))
            if abs(reached / target - 1) < accuracy:
                return float("%.5g" % a)
            if reached < target:
                low = (a, reached)
            else:
                high = (a, reached)
            if high is None:
                if a == 1.0:
                    return None
                a = min(1.0, a * np.clip(1.3 * target / max(low[1], 1e-9), 1.5, 30))
            elif low is None:
                a *= np.clip(0.8 * target / max(high[1], 1e-9), 0.01, 0.7)
            else:  # straight on double logarithmic paper, halved now and then
                share = (
                    np.log(target / low[1]) / np.log(high[1] / low[1])
                    if k % 3 and low[1] > 0 and np.isfinite(high[1])
                    else 0.5
                )
                a = low[0] * (high[0] / low[0]) ** np.clip(share, 0.05, 0.95)
            if a < 1e-7:
                return None
        return None
