"""What a machine is to the generator: its numbers as the user writes them, its equations, its diagram, its laboratory."""
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Machine:
    name: str
    title: str
    drive: tuple  # (unit, value at rest, largest departure from it, digits behind the point)
    outputs: list  # (name, unit, share of its deviation that is noise (low, high))
    numbers: dict  # name -> (low, high), drawn in between and rounded to three digits: what the user writes
    paths: dict  # number -> path in the diagram, of those that may be written wrongly
    scale_groups: list  # of paths
    gains: list  # of paths
    tau: float  # what it settles in [s]
    dt: float  # s between rows
    slowest: float  # time constant [s] of which eight bring it to rest
    rate: object  # (x, v, side, p, dx), compiled
    sense: object  # (x, v, side, p, y), compiled
    plant: object  # (numbers, hidden) -> p, with everything of `hidden` off where it is absent
    start: object  # (p, drive at rest, temperature) -> x
    diagram: object  # numbers -> (inputs, blocks, outputs)
    effects: dict  # name -> function of Lab; ways to enter beside those of every wire
    sides: tuple = (
        ("T_room", "degC", "", 22.0, 1.0),
        ("", "", "", 0.0, 0.0),
    )  # temperature, other: name, unit, input, middle, swing
    loop: tuple = ()  # kp, ki, kd, in units of drive and first output
    aims: tuple = ()  # of the loop: middle and largest departure
    integrates: bool = False  # under a drive it never rests
    mostly_closed: bool = False  # nobody lets it run open for long
    parts: int = 20  # fine steps in a row
    kinds: tuple = ("steps", "prbs", "multisine", "chirp", "triangle", "sine", "hand")
    cases: list = field(default_factory=list)  # (group, keys of what is hidden, strength)


def off(hidden, *names):
    """Numbers of the plant's own effects, zero where nothing is hidden."""
    return [hidden.get(name, 0.0) for name in names]


def significant(x, digits=3):
    return float("%.*g" % (digits, x))


def draw_numbers(rng, machine):
    return {
        name: significant(np.exp(rng.uniform(np.log(low), np.log(high))))
        for name, (low, high) in machine.numbers.items()
    }


def gain(value, unit, wire):
    return {"type": "gain", "gain": f"{value:.9g} {unit}", "in": wire}


def minus(first, second):
    return {"type": "sum", "signs": "+-", "in": [first, second]}


def lag_of_one(value, gain_text, wire):
    return {"type": "transfer_function", "gain": gain_text, "num": [1], "den": [value, 1], "in": wire}
