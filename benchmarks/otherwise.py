#!/usr/bin/env python3
"""What a user would do otherwise: sparse regression and a NARX term search on cases with hidden effects.

    benchmarks/otherwise.py CASES [--hysteron RESULTS] [--only 003,004]

CASES: folders with task.json, case.json and recordings (tests/discovery/make_cases.py makes more of them).
RESULTS: answers of build/benchmarks/discovery on the same cases, for a column of their own.

All methods get the same: the residual e = measured - base model, drive, base output, temperatures, the
other axis (the load cell is left out). Train recordings only; the error is that of a free run over the validate recordings.

  sparse        e = sum of features (no state); orthogonal matching pursuit; the number of terms by leaving out recordings
  sparse, rate  de/dt = sum of features, e among them (SINDy); the derivative of e by local parabolas over 9 rows
  NARX          e(k) from monomials up to the third degree in e(k-1), e(k-2), u(k), u(k-1), base(k), ...; forward orthogonal
                regression (FROLS); the number of terms as above, by one-step errors. A NARX model belongs to one row step:
                one model per step; a validate recording whose step was not trained stays with the base model

A name follows from the terms by the table NAMES, a term's weight being what it takes off the sum of squares when chosen.
Names that no term stands for (initial_remanence, backlash, dead_time, ...) cannot be found: that is a property of the method.
Needs Debian's python3-scipy, python3-numba, python3-sklearn.
"""
import argparse
import json
import sys
import time
import warnings
from itertools import combinations_with_replacement
from pathlib import Path

import numpy as np
from scipy.signal import savgol_filter
from sklearn.linear_model import OrthogonalMatchingPursuit

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "discovery"))
from read_cases import read_case  # noqa: E402

warnings.filterwarnings("ignore", message="Orthogonal matching pursuit ended prematurely")  # fewer terms, and no harm
MOST_TERMS = 10
WINDOW = 9  # rows of the local parabola

# term -> name. `base` is the output of the base model, u the drive, T the temperature above 22 degC, ' a derivative.
NAMES = {
    "1": "calibration", "base": "calibration", "u": "calibration",
    "u^2": "asymmetry", "u^3": "asymmetry", "base^2": "sensor_nonlinearity", "base^3": "sensor_nonlinearity",
    "u'": "amplifier_lag", "base'": "amplifier_lag", "u''": "structural_resonance", "base''": "structural_resonance",
    "sign(u')": "hysteresis", "sign(base')": "friction", "sign(u')*u": "hysteresis", "sign(u')*u^2": "hysteresis",
    "|u'|": "hysteresis", "|u'|*e": "hysteresis", "|u'|*u": "hysteresis", "u'*|u'|": "rate_dependence", "u'^3": "slew_limit",
    "u over 60 %": "saturation", "u over 80 %": "saturation",
    "T": "thermal_expansion", "T*base": "temperature_gain", "cycles*base": "ageing",
    "other u": "cross_coupling", "other base": "cross_coupling", "sin 50": "mains_interference", "cos 50": "mains_interference",
    "sin 60": "mains_interference", "cos 60": "mains_interference"}
SLOW_S = 0.1  # a relaxation of e slower than this, driven by u or base, is called creep; a faster one a lag


def residual(r, axis):
    return r.extra["measured"][axis] - r.extra["base"][axis]


def rms(parts):
    flat = np.concatenate(parts)
    return float(np.sqrt(np.mean(flat**2))) if np.all(np.isfinite(flat)) else np.inf


# ---- features ---------------------------------------------------------------------------------------------------------------

def features(recordings, axis, with_state):
    """name -> one array per recording; scaled by common factors so that the tables of all recordings can be stacked."""
    top = max(np.abs(r.u[axis]).max() for r in recordings)
    columns = {}
    for r in recordings:
        u, base = r.u[axis] / top, r.extra["base"][axis] / top
        du, db = np.gradient(u, r.h), np.gradient(base, r.h)
        warm = smooth(r.temperature - 22.0)
        cycles = np.log10(1 + (r.cycles_before + np.abs(np.diff(u)).sum() / 2 * np.linspace(0, 1, len(u))) / 100)
        one = {"1": np.ones(len(u)), "base": base, "u": u, "u^2": u * u, "u^3": u**3, "base^2": base**2, "base^3": base**3,
               "u'": du, "base'": db, "u''": np.gradient(du, r.h), "base''": np.gradient(db, r.h), "sign(u')": np.sign(du),
               "sign(base')": np.sign(db), "sign(u')*u": np.sign(du) * u, "sign(u')*u^2": np.sign(du) * u * u,
               "u'*|u'|": du * np.abs(du), "u'^3": du**3, "u over 60 %": np.maximum(np.abs(u) - 0.6, 0) * np.sign(u),
               "u over 80 %": np.maximum(np.abs(u) - 0.8, 0) * np.sign(u), "T": warm, "T*base": warm * base,
               "cycles*base": cycles * base}
        for f in (50, 60):
            one["sin %d" % f], one["cos %d" % f] = np.sin(2 * np.pi * f * r.t), np.cos(2 * np.pi * f * r.t)
        if with_state:
            e = smooth(residual(r, axis))
            one.update({"e": e, "|u'|*e": np.abs(du) * e, "|u'|": np.abs(du), "|u'|*u": np.abs(du) * u})
        if len(r.u) == 2:
            one["other u"], one["other base"] = r.u[1 - axis] / top, r.extra["base"][1 - axis] / top
        for name, values in one.items():
            columns.setdefault(name, []).append(values)
    return columns


def smooth(x):
    return savgol_filter(x, WINDOW, 2)


def matching_pursuit(a, y, terms):
    """Indices in the order in which they are chosen, and the coefficients for each count of terms."""
    scale = np.sqrt(np.mean(a**2, axis=0))
    usable = np.flatnonzero(scale > 1e-12)
    scaled, paths = a[:, usable] / scale[usable], []
    for k in range(1, min(terms, len(usable)) + 1):
        fit = OrthogonalMatchingPursuit(n_nonzero_coefs=k, fit_intercept=False).fit(scaled, y)
        c = np.zeros(a.shape[1])
        c[usable] = fit.coef_ / scale[usable]
        paths.append(c)
    return paths


def folds_of(lengths):
    """Leave out one recording, or a third of the only one."""
    marks = np.repeat(np.arange(len(lengths)), lengths)
    if len(lengths) == 1:
        marks = np.arange(lengths[0]) * 3 // lengths[0]
    return [marks == k for k in np.unique(marks)]


def best_count(lengths, a, y, path_of):
    """How many terms leave the least on recordings left out; a further term must bring one per cent. 0: none helps."""
    left = np.zeros(MOST_TERMS + 1)
    for out in folds_of(lengths):
        paths = path_of(a[~out], y[~out])
        left[0] += y[out] @ y[out]
        for k in range(1, MOST_TERMS + 1):
            d = y[out] - a[out] @ paths[min(k, len(paths)) - 1]
            left[k] += d @ d
    best = 0
    for k in range(1, MOST_TERMS + 1):
        if left[k] < 0.99 * left[best]:
            best = k
    return best


def gains(a, y, path):
    """What each chosen column takes off the sum of squares, in the order of the path."""
    before, seen, out = y @ y, set(), []
    for c in path:
        new = [int(i) for i in np.flatnonzero(c) if i not in seen]
        after = np.sum((y - a @ c) ** 2)
        out += [(i, max(before - after, 0.0) / len(new)) for i in new]
        seen |= set(new)
        before = after
    return out


# ---- the three methods: each returns {name: weight} and predictions of e for the validate recordings --------------------------

def sparse(plant, train, validate, axis):
    columns = features(train + validate, axis, False)
    names = list(columns)
    table = lambda k: np.column_stack([columns[n][k] for n in names])
    a = np.concatenate([table(k) for k in range(len(train))])
    y = np.concatenate([residual(r, axis) for r in train])
    path_of = lambda a, y: matching_pursuit(a, y, MOST_TERMS)
    count = best_count([len(r.t) for r in train], a, y, path_of)
    if count == 0:
        return {}, [np.zeros(len(r.t)) for r in validate]
    path = path_of(a, y)[:count]
    weights = {}
    for i, gain in gains(a, y, path):
        weights[NAMES[names[i]]] = weights.get(NAMES[names[i]], 0) + gain
    return weights, [table(len(train) + k) @ path[-1] for k in range(len(validate))]


def sparse_rate(plant, train, validate, axis):
    """Rows are weighted with their step, for the noise of a derivative goes with one over it."""
    columns = features(train + validate, axis, True)
    names = list(columns)
    table = lambda k: np.column_stack([columns[n][k] for n in names])
    a = np.concatenate([r.h * table(k) for k, r in enumerate(train)])
    y = np.concatenate([savgol_filter(residual(r, axis), WINDOW, 2, deriv=1) for r in train])
    path_of = lambda a, y: matching_pursuit(a, y, MOST_TERMS)
    count = best_count([len(r.t) for r in train], a, y, path_of)
    if count == 0:
        return {}, [np.zeros(len(r.t)) for r in validate]
    path = path_of(a, y)[:count]
    c = dict(zip(names, path[-1]))
    slow = c.get("e", 0) != 0 and -1 / c["e"] > SLOW_S
    weights = {}
    for i, gain in gains(a, y, path):
        name = NAMES.get(names[i])
        if name in ("calibration", "amplifier_lag") and names[i] in ("u", "base", "u'", "base'") and c.get("e"):
            name = "creep" if slow else "amplifier_lag"
        if name:
            weights[name] = weights.get(name, 0) + gain
    return weights, [integrate(r, {n: columns[n][len(train) + k] for n in names}, c) for k, r in enumerate(validate)]


def integrate(r, columns, c):
    """Free run of de/dt = drive + decay*e from 0; exact for a drive and a decay that stay over a row."""
    n = len(r.t)
    drive = sum((c[k] * v for k, v in columns.items() if k not in ("e", "|u'|*e")), np.zeros(n))
    decay = np.full(n, c["e"]) + c["|u'|*e"] * columns["|u'|"]
    e = np.zeros(n)
    for k in range(1, n):
        z = np.clip(decay[k] * r.h, -50, 3)
        grown = np.exp(z)
        e[k] = grown * e[k - 1] + drive[k] * r.h * ((grown - 1) / z if abs(z) > 1e-6 else 1)
        if not abs(e[k]) < 1e6:
            return np.full(n, np.nan)
    return e


def variables(r, axis, top, warm):
    """Inputs of a NARX model besides e(k-1), e(k-2)."""
    u, base = r.u[axis] / top, r.extra["base"][axis] / top
    back = lambda x: np.concatenate([[x[0]], x[:-1]])
    inputs = [("u", u), ("u'", back(u)), ("base", base), ("base'", back(base))]
    if warm:
        inputs.append(("T", r.temperature - 22.0))
    if len(r.u) == 2:
        inputs.append(("other base", r.extra["base"][1 - axis] / top))
    return inputs


def narx(plant, train, validate, axis):
    weights, predictions = {}, []
    top = max(np.abs(r.u[axis]).max() for r in train)
    models = {}
    for r in validate:
        key = "%.3g" % r.h
        same = [q for q in train if abs(q.h / r.h - 1) < 0.02]
        if key not in models:
            models[key] = fit_narx(same, axis, top) if same else None
            for name, gain in (models[key] or {}).get("weights", {}).items():
                weights[name] = weights.get(name, 0) + gain
        predictions.append(run_narx(models[key], r, axis, top) if models[key] else np.zeros(len(r.t)))
    return weights, predictions


def fit_narx(train, axis, top):
    warm = max(np.ptp(r.temperature) for r in train) > 1
    size = max(rms([residual(r, axis)]) for r in train)
    tables, targets = [], []
    for r in train:
        e = residual(r, axis) / size
        inputs = variables(r, axis, top, warm)
        tables.append(np.column_stack([e[1:-1], e[:-2]] + [x[2:] for _, x in inputs]))
        targets.append(e[2:])
    names = ["e", "e"] + [n for n, _ in inputs]
    monomials = [m for d in range(4) for m in combinations_with_replacement(range(len(names)), d)]
    a = monomial_table(np.concatenate(tables), monomials)
    y = np.concatenate(targets)
    count = best_count([len(t) for t in targets], a, y, frols)
    if count == 0:
        return None
    path = frols(a, y)[:count]
    weights = {}
    for i, gain in gains(a, y, path):
        if name := narx_name([names[k] for k in monomials[i]]):
            weights[name] = weights.get(name, 0) + gain
    return dict(coefficients=path[-1], monomials=monomials, warm=warm, size=size, weights=weights)


def narx_name(factors):
    """A pure e term is the model's own memory and names nothing."""
    inputs = [f for f in factors if f != "e"]
    if not factors:
        return "calibration"
    if not inputs:
        return None
    if "T" in inputs:
        return "temperature_gain" if len(inputs) > 1 else "thermal_expansion"
    if "other base" in inputs:
        return "cross_coupling"
    if len(inputs) < len(factors):
        return "hysteresis"  # the memory times the drive
    if len(inputs) == 1:
        return "amplifier_lag" if inputs[0].endswith("'") else "calibration"
    return "asymmetry" if any(i.startswith("u") for i in inputs) else "sensor_nonlinearity"


def monomial_table(x, monomials):
    return np.column_stack([np.prod(x[:, list(m)], axis=1) if m else np.ones(len(x)) for m in monomials])


def frols(a, y):
    """Forward orthogonal regression: at each step the column with the largest error reduction ratio."""
    q, left = a / np.maximum(np.sqrt(np.sum(a**2, axis=0)), 1e-300), y.copy()
    chosen, paths = [], []
    w = q.copy()
    for _ in range(MOST_TERMS):
        norm = np.sum(w * w, axis=0)
        ratio = np.where(norm > 1e-9, (w.T @ left) ** 2 / np.maximum(norm, 1e-300), -1)
        ratio[chosen] = -1
        best = int(np.argmax(ratio))
        if ratio[best] <= 0:
            break
        chosen.append(best)
        direction = w[:, best] / np.sqrt(norm[best])
        left = left - direction * (direction @ left)
        w = w - np.outer(direction, direction @ w)
        c = np.zeros(a.shape[1])
        c[chosen] = np.linalg.lstsq(a[:, chosen], y, rcond=None)[0]
        paths.append(c)
    return paths


def run_narx(model, r, axis, top):
    inputs = np.column_stack([x for _, x in variables(r, axis, top, model["warm"])])
    used = [(c, m) for c, m in zip(model["coefficients"], model["monomials"]) if c != 0]
    e = np.zeros(len(r.t))
    for k in range(2, len(e)):
        x = [e[k - 1], e[k - 2], *inputs[k]]
        total = 0.0
        for c, m in used:
            for i in m:
                c = c * x[i]
            total += c
        if not abs(total) < 1e6:
            return np.full(len(e), np.nan)
        e[k] = total
    return e * model["size"]


METHODS = {"sparse": sparse, "sparse, rate": sparse_rate, "NARX": narx}


# ---- comparison -----------------------------------------------------------------------------------------------------------

def answer(method, plant, recordings):
    """Ranked names, error of the free run on the validate recordings [um], CPU seconds."""
    start = time.process_time()
    train, validate = ([r for r in recordings if r.role == role] for role in ("train", "validate"))
    weights, left = {}, []
    for axis in range(plant.axes):
        names, predictions = METHODS[method](plant, train, validate, axis)
        for name, gain in names.items():
            weights[name] = weights.get(name, 0) + gain
        left += [residual(r, axis) - p for r, p in zip(validate, predictions)]
    return sorted(weights, key=lambda n: -weights[n]), rms(left), time.process_time() - start


def hysteron_answer(folder, name):
    try:
        r = json.loads((folder / (name + ".json")).read_text())
        return (r.get("effects") or [] if r["verdict"] != "adequate" else []), r["validation_rms_after"], r.get("seconds", np.nan)
    except (OSError, ValueError, KeyError, TypeError):
        return None


def line(name, truth, found):
    floor = truth["expected"]["noise_floor_rms"]
    cells = ["%-24s" % ((", ".join(truth["expected"]["effects"]) or truth["group"])[:24])]
    for names, error, _ in found.values():
        times = "%.2f" % (error / floor) if np.isfinite(error) else "runs off"
        cells.append("%-21s %8s" % ((names[0] if names else "-")[:21], times))
    return name + "  " + "  ".join(cells)


def seconds(answers):
    """Median CPU time, of the answers that tell theirs."""
    each = [f[2] for _, f in answers if np.isfinite(f[2])]
    return "%.2f" % np.median(each) if each else "-"


def summary(rows, methods):
    """Per method: names, false alarms, error over the noise floor, seconds."""
    print("\n%-14s %9s %9s %14s %22s %22s %9s" % ("method", "top-1", "top-3", "false alarms", "error/floor, median",
                                                  "worse than the base", "CPU s"))
    for m in methods:
        one = [(t, f[m]) for t, f in rows if m in f]
        named = [(t["expected"]["effects"], f) for t, f in one if t["group"] in ("single", "pair", "triple")]
        none = [f for t, f in one if t["group"] == "none"]
        ratios = [f[1] / t["expected"]["noise_floor_rms"] for t, f in one if t["group"] in ("single", "pair", "triple")]
        worse = sum(not f[1] <= 1.02 * t["expected"]["validation_rms_before"] for t, f in one)
        print("%-14s %4d/%-4d %4d/%-4d %9d/%-4d %22.2f %18d/%-3d %9s" % (
            m, sum(f[0][:1] == [e[0]] or (bool(f[0]) and f[0][0] in e) for e, f in named), len(named),
            sum(bool(set(f[0][:3]) & set(e)) for e, f in named), len(named), sum(bool(f[0]) for f in none), len(none),
            np.median(ratios) if ratios else np.nan, worse, len(one), seconds(one)))


def main():
    ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ap.add_argument("cases", type=Path)
    ap.add_argument("--hysteron", type=Path)
    ap.add_argument("--only", default="")
    a = ap.parse_args()
    rows, methods = [], list(METHODS) + (["hysteron"] if a.hysteron else [])
    print("case %-26s" % "hidden" + "  ".join("%-30s" % (m + ": first name, error") for m in methods))
    for folder in sorted(f for f in a.cases.iterdir() if (f / "case.json").exists()):
        if a.only and folder.name not in a.only.split(","):
            continue
        truth = json.loads((folder / "case.json").read_text())
        plant, recordings = read_case(folder)
        found = {m: answer(m, plant, recordings) for m in METHODS}
        if a.hysteron and (got := hysteron_answer(a.hysteron, folder.name)):
            found["hysteron"] = got
        rows.append((truth, found))
        print(line(folder.name, truth, found), flush=True)
    summary(rows, methods)


if __name__ == "__main__":
    main()
