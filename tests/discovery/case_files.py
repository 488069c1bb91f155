"""A case on disk: noise, quantisation, task.json, case.json, recordings.

Decides the sensor and the layout (that of the hidden-effect cases: task.json what a user knows, case.json with the truth).
Does not decide what is hidden.
"""
import json

import numpy as np


def draw_sensor(rng, low, high, noise=None):
    """White noise as asked, else log-uniform over a factor of twenty; 1/f share, its exponent and the bits vary."""
    span = high - low
    white = span * np.exp(rng.uniform(*np.log([3e-5, 6e-4]))) if noise is None else noise
    range_ = [float(np.floor(low - 0.12 * span)), float(np.ceil(high + 0.12 * span))]
    bits = int(rng.choice([14, 16, 16, 16, 18]))
    while (range_[1] - range_[0]) / 2**bits > 1.5 * white:  # a converter that suits the sensor
        bits += 1
    flicker = float(white * rng.choice([0.0, *rng.uniform(0.1, 0.5, 8), 0.8]))
    return dict(range=range_, bits=bits, white=float(white), flicker=flicker,
                exponent=float(rng.choice([1.0, 1.0, rng.uniform(0.8, 1.3)])), heavy=bool(rng.random() < 0.1))


def total(sensor):
    return float(np.hypot(sensor["white"], sensor["flicker"]))


def noise(rng, sensor, n):
    white = rng.standard_t(6, n) / np.sqrt(1.5) if sensor["heavy"] else rng.standard_normal(n)
    f = np.fft.rfftfreq(n)
    shape = np.zeros(len(f))
    shape[1:] = f[1:] ** (-sensor["exponent"] / 2)
    pink = np.fft.irfft(shape * (rng.standard_normal(len(f)) + 1j * rng.standard_normal(len(f))), n)
    expected = np.sqrt(2 * 2 * np.sum(shape**2)) / n  # rms of pink, averaged over draws
    return sensor["white"] * white + sensor["flicker"] * pink / expected


def measure(rng, sensor, y):
    lsb = (sensor["range"][1] - sensor["range"][0]) / 2 ** sensor["bits"]
    noisy = np.clip(y + noise(rng, sensor, len(y)), *sensor["range"])
    return sensor["range"][0] + lsb * np.round((noisy - sensor["range"][0]) / lsb)


def sensor_entry(rng, sensor):
    """What the data sheet says: the white noise to about ten per cent."""
    return dict(range=sensor["range"], bits=sensor["bits"],
                lsb=float("%.6g" % ((sensor["range"][1] - sensor["range"][0]) / 2 ** sensor["bits"])),
                datasheet_noise_rms=float("%.2g" % (sensor["white"] * rng.uniform(0.92, 1.08))))


def write_csv(path, recording, columns):
    """columns: (header, format, values)."""
    heads = ["t [s]"] + [c[0] for c in columns]
    times = ["%.10g" % (k * recording.h) for k in range(len(recording.u[0]))]
    texts = [times] + [[form % x for x in values] for _, form, values in columns]
    path.write_text("\n".join([",".join(heads)] + [",".join(row) for row in zip(*texts)]) + "\n")


def columns_of(rng, plant, recording, measured, force, with_temperature):
    """The columns in the order of the layout."""
    u = recording.u
    if plant.base == "B5":
        return [("u [V]", "%.4f", u[0]), ("T [degC]", "%.5f", measured[0]), ("Ta [degC]", "%.4f", recording.temperature)]
    columns = [("u [V]", "%.4f", u[0]), ("y [um]", "%.7f", measured[0])]
    if with_temperature:
        columns.append(("T [degC]", "%.2f", recording.temperature + 0.01 * rng.standard_normal(len(u[0]))))
    if plant.base == "B3":
        columns += [("u2 [V]", "%.4f", u[1]), ("y2 [um]", "%.7f", measured[1])]
    if force is not None:
        cell = 3e-4 * np.abs(force).max() * rng.standard_normal(len(force))
        columns.append(("F [N]", "%.5f", force + cell))
    return columns


def write_json(path, content):
    path.write_text(json.dumps(content, indent=1) + "\n")
