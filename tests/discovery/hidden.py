"""The effects of the list: in which plants they make sense, which recordings show them, how they are drawn.

Decides the numbers of an effect, and by what amount it stands above the noise.
Does not decide the physics (laws.py, plants.py) nor what else could explain the same recordings (alternatives.py).
"""
from dataclasses import dataclass

import numpy as np

import laws
from plants import Hidden, simulate

STRENGTHS = ("weak", "medium", "strong")
# rms of the effect in its most visible recording, over the rms of the noise
TARGETS = dict(weak=(0.3, 0.4), medium=(1.0, 5.0), strong=(12.0, 120.0))
ACTUATORS = ("B1", "B2", "B3")


@dataclass
class Law:
    plants: tuple
    shows: dict           # excitations that show it, by kind of plant: one of them in train and in validate
    draw: object          # (rng, plant, recordings) -> shape
    unit: float           # a small amount, from which the search starts
    top: float            # no larger amount
    linear: bool = False  # trace proportional to the amount


def words(actuator, mass=(), heater=()):
    return dict(B1=actuator, B2=actuator, B3=actuator, B4=mass, B5=heater)


# Plants that are not given an effect which they could well have: it is a rival there only.
ELSEWHERE = dict(asymmetry=("B5",), amplifier_lag=("B5",))
FAST, FAST_MASS = ("multisine", "freq_high", "chirp"), ("multisine", "steps", "chirp")
LARGE, LARGE_MASS = ("sine_multiamp", "triangle"), ("sine_multiamp", "triangle")
HEAT = ("staircase", "prbs", "steps", "sine")
WARM = ("temp_staircase", "temp_ramp")


def swept(recordings, axis=0):
    return max(np.abs(r.u[axis]).max() for r in recordings)


def fastest(recordings):
    return max(np.abs(np.diff(u)).max() / r.h for r in recordings for u in r.u)


def stroke(plant, recordings):
    """Middle and half of what the base model sweeps, of the first output."""
    if "sweep" not in plant.shared:
        ys = [base_outputs(plant, r)[0] for r in recordings]
        plant.shared["sweep"] = (min(y.min() for y in ys), max(y.max() for y in ys))
    low, high = plant.shared["sweep"]
    return (low + high) / 2, (high - low) / 2


def draw_hysteresis(rng, plant, recordings):
    """slope: how much of the loop's mean slope the user's gain or stiffness already holds, being fitted to a full stroke."""
    return dict(table=laws.everett_table(rng), slope=rng.uniform(0.6, 1.0))


def draw_asymmetry(rng, plant, recordings):
    top = swept(recordings)
    return dict(width=top * rng.uniform(0.15, 0.4), bend=top * (rng.uniform(0.3, 0.6) if plant.base != "B4" else
                rng.uniform(-0.2, 0.2)), lean=rng.uniform(0, 0.7), bulge=0 if plant.base == "B1" else rng.uniform(-0.3, 0.8))


def draw_friction(rng, plant, recordings):
    half = stroke(plant, recordings)[1]
    speed = half * 2 * np.pi * (plant.frequency if plant.base == "B4" else 5.0)  # um/s
    return dict(presliding=half * np.exp(rng.uniform(*np.log([0.01, 0.08]))), excess=rng.uniform(0, 0.5),
                stribeck=speed * rng.uniform(0.03, 0.2),
                bristle_s=0.02 / plant.frequency * rng.uniform(0, 1) if plant.base == "B4" else 0.0)


def draw_resonance(rng, plant, recordings):
    shown = [0.2 / r.h for r in recordings if r.word in EFFECTS["structural_resonance"].shows[plant.base]]
    low, high = (1.6 * plant.frequency, 4 * plant.frequency) if plant.base == "B4" else (100, 700)  # Hz
    f = rng.uniform(low, max(min([high, *shown]), 1.05 * low))  # five rows to a period where it shows
    return dict(frequency=f, damping=np.exp(rng.uniform(*np.log([0.006, 0.05]))), second=f * rng.uniform(1.5, 2.6),
                share=rng.choice([0.0, rng.uniform(0.05, 0.3)]))


def draw_expansion(rng, plant, recordings):
    inner = np.exp(rng.uniform(*np.log([8, 60])))
    return dict(inner=inner, outer=inner * rng.uniform(2, 8), share=rng.uniform(0.2, 0.9))


def draw_sensor(rng, plant, recordings):
    middle, half = stroke(plant, recordings)
    return dict(middle=middle, half=half, odd=rng.uniform(1, 2.5), even=rng.uniform(-0.4, 0.4))


def draw_calibration(rng, plant, recordings):
    kind = rng.integers(3)  # gain, offset, both
    half = stroke(plant, recordings)[1]
    offset = half * rng.uniform(0.3, 1) * rng.choice([-1, 1])
    return dict(gain=0.0 if kind == 1 else 1.0, offset=0.0 if kind == 0 else offset)


def draw_mains(rng, plant, recordings):
    return dict(frequency=rng.choice([50, 60]) + rng.uniform(-0.2, 0.2), phases=rng.uniform(0, 6.28, 64),
                second=rng.choice([0, 0.1]), third=rng.choice([0, rng.uniform(0.05, 0.3)]))


def draw_lag(rng, plant, recordings):
    second = rng.choice([0, 0.15, 0.4])
    return dict(times=(1 - second, second))


def draw_limit(rng, plant, recordings):
    return dict(inverse=1 / swept(recordings), sharpness=float(rng.choice([0, 6, 14, 30])))


EFFECTS = dict(
    hysteresis=Law(("B1", "B4"), words(LARGE, LARGE_MASS), draw_hysteresis, 1e-3, 0.6),
    asymmetry=Law(("B1", "B2", "B3", "B4"), words(LARGE, LARGE_MASS), draw_asymmetry, 1e-3, 0.5),
    creep=Law(ACTUATORS, words(("step_hold",)), lambda rng, *_: dict(
        t0=np.exp(rng.uniform(*np.log([2e-3, 0.05]))), power=rng.uniform(0.01, 0.08)), 1e-3, 0.15, linear=True),
    rate_dependence=Law(("B2", "B3"), words(("freq_high", "multisine", "chirp")),
                        lambda rng, *_: dict(power=rng.uniform(0, 1.2), part=str(rng.choice(["operator", "gap"]))),
                        1e-5, 0.03),
    structural_resonance=Law(("B1", "B2", "B3", "B4"), words(("multisine", "steps"), ("multisine", "steps")),
                             draw_resonance, 1e-4, 0.4, linear=True),
    amplifier_lag=Law(("B1", "B2", "B3", "B4"), words(FAST, FAST_MASS), draw_lag, 1e-6, 0.03),
    slew_limit=Law(("B1", "B2", "B3", "B4"), words(("freq_high", "steps", "steps"), ("steps",)),
                   lambda rng, plant, rs: dict(fastest=fastest(rs), down=rng.uniform(0.7, 1.3)), 1.0, 2e3),
    saturation=Law(("B1", "B2", "B3", "B4", "B5"), words(LARGE, LARGE_MASS, HEAT), draw_limit, 0.2, 2.5),
    dead_time=Law(("B1", "B2", "B3", "B4", "B5"), words(FAST, FAST_MASS, HEAT), lambda *_: {}, 1e-6, 60.0),
    temperature_gain=Law(ACTUATORS, words(WARM), lambda rng, *_: dict(bend=rng.uniform(-0.002, 0.004)),
                         1e-5, 0.01, linear=True),
    thermal_expansion=Law(ACTUATORS, words(WARM), draw_expansion, 1e-4, 0.1, linear=True),
    cross_coupling=Law(("B3",), words(("sine_multiamp", "triangle", "steps")), lambda rng, *_: dict(
        lag=rng.choice([0, 1e-4, 3e-4])), 1e-3, 0.1, linear=True),
    sensor_nonlinearity=Law(("B1", "B2", "B3", "B4", "B5"), words(LARGE, LARGE_MASS, HEAT), draw_sensor, 1e-3, 0.3, linear=True),
    friction=Law(("B4", "B4", "B1"), words(LARGE, LARGE_MASS), draw_friction, 1e-4, 3.0),
    backlash=Law(("B1", "B2", "B4"), words(LARGE, LARGE_MASS), lambda rng, *_: dict(
        gaps=np.linspace(0.95, 1.05, 5), shares=np.full(5, 0.2)), 1e-4, 2.0),
    stiffening=Law(("B4",), words((), ("multisine", "chirp", "sine_multiamp")), lambda rng, *_: dict(
        even=rng.choice([0, rng.uniform(-0.4, 0.4)])), 1e-4, 1.5),
    mains_interference=Law(("B1", "B2", "B3", "B4"), words(("sine_multiamp", "freq_high", "multisine", "steps"), FAST_MASS),
                           draw_mains, 1e-4, 1.0, linear=True),
    ageing=Law(ACTUATORS, words(LARGE), lambda rng, *_: dict(n0=rng.uniform(70, 140)), 1e-4, 0.15, linear=True),
    initial_remanence=Law(("B2", "B3"), words(LARGE), lambda rng, *_: dict(share=rng.uniform(0.6, 1.0)), 0.05, 6.0),
    calibration=Law(("B1", "B2", "B3", "B4", "B5"), words(LARGE, LARGE_MASS, HEAT), draw_calibration, 1e-3, 0.3, linear=True),
)
BOTH_AXES = ("thermal_expansion", "temperature_gain", "ageing", "mains_interference")  # of the room, not of one axis
# Two of one group in one case could not be told apart, or only by luck.
LOOK_ALIKE = [{"amplifier_lag", "dead_time", "rate_dependence", "slew_limit"}, {"hysteresis", "friction", "backlash"},
              {"asymmetry", "sensor_nonlinearity", "stiffening", "saturation"}, {"temperature_gain", "ageing", "calibration"},
              {"saturation", "slew_limit"}]


def draw(rng, name, plant, recordings):
    law = EFFECTS[name]
    axes = (0,)
    if plant.base == "B3":
        axes = (0, 1) if name in BOTH_AXES or rng.random() < 0.5 else (int(rng.integers(2)),)
    return Hidden(name, law.unit, law.draw(rng, plant, recordings), axes)


def with_amount(e, amount):
    return Hidden(e.name, amount, e.shape, e.axes, e.strength)


def base_outputs(plant, recording):
    """Of the base model; kept with the recording, for it is asked for at every step of a search."""
    if "base" not in recording.extra:
        recording.extra["base"] = simulate(plant, recording)[0]
    return recording.extra["base"]


def traces(plant, recordings, hidden):
    """What `hidden` changes, per recording: outputs with it minus outputs of the base model."""
    return [np.array(simulate(plant, r, [hidden])[0]) - np.array(base_outputs(plant, r)) for r in recordings]


def heights(trace):
    """rms per recording, of the output that shows it most."""
    return [max(np.sqrt(np.mean(y * y)) for y in one) for one in trace]


def scale(plant, recordings, hidden, target, accuracy=0.01):
    """The amount that makes the effect `target` [um] rms in its most visible recording; None where there is none."""
    law = EFFECTS[hidden.name]
    top = law.top * (2e3 if plant.base in ELSEWHERE.get(hidden.name, ()) else 1)  # minutes beside milliseconds

    def height(amount):
        reached = max(heights(traces(plant, recordings, with_amount(hidden, amount))))
        return reached if np.isfinite(reached) else np.inf
    low = (law.unit, height(law.unit))
    if law.linear:
        amount = low[0] * target / max(low[1], 1e-15)
        return with_amount(hidden, amount) if amount <= top else None
    while low[1] > target:
        low = (low[0] / 8, height(low[0] / 8))
    high = low
    while high[1] < target:
        low = high
        if low[0] > top:
            return None
        ahead = low[0] * min(64.0, max(1.5, 1.3 * target / max(low[1], 1e-12)) if low[1] > 0 else 2.0)
        high = (ahead, height(ahead))
    amount = between(low, high, target, accuracy, height)
    return with_amount(hidden, amount) if amount is not None and amount <= top else None


def between(low, high, target, accuracy, height):
    """The amount whose height is the target, by straight lines on double logarithmic paper, halving where that fails."""
    for k in range(40):
        share = 0.5
        if k % 3 < 2 and low[1] > 0 and np.isfinite(high[1]):
            share = np.clip(np.log(target / low[1]) / np.log(high[1] / low[1]), 0.03, 0.97)
        mid = low[0] * (high[0] / low[0]) ** share
        reached = height(mid)
        if abs(reached - target) < accuracy * target:
            return mid
        low, high = ((mid, reached), high) if reached < target else (low, (mid, reached))
    return None
