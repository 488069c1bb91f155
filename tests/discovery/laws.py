"""Laws of nature for the generated cases: pure functions on equidistant samples.

Decides the formulas of what a model may lack, on purpose others than those of the program's blocks (a Preisach density,
not play operators; a power law by convolution, not Kelvin-Voigt chains; LuGre, not Dahl).
Does not decide where in a plant they act, nor how strong they are.
"""
import numpy as np
from scipy.signal import fftconvolve, lfilter

try:
    import numba

    def njit(function):
        return numba.njit(cache=True)(function)  # compiled once per machine
except ImportError:  # everything runs without, some thirty times slower
    def njit(function):
        return function


# ---- linear parts: exact for an input that is a straight line between samples ------------------------------------------

def modes_of(a, b, c):
    """Poles and residues of c (s - a)^-1 b; the poles must differ."""
    poles, vectors = np.linalg.eig(np.atleast_2d(a))
    return poles, (np.atleast_1d(c) @ vectors) * np.linalg.solve(vectors, np.asarray(b, dtype=complex))


def modes_of_ratio(num, den):
    """Poles and residues of num/den (strictly proper, descending powers of s)."""
    poles = np.roots(den)
    return poles, np.polyval(num, poles) / np.polyval(np.polyder(den), poles)


def respond(modes, u, h):
    """Response of a sum of modes r/(s - p), in equilibrium with u[0] at the start."""
    y = np.zeros(len(u), dtype=complex)
    for p, r in zip(*modes):
        x = p * h
        e = np.exp(x)
        small = abs(x) < 1e-3  # series: the closed forms lose digits there
        phi_1 = 1 + x / 2 + x * x / 6 if small else (e - 1) / x
        phi_2 = 0.5 + x / 6 + x * x / 24 if small else (e - 1 - x) / x**2
        drive = h * ((phi_1 - phi_2) * u[:-1] + phi_2 * u[1:])
        start = -u[0] / p
        y += r * np.concatenate([[start], lfilter([1.0], [1.0, -e], drive.astype(complex), zi=[e * start])[0]])
    return y.real


def lag(u, h, *times):
    """Poles in a row, unity at rest; times [s] must differ, 0 is no pole."""
    for tau in times:
        if tau > 0:
            u = respond((np.array([-1 / tau]), np.array([1 / tau])), u, h)
    return u


def oscillator(u, h, frequency, damping):
    """One mode of unity static gain; frequency [Hz]."""
    w = 2 * np.pi * frequency
    return respond(modes_of_ratio([w * w], [1, 2 * damping * w, w * w]), u, h)


def delayed(u, h, time):
    """u(t - time) of straight lines between samples; before the first sample: u[0]."""
    t = h * np.arange(len(u))
    return np.interp(t - time, t, u)


def power_law_creep(x, h, t0, exponent):
    """Answer to each change of x after t: ((1 + t/t0)^p - 1)/(p ln 10), which for p -> 0 is log10(1 + t/t0)."""
    t = h * np.arange(len(x))
    q = exponent + 1
    integral = (t0 * ((1 + t / t0) ** q - 1) / q - t) / (exponent * np.log(10))  # of the answer, from 0 to t
    slopes = np.diff(x) / h
    creep = np.zeros(len(x))
    creep[1:] = fftconvolve(slopes, np.diff(integral))[:len(slopes)]
    return creep


# ---- memory -------------------------------------------------------------------------------------------------------------

@njit
def plays(u, thresholds, start, bulge):
    """One-sided plays, a row each; `bulge` moves the falling envelope from u to u + bulge*u*(top - u)/top."""
    rows = np.empty((len(thresholds), len(u)))
    top = max(u.max(), 1e-9)
    for i in range(len(thresholds)):
        w = start[i]
        for k in range(len(u)):
            falling = u[k] + bulge[i] * u[k] * (top - u[k]) / top
            w = max(u[k] - thresholds[i], min(falling, w))
            rows[i, k] = w
    return rows


@njit
def lost_motion(x, half_gaps, shares):
    """Backlash whose flanks touch one after the other: two-sided plays of almost the same gap."""
    y = np.zeros(len(x))
    for i in range(len(half_gaps)):
        z = x[0]
        for k in range(len(x)):
            z = max(x[k] - half_gaps[i], min(x[k] + half_gaps[i], z))
            y[k] += shares[i] * z
    return y


def everett_table(rng, cells=96):
    """Everett function of a random Preisach density on [-1, 1]^2, antisymmetric: table[i, j] for alpha_i, beta_j.

    The density is a hill in the coercive field (width of a relay) times one in the bias of a relay, on a floor, times
    a smooth random factor. Scaled so that the whole triangle holds 1.
    """
    node = np.linspace(-1, 1, cells + 1)
    mid = (node[1:] + node[:-1]) / 2
    alpha, beta = np.meshgrid(mid, mid, indexing="ij")
    width, bias = (alpha - beta) / 2, (alpha + beta) / 2
    hill = np.exp(-((width - rng.uniform(0.05, 0.4)) / rng.uniform(0.15, 0.4)) ** 2
                  - ((bias - rng.uniform(-0.2, 0.2)) / rng.uniform(0.4, 1.0)) ** 2) + rng.uniform(0.1, 0.4)
    rough = sum(rng.normal(0, 0.15) * np.cos(rng.uniform(1, 5) * alpha + rng.uniform(1, 5) * beta + rng.uniform(0, 6.3))
                for _ in range(6))
    mass = np.tril(hill * np.exp(rough))
    mass[np.diag_indices(cells)] /= 2
    mass /= mass.sum()
    right = np.cumsum(mass[:, ::-1], axis=1)[:, ::-1]  # over beta from j upwards
    table = np.zeros((cells + 1, cells + 1))
    table[1:, :-1] = np.cumsum(right, axis=0)
    table = np.tril(table)
    return table - table.T


@njit
def everett(table, alpha, beta):
    """Bilinear; being antisymmetric, the table gives exactly 0 on the diagonal: no jump at a turning point."""
    cells = table.shape[0] - 1
    a = min(max((alpha + 1) / 2 * cells, 0.0), cells - 1e-9)
    b = min(max((beta + 1) / 2 * cells, 0.0), cells - 1e-9)
    i, j = int(a), int(b)
    p, q = a - i, b - j
    return ((1 - p) * ((1 - q) * table[i, j] + q * table[i, j + 1])
            + p * ((1 - q) * table[i + 1, j] + q * table[i + 1, j + 1]))


@njit
def preisach_step(table, u, turns, outputs, memory):
    """Output at u after the history in memory = (number of turns, direction, last u, last output); changes the memory."""
    n, direction, last, value = int(memory[0]), memory[1], memory[2], memory[3]
    if (u - last) * direction < 0:
        turns[n], outputs[n] = last, value
        n += 1
        direction = -direction
    while n >= 3 and (u - turns[n - 2]) * direction >= 0:  # wiped out
        n -= 2
    if direction > 0:
        value = outputs[n - 1] + everett(table, u, turns[n - 1])
    else:
        value = outputs[n - 1] - everett(table, turns[n - 1], u)
    memory[0], memory[1], memory[2], memory[3] = n, direction, u, value
    return value


@njit
def preisach_walk(table, u):
    """From negative saturation (all relays down at -1)."""
    turns, outputs = np.zeros(len(u) + 8), np.zeros(len(u) + 8)
    turns[0] = -1.0
    memory = np.array([1.0, 1.0, -1.0, 0.0])
    y = np.empty(len(u))
    for k in range(len(u)):
        y[k] = preisach_step(table, u[k], turns, outputs, memory)
    return y


def preisach(table, u, low, high):
    """Output for u within [low, high], 0 at u[0]. A range around zero starts demagnetised, else all relays are down."""
    scaled = (u - low) / (high - low) * 1.96 - 0.98
    before = demagnetising() if low < 0 else np.array([-1.0])
    y = preisach_walk(table, np.concatenate([before, scaled]))[len(before):]
    return y - y[0]


def demagnetising():
    swings = np.linspace(0.99, 0, 120)
    return np.ravel(np.column_stack([swings, -swings]))


# ---- limits and friction --------------------------------------------------------------------------------------------------

def soft_limit(u, inverse_limit, sharpness):
    """u/(1 + |u/limit|^n)^(1/n), or tanh for sharpness 0; one over the limit, so that 0 is no limit."""
    if inverse_limit == 0:
        return u
    z = np.abs(u) * inverse_limit
    if sharpness == 0:
        return np.sign(u) * np.tanh(z) / inverse_limit
    return u / (1 + z**sharpness) ** (1 / sharpness)


@njit
def slew(u, h, up, down, steps):
    """v' = clip((u - v)/tau, -down, up) in fine steps, tau one of them; rates [V/s]."""
    v = np.empty(len(u))
    v[0] = u[0]
    fine = h / steps
    for k in range(1, len(u)):
        x = v[k - 1]
        for i in range(1, steps + 1):
            to_go = u[k - 1] + (u[k] - u[k - 1]) * i / steps - x
            x += min(max(to_go, -down * fine), up * fine)
        v[k] = x
    return v


@njit
def bristles(zeta, w, h, presliding, excess, stribeck):
    """LuGre bristle deflection over its Coulomb value after h at the speed w; exact for a constant speed."""
    level = 1.0 + excess * np.exp(-(w / stribeck) ** 2)
    if w > 0:
        steady = level
    else:
        steady = -level
    return steady + (zeta - steady) * np.exp(-abs(w) * h / (presliding * level))


@njit
def guided(x_free, h, coulomb, presliding, excess, stribeck):
    """Motion of an actuator without mass in a guide with friction: x = x_free - coulomb*zeta(x); implicit steps."""
    x = np.empty(len(x_free))
    x[0] = x_free[0]
    zeta = 0.0
    for k in range(1, len(x)):
        low = min(x_free[k], x[k - 1]) - 3 * coulomb
        high = max(x_free[k], x[k - 1]) + 3 * coulomb
        for _ in range(50):  # the balance rises monotonically with x
            mid = (low + high) / 2
            z = bristles(zeta, (mid - x[k - 1]) / h, h, presliding, excess, stribeck)
            if mid + coulomb * z > x_free[k]:
                high = mid
            else:
                low = mid
        x[k] = (low + high) / 2
        zeta = bristles(zeta, (x[k] - x[k - 1]) / h, h, presliding, excess, stribeck)
    return x


@njit
def mass_on_spring(pull, h, step, cubic, quadratic, friction, table, depth, slope, scale):
    """x'' + 2 zeta w x' + w^2 (x + p) = w^2 pull; pull and x in um, p what the spring or the guide holds back.

    step: exact propagator of the linear part, rows (x, v): from (x, v, force before, force after).
    friction: (coulomb, presliding, excess, stribeck, bristle damping); table: Everett function of x/scale.
    """
    n = len(pull)
    y = np.empty(n)
    x = v = zeta = p = p_before = 0.0
    turns, outputs, memory = np.zeros(4096), np.zeros(4096), np.array([1.0, 1.0, -1.0, 0.0])
    turns[0] = -1.0
    rest = 0.0
    if depth != 0:
        for i in range(120):
            swing = 0.99 * (1 - i / 119)
            preisach_step(table, swing, turns, outputs, memory)
            rest = preisach_step(table, -swing, turns, outputs, memory)
    y[0] = 0.0
    for k in range(1, n):
        before, after = pull[k - 1] - p, pull[k] - (2 * p - p_before)
        v_before = v
        x, v = (step[0, 0] * x + step[0, 1] * v + step[0, 2] * before + step[0, 3] * after,
                step[1, 0] * x + step[1, 1] * v + step[1, 2] * before + step[1, 3] * after)
        p_before = p
        p = cubic * x**3 / scale**2 + quadratic * x**2 / scale
        if friction[0] != 0:
            zeta_before = zeta
            zeta = bristles(zeta, 0.5 * (v_before + v), h, friction[1], friction[2], friction[3])
            p += friction[0] * (zeta + friction[4] * (zeta - zeta_before) / h)
        if depth != 0:
            # What a lagging memory leaves of a straight line leads: pushed out it takes more force than coming back, as
            # whatever loses energy does. The line is what the user's stiffness already holds, of a full stroke.
            p -= depth * scale * (2 * (preisach_step(table, x / scale, turns, outputs, memory) - rest) - slope * x / scale)
        y[k] = x
    return y


def propagator(frequency, damping, h):
    """Exact step of x'' + 2 zeta w x' + w^2 x = w^2 f with f a straight line: what mass_on_spring needs."""
    w = 2 * np.pi * frequency
    poles, vectors = np.linalg.eig(np.array([[0, 1], [-w * w, -2 * damping * w]]))
    inverse = np.linalg.inv(vectors)
    x = poles * h
    e = np.exp(x)
    phi_1, phi_2 = (e - 1) / x, (e - 1 - x) / x**2
    column = inverse @ np.array([0, w * w])
    step = np.empty((2, 4))
    step[:, :2] = (vectors * e @ inverse).real
    step[:, 2] = (vectors @ (h * (phi_1 - phi_2) * column)).real
    step[:, 3] = (vectors @ (h * phi_2 * column)).real
    return step
