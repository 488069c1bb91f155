"""What the right answer to a case is: what else explains it, which numbers the recordings show, the form of case.json.

Decides by first-order directions: a rival whose trace, with all numbers let go, leaves less than TIE of chi2 explains as much.
"""
import math

import numpy as np

from machine_lab import WIRES, effect_of

TIE = 40.0  # chi2; the directions are of first order, and no law has quite the shape that is drawn here
# What is taken for each other: late, bent, with a memory of turns. Anything else was further from a tie by a hundred times.
LOOK_ALIKE = (
    ("amplifier_lag", "dead_time", "slew_limit", "sensor_lag", "structural_resonance"),
    ("saturation", "asymmetry", "sensor_nonlinearity", "saturation_s", "stiffening", "quadratic_drag"),
    ("backlash", "hysteresis", "friction", "stribeck_friction", "backlash_s", "creep"),
)
UNSURE = 0.5  # a number's logarithm before any recording: known to half of itself


def directions(lab, runs):
    """What each written number changes, over the noise, per unit of its logarithm: a column for each; runs: drives as recorded."""
    found = {}
    base = stack(lab, [lab.run(r, {}, drive=u)[0] for r, u in zip(lab.recordings, runs)])
    for name in lab.machine.numbers:
        other = {**lab.numbers, name: lab.numbers[name] * 1.002}
        found[name] = (
            stack(lab, [lab.run(r, {}, other, u)[0] for r, u in zip(lab.recordings, runs)]) - base
        ) / math.log(1.002)
    return found


def stack(lab, traces):
    return np.concatenate([np.nan_to_num((t / lab.noise).ravel()) for t in traces])


def deviations(found):
    """Standard deviation of each number's logarithm, all of them free."""
    a = np.array(list(found.values()))
    information = a @ a.T + np.eye(len(a)) / UNSURE**2
    return dict(zip(found, np.sqrt(np.diag(np.linalg.inv(information)))))


def left_of(want, columns):
    a = np.array(columns).T
    left = want - a @ np.linalg.lstsq(a, want, rcond=1e-10)[0] if a.size else want
    return float(left @ left)


def rivals(lab, key, hidden, found, runs):
    """-> (chi2 that the numbers alone leave of it, {effect: chi2 left by it and the numbers})."""
    beside = {k: a for k, a in hidden.items() if k != key}
    want = stack(lab, [t for t, _ in lab.traces(hidden, tuple(beside))])
    columns, left = list(found.values()), {}
    base = stack(lab, [lab.run(r, {}, drive=u)[0] for r, u in zip(lab.recordings, runs)])
    size = lab.height(hidden, tuple(beside))
    alike = {k for family in LOOK_ALIKE if key in family for k in family}
    for other in sorted(alike & {*WIRES, *lab.machine.effects}):
        if effect_of(other) == effect_of(key):
            continue
        amount = lab.amount(other, size, accuracy=0.5)
        if amount is None:
            continue
        traces = [
            stack(lab, [lab.run(r, {other: a}, drive=u)[0] for r, u in zip(lab.recordings, runs)]) - base
            for a in (amount, 0.6 * amount)
        ]
        left[effect_of(other)] = min(left.get(effect_of(other), np.inf), left_of(want, [*columns, *traces]))
    return left_of(want, columns), left


def case_json(lab, spec, hidden, wrong, heights, clean, stated):
    m = lab.machine
    group, strength = spec["group"], spec["strength"]
    names = [effect_of(k) for k in hidden]
    runs = [u for _, u, _ in clean]
    found = directions(lab, runs)
    sd = deviations(found)
    alternatives, explain, remaining = [], False, {}
    listed = names if group not in ("outside", "starved") else []
    for key in hidden if listed else ():
        numbers_leave, left = rivals(lab, key, hidden, found, runs)
        remaining[key] = dict(
            numbers=round(numbers_leave, 1), **{k: round(v, 1) for k, v in sorted(left.items(), key=lambda x: x[1])[:4]}
        )
        explain |= numbers_leave < TIE
        alternatives += [
            dict(effect=k, instead_of=effect_of(key)) for k, v in left.items() if v < TIE and v < numbers_leave
        ]
        alternatives += [
            dict(effect=b, instead_of=a)
            for a, b in (("friction", "stribeck_friction"), ("stribeck_friction", "friction"))
            if effect_of(key) == a
        ]
    verdicts = dict(
        none=["adequate"],
        wrong=["adequate", "missing_effect"],
        outside=["unexplained"],
        starved=["not_distinguishable"],
    )
    expected = dict(
        verdicts=verdicts.get(group, ["missing_effect"]),
        effects=names if group != "outside" else [],
        acceptable_alternatives=alternatives,
        numbers_explain=bool(explain),
    )
    if group == "starved":
        expected["either"] = [names[0], spec["either"]]
    if group == "outside":
        expected["location"] = location(lab, hidden)
    return dict(
        id=spec["id"],
        device=m.name,
        family="M",
        group=group,
        title=m.title,
        strength=strength if hidden and group != "outside" else "-",
        outside=next(iter(hidden)) if group == "outside" else None,
        effects=[
            dict(
                effect=effect_of(k),
                key=k,
                strength=strength,
                height=round(heights[k], 3),
                amount=a,
                settings=entered(lab, k, a),
            )
            for k, a in hidden.items()
        ],
        wrong_numbers=[
            dict(
                number=n,
                path=m.paths[n],
                true=lab.numbers[n],
                written=v,
                factor=v / lab.numbers[n],
                sd_log=float("%.4g" % sd[n]),
            )
            for n, v in wrong.items()
        ],
        scale_groups=m.scale_groups,
        gains=m.gains,
        expected=expected,
        start=spec["start"],
        moving=[r.moving for r in lab.recordings],
        closed_loop=spec["closed"],
        hold=lab.hold,
        noise_stated=stated,
        outputs=[o[0] for o in m.outputs],
        noise_floor=floor(lab, clean),
        recordings=[dict(kind=r.kind, rows=r.rows, dt=r.dt, role=r.role, loop=int(r.closed)) for r in lab.recordings],
        left_chi2=remaining,
    )


def entered(lab, key, amount):
    return {k: float("%.6g" % v) for k, v in (lab.machine.effects.get(key) or WIRES[key])(amount, lab).items()}


def floor(lab, clean):
    """rms of the noise in the recordings that judge, as written."""
    noise = [n for r, (_, _, n) in zip(lab.recordings, clean) if r.role == "validate"]
    return [float(np.sqrt(np.mean(np.concatenate([n[:, o] for n in noise]) ** 2))) for o in range(len(lab.noise))]


def location(lab, hidden):
    if "sensor_periodic" in hidden:
        return dict(variable="y", period=lab.period)
    intervals = {}
    for k, r in enumerate(lab.recordings):
        edges = np.flatnonzero(np.diff(np.concatenate([[0], np.isin(r.events[r.skip :], (1, 2)).astype(int), [0]])))
        intervals["%02d.csv" % (k + 1)] = [
            [round(float(a * r.dt), 6), round(float(b * r.dt), 6)] for a, b in edges.reshape(-1, 2)
        ]
    return dict(variable="t", intervals=intervals)
