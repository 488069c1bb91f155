"""What else explains the same recordings as well as the truth does.

Decides by computing: the trace of a look-alike is fitted to the trace of the truth; what is left, over the noise, is the
chi2 gap. Below TIE nobody can tell the two from these recordings, nor where the gap is no more than what a good law leaves
of its own effect (LAW_ERROR).
Does not decide which verdict follows from it (cases.py).
"""
import numpy as np
from scipy.fft import dct

from hidden import ELSEWHERE, EFFECTS, base_outputs, draw, heights, scale, traces
from laws import lost_motion
from plants import directions

TIE = 9.0  # chi2; two laws of one parameter each: odds of 90 to 1
LAW_ERROR = 0.015  # of an effect's amplitude: no formula describes a device better

# A smooth curve may have any shape; sums of so many drawn ones, with slopes and zeros of their own, come to a tenth of a
# per cent of each other.
CURVES = ("asymmetry", "sensor_nonlinearity")
ANY_CURVE = 9

# Pairs that are easily taken for each other; the deciding feature may be missing from the recordings.
RIVALS = dict(
    hysteresis=("friction", "backlash", "amplifier_lag", "creep"),
    asymmetry=("sensor_nonlinearity", "saturation", "calibration"),
    creep=("thermal_expansion", "hysteresis"), rate_dependence=("amplifier_lag", "dead_time"),
    structural_resonance=("amplifier_lag", "dead_time"),
    amplifier_lag=("dead_time", "rate_dependence", "structural_resonance"),
    slew_limit=("amplifier_lag", "dead_time", "saturation"), saturation=("asymmetry", "sensor_nonlinearity", "slew_limit"),
    dead_time=("amplifier_lag", "rate_dependence", "structural_resonance"), temperature_gain=("calibration", "ageing"),
    thermal_expansion=("creep", "calibration"), cross_coupling=("calibration",),
    sensor_nonlinearity=("asymmetry", "saturation", "stiffening", "calibration"), friction=("hysteresis", "backlash"),
    backlash=("hysteresis", "friction", "asymmetry"), stiffening=("sensor_nonlinearity", "asymmetry", "saturation"),
    ageing=("temperature_gain", "calibration"), initial_remanence=("calibration",),
    calibration=("temperature_gain", "ageing"))


def gap(plant, recordings, truth, name, sensor, seed=0):
    """chi2 left of the truth's trace after the best sum of a few differently shaped traces of the rival."""
    if plant.base not in EFFECTS[name].plants + ELSEWHERE.get(name, ()):
        return np.inf
    want = traces(plant, recordings, truth)
    columns = curves_of(plant, recordings, truth, name, max(heights(want)), np.random.default_rng([seed, 77]))
    if not columns:
        return np.inf
    columns += free_numbers(plant, recordings)
    y, a = whitened(want, sensor), np.array([whitened(c, sensor) for c in columns]).T
    left = y - a @ np.linalg.lstsq(a, y, rcond=None)[0]
    return float(left @ left)


def curves_of(plant, recordings, truth, name, size, rng):
    if name == "hysteresis" and plant.base == "B1":
        return loops(plant, recordings)
    columns = []
    for _ in range(ANY_CURVE if name in CURVES else 3):
        rival = draw(rng, name, plant, recordings)
        rival.axes = truth.axes
        rival = scale(plant, recordings, rival, size, accuracy=0.25)
        if rival is not None:
            columns.append(traces(plant, recordings, rival))
    if columns and name in CURVES:
        columns += lines(plant, recordings, truth.axes)
    return columns


def lines(plant, recordings, axes):
    """A curve has a slope and a zero of its own: of each axis what it does, and one."""
    columns = []
    for axis in axes:
        for part in (lambda y: y, np.ones_like):
            columns.append([np.array([part(y) if j == axis else np.zeros_like(y) for j, y in enumerate(base_outputs(plant, r))])
                            for r in recordings])
    return columns


def loops(plant, recordings):
    """Any hysteresis of an actuator without mass: a gain and plays of many widths, their weights free."""
    motions = [base_outputs(plant, r)[0] - plant.task["offset_um"] for r in recordings]
    half = max(np.abs(x).max() for x in motions) / 2
    widths = half * np.geomspace(0.003, 0.95, 10)
    columns = [motions] + [[lost_motion(x, np.array([w]), np.ones(1)) for x in motions] for w in widths]
    return [[x[np.newaxis] for x in one] for one in columns]


def free_numbers(plant, recordings):
    """What the numbers can do that the user leaves free: one trace each."""
    if not plant.uncertain:
        return []
    return [list(one) for one in zip(*(directions(plant, r) for r in recordings))]


def known_by(plant, recordings, sensor):
    """How well these recordings tell the free numbers: standard deviation over value of the one that they tell worst."""
    a = np.array([whitened(c, sensor) for c in free_numbers(plant, recordings)]).T
    try:
        return float(np.sqrt(np.diag(np.linalg.inv(a.T @ a)).max()))
    except np.linalg.LinAlgError:
        return np.inf


def left_by(plant, recordings, trace):
    """Share of the height of a trace, in the recording that shows it most, that is left beside the free numbers."""
    y = np.concatenate([np.ravel(one) for one in trace])
    a = np.array([np.concatenate([np.ravel(one) for one in c]) for c in free_numbers(plant, recordings)]).T
    left = y - a @ np.linalg.lstsq(a, y, rcond=None)[0]
    parts, at = [], 0
    for one in trace:
        parts.append(left[at:at + one.size].reshape(one.shape))
        at += one.size
    return max(heights(parts)) / max(heights(trace))


def whitened(trace, sensor):
    """Over the noise, cosine by cosine: what lies below the 1/f noise is no evidence."""
    parts = []
    for y in trace:
        n = y.shape[1]
        k = np.arange(n) + 0.5
        share = (sensor["flicker"] / sensor["white"]) ** 2
        parts.append(dct(y, axis=1, norm="ortho") / (sensor["white"] * np.sqrt(1 + share * n / k / np.sum(1 / k))))
    return np.concatenate([np.ravel(p) for p in parts])


def alternatives(plant, recordings, truth, sensor, seed=0):
    whole = whitened(traces(plant, recordings, truth), sensor)
    enough = max(TIE, LAW_ERROR**2 * float(whole @ whole))
    return [name for name in RIVALS.get(truth.name, ()) if gap(plant, recordings, truth, name, sensor, seed) < enough]
