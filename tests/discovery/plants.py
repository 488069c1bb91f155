"""The five plants with what is hidden in them: from drive and temperature to the true outputs.

Decides where in a plant each effect acts: amplifier, core, side path, mechanics, sensor.
Does not decide the formulas (laws.py), the numbers of the effects and their strength (hidden.py), or the noise (case_files.py).
"""
import copy
from dataclasses import dataclass, field

import numpy as np

import laws

REST_DEGC = 22.0


@dataclass
class Plant:
    base: str
    task: dict            # base_parameters as the user knows them, rounded; the plant is simulated with these very numbers
    top: float            # largest drive [V]
    shared: dict = field(default_factory=dict)
    uncertain: bool = False  # the user knows gains and weights to a few per cent, and leaves them free

    @property
    def axes(self):
        return 2 if self.base == "B3" else 1

    @property
    def outputs(self):
        return {"B3": ["y [um]", "y2 [um]"], "B5": ["T [degC]"]}.get(self.base, ["y [um]"])

    @property
    def frequency(self):  # of B4 [Hz]
        return np.sqrt(self.task["stiffness_N_per_m"] / self.task["mass_kg"]) / (2 * np.pi)


@dataclass
class Hidden:
    """One effect at work: how much of it, and the numbers of its shape. amount 0 is the base model."""
    name: str
    amount: float
    shape: dict
    axes: tuple = (0,)
    strength: str = "-"


def significant(x, digits):
    return float("%.*g" % (digits, x))


UNCERTAIN = ("gain_um_per_V", "weights_um_per_V", "damping_Ns_per_m", "force_per_volt_N", "power_per_volt_W")


def uncertain_numbers(parameters):
    """Gains and weights of a user's model: (holder, key), so that holder[key] is the number."""
    for key, value in parameters.items():
        if key == "axes":
            for axis in value:
                yield from uncertain_numbers(axis)
        elif key in UNCERTAIN:
            yield from ((value, i) for i in range(len(value))) if isinstance(value, list) else [(parameters, key)]


def directions(plant, recording):
    """What each uncertain number changes of the outputs, to first order; kept with the recording."""
    if "directions" not in recording.extra:
        base, found = simulate(plant, recording)[0], []
        for k, _ in enumerate(uncertain_numbers(plant.task)):
            other = copy.deepcopy(plant)
            holder, key = list(uncertain_numbers(other.task))[k]
            holder[key] *= 1.001
            found.append((np.array(simulate(other, recording)[0]) - base) / 1e-3)
        recording.extra["directions"] = found
    return recording.extra["directions"]


def draw_plant(rng, base, uncertain=False):
    draw = dict(B1=draw_linear, B2=draw_plays, B3=draw_two_axes, B4=draw_mass, B5=draw_heater)[base]
    task, top = draw(rng)
    return Plant(base, task, top, uncertain=uncertain)


def draw_linear(rng):
    """First to fourth order; slowest pole 0.3 .. 3 kHz."""
    w = 2 * np.pi * np.exp(rng.uniform(np.log(400), np.log(2500)))
    order = int(rng.integers(1, 5))
    poles = []
    if order % 2:
        poles.append(-w * rng.uniform(0.8, 2))
    for _ in range(order // 2):
        zeta = rng.uniform(0.3, 0.95)
        poles += [w * (-zeta + 1j * np.sqrt(1 - zeta**2)), w * (-zeta - 1j * np.sqrt(1 - zeta**2))]
        w *= rng.uniform(1.3, 2.5)
    den = [significant(c, 5) for c in np.poly(poles).real]
    return dict(gain_um_per_V=round(rng.uniform(0.7, 1.6), 4), offset_um=round(rng.uniform(0.2, 1.3), 4),
                dynamics=dict(num=[den[-1]], den=den)), round(rng.uniform(5.5, 9), 2)


def draw_axis(rng):
    count = int(rng.integers(6, 15))
    pitch = round(6.0 / count, 2)
    weights = rng.uniform(0.02, 0.08, count) * np.exp(-np.arange(count) / count * rng.uniform(-0.3, 1)) * 10 / count
    weights[0] = rng.uniform(0.5, 0.9)
    if rng.random() < 0.5:
        weights[-1] *= 2
    return dict(thresholds_V=[round(pitch * i, 2) for i in range(count)],
                weights_um_per_V=[round(float(w), 5) for w in weights], offset_um=round(rng.uniform(0.2, 1.3), 4))


def draw_plays(rng):
    return draw_axis(rng), round(rng.uniform(6.5, 8), 2)


def draw_two_axes(rng):
    return dict(axes=[draw_axis(rng), draw_axis(rng)]), round(rng.uniform(6.5, 8), 2)


def draw_mass(rng):
    mass = rng.uniform(0.5, 6)
    w = 2 * np.pi * np.exp(rng.uniform(np.log(8), np.log(60)))
    k = mass * w * w
    return dict(mass_kg=round(mass, 3), damping_Ns_per_m=significant(2 * rng.uniform(0.03, 0.25) * mass * w, 5),
                stiffness_N_per_m=significant(k, 6), force_per_volt_N=significant(k * rng.uniform(1, 2.5) * 1e-6, 4),
                offset_um=round(rng.uniform(-0.5, 0.5), 4)), 8.0


def draw_heater(rng):
    return dict(C1_J_per_K=significant(rng.uniform(30, 120), 4), C2_J_per_K=significant(rng.uniform(80, 400), 4),
                R12_K_per_W=significant(rng.uniform(0.2, 0.9), 4), R2a_K_per_W=significant(rng.uniform(0.5, 1.5), 4),
                power_per_volt_W=significant(rng.uniform(2, 6), 5)), 10.0


def heater_matrices(p):
    c1, c2, r12, r2a = (p[k] for k in ("C1_J_per_K", "C2_J_per_K", "R12_K_per_W", "R2a_K_per_W"))
    a = np.array([[-1 / (r12 * c1), 1 / (r12 * c1)], [1 / (r12 * c2), -1 / (r12 * c2) - 1 / (r2a * c2)]])
    return a, np.array([1 / c1, 0]), np.array([0, 1 / (r2a * c2)])


# ---- simulation -----------------------------------------------------------------------------------------------------------

def of(hidden, name, axis=0):
    """The effect of that name on that axis, or None."""
    return next((e for e in hidden if e.name == name and axis in e.axes), None)


def simulate(plant, recording, hidden=()):
    """True outputs at the rows, one array each; and what a load cell would show (B4), else None."""
    steps = fine_steps(plant, recording, hidden)
    n = len(recording.u[0])
    t = recording.h * np.arange(n)
    fine = recording.h / steps * np.arange((n - 1) * steps + 1)
    drives = [np.interp(fine, t, u) for u in recording.u]
    h = recording.h / steps
    temperature = np.interp(fine, t, recording.temperature)
    if plant.base == "B5":
        outputs, force = [heat(plant, distorted(late(amplified(drives[0], h, hidden, 0), h, hidden, 0), hidden, 0),
                               temperature, h)], None
    elif plant.base == "B4":
        v = late(amplified(drives[0], h, hidden, 0), h, hidden, 0)
        outputs, force = [swing(plant, distorted(v, hidden, 0), h, hidden)], plant.task["force_per_volt_N"] * v[::steps]
    else:
        outputs, force = actuate(plant, recording, drives, temperature, h, hidden), None
    for j in range(len(outputs)):
        outputs[j] = sensed(mechanics(outputs[j], h, hidden, j, plant.base), fine, recording, hidden, j)[::steps]
    return outputs, force


def fine_steps(plant, recording, hidden=()):
    if plant.base == "B4":  # 300 steps to a period: nonlinear forces are extrapolated over one
        return max(2, int(np.ceil(recording.h * plant.frequency * 300)))
    usual = 4 if plant.base == "B5" else 8 if recording.h > 1e-3 else 4
    names = {e.name for e in hidden}
    if names & {"saturation", "slew_limit"} and names & {"amplifier_lag", "dead_time"}:
        usual = 32  # what is late behind a kink sees the last fine step before the row, not the row
    if plant.base in ("B2", "B3") or names & {"hysteresis", "backlash", "friction"}:
        # Plays keep how far a quick lag overshoots where the drive turns, soon after a row: half of its time is a step.
        usual = max([usual] + [min(256, int(np.ceil(2 * recording.h / (e.amount * sum(e.shape["times"])))))
                               for e in hidden if e.name == "amplifier_lag" and e.amount > 0])
    if plant.base == "B1" and recording.h < 0.1 and any(e.name in ("backlash", "friction") for e in hidden):
        # Plays keep how far the plant rings between two rows: 20 steps to its quickest period. Behind a ramp of a tenth of
        # a second it hardly rings.
        quickest = np.abs(np.roots(plant.task["dynamics"]["den"])).max() / (2 * np.pi)
        return int(np.clip(np.ceil(20 * quickest * recording.h), usual, 64))
    return usual


def amplified(u, h, hidden, axis):
    """Between the drive and the actuator."""
    if e := of(hidden, "saturation", axis):
        u = laws.soft_limit(u, e.amount * e.shape["inverse"], e.shape["sharpness"])
    if (e := of(hidden, "slew_limit", axis)) and e.amount > 0:
        rate = e.shape["fastest"] / e.amount
        u = laws.slew(u, h, rate, rate * e.shape["down"], 4)
    if (e := of(hidden, "amplifier_lag", axis)) and e.amount > 0:
        u = laws.lag(u, h, *(e.amount * x for x in e.shape["times"]))
    return u


def late(u, h, hidden, axis):
    """A dead time of the amplifier, wherever it can be put: it changes places with all that does not look at the clock."""
    if e := of(hidden, "dead_time", axis):
        u = laws.delayed(u, h, e.amount)
    return u


def distorted(v, hidden, axis):
    """Low and high side respond differently: the slope tilts smoothly about a bend, the value at 0 stays."""
    if e := of(hidden, "asymmetry", axis):
        width, bend = e.shape["width"], e.shape["bend"]
        curve = width * (np.logaddexp(0, (v - bend) / width) - np.logaddexp(0, -bend / width))
        v = v + e.amount * (curve - e.shape["lean"] * v)
    return v


def actuate(plant, recording, drives, temperature, h, hidden):
    amplifiers = [amplified(u, h, hidden, j) for j, u in enumerate(drives)]
    parts = plant.task["axes"] if plant.base == "B3" else [plant.task]
    offsets = [p["offset_um"] for p in parts]
    motions = []
    for j, p in enumerate(parts):
        # Late behind the plays: before them the extremes, which they remember, would fall between the steps.
        x = late(core(plant, p, amplifiers[j], h, hidden, j), h, hidden, j) * gain_factor(recording, temperature, hidden, j)
        if plant.base == "B1":
            x = laws.respond(laws.modes_of_ratio(p["dynamics"]["num"], p["dynamics"]["den"]), x, h)
        motions.append(x)
    return [beside(motions, drives, temperature, h, hidden, j) + offsets[j] for j in range(len(parts))]


def core(plant, p, v, h, hidden, axis):
    if plant.base == "B1":
        v = distorted(v, hidden, axis)
        if e := of(hidden, "hysteresis", axis):
            loop = laws.preisach(e.shape["table"], v, -0.02 * plant.top, 1.02 * plant.top)
            v = v + e.amount * plant.top * (loop - e.shape["slope"] * v / plant.top)
        return p["gain_um_per_V"] * v
    thresholds, weights = np.array(p["thresholds_V"]), np.array(p["weights_um_per_V"])
    start, bulge = np.zeros(len(thresholds)), np.zeros(len(thresholds))
    if e := of(hidden, "initial_remanence", axis):
        start = -np.minimum(thresholds, e.amount) * e.shape["share"]
    if e := of(hidden, "asymmetry", axis):
        bulge = e.amount * e.shape["bulge"] * np.minimum(1, thresholds / thresholds.max() * 2)
        v = distorted(v, hidden, axis)
    rows = laws.plays(v, thresholds, start, bulge)
    if (e := of(hidden, "rate_dependence", axis)) and e.amount > 0:
        for i in range(len(thresholds)):  # each, or its gap to the drive, relaxes; wide ones take longer
            if thresholds[i] > 0:
                tau = e.amount * (thresholds[i] / thresholds[-1]) ** e.shape["power"]
                before = v if e.shape["part"] == "gap" else 0.0
                rows[i] = before + laws.lag(rows[i] - before, h, tau)
    return weights @ rows


def gain_factor(recording, temperature, hidden, axis):
    factor = 1.0
    if e := of(hidden, "temperature_gain", axis):
        dt = temperature - REST_DEGC
        factor = factor * (1 + e.amount * (dt + e.shape["bend"] * dt * dt))
    if e := of(hidden, "ageing", axis):
        u = recording.u[axis]
        driven = np.abs(np.diff(u)).sum() / (2 * max(np.abs(u).max(), 1e-9))
        cycles = recording.cycles_before + driven * np.linspace(0, 1, len(temperature))
        factor = factor * (1 - e.amount * np.log10(1 + cycles / e.shape["n0"]))
    return factor


def beside(motions, drives, temperature, h, hidden, axis):
    """What adds to the motion: creep, expansion, the other axis."""
    x = motions[axis]
    y = x
    if e := of(hidden, "creep", axis):
        y = y + e.amount * laws.power_law_creep(x, h, e.shape["t0"], e.shape["power"])
    if e := of(hidden, "thermal_expansion", axis):
        inner = laws.lag(temperature, h, e.shape["inner"])
        outer = laws.lag(inner, h, e.shape["outer"])
        y = y + e.amount * (e.shape["share"] * inner + (1 - e.shape["share"]) * outer - REST_DEGC)
    if e := of(hidden, "cross_coupling", axis):
        y = y + e.amount * laws.lag(motions[1 - axis], h, e.shape["lag"])
    return y


def mechanics(x, h, hidden, axis, base):
    if e := of(hidden, "structural_resonance", axis):
        first = laws.oscillator(x, h, e.shape["frequency"], e.shape["damping"])
        second = laws.oscillator(x, h, e.shape["second"], e.shape["damping"] * 1.3)
        x = x + e.amount * (first - x + e.shape["share"] * (second - x))
    if base != "B4" and (e := of(hidden, "friction", axis)) and e.amount > 0:
        rest = x[0]
        x = rest + laws.guided(x - rest, h, e.amount, e.shape["presliding"], e.shape["excess"], e.shape["stribeck"])
    if (e := of(hidden, "backlash", axis)) and e.amount > 0:
        x = laws.lost_motion(x, e.amount * e.shape["gaps"], e.shape["shares"])
    return x


def swing(plant, v, h, hidden):
    """B4: exact for the linear part; spring, guide and loop act back on the mass."""
    p = plant.task
    pull = p["force_per_volt_N"] * v / p["stiffness_N_per_m"] * 1e6
    w = 2 * np.pi * plant.frequency
    zeta = p["damping_Ns_per_m"] / (2 * p["mass_kg"] * w)
    spring, guide, loop = (of(hidden, name) for name in ("stiffening", "friction", "hysteresis"))
    if not any(e and e.amount for e in (spring, guide, loop)):
        return laws.respond(laws.modes_of_ratio([w * w], [1, 2 * zeta * w, w * w]), pull, h) + p["offset_um"]
    scale = plant.shared["largest_um"] * 1.6
    friction = np.zeros(5)
    if guide:
        friction[:] = guide.amount, guide.shape["presliding"], guide.shape["excess"], guide.shape["stribeck"], \
            guide.shape["bristle_s"]
    return p["offset_um"] + laws.mass_on_spring(
        pull, h, laws.propagator(plant.frequency, zeta, h), spring.amount if spring else 0.0,
        spring.amount * spring.shape["even"] if spring else 0.0, friction,
        loop.shape["table"] if loop else np.zeros((3, 3)), loop.amount if loop else 0.0,
        loop.shape["slope"] if loop else 0.0, scale)


def heat(plant, v, ambient, h):
    a, of_power, of_ambient = heater_matrices(plant.task)
    c = np.array([0.0, 1.0])
    return laws.respond(laws.modes_of(a, of_power, c), plant.task["power_per_volt_W"] * v, h) + \
        laws.respond(laws.modes_of(a, of_ambient, c), ambient, h)


def sensed(y, t, recording, hidden, axis):
    if e := of(hidden, "sensor_nonlinearity", axis):
        z = (y - e.shape["middle"]) / e.shape["half"]
        y = y + e.amount * e.shape["half"] * (np.sinh(e.shape["odd"] * z) / np.sinh(e.shape["odd"]) - z
                                              + e.shape["even"] * (z * z - 0.5))
    if e := of(hidden, "calibration", axis):
        y = y + e.amount * (e.shape["gain"] * y + e.shape["offset"])
    if e := of(hidden, "mains_interference", axis):
        phase = 2 * np.pi * (e.shape["frequency"] * t + 0.02 * np.sin(0.3 * t)) + e.shape["phases"][recording.index]
        y = y + e.amount * (np.sin(phase) + e.shape["third"] * np.sin(3 * phase + 1) + e.shape["second"] * np.sin(2 * phase))
    for e in hidden:
        if "add" in e.shape and axis in e.axes:  # what no list holds
            y = y + e.amount * e.shape["add"](y, t, recording)
    return y
