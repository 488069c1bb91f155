"""One case: plant, recordings, what is hidden, its strength, the truth; deterministic by seed, kind and number.

Decides the mixture of each kind (single, pair, triple, none, unknown, starved).
Does not decide physics, drawing of effects, or file formats (laws, hidden, unlisted, case_files).
"""
from dataclasses import dataclass
from itertools import combinations

import numpy as np

import case_files
import excitations
import hidden
import unlisted
from alternatives import TIE, alternatives, gap, known_by, left_by
from laws import lag
from plants import draw_plant, heater_matrices, simulate, uncertain_numbers

KINDS = ("singles", "pairs", "triples", "nothing", "unlisted", "starved")
GROUP = dict(singles="single", pairs="pair", triples="triple", nothing="none", unlisted="unknown", starved="starved")
PER_SEED = dict(pairs=6, triples=2, nothing=10, unlisted=4, starved=4)  # singles: every effect in every strength
MENU = dict(actuator=("sine_multiamp", "triangle", "freq_low", "freq_high", "step_hold", "steps", "multisine", "chirp",
                      "temp_staircase", "temp_ramp"),
            mass=("triangle", "sine_multiamp", "steps", "step_hold", "multisine", "chirp"),
            heater=("step", "staircase", "prbs", "steps", "sine"))
# What a laboratory records that means to know its device: the same words in every case.
CAMPAIGN = dict(actuator=dict(train=("sine_multiamp", "triangle", "freq_low", "freq_high", "step_hold", "multisine",
                                     "temp_staircase"),
                              validate=("sine_multiamp", "step_hold", "multisine", "temp_ramp")),
                mass=dict(train=MENU["mass"], validate=MENU["mass"]),
                heater=dict(train=("step", "staircase", "prbs"), validate=("steps", "sine", "prbs")))
ATTEMPTS = 400
ATTEMPTS_WITH_NOISE = 15  # then the sensor is a quieter one


class Unsuited(Exception):
    """This draw cannot hold what was asked for; another one may."""


@dataclass
class Case:
    plant: object
    recordings: list
    effects: list
    sensor: dict
    expected: dict
    group: str


def of_plant(table, base):
    return table[{"B4": "mass", "B5": "heater"}.get(base, "actuator")]


def draw_recordings(rng, plant, shows, campaign=False, words=None):
    """2 to 8 recordings; of each set in `shows` one word among those of either role, the same in both. `campaign`: those
    of a whole campaign instead."""
    roles, habits = {}, {}
    if campaign:
        roles = of_plant(CAMPAIGN, plant.base)
        return play(rng, plant, roles, habits)
    needed = [str(rng.choice(s)) for s in shows]
    for role, count in (("train", rng.integers(1, 6 - len(shows))), ("validate", rng.integers(1, 4 - min(len(shows), 2)))):
        others = [str(w) for w in rng.choice(of_plant(MENU, plant.base), count)]
        roles[role] = words or list(dict.fromkeys(needed + others))
    return play(rng, plant, roles, habits)


def play(rng, plant, roles, habits):
    recordings = [record(rng, plant, word, role, habits) for role in roles for word in roles[role]]
    excitations.date(rng, recordings)
    fit_to_stroke(rng, plant, recordings)
    return recordings


def record(rng, plant, word, role, habits):
    if plant.base == "B4":
        return excitations.mass_recording(rng, word, role, plant.frequency, habits)
    if plant.base == "B5":
        slowest = -1 / max(np.linalg.eigvals(heater_matrices(plant.task)[0]).real)
        return excitations.heater_recording(rng, word, role, slowest)
    return excitations.actuator_recording(rng, word, role, plant.top, plant.axes, habits)


def fit_to_stroke(rng, plant, recordings):
    """A mass on a spring: drives as large as a stroke of some 12 um allows, resonance included."""
    if plant.base != "B4":
        return
    plant.shared["largest_um"] = 0.0
    for r in recordings:
        largest = np.abs(simulate(plant, r)[0][0] - plant.task["offset_um"]).max()
        r.u[0] = np.round(r.u[0] * min(rng.uniform(6, 12) / largest, plant.top / np.abs(r.u[0]).max()), 4)
        reached = np.abs(simulate(plant, r)[0][0] - plant.task["offset_um"]).max()
        plant.shared["largest_um"] = max(plant.shared["largest_um"], float(reached))


def shows_of(names, base):
    return [hidden.EFFECTS[n].shows[base] for n in names]


def by_role(recordings, values, role):
    return [v for r, v in zip(recordings, values) if r.role == role]


# ---- the kinds ------------------------------------------------------------------------------------------------------------

WELL_KNOWN = 0.02  # of a free number, from the train recordings: nobody leaves free what no recording tells


def sensor_for(rng, plant, recordings, quieter=1.0):
    half = hidden.stroke(plant, recordings)[1]
    ys = np.concatenate([y for r in recordings for y in hidden.base_outputs(plant, r)])
    white = 2 * half * np.exp(rng.uniform(*np.log([3e-5, 6e-4]))) * quieter
    sensor = case_files.draw_sensor(rng, ys.min(), ys.max(), white)
    if plant.uncertain and known_by(plant, by_role(recordings, recordings, "train"), sensor) > WELL_KNOWN:
        raise Unsuited("the train recordings do not tell the free numbers")
    return sensor


LEAST_LEFT = 0.15  # of an effect, beside the free numbers: less is hardly an effect of its own


def scaled(plant, recordings, e, target):
    """Scaled so that what is left of it beside the numbers that the user leaves free is as high as asked for."""
    e = hidden.scale(plant, recordings, e, target)
    if e is None or not plant.uncertain:
        return e
    left = left_by(plant, recordings, hidden.traces(plant, recordings, e))
    if left < LEAST_LEFT:
        raise Unsuited("free numbers of the model take %s over" % e.name)
    return hidden.scale(plant, recordings, e, target / left)


def hide(rng, plant, recordings, names, strengths, sensor):
    """The named effects, each scaled against the noise by itself."""
    effects = []
    for name, strength in zip(names, strengths):
        e = hidden.draw(rng, name, plant, recordings)
        target = case_files.total(sensor) * np.exp(rng.uniform(*np.log(hidden.TARGETS[strength])))
        e = scaled(plant, recordings, e, target)
        if e is None:
            raise Unsuited("%s cannot be %s" % (name, strength))
        heights = hidden.heights(hidden.traces(plant, recordings, e))
        if max(by_role(recordings, heights, "validate")) < 0.3 * max(heights) or \
           max(by_role(recordings, heights, "train")) < 0.3 * max(heights):
            raise Unsuited("one role hardly shows " + name)
        e.strength = strength
        effects.append(e)
    return effects


def named(rng, names, strengths, group, attempt, layout):
    """Singles, pairs, triples."""
    plants = [b for b in hidden.EFFECTS[names[0]].plants if all(b in hidden.EFFECTS[n].plants for n in names)]
    if not plants:
        raise Unsuited("no plant holds all of " + ", ".join(names))
    plant = draw_plant(rng, str(rng.choice(plants)), layout.uncertain)
    recordings = draw_recordings(rng, plant, shows_of(names, plant.base), layout.campaign)
    sensor = sensor_for(rng, plant, recordings, 1.0 if attempt < ATTEMPTS_WITH_NOISE else 0.2)
    effects = hide(rng, plant, recordings, names, strengths, sensor)
    allowed = []
    for e in effects:
        others = alternatives(plant, recordings, e, sensor)
        allowed += others if group == "single" else [dict(effect=o, instead_of=e.name) for o in others if o not in names]
    return Case(plant, recordings, effects, sensor, dict(
        verdict="missing_effect", effects=list(names), acceptable_alternatives=allowed), group)


class Impossible(ValueError):
    """What was asked for cannot be made; says why and what to ask for."""


def go_together(names):
    """No two look-alikes, and at least one plant that holds them all."""
    alike = any(len(group & set(names)) > 1 for group in hidden.LOOK_ALIKE)
    return not alike and bool(set.intersection(*(set(hidden.EFFECTS[n].plants) for n in names)))


def draw_names(rng, count, offered):
    if not any(go_together(names) for names in combinations(offered, count)):
        raise Impossible("no %d of %s go together: they look alike, or no plant holds them all; offer more effects"
                         % (count, ", ".join(offered)))
    while True:
        names = [str(x) for x in rng.choice(offered, count, replace=False)]
        if go_together(names):
            return names


def several(rng, count, offered, strengths, attempt, layout):
    """Pairs and triples of medium and strong effects, unless other strengths are asked for."""
    choice = [s for s in strengths if s != "weak"] or list(strengths)
    names = draw_names(rng, count, offered)
    return named(rng, names, [str(rng.choice(choice)) for _ in names], {2: "pair", 3: "triple"}[count], attempt, layout)


def nothing(rng, layout):
    plant = draw_plant(rng, "B%d" % rng.integers(1, 6), layout.uncertain)
    candidates = [n for n in hidden.EFFECTS if plant.base in hidden.EFFECTS[n].plants]
    recordings = draw_recordings(rng, plant, shows_of([str(rng.choice(candidates))], plant.base), layout.campaign)
    return Case(plant, recordings, [], sensor_for(rng, plant, recordings),
                dict(verdict="adequate", effects=[], acceptable_alternatives=[]), "none")


def outside(rng, layout):
    """Something that is not in the list, medium or strong."""
    kind = str(rng.choice(list(unlisted.KINDS)))
    plant = draw_plant(rng, str(rng.choice(["B1", "B2", "B3", "B4"])), layout.uncertain)
    shows = [("sine_multiamp", "triangle")] if plant.base == "B4" else [("sine_multiamp", "triangle", "freq_low")]
    recordings = draw_recordings(rng, plant, shows, layout.campaign)
    sensor = sensor_for(rng, plant, recordings)
    outputs = [hidden.base_outputs(plant, r)[0] for r in recordings]
    e, location = unlisted.draw(rng, kind, recordings, outputs)
    strength = str(rng.choice(["medium", "strong"]))
    size = max(hidden.heights(hidden.traces(plant, recordings, e)))
    height = rng.uniform(*((2.5, 6) if strength == "medium" else (10, 30)))
    e = hidden.with_amount(e, case_files.total(sensor) * height / size)
    e.strength = strength
    return Case(plant, recordings, [e], sensor, dict(
        verdict="unexplained", effects=[], acceptable_alternatives=[], location=location), "unknown")


# ---- starved: recordings that cannot decide between two effects -----------------------------------------------------------

# truth, rival, plants, words of the few recordings, how they are spoilt, experiments that would decide
STARVED = (
    ("thermal_expansion", "creep", ("B1", "B2"), ("step_hold",), "self_heating",
     ("temperature_constant", "temperature_staircase")),
    ("creep", "thermal_expansion", ("B1", "B2"), ("step_hold",), "self_heating",
     ("temperature_constant", "temperature_staircase")),
    ("amplifier_lag", "dead_time", ("B1", "B2"), ("sine_multiamp",), "", ("high_frequencies", "multisine", "fast_steps")),
    ("dead_time", "amplifier_lag", ("B1", "B2"), ("sine_multiamp",), "", ("high_frequencies", "multisine", "fast_steps")),
    ("cross_coupling", "calibration", ("B3",), ("sine_multiamp", "triangle"), "axes_together", ("axes_independent",)),
    ("sensor_nonlinearity", "asymmetry", ("B1",), ("freq_low", "sine_multiamp"), "", ("reference_sensor", "multisine")),
    ("temperature_gain", "calibration", ("B1", "B2"), ("sine_multiamp", "triangle"), "warm_room",
     ("temperature_staircase",)),
    ("ageing", "calibration", ("B1", "B2"), ("sine_multiamp", "triangle"), "late", ("repeat_after_cycles",)),
)


def spoil(rng, how, plant, recordings):
    """What makes the recordings unable to decide."""
    warm = rng.uniform(8, 25)
    tau = rng.uniform(8, 25)
    late = int(rng.uniform(2e5, 2e6))
    for r in recordings:
        if how == "self_heating":  # the stack warms with every drive, as slowly as it creeps
            heat = lag(np.abs(r.u[0]) / np.abs(r.u[0]).max(), r.h, tau)
            r.temperature = r.temperature[0] + rng.uniform(1.2, 1.8) * heat
        elif how == "axes_together":
            r.u[1] = r.u[0].copy()
        elif how == "warm_room":
            r.temperature = r.temperature + warm
        elif how == "late":  # recorded within a thousandth of the cycles that went before
            r.cycles_before += late


def starved(rng, layout):
    choice = [s for s in STARVED if "calibration" not in s or not layout.uncertain]  # a free gain is no second name
    truth, rival, bases, words, how, experiments = choice[rng.integers(len(choice))]
    plant = draw_plant(rng, str(rng.choice(bases)), layout.uncertain)
    if how == "axes_together":
        plant.task["axes"][1] = plant.task["axes"][0]
    recordings = draw_recordings(rng, plant, [], words=list(words))
    if len(words) > 1 and rng.random() < 0.4:
        recordings = [r for r in recordings if r.role == "validate" or r.word == words[0]]
    spoil(rng, how, plant, recordings)
    sensor = sensor_for(rng, plant, recordings)
    sigma = case_files.total(sensor)
    e = hidden.draw(rng, truth, plant, recordings)
    if truth == "calibration" or "gain" in e.shape:
        e.shape.update(gain=1.0, offset=0.0)
    e = scaled(plant, recordings, e, sigma * rng.uniform(1.0, 8.0))
    if e is None:
        raise Unsuited("too little of " + truth)
    e.strength = "medium"
    if gap(plant, recordings, e, rival, sensor) > TIE / 2:
        raise Unsuited("%s and %s can be told apart" % (truth, rival))
    return Case(plant, recordings, [e], sensor, dict(
        verdict="not_distinguishable", effects=[truth, rival], acceptable_alternatives=[],
        separating_experiments=list(experiments)), "starved")


# ---- from seed to case ----------------------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Layout:
    """How a folder of cases differs from the usual one. campaign: many recordings, each of a kind of its own. uncertain:
    gains and weights of the user's model are off by a few per cent, and free."""
    campaign: bool = False
    uncertain: bool = False

    def offered(self, names):
        """A wrong gain is no effect where the gain is free."""
        return [n for n in names if n != "calibration" or not self.uncertain]


def wanted(kind, offered, strengths, count):
    """What the numbers of a kind stand for: singles every effect in every strength."""
    if kind == "singles":
        every = [(n, s) for n in offered for s in strengths]
        return every if count is None else [every[k % len(every)] for k in range(count)]
    return [None] * (PER_SEED[kind] if count is None else count)


def build(seed, kind, number, what, offered, strengths, layout=Layout()):
    """The case; draws again with the same stream until one can hold what was asked for."""
    rng = np.random.default_rng([seed, KINDS.index(kind), number])
    reasons = []
    for attempt in range(ATTEMPTS):
        try:
            if kind == "singles":
                return named(rng, [what[0]], [what[1]], "single", attempt, layout), rng
            if kind in ("pairs", "triples"):
                return several(rng, 2 if kind == "pairs" else 3, offered, strengths, attempt, layout), rng
            if kind == "starved":
                return starved(rng, layout), rng
            return dict(nothing=nothing, unlisted=outside)[kind](rng, layout), rng
        except Unsuited as reason:
            reasons.append(str(reason))
    raise RuntimeError("seed %d, %s %d: %d draws do not suit; the last: %s" % (seed, kind, number, ATTEMPTS, reasons[-1]))


def perturbed(rng, parameters):
    """--wrong-parameters: every gain and weight the user believes in is off by 0.5 to 3 %."""
    for holder, key in uncertain_numbers(parameters):
        holder[key] = float("%.5g" % (holder[key] * (1 + rng.choice([-1, 1]) * rng.uniform(0.005, 0.03))))
