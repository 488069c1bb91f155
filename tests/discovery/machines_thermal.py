"""A heat exchanger behind a pipe and a thermoelectric cooler: equations and diagrams."""
import numpy as np
from numba import njit

from machine import Machine, gain

# ---- steam-heated exchanger, its outlet measured at the end of a pipe (Bequette, Process Control, chapter 3) --------------


@njit
def exchanger_rate(x, v, side, p, dx):
    # x: stem of the valve [%], water [degC], probe [degC]
    dx[0] = (v - x[0]) / p[0]
    dx[1] = (1e3 * p[1] * x[0] + 1e3 * p[3] * (side[0] - x[1])) / (1e3 * p[2])
    dx[2] = (x[1] - x[2]) / p[4]


@njit
def exchanger_sense(x, v, side, p, y):
    y[0] = x[2]


def exchanger_start(p, u, kelvin):
    outlet = kelvin + p[1] * u / p[3]
    return np.array([u, outlet, outlet])


def exchanger_diagram(n):
    blocks = {
        "valve": {"type": "lag", "times": [f"{n['stem']:.9g} s"], "in": "u"},
        "steam": gain(n["steam"], "kW/%", "valve"),
        "shell": {
            "type": "thermal_network",
            "capacities": [f"{n['heat']:.9g} kJ/K"],
            "to_ambient": [f"{n['flow']:.9g} kW/K"],
            "initial": ["60 degC"],
            "in": {"heat": "steam", "ambient": "T_in"},
        },
        "probe": {"type": "lag", "times": [f"{n['probe']:.9g} s"], "in": "shell.temperature[0]"},
    }
    return {"u": {"unit": "%"}, "T_in": {"unit": "degC"}}, blocks, {"T": "probe"}


EXCHANGER = Machine(
    "exchanger",
    "Heat exchanger with steam",
    ("%", 45.0, 30.0, 2),
    [("T", "degC", (0.003, 0.012))],
    dict(stem=(3, 7), steam=(0.8, 1.6), heat=(60, 140), flow=(1.2, 2.4), probe=(6, 14)),
    dict(
        stem="valve.times[0]",
        steam="steam.gain",
        heat="shell.capacities[0]",
        flow="shell.to_ambient[0]",
        probe="probe.times[0]",
    ),
    [["steam.gain", "shell.capacities[0]", "shell.to_ambient[0]"]],
    ["steam.gain"],
    60.0,
    2.0,
    60.0,
    exchanger_rate,
    exchanger_sense,
    lambda n, hidden: np.array([n["stem"], n["steam"], n["heat"], n["flow"], n["probe"]]),
    exchanger_start,
    exchanger_diagram,
    {},
    sides=(("T_in", "degC", "T_in", 22.0, 3.0), ("flow", "l/min", "", 28.0, 3.0)),
    loop=(0.6, 0.012, 0.0),
    aims=(52.0, 14.0),
    cases=[
        ("none", (), "-"),
        ("single", ("dead_time",), "medium"),
        ("single", ("asymmetry",), "strong"),
        ("wrong", (), "-"),
        ("wrong_plus", ("backlash",), "medium"),
        ("pair", ("dead_time", "slew_limit"), "strong"),
    ],
)


# ---- thermoelectric cooler about its working point (Rowe, CRC Handbook of Thermoelectrics, chapter 49) -------------------------


@njit
def cooler_rate(x, v, side, p, dx):
    # x: cold plate, heat sink [degC]
    pumped, through = p[0] * v, p[4] * (x[1] - x[0])
    dx[0] = (-pumped + through + p[5] * (side[0] - x[0])) / p[2]
    dx[1] = (p[1] * v - through + p[6] * (side[0] - x[1])) / p[3]


@njit
def cooler_sense(x, v, side, p, y):
    y[0], y[1] = x[0], x[1]


def cooler_start(p, u, kelvin):
    a = np.array([[p[4] + p[5], -p[4]], [-p[4], p[4] + p[6]]])
    return kelvin + np.linalg.solve(a, np.array([-p[0] * u, p[1] * u]))


def cooler_diagram(n):
    blocks = {
        "taken": gain(n["cold"], "W/A", "i"),
        "given": gain(n["hot"], "W/A", "i"),
        "drawn": {"type": "sum", "signs": "-", "in": ["taken"]},
        "heat": {"type": "mux", "in": ["drawn", "given"]},
        "plates": {
            "type": "thermal_network",
            "capacities": [f"{n['plate']:.9g} J/K", f"{n['sink']:.9g} J/K"],
            "to_ambient": [f"{n['leak']:.9g} W/K", f"{n['fan']:.9g} W/K"],
            "between": [f"{n['element']:.9g} W/K"],
            "initial": ["22 degC", "22 degC"],
            "in": {"heat": "heat", "ambient": "T_room"},
        },
    }
    return (
        {"i": {"unit": "A"}, "T_room": {"unit": "degC"}},
        blocks,
        {"T_cold": "plates.temperature[0]", "T_hot": "plates.temperature[1]"},
    )


COOLER = Machine(
    "cooler",
    "Thermoelectric cooler",
    ("A", 0.0, 2.5, 4),
    [("T_cold", "degC", (0.003, 0.01)), ("T_hot", "degC", (0.004, 0.015))],
    dict(cold=(9, 14), hot=(11, 17), plate=(30, 70), sink=(250, 600), leak=(0.08, 0.2), fan=(4, 9), element=(0.6, 1.2)),
    dict(
        cold="taken.gain",
        hot="given.gain",
        plate="plates.capacities[0]",
        sink="plates.capacities[1]",
        fan="plates.to_ambient[1]",
        element="plates.between[0]",
    ),
    [
        [
            "taken.gain",
            "given.gain",
            "plates.capacities[0]",
            "plates.capacities[1]",
            "plates.to_ambient[0]",
            "plates.to_ambient[1]",
            "plates.between[0]",
        ]
    ],
    ["taken.gain", "given.gain"],
    50.0,
    1.0,
    80.0,
    cooler_rate,
    cooler_sense,
    lambda n, hidden: np.array([n[k] for k in ("cold", "hot", "plate", "sink", "element", "leak", "fan")]),
    cooler_start,
    cooler_diagram,
    {},
    sides=(("T_room", "degC", "T_room", 22.0, 2.0), ("P_lamp", "W", "", 2.0, 2.0)),
    loop=(-0.25, -0.01, 0.0),
    aims=(20.0, 12.0),
    parts=10,
    cases=[
        ("none", (), "-"),
        ("single", ("sensor_lag",), "medium"),
        ("single", ("slew_limit",), "strong"),
        ("wrong", (), "-"),
        ("wrong_plus", ("cross_coupling",), "medium"),
        ("outside", ("dropped",), "medium"),
    ],
)
