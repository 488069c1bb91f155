"""A geared axis, a hydraulic axis, an arm that hangs, a galvanometer scanner: equations and diagrams."""
import numpy as np
from numba import njit

from machine import Machine, gain, lag_of_one, minus, off

# ---- motor, gear, load (Nordin, Gutman, Automatica 38 (2002) 1633) --------------------------------------------------------------


@njit
def bristles(w, z, coulomb, excess, stribeck, stiffness):
    """Torque and rate of the mean bristle: LuGre (Canudas de Wit and others, 1995), without its damping."""
    slides = coulomb * (1 + excess * np.exp(-((w / stribeck) ** 2)))
    return stiffness * z, w - stiffness * abs(w) / max(slides, 1e-30) * z


@njit
def geared_rate(x, v, side, p, dx):
    # x: angle and speed of motor and load, bristle
    torque, inertia, damping, ratio, stiffness, contact, load, loss = p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]
    gap, coulomb, excess, stribeck, teeth, drag = p[8], p[9], p[10], p[11], p[12], p[13]
    twist, rate = x[0] / ratio - x[2], x[1] / ratio - x[3]
    out = 0.0
    if twist > gap / 2:
        out = (
            max(stiffness * (twist - gap / 2) + contact * rate, 0.0) if gap > 0 else stiffness * twist + contact * rate
        )
    elif twist < -gap / 2:
        out = (
            min(stiffness * (twist + gap / 2) + contact * rate, 0.0) if gap > 0 else stiffness * twist + contact * rate
        )
    held, dx[4] = 0.0, 0.0
    if coulomb > 0:
        held, dx[4] = bristles(x[3], x[4], coulomb, excess, stribeck, coulomb / 2e-3)
    dx[0] = x[1]
    dx[1] = (torque * v - damping * x[1] - out / ratio + teeth * np.sin(28 * x[0] + 0.7)) / inertia
    dx[2] = x[3]
    dx[3] = (out - loss * x[3] - held - drag * x[3] * abs(x[3])) / load


@njit
def geared_sense(x, v, side, p, y):
    y[0], y[1] = x[3], x[1]


def geared_diagram(n):
    blocks = {
        "magnet": gain(n["torque"], "N m/A", "i"),
        "net": minus("magnet", "gear.torque_in"),
        "rotor": {
            "type": "inertia",
            "inertia": f"{n['inertia']:.9g} kg m^2",
            "damping": f"{n['damping']:.9g} N m s/rad",
            "stiffness": "0 N m/rad",
            "in": "net",
        },
        "gear": {
            "type": "gear",
            "ratio": n["ratio"],
            "stiffness": f"{n['stiffness']:.9g} N m/rad",
            "damping": f"{n['contact']:.9g} N m s/rad",
            "in": ["rotor.angle", "rotor.velocity", "table.angle", "table.velocity"],
        },
        "table": {
            "type": "inertia",
            "inertia": f"{n['load']:.9g} kg m^2",
            "damping": f"{n['loss']:.9g} N m s/rad",
            "stiffness": "0 N m/rad",
            "in": "gear.torque_out",
        },
    }
    return {"i": {"unit": "A"}}, blocks, {"w_table": "table.velocity", "w_motor": "rotor.velocity"}


GEARED = Machine(
    "geared",
    "Rotary table behind a gear",
    ("A", 0.0, 2.0, 4),
    [("w_table", "rad/s", (0.003, 0.01)), ("w_motor", "rad/s", (0.003, 0.01))],
    dict(
        torque=(0.04, 0.08),
        inertia=(2e-5, 5e-5),
        damping=(1e-4, 3e-4),
        ratio=(12, 24),
        stiffness=(60, 160),
        contact=(0.02, 0.08),
        load=(0.01, 0.03),
        loss=(0.04, 0.12),
    ),
    dict(
        torque="magnet.gain",
        inertia="rotor.inertia",
        damping="rotor.damping",
        load="table.inertia",
        loss="table.damping",
        stiffness="gear.stiffness",
    ),
    [
        [
            "magnet.gain",
            "rotor.inertia",
            "rotor.damping",
            "gear.stiffness",
            "gear.damping",
            "table.inertia",
            "table.damping",
        ]
    ],
    ["magnet.gain"],
    0.12,
    4e-3,
    0.4,
    geared_rate,
    geared_sense,
    lambda n, hidden: np.array(
        [n[k] for k in ("torque", "inertia", "damping", "ratio", "stiffness", "contact", "load", "loss")]
        + off(hidden, "gap", "coulomb", "excess")
        + [0.3]
        + off(hidden, "teeth", "drag")
    ),
    lambda p, u, kelvin: np.zeros(5),
    geared_diagram,
    dict(
        backlash=lambda a, lab: dict(gap=0.05 * a),
        friction=lambda a, lab: dict(coulomb=0.4 * a * lab.numbers["torque"] * lab.numbers["ratio"]),
        stribeck_friction=lambda a, lab: dict(
            coulomb=0.4 * a * lab.numbers["torque"] * lab.numbers["ratio"], excess=0.8
        ),
        cogging=lambda a, lab: dict(teeth=0.5 * a * lab.numbers["torque"]),
        quadratic_drag=lambda a, lab: dict(drag=a * lab.numbers["loss"]),
    ),
    sides=(("T_motor", "degC", "", 38.0, 4.0), ("", "", "", 0.0, 0.0)),
    loop=(0.25, 1.5, 0.0),
    aims=(0.0, 5.0),
    parts=40,
    integrates=True,
    cases=[
        ("none", (), "-"),
        ("single", ("quadratic_drag",), "weak"),
        ("single", ("friction",), "strong"),
        ("wrong", (), "-"),
        ("wrong_plus", ("backlash",), "medium"),
        ("outside", ("knocked",), "medium"),
    ],
)


# ---- servo valve, cylinder, mass (Merritt, Hydraulic Control Systems, chapter 6) ------------------------------------------------

LITRE_PER_MINUTE, BAR = 1e-3 / 60, 1e5


@njit
def hydraulic_rate(x, v, side, p, dx):
    # x: spool and its rate [l/min], pressure [bar], position [m], speed [m/s], bristle [m]
    w, damping = 2 * np.pi * p[1], p[2]
    held, dx[5] = 0.0, 0.0
    if p[9] > 0:
        held, dx[5] = bristles(x[4], x[5], p[9], p[10], 0.02, p[9] / 4e-5)
    dx[0] = x[1]
    dx[1] = w * w * (p[0] * v - x[0]) - 2 * damping * w * x[1]
    dx[2] = p[3] * (x[0] - p[4] * 1e3 * x[4] - p[5] * x[2]) / 60
    dx[3] = x[4]
    dx[4] = (p[6] * x[2] - p[8] * x[4] - held) / p[7]


@njit
def hydraulic_sense(x, v, side, p, y):
    y[0], y[1] = 1e3 * x[3], x[2]


def hydraulic_diagram(n):
    blocks = {
        "valve": {
            "type": "second_order",
            "gain": f"{n['valve']:.9g} l/min/V",
            "frequency": f"{n['spool']:.9g} Hz",
            "damping": n["spool_damping"],
            "in": "u",
        },
        "taken": {"type": "sum", "signs": "+--", "in": ["valve", "moved", "leak"]},
        "oil": gain(n["oil"], "bar/l", "taken"),
        "pressure": {"type": "integrator", "in": "oil"},
        "leak": gain(n["leak"], "l/min/bar", "pressure"),
        "piston": gain(n["area"], "N/bar", "pressure"),
        "slide": {
            "type": "mass_spring_damper",
            "mass": f"{n['mass']:.9g} kg",
            "damping": f"{n['seal']:.9g} N s/m",
            "stiffness": "0 N/m",
            "in": "piston",
        },
        "moved": gain(n["swept"], "l/min/(mm/s)", "slide.velocity"),
    }
    return {"u": {"unit": "V"}}, blocks, {"x": "slide.position", "p": "pressure"}


HYDRAULIC = Machine(
    "hydraulic",
    "Hydraulic servo axis",
    ("V", 0.0, 5.0, 4),
    [("x", "mm", (0.001, 0.004)), ("p", "bar", (0.004, 0.015))],
    dict(
        valve=(2, 4),
        spool=(50, 90),
        spool_damping=(0.6, 0.9),
        oil=(15000, 30000),
        leak=(0.01, 0.03),
        area=(80, 140),
        mass=(60, 140),
        seal=(300, 900),
        swept=(0.05, 0.08),
    ),
    dict(
        valve="valve.gain",
        mass="slide.mass",
        seal="slide.damping",
        swept="moved.gain",
        oil="oil.gain",
        area="piston.gain",
    ),
    [["piston.gain", "slide.mass", "slide.damping"], ["valve.gain", "moved.gain", "leak.gain", "oil.gain"]],
    ["valve.gain"],
    0.15,
    4e-3,
    0.3,
    hydraulic_rate,
    hydraulic_sense,
    lambda n, hidden: np.array(
        [n[k] for k in ("valve", "spool", "spool_damping", "oil", "swept", "leak", "area", "mass", "seal")]
        + off(hidden, "coulomb", "excess")
    ),
    lambda p, u, kelvin: np.zeros(6),
    hydraulic_diagram,
    dict(
        friction=lambda a, lab: dict(coulomb=2000 * a),
        stribeck_friction=lambda a, lab: dict(coulomb=2000 * a, excess=0.7),
    ),
    sides=(("T_oil", "degC", "", 44.0, 4.0), ("", "", "", 0.0, 0.0)),
    loop=(0.08, 0.0, 0.0),
    aims=(0.0, 40.0),
    parts=40,
    mostly_closed=True,
    integrates=True,
    cases=[
        ("none", (), "-"),
        ("single", ("backlash_s",), "medium"),
        ("single", ("friction",), "strong"),
        ("wrong", (), "-"),
        ("wrong_plus", ("dead_time",), "medium"),
        ("pair", ("stribeck_friction", "sensor_lag"), "medium"),
    ],
)


# ---- an arm that hangs (Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, chapter 6) ----------------------------------


@njit
def arm_rate(x, v, side, p, dx):
    # x: angle [rad], speed, bristle
    held, dx[2] = 0.0, 0.0
    if p[5] > 0:
        held, dx[2] = bristles(x[1], x[2], p[5], p[6], 0.25, p[5] / 4e-3)
    dx[0] = x[1]
    dx[1] = (p[0] * v - p[4] * x[1] - held - p[1] * 9.80665 * p[2] * np.sin(x[0])) / (p[3] + p[1] * p[2] ** 2)


@njit
def arm_sense(x, v, side, p, y):
    y[0] = x[0] * 180 / np.pi


def arm_diagram(n):
    blocks = {
        "motor": gain(n["torque"], "N m/V", "u"),
        "arm": {
            "type": "pendulum",
            "mass": f"{n['mass']:.9g} kg",
            "length": f"{n['length']:.9g} mm",
            "inertia": f"{n['inertia']:.9g} kg m^2",
            "damping": f"{n['damping']:.9g} N m s/rad",
            "in": "motor",
        },
    }
    return {"u": {"unit": "V"}}, blocks, {"angle": "arm.angle"}


ARM = Machine(
    "arm",
    "Robot arm in a vertical plane",
    ("V", 0.0, 5.0, 3),
    [("angle", "deg", (0.002, 0.008))],
    dict(torque=(0.35, 0.6), mass=(1.0, 1.8), length=(240, 340), inertia=(0.01, 0.03), damping=(0.2, 0.5)),
    dict(torque="motor.gain", mass="arm.mass", damping="arm.damping", length="arm.length"),
    [["motor.gain", "arm.mass", "arm.damping", "arm.inertia"]],
    ["motor.gain"],
    0.5,
    0.02,
    1.2,
    arm_rate,
    arm_sense,
    lambda n, hidden: np.array(
        [n["torque"], n["mass"], 1e-3 * n["length"], n["inertia"], n["damping"], *off(hidden, "coulomb", "excess")]
    ),
    lambda p, u, kelvin: np.zeros(3),
    arm_diagram,
    dict(
        friction=lambda a, lab: dict(coulomb=0.5 * a),
        stribeck_friction=lambda a, lab: dict(coulomb=0.5 * a, excess=0.8),
    ),
    sides=(("T_motor", "degC", "", 33.0, 4.0), ("", "", "", 0.0, 0.0)),
    loop=(0.03, 0.08, 0.008),
    aims=(0.0, 40.0),
    parts=40,
    cases=[
        ("none", (), "-"),
        ("single", ("quantization",), "weak"),
        ("single", ("friction",), "medium"),
        ("wrong", (), "-"),
        ("wrong_plus", ("saturation",), "strong"),
        ("pair", ("stribeck_friction", "dead_time"), "medium"),
    ],
)


# ---- galvanometer scanner on a torsion bar (Aylward, Proc. SPIE 3787) ------------------------------------------------------------


@njit
def galvo_rate(x, v, side, p, dx):
    dx[0] = x[1]
    dx[1] = (p[0] * v - p[2] * x[1] - p[3] * x[0]) / p[1]


@njit
def galvo_sense(x, v, side, p, y):
    y[0] = 1e3 * x[0]


def galvo_diagram(n):
    blocks = {
        "magnet": gain(n["torque"], "mN m/A", "i"),
        "mirror": {
            "type": "inertia",
            "inertia": f"{n['inertia']:.9g} g cm^2",
            "damping": f"{n['damping']:.9g} mN m s/rad",
            "stiffness": f"{n['bar']:.9g} mN m/rad",
            "in": "magnet",
        },
    }
    return {"i": {"unit": "A"}}, blocks, {"angle": "mirror.angle"}


GALVO = Machine(
    "galvo",
    "Galvanometer scanner",
    ("A", 0.0, 1.5, 4),
    [("angle", "mrad", (0.002, 0.008))],
    dict(torque=(8, 15), inertia=(1.0, 2.0), damping=(0.03, 0.08), bar=(60, 130)),
    dict(torque="magnet.gain", inertia="mirror.inertia", damping="mirror.damping", bar="mirror.stiffness"),
    [["magnet.gain", "mirror.inertia", "mirror.damping", "mirror.stiffness"]],
    ["magnet.gain"],
    4e-3,
    2.5e-4,
    0.015,
    galvo_rate,
    galvo_sense,
    lambda n, hidden: np.array([1e-3 * n["torque"], 1e-7 * n["inertia"], 1e-3 * n["damping"], 1e-3 * n["bar"]]),
    lambda p, u, kelvin: np.zeros(2),
    galvo_diagram,
    {},
    sides=(("T_mirror", "degC", "", 27.0, 1.0), ("i_other", "A", "", 0.0, 1.5)),
    parts=20,
    cases=[
        ("none", (), "-"),
        ("single", ("structural_resonance",), "medium"),
        ("single", ("amplifier_lag",), "weak"),
        ("starved", ("temperature_gain",), "medium", "calibration", "multisine"),
        ("wrong_plus", ("sensor_nonlinearity",), "strong"),
        ("outside", ("sensor_periodic",), "medium"),
    ],
)
