"""Runs a machine in fine steps: what lies before the plant, the plant, what lies behind it, a controller at the rows.

Decides the textbook laws of whatever enters on a wire: limits, lags, delays, lost motion, loops, creep, curves, sensors.
Shares nothing with the program's blocks. Does not decide the machines (machines_*.py) nor how much is hidden (make_machines.py).
"""
import numpy as np
from numba import njit

# Settings of what may lie on the wires; those of the drive first. All are off at the value of OFF.
OFF = dict(
    mix=0.0,
    low=-np.inf,
    high=np.inf,
    rise=np.inf,
    lag=0.0,
    delay=0.0,
    gap=0.0,
    curve=0.0,
    loop=0.0,
    creep=0.0,
    creep_from=1.0,
    kelvin=0.0,
    kelvin_at=20.0,
    cross=0.0,
    mode_share=0.0,
    mode_hz=1.0,
    mode_damping=0.05,
    knock=0.0,
    middle=0.0,
    half=1.0,
    s_lag=0.0,
    s_delay=0.0,
    s_gap=0.0,
    s_curve=0.0,
    s_low=-np.inf,
    s_high=np.inf,
    s_step=0.0,
    s_line=0.0,
    s_line_hz=50.0,
    s_drift=0.0,
    s_expand=0.0,
    s_expand_s=1.0,
    s_expand_at=20.0,
    s_cross=0.0,
    s_period=0.0,
    s_period_of=1.0,
    s_middle=0.0,
    s_half=1.0,
)
(
    MIX,
    LOW,
    HIGH,
    RISE,
    LAG,
    DELAY,
    GAP,
    CURVE,
    LOOP,
    CREEP,
    CREEP_FROM,
    KELVIN,
    KELVIN_AT,
    CROSS,
    SHARE,
    HZ,
    DAMPING,
    KNOCK,
    MIDDLE,
    HALF,
    S_LAG,
    S_DELAY,
    S_GAP,
    S_CURVE,
    S_LOW,
    S_HIGH,
    S_STEP,
    S_LINE,
    S_LINE_HZ,
    S_DRIFT,
    S_EXPAND,
    S_EXPAND_S,
    S_EXPAND_AT,
    S_CROSS,
    S_PERIOD,
    S_PERIOD_OF,
    S_MIDDLE,
    S_HALF,
) = range(len(OFF))
RELAXATIONS = 13  # two per decade
# Memory of the wires: slew, lag, play, loop and its last input, mode (2), held value, relaxations; of the sensor: lag, play, warmth
Z_SLEW, Z_LAG, Z_PLAY, Z_LOOP, Z_LAST, Z_Q, Z_QV, Z_HELD, Z_SLAG, Z_SPLAY, Z_WARM, Z_WAS, Z_CREEP = range(13)


def settings(values):
    """The array that the run reads; unknown names are mistakes."""
    unknown = set(values) - set(OFF)
    if unknown:
        raise KeyError(f"no setting {sorted(unknown)}; known: {sorted(OFF)}")
    return np.array([values.get(name, off) for name, off in OFF.items()], float)


@njit
def late(ring, place, delay, h, now):
    """The value a delay ago (now: at this step), straight between fine steps."""
    ring[place % len(ring)] = now
    back = delay / h
    whole = int(back)
    if whole + 1 >= len(ring):
        return ring[(place + 1) % len(ring)]
    part = back - whole
    return (1 - part) * ring[(place - whole) % len(ring)] + part * ring[(place - whole - 1) % len(ring)]


@njit
def before_plant(u, e, z, h, ring, place, kelvin, other, event):
    """From the drive to what the plant is given, over one fine step. event: 1 frozen, 2 knocked, 3 the loop is not closed yet."""
    v = (1 - e[MIX]) * u + e[MIX] * abs(u)
    v = min(max(v, e[LOW]), e[HIGH])
    if e[RISE] < np.inf:
        v = z[Z_SLEW] + min(max(v - z[Z_SLEW], -e[RISE] * h), e[RISE] * h)
    z[Z_SLEW] = v
    if event == 1:
        v = z[Z_HELD]
    z[Z_HELD] = v
    if e[LAG] > 0:
        last = z[Z_LAG]
        z[Z_LAG] += (v - z[Z_LAG]) * (1 - np.exp(-h / e[LAG]))
        v = 0.5 * (last + z[Z_LAG])
    if e[DELAY] > 0:
        v = late(ring, place, e[DELAY], h, v)
    if e[GAP] > 0:
        z[Z_PLAY] = min(max(z[Z_PLAY], v - e[GAP] / 2), v + e[GAP] / 2)
        v = z[Z_PLAY]
    # Bouc-Wen about the rest, in shares of half the range (Wen, J. Eng. Mech. Div. 102 (1976) 249). What it holds is held
    # back: a response ahead of its drive would give energy in every cycle.
    if e[LOOP] != 0:
        d = (v - z[Z_LAST]) / e[HALF]
        z[Z_LAST] = v
        z[Z_LOOP] += 3.0 * d - 2.0 * abs(d) * z[Z_LOOP] - 0.6 * d * abs(z[Z_LOOP])
        v -= e[LOOP] * e[HALF] * z[Z_LOOP]
    if e[CURVE] != 0:  # exponential, as of an equal-percentage valve or a diode; slope 1 in the middle
        v = e[MIDDLE] + e[HALF] * (np.exp(e[CURVE] * (v - e[MIDDLE]) / e[HALF]) - 1) / e[CURVE]
    if e[CREEP] != 0:  # gamma per decade as relaxations, two of them each decade
        total = 0.0
        for k in range(RELAXATIONS):
            z[Z_CREEP + k] += (v - z[Z_CREEP + k]) * (1 - np.exp(-h / (e[CREEP_FROM] * 10 ** (0.5 * k))))
            total += z[Z_CREEP + k]
        v += 0.5 * e[CREEP] * total
    v *= 1 + e[KELVIN] * (kelvin - e[KELVIN_AT])
    v += e[CROSS] * other
    if e[SHARE] != 0:  # a mode beside the stiff way
        w = 2 * np.pi * e[HZ]
        z[Z_QV] += h * (w * w * (v - z[Z_Q]) - 2 * e[DAMPING] * w * z[Z_QV])
        z[Z_Q] += h * z[Z_QV]
        v += e[SHARE] * (z[Z_Q] - v)
    if event == 2:
        v += e[KNOCK] * e[HALF]
    return v


@njit
def sensor_moves(y, e, z, h, ring, place, kelvin):
    """What remembers in the sensor, over one fine step; returns what the rest of the sensor is given."""
    if e[S_LAG] > 0:
        middle = 0.5 * (y + z[Z_WAS])
        z[Z_SLAG] += (middle - z[Z_SLAG]) * (1 - np.exp(-h / e[S_LAG]))
    z[Z_WAS] = y
    if e[S_LAG] > 0:
        y = z[Z_SLAG]
    if e[S_DELAY] > 0:
        y = late(ring, place, e[S_DELAY], h, y)
    if e[S_GAP] > 0:
        z[Z_SPLAY] = min(max(z[Z_SPLAY], y - e[S_GAP] / 2), y + e[S_GAP] / 2)
        y = z[Z_SPLAY]
    z[Z_WARM] += (kelvin - z[Z_WARM]) * (1 - np.exp(-h / e[S_EXPAND_S]))
    return y


@njit
def sensor_shows(y, e, z, t, kelvin, other, luck):
    """The static part of the sensor at a row. luck: phase of the line and slope of the drift, of its own each time."""
    y += e[S_EXPAND] * (z[Z_WARM] - e[S_EXPAND_AT]) + e[S_CROSS] * other
    s = (y - e[S_MIDDLE]) / e[S_HALF]
    y += e[S_CURVE] * e[S_HALF] * (np.sin(1.9 * s) / 1.9 - s + 0.35 * s * s)  # odd and even, no polynomial
    if e[S_PERIOD] != 0:
        y += e[S_PERIOD] * np.sin(2 * np.pi * y / e[S_PERIOD_OF])
    y += e[S_LINE] * (
        np.sin(2 * np.pi * e[S_LINE_HZ] * t + luck[0]) + 0.15 * np.sin(6 * np.pi * e[S_LINE_HZ] * t + 2 * luck[0])
    )
    y += e[S_DRIFT] * luck[1] * t
    return min(max(y, e[S_LOW]), e[S_HIGH])


@njit
def control(c, memory, error, dt):
    """PID with a filtered difference and a limit that stops the integral. c: kp, ki, kd, rest, low, high, step."""
    rate = (error - memory[1]) / dt
    memory[1] = error
    memory[2] += 0.4 * (rate - memory[2])
    wish = c[3] + c[0] * error + c[2] * memory[2] + memory[0]
    u = min(max(wish, c[4]), c[5])
    if u == wish:
        memory[0] += c[1] * error * dt
    return np.round(u / c[6]) * c[6]


@njit
def run(rate, sense, p, x0, u, target, w, events, e, noise, dt, parts, hold, c, luck, ny):
    """-> (what the sensors show, what the drive was). u: rows; c empty: u is played, else the controller makes it of target.

    w: side signals at the rows, column 0 a temperature [degC], column 1 whatever else couples in. Sensors other than the first
    show the plant as it is. noise is added before the controller looks."""
    rows, h, closed = len(u), dt / parts, len(c) > 0
    u = u.copy()
    ring_u = np.full(int(e[DELAY] / h) + 3, u[0])
    ring_y = np.zeros(int(e[S_DELAY] / h) + 3)
    z = np.zeros(Z_CREEP + RELAXATIONS)
    for k in (Z_SLEW, Z_LAG, Z_Q, Z_HELD):
        z[k] = u[0]
    z[Z_CREEP:] = u[0]
    z[Z_LAST] = u[0]
    z[Z_WARM] = w[0, 0]
    x, y, shown = x0.copy(), np.zeros(ny), np.zeros((rows, ny))
    k1, k2, k3, k4 = np.zeros(len(x)), np.zeros(len(x)), np.zeros(len(x)), np.zeros(len(x))
    memory, side, v, was = np.zeros(3), w[0].copy(), u[0], u[0]
    sense(x, v, side, p, y)
    z[Z_SLAG] = z[Z_WAS] = y[0]
    ring_y[:] = y[0]
    first = y[0]
    for i in range(rows):
        for j in range(parts):
            f = (j + 0.5) / parts
            nxt = min(i + 1, rows - 1)
            if j == 0 and closed:
                sense(x, v, w[i], p, y)
                y[0] = sensor_shows(first if i else y[0], e, z, i * dt, w[i, 0], w[i, 1], luck)
                shown[i] = y + noise[i]
                u[i] = control(c, memory, target[i] - shown[i, 0], dt) if events[i] != 3 else c[3]
            to_row = v + 0.5 * (v - was)  # the drive may bend there: from the left
            was = v
            side = w[i] + (w[nxt] - w[i]) * f
            now = u[i] if hold else u[i] + (u[nxt] - u[i]) * f
            v = before_plant(now, e, z, h, ring_u, i * parts + j, side[0], side[1], events[i])
            if j == 0 and not closed:
                sense(x, v if hold else to_row, w[i], p, y)
                moved = e[S_LAG] > 0 or e[S_DELAY] > 0 or e[S_GAP] > 0
                y[0] = sensor_shows(first if i and moved else y[0], e, z, i * dt, w[i, 0], w[i, 1], luck)
                shown[i] = y + noise[i]
            rate(x, v, side, p, k1)
            rate(x + 0.5 * h * k1, v, side, p, k2)
            rate(x + 0.5 * h * k2, v, side, p, k3)
            rate(x + h * k3, v, side, p, k4)
            x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            sense(x, v, side, p, y)
            first = sensor_moves(y[0], e, z, h, ring_y, i * parts + j, side[0])
    if e[S_STEP] > 0:
        for i in range(rows):
            shown[i, 0] = np.round(shown[i, 0] / e[S_STEP]) * e[S_STEP]
    return shown, u
