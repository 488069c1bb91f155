"""A buck converter, a lithium-ion cell, a loudspeaker, a thermoelectric cooler: equations and diagrams."""
import numpy as np
from numba import njit

from machine import Machine, gain, lag_of_one, minus, off


# ---- buck converter, averaged over the switching period (Erickson, Maksimovic, Fundamentals of Power Electronics) ----------


@njit
def buck_rate(x, v, side, p, dx):
    supply, admittance, coil, elastance, load = p[0], p[1], p[2], p[3], p[4]
    dx[0] = (admittance * (supply * v - x[1]) - x[0]) / coil
    dx[1] = elastance * (x[0] - load * x[1])


@njit
def buck_sense(x, v, side, p, y):
    y[0], y[1] = x[1], x[0]


def buck_start(p, u, kelvin):
    v = p[1] * p[0] * u / (p[1] + p[4])
    return np.array([p[4] * v, v])


def buck_diagram(n):
    blocks = {
        "switch": gain(n["supply"], "V/%", "duty"),
        "across": minus("switch", "output"),
        "coil": lag_of_one(n["coil"], f"{n['admittance']:.9g} A/V", "across"),
        "surplus": minus("coil", "load"),
        "capacitor": gain(n["elastance"], "V/(A s)", "surplus"),
        "output": {"type": "integrator", "in": "capacitor"},
        "load": gain(n["load"], "A/V", "output"),
    }
    return {"duty": {"unit": "%"}}, blocks, {"v": "output", "i": "coil"}


BUCK = Machine(
    "buck",
    "Buck converter, averaged",
    ("%", 40.0, 30.0, 3),
    [("v", "V", (0.002, 0.01)), ("i", "A", (0.004, 0.015))],
    dict(supply=(0.18, 0.4), admittance=(3.0, 8.0), coil=(6e-4, 1.6e-3), elastance=(1500, 4000), load=(0.2, 0.5)),
    dict(
        supply="switch.gain", admittance="coil.gain", coil="coil.den[0]", elastance="capacitor.gain", load="load.gain"
    ),
    [["coil.gain", "coil.num[0]", "coil.den[0]", "coil.den[1]"]],
    ["switch.gain"],
    5e-4,
    4e-5,
    3e-3,
    buck_rate,
    buck_sense,
    lambda n, hidden: np.array([n["supply"], n["admittance"], n["coil"], n["elastance"], n["load"]]),
    buck_start,
    buck_diagram,
    {},
    sides=(("T_sink", "degC", "", 41.0, 2.0), ("", "", "", 0.0, 0.0)),
    loop=(0.8, 2500.0, 0.0),
    aims=(8.0, 4.0),
    cases=[
        ("none", (), "-"),
        ("single", ("sensor_lag",), "weak"),
        ("single", ("saturation",), "strong"),
        ("wrong", (), "-"),
        ("wrong_plus", ("slew_limit",), "medium"),
        ("outside", ("dropped",), "medium"),
    ],
)


# ---- lithium-ion cell with two RC pairs (Plett, Battery Management Systems I) -----------------------------------------------

CHARGES = np.array([0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0])
VOLTS = np.array([3.0, 3.43, 3.58, 3.68, 3.92, 4.08, 4.18])


@njit
def cell_rate(x, v, side, p, dx):
    dx[0] = -v / p[0]
    dx[1] = (v - x[1]) / p[4]
    dx[2] = (v - x[2]) / p[5]


@njit
def cell_sense(x, v, side, p, y):
    k = min(max(np.searchsorted(CHARGES, x[0]) - 1, 0), len(CHARGES) - 2)
    open_circuit = VOLTS[k] + (VOLTS[k + 1] - VOLTS[k]) * (x[0] - CHARGES[k]) / (CHARGES[k + 1] - CHARGES[k])
    y[0] = 1e3 * (open_circuit - p[1] * v - p[2] * x[1] - p[3] * x[2])


def cell_start(p, u, kelvin):
    return np.array([p[6], u, u])


def cell_diagram(n):
    cell = {
        "type": "battery_cell",
        "capacity": f"{n['capacity']:.9g} C",
        "resistance": f"{n['r0']:.9g} ohm",
        "charges": CHARGES.tolist(),
        "open_circuit": [f"{x:g} V" for x in VOLTS],
        "resistances": [f"{n['r1']:.9g} ohm", f"{n['r2']:.9g} ohm"],
        "times": [f"{n['t1']:.9g} s", f"{n['t2']:.9g} s"],
        "initial": n["charge"],
        "in": "i",
    }
    return {"i": {"unit": "A"}}, {"cell": cell}, {"v": "cell.voltage"}


CELL = Machine(
    "cell",
    "Lithium-ion cell",
    ("A", 0.0, 3.0, 4),
    [("v", "mV", (0.004, 0.02))],
    dict(
        capacity=(14000, 24000),
        r0=(0.02, 0.05),
        r1=(0.008, 0.02),
        r2=(0.01, 0.03),
        t1=(15, 35),
        t2=(180, 400),
        charge=(0.5, 0.6),
    ),
    dict(
        capacity="cell.capacity",
        r0="cell.resistance",
        r1="cell.resistances[0]",
        r2="cell.resistances[1]",
        t1="cell.times[0]",
        t2="cell.times[1]",
    ),
    [],
    [],
    40.0,
    1.0,
    0.0,
    cell_rate,
    cell_sense,
    lambda n, hidden: np.array([n[k] for k in ("capacity", "r0", "r1", "r2", "t1", "t2", "charge")]),
    cell_start,
    cell_diagram,
    {},
    integrates=True,
    sides=(("T_cell", "degC", "", 25.0, 2.0), ("i_neighbour", "A", "", 0.0, 2.5)),
    cases=[
        ("none", (), "-"),
        ("single", ("quantization",), "weak"),
        ("single", ("cross_coupling_s",), "strong"),
        ("wrong", (), "-"),
        ("wrong_plus", ("sensor_lag",), "medium"),
        ("pair", ("sensor_drift", "dead_time"), "medium"),
    ],
    parts=16,
)


# ---- loudspeaker by the parameters of Thiele and Small -----------------------------------------------------------------------


@njit
def speaker_rate(x, v, side, p, dx):
    admittance, coil, force, mass, damping, stiffness, emf = p[0], p[1], p[2], p[3], p[4], p[5], p[6]
    dx[0] = (admittance * (v - emf * x[2]) - x[0]) / coil
    dx[1] = x[2]
    # suspension k(x) of Klippel, J. Audio Eng. Soc. 54 (2006) 907: hardens with the square of the excursion
    dx[2] = (force * x[0] - damping * x[2] - stiffness * x[1] * (1 + p[7] * x[1] ** 2) - p[8] * x[2] * abs(x[2])) / mass


@njit
def speaker_sense(x, v, side, p, y):
    y[0], y[1] = 1e3 * x[1], x[0]


def speaker_diagram(n):
    blocks = {
        "drive": minus("u", "back"),
        "coil": lag_of_one(n["coil"], f"{n['admittance']:.9g} A/V", "drive"),
        "motor": gain(n["force"], "N/A", "coil"),
        "cone": {
            "type": "mass_spring_damper",
            "mass": f"{n['mass']:.9g} g",
            "damping": f"{n['damping']:.9g} N s/m",
            "stiffness": f"{n['stiffness']:.9g} N/m",
            "in": "motor",
        },
        "back": gain(n["emf"], "V s/m", "cone.velocity"),
    }
    return {"u": {"unit": "V"}}, blocks, {"x": "cone.position", "i": "coil"}


SPEAKER = Machine(
    "speaker",
    "Loudspeaker",
    ("V", 0.0, 9.0, 4),
    [("x", "mm", (0.003, 0.012)), ("i", "A", (0.004, 0.012))],
    dict(
        admittance=(0.14, 0.28),
        coil=(1e-4, 3e-4),
        force=(5, 9),
        mass=(14, 35),
        damping=(0.8, 2.5),
        stiffness=(1500, 3500),
        emf=(5, 9),
    ),
    dict(
        admittance="coil.gain",
        force="motor.gain",
        mass="cone.mass",
        damping="cone.damping",
        stiffness="cone.stiffness",
        emf="back.gain",
    ),
    [
        ["coil.gain", "coil.num[0]", "coil.den[0]", "coil.den[1]"],
        ["motor.gain", "cone.mass", "cone.damping", "cone.stiffness"],
    ],
    ["coil.gain", "motor.gain"],
    8e-3,
    5e-4,
    0.02,
    speaker_rate,
    speaker_sense,
    lambda n, hidden: np.array(
        [
            n["admittance"],
            n["coil"],
            n["force"],
            1e-3 * n["mass"],
            n["damping"],
            n["stiffness"],
            n["emf"],
            *off(hidden, "hardens", "drag"),
        ]
    ),
    lambda p, u, kelvin: np.zeros(3),
    speaker_diagram,
    dict(
        stiffening=lambda a, lab: dict(hardens=a / (1e-3 * lab.half_of("x")) ** 2),
        quadratic_drag=lambda a, lab: dict(drag=20 * a),
    ),
    sides=(("T_room", "degC", "", 23.0, 1.0), ("", "", "", 0.0, 0.0)),
    parts=40,
    cases=[
        ("none", (), "-"),
        ("single", ("mains_interference",), "weak"),
        ("single", ("stiffening",), "strong"),
        ("wrong", (), "-"),
        ("wrong_plus", ("sensor_nonlinearity",), "strong"),
        ("pair", ("stiffening", "saturation"), "medium"),
    ],
)
