"""An accelerometer of silicon and a magnetostrictive actuator: equations and diagrams."""
import numpy as np
from numba import njit

from machine import Machine, gain, off

# ---- accelerometer with a film of gas (Senturia, Microsystem Design, chapter 19) ------------------------------------------------


@njit
def proof_rate(x, v, side, p, dx):
    # x: position [um], speed [um/s]; the springs harden with the square of the travel
    dx[0] = x[1]
    dx[1] = 1e6 * p[0] * v / p[1] - (p[2] * x[1] + p[3] * x[0] * (1 + p[5] * x[0] ** 2)) / p[1]


@njit
def proof_sense(x, v, side, p, y):
    y[0] = p[4] * x[0]


def proof_diagram(n):
    blocks = {
        "shaken": gain(1e-9 * n["shaken"], "N/(m/s^2)", "a"),
        "proof": {
            "type": "mass_spring_damper",
            "mass": f"{n['mass']:.9g} ug",
            "damping": f"{n['film']:.9g} uN s/m",
            "stiffness": f"{n['springs']:.9g} N/m",
            "in": "shaken",
        },
        "readout": gain(n["readout"], "mV/um", "proof.position"),
    }
    return {"a": {"unit": "m/s^2"}}, blocks, {"y": "readout"}


PROOF = Machine(
    "accelerometer",
    "Accelerometer of silicon",
    ("m/s^2", 0.0, 80.0, 3),
    [("y", "mV", (0.003, 0.01))],
    dict(shaken=(1.0, 1.6), mass=(1.0, 1.6), film=(15, 40), springs=(0.3, 0.6), readout=(30, 70)),
    dict(mass="proof.mass", film="proof.damping", springs="proof.stiffness", readout="readout.gain"),
    [["shaken.gain", "proof.mass", "proof.damping", "proof.stiffness", "readout.gain"]],
    ["shaken.gain", "readout.gain"],
    4e-4,
    2.5e-5,
    1e-3,
    proof_rate,
    proof_sense,
    lambda n, hidden: np.array(
        [1e-9 * n["shaken"], 1e-9 * n["mass"], 1e-6 * n["film"], n["springs"], n["readout"], *off(hidden, "hardens")]
    ),
    lambda p, u, kelvin: np.zeros(2),
    proof_diagram,
    dict(stiffening=lambda a, lab: dict(hardens=a / (lab.half_of(0) / lab.numbers["readout"]) ** 2)),
    sides=(("T_chip", "degC", "", 26.0, 0.6), ("", "", "", 0.0, 0.0)),
    parts=20,
    cases=[
        ("none", (), "-"),
        ("single", ("temperature_gain",), "medium"),
        ("single", ("stiffening",), "weak"),
        ("wrong", (), "-"),
        ("wrong_plus", ("saturation_s",), "strong"),
        ("starved", ("temperature_gain",), "medium", "calibration", "prbs"),
    ],
)


# ---- rod of Terfenol-D about its bias (Engdahl, Handbook of Giant Magnetostrictive Materials) ----------------------------------


@njit
def rod_rate(x, v, side, p, dx):
    w = 2 * np.pi * p[2]
    dx[0] = (v - x[0]) / p[0]
    dx[1] = x[2]
    dx[2] = w * w * (p[1] * x[0] - x[1]) - 2 * p[3] * w * x[2]


@njit
def rod_sense(x, v, side, p, y):
    y[0] = x[1]


def rod_start(p, u, kelvin):
    return np.array([u, p[1] * u, 0.0])


def rod_diagram(n):
    blocks = {
        "coil": {"type": "lag", "times": [f"{n['coil']:.9g} ms"], "in": "i"},
        "rod": gain(n["stroke"], "um/A", "coil"),
        "horn": {"type": "resonance", "frequency": f"{n['horn']:.9g} Hz", "damping": n["damping"], "in": "rod"},
    }
    return {"i": {"unit": "A"}}, blocks, {"x": "horn"}


ROD = Machine(
    "rod",
    "Magnetostrictive actuator",
    ("A", 0.0, 3.0, 4),
    [("x", "um", (0.002, 0.008))],
    dict(coil=(0.6, 1.5), stroke=(6, 12), horn=(250, 450), damping=(0.05, 0.2)),
    dict(coil="coil.times[0]", stroke="rod.gain", horn="horn.frequency", damping="horn.damping"),
    [],
    ["rod.gain"],
    4e-3,
    3e-4,
    0.01,
    rod_rate,
    rod_sense,
    lambda n, hidden: np.array([1e-3 * n["coil"], n["stroke"], n["horn"], n["damping"]]),
    rod_start,
    rod_diagram,
    {},
    sides=(("T_rod", "degC", "", 30.0, 1.0), ("", "", "", 0.0, 0.0)),
    parts=20,
    cases=[
        ("none", (), "-"),
        ("single", ("creep",), "medium"),
        ("single", ("hysteresis",), "strong"),
        ("wrong", (), "-"),
        ("wrong_plus", ("asymmetry",), "medium"),
        ("pair", ("hysteresis", "temperature_gain"), "strong"),
    ],
)
