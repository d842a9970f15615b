"""Theory, exact orbits, limits, decay and dampers at the ends of every parameter's range, in 80 digits (sweeps in 22).

    python3 layers.py >../../evidence/src/extremes/layers.json

It shares nothing with the program, and uses none of its closed forms. The slow flow's fixed points are where its rates
vanish, on a manifold that is solved for; its Jacobian is a difference quotient in 80 digits, and so is that of the map of
the full system from impact to impact; decay times are integrals; amplitudes of dampers are solutions of their linear
equations. Beside each value stands what it changes by when each parameter in turn is moved by half a unit in the last place
of a double: nobody who computes with doubles can know it better.
"""

import json
import sys

import mpmath as mp

mp.mp.dps = 80
ONE, HALF = mp.mpf(1), mp.mpf(1) / 2
STEP = mp.mpf(10) ** -30  # of difference quotients: their error is its square over rounding, 1e-50 at the least
ULP = mp.mpf(2) ** -53

NATURAL = (11.47e3 / 4.168) ** 0.5
TABLE = {
    "mass-ratio": 0.032 / 4.168,
    "damping": 3.02 / (0.032 * NATURAL),
    "restitution": 0.6,
    "frequency": 8.0 * (2 * float(mp.pi)) / NATURAL,
    "forcing": 0.25 / (0.032 / 4.168) / 7.5,
}
ORDER = list(TABLE)

# One number of Table 1 at the ends of its range.
ONES = {
    "mass-ratio": [1e-9, 1e-6, 1e-3, 0.1, 0.5],
    "restitution": [0.0, 1e-9, 1e-4, 0.05, 0.95, 1 - 1e-9, 1.0],
    "damping": [0.0, 1e-9, 1e-3, 10.0, 100.0, 1e3, 1e6],
    "forcing": [1e-9, 1e-4, 0.1, 1.0, 100.0, 1e4, 1e9],
    "frequency": [1e-6, 1e-3, 0.1, 0.9999999, 1.0, 1.01, 2.0, 10.0, 1e3, 1e6],
}
# Several at once. At a mass ratio of 1e-9 resonance is 1e-9 wide.
SEVERAL = [
    {"mass-ratio": 1e-9, "frequency": 1.0},
    {"mass-ratio": 1e-9, "frequency": 1 + 2.0**-30, "forcing": 1.0},
    {"mass-ratio": 0.5, "frequency": 1.0, "damping": 0.0},
    {"mass-ratio": 0.5, "frequency": 1.2, "damping": 0.0, "restitution": 0.0},
    {"mass-ratio": 0.5, "damping": 4.0},  # exactly critical
    {"mass-ratio": 0.5, "damping": 1e3, "forcing": 1e4},
    {"damping": 1e9, "forcing": 1e9, "frequency": 1.0},
    {"damping": 0.0, "restitution": 1.0, "frequency": 0.98},
    {"damping": 0.0, "restitution": 1.0, "frequency": 1.02},
    {"restitution": 1e-9, "frequency": 1.01, "forcing": 2.0},
    {"restitution": 0.0, "frequency": 1.01, "forcing": 2.0},
    {"restitution": 1 - 1e-9, "frequency": 1.0, "forcing": 1.0},
    {"restitution": 1 - 1e-9, "damping": 1e-9, "frequency": 1.0, "forcing": 1e-3},
    {"restitution": 0.3, "damping": 1e-6, "mass-ratio": 1e-6, "frequency": 1.0, "forcing": 1.5},
    {"restitution": 0.3, "frequency": 1e-3, "forcing": 100.0},
    {"restitution": 0.9, "frequency": 1e3, "forcing": 1e6},
]


def systems():
    yield {}
    for name, values in ONES.items():
        for value in values:
            yield {name: value}
    yield from SEVERAL


# --- The slow flow: (14), (15), (18), lengths over the clearance -----------------------------------------------------


def parabola(f, at=(0.5, 2, 3.5)):
    """Coefficients by ascending powers of the parabola through three values."""
    a, b, c = (mp.mpf(x) for x in at)
    p, q, r = f(a), f(b), f(c)
    first, second = (q - p) / (b - a), (r - q) / (c - b)
    square = (second - first) / (c - a)
    return p - first * a + square * a * b, first - square * (a + b), square


def roots_of(constant, linear, square):
    if square == 0:
        return [-constant / linear] if linear else []
    root = linear * linear - 4 * square * constant
    if root < 0:
        return []
    return sorted([(-linear - mp.sqrt(root)) / (2 * square), (-linear + mp.sqrt(root)) / (2 * square)])


class Slow:
    def __init__(self, eps, damping, restitution, omega, gamma):
        self.damping, self.gamma = damping, gamma
        self.sigma = (omega - 1) / eps
        self.rho = (1 - restitution) / (1 + restitution)

    def sides(self, ratio):
        """C cos Theta, C sin Theta, C squared and E."""
        cosine, sine = 1 - ratio, 2 / mp.pi * self.rho * ratio
        return cosine, sine, cosine**2 + sine**2, 8 * ratio / mp.pi**2

    def force(self, ratio, sigma=None):
        """C gamma e^(i eta), by its squares, that (18) asks for; times C squared."""
        sigma = self.sigma if sigma is None else sigma
        cosine, sine, square, e = self.sides(ratio)
        # C times each side, so that every term is a polynomial.
        amplitude, phase = self.damping * square + e * sine, e * cosine - 2 * sigma * square
        return (amplitude**2 + phase**2) / square

    def parabola(self, sigma=None):
        return parabola(lambda ratio: self.force(ratio, sigma))

    def fold(self):
        constant, linear, square = parabola(lambda ratio: self.sides(ratio)[2])
        return -linear / (2 * square)

    def node(self, sigma=None):
        constant, linear, square = self.parabola(sigma)
        ratio = -linear / (2 * square)
        value = constant - linear**2 / (4 * square)
        return ratio, mp.sqrt(value) if value > 0 else mp.mpf(0)

    def points(self):
        constant, linear, square = self.parabola()
        return [one for one in roots_of(constant - self.gamma**2, linear, square) if one > 0]

    def rates(self, ratio, eta):
        cosine, sine, square, e = self.sides(ratio)
        c = mp.sqrt(square)
        of_c = (-self.damping * c - e * sine / c + self.gamma * mp.sin(eta)) / 2
        of_eta = self.sigma + (self.gamma * mp.cos(eta) - e * cosine / c) / (2 * c)
        slope = (self.sides(ratio + STEP)[2] - self.sides(ratio - STEP)[2]) / (2 * STEP)
        return 2 * c * of_c / slope, of_eta

    def jacobian(self, ratio):
        cosine, sine, square, e = self.sides(ratio)
        c = mp.sqrt(square)
        eta = mp.atan2(self.damping * c + e * sine / c, e * cosine / c - 2 * self.sigma * c)
        sides = [[self.rates(ratio + s * STEP, eta) for s in (1, -1)], [self.rates(ratio, eta + s * STEP) for s in (1, -1)]]
        d = [[(plus[k] - minus[k]) / (2 * STEP) for k in (0, 1)] for plus, minus in sides]
        return d[0][0] + d[1][1], d[0][0] * d[1][1] - d[0][1] * d[1][0]


BREAKING = mp.pi**2 / (mp.pi**2 - 4)  # held to the impact pair's own map below


def theory(parameters):
    slow = Slow(*parameters)
    found = {}
    for k, ratio in enumerate(slow.points()):
        square = slow.sides(ratio)[2]
        if square == 0:
            continue
        found[f"B{k + 1}"], found[f"C{k + 1}"] = ratio, mp.sqrt(square)
        trace, determinant = slow.jacobian(ratio)
        found[f"trace{k + 1}"], found[f"det{k + 1}"] = trace, determinant
    fold = slow.fold()
    if slow.sides(fold)[2]:  # for elastic impacts the fold is at C = 0
        found["hopf"] = mp.sqrt(slow.force(fold))
    found["breaking"] = mp.sqrt(slow.force(BREAKING))
    ratio, gamma = slow.node()
    if ratio > 0 and gamma > 0:
        found["node-B"], found["node"] = ratio, gamma
    # P1: the detuning at which the node's amplitude is the fold's; -q1/(2 q2) is then linear over linear in sigma^2, and the
    # difference a parabola in sigma.
    def apart(sigma):
        _, linear, square = slow.parabola(sigma)
        return linear + 2 * square * fold
    constant, linear, square = parabola(apart, (-1, 0, 1))
    # At the fold the squares of sigma cancel.
    if abs(linear) > 1e-40:
        assert abs(square) < mp.mpf(10) ** -60 * (abs(linear) + abs(constant)), square
        if slow.sides(fold)[2]:
            sigma = -constant / linear
            found["P1-sigma"], found["P1-gamma"] = sigma, mp.sqrt(slow.force(fold, sigma))
    return found


BANDS = (mp.mpf(3), (mp.mpf("0.2"), mp.mpf(3)))  # detunings to both sides of resonance, factors of the forcing
SCANNED = 600


def bands(parameters):
    """The share of a band in area Z3: where a fixed point is on the stable branch of the manifold, or on its left branch while
    the forcing is below the Hopf boundary. Scanned, and each change bisected."""
    eps, damping, restitution, omega, forcing = parameters

    def in_z3(slow):
        fold = slow.fold()
        points = slow.points()
        below = slow.sides(fold)[2] and slow.gamma < mp.sqrt(slow.force(fold))
        return any(fold <= one <= BREAKING for one in points) or bool(below) and any(one < fold for one in points)

    def share(low, high, at):
        places = [low + (high - low) * (k + mp.mpf("0.37")) / SCANNED for k in range(SCANNED)]
        edges, known = [low], [in_z3(at(one)) for one in places]
        for left, right, before, after in zip(places, places[1:], known, known[1:]):
            if before != after:
                for _ in range(70):
                    middle = (left + right) / 2
                    if in_z3(at(middle)) == before:
                        left = middle
                    else:
                        right = middle
                edges.append((left + right) / 2)
        edges.append(high)
        parts, state = mp.mpf(0), known[0]
        for left, right in zip(edges, edges[1:]):
            parts += (right - left) * state
            state = not state
        return parts / (high - low), len(edges) - 2

    with mp.workdps(40):
        width, (least, most) = BANDS
        # The program is given frequency ratios in doubles.
        low, high = (mp.mpf(max(float(1 + sign * width * eps), 1e-3)) for sign in (-1, 1))
        of_frequency, ends = share(low, high, lambda one: Slow(eps, damping, restitution, one, forcing))
        of_amplitude, others = share(least, most, lambda one: Slow(eps, damping, restitution, omega, one * forcing))
        # Each end of a stretch is known to a rounding of the frequency ratio, or of the factor.
        return {
            "z3-frequency": (of_frequency, 8 * ULP * ends / (high - low)),
            "z3-amplitude": (of_amplitude, 8 * ULP * others),
        }


# --- Free decay: an integral over the amplitude ----------------------------------------------------------------------


def decay(parameters):
    slow = Slow(*parameters)
    fold = slow.fold()
    low, high = mp.sqrt(slow.sides(fold)[2]), mp.mpf("0.5")
    if low >= high:
        return {}
    def ratio(c):
        constant, linear, square = parabola(lambda b: slow.sides(b)[2])
        return (-linear + mp.sqrt(abs(linear**2 - 4 * square * (constant - c * c)))) / (2 * square)
    def taken(b):  # by impacts per slow time, from C squared over two
        _, sine, _, e = slow.sides(b)
        return e * sine
    # Over B, not C, so that the fold is no singularity: C dC = (dC^2/dB)/2 dB.
    c2 = parabola(lambda b: slow.sides(b)[2])
    slope = lambda b: c2[1] + 2 * c2[2] * b
    square = lambda b: slow.sides(b)[2]
    rate = lambda b: slow.damping * square(b) + taken(b)
    start = ratio(high)
    if slow.rho == 0:  # down to no amplitude at all: for ever
        return {}
    mp.mp.dps = 30
    edges = [fold] + [fold + (start - fold) * mp.mpf(10) ** -k for k in range(9, -1, -1)]
    time = mp.quad(lambda b: slope(b) / rate(b), edges)
    impacts = mp.quad(lambda b: slope(b) * taken(b) / rate(b), edges)
    mp.mp.dps = 80
    # What rounding of the amplitude that it begins at changes; of the one that it ends at, no more.
    rounded = 2 * high / rate(start) * high * ULP
    return {"time": (time, rounded), "impacts-share": (impacts / high**2, taken(start) * rounded / high**2), "residual": (low, 0)}


# --- The full system ------------------------------------------------------------------------------------------------


class Full:
    """Equations (1) and (2) from impact to impact, for the orbit whose sawtooth has the amplitude beta."""

    def __init__(self, eps, damping, restitution, omega):
        self.eps, self.r, self.omega, self.d = eps, restitution, omega, eps * damping
        self.half = mp.pi / omega
        self.q = mp.sqrt(mp.mpc(self.d**2 / 4 - 1))

    def free(self, s, x, v):
        """The free oscillator a time later."""
        # exp(-d s/2 +- q s), so that neither overflows.
        if self.q == 0:
            slow = mp.exp(-self.d * s / 2)
            c, z = slow, slow * s
        else:
            plus, minus = mp.exp((-self.d / 2 + self.q) * s), mp.exp((-self.d / 2 - self.q) * s)
            c, z = mp.re((plus + minus) / 2), mp.re((plus - minus) / (2 * self.q))
        return c * x + z * (v + self.d / 2 * x), c * v - z * (self.d / 2 * v + x)

    def linear(self, gamma, base):
        """Amplitude of the steady motion."""
        force = self.eps * gamma
        if base:
            force *= mp.sqrt(1 + (self.d * self.omega) ** 2)
        size = mp.sqrt((1 - self.omega**2) ** 2 + (self.d * self.omega) ** 2)
        return force / size if size else mp.inf

    def orbit(self, beta):
        """Velocities and steady part at the impact on the +b wall."""
        u = 2 * beta / self.half
        # x'+ - u = -r (x'- + u), x'+ + eps u = x'- - eps u.
        before = (u * (1 - self.r) + 2 * self.eps * u) / (1 + self.r)
        after = before - 2 * self.eps * u
        # (Phi + I) z = (0, x'+ - x'-)
        a, c = self.free(self.half, ONE, mp.mpf(0))
        b, d = self.free(self.half, mp.mpf(0), ONE)
        jump = after - before
        det = (a + 1) * (d + 1) - b * c
        zx, zv = -b * jump / det, (a + 1) * jump / det
        return {"u": u, "after": after, "before": before, "z": (zx, zv), "X": 1 - beta - zx, "V": after - zv}

    def square(self, beta):
        at = self.orbit(beta)
        return at["X"] ** 2 + (at["V"] / self.omega) ** 2

    def squares(self):
        return parabola(self.square)

    def flight(self, at, s):
        """w, w' and w'' a time s after the impact on the +b wall."""
        zx, zv = self.free(s, *at["z"])
        c, n = mp.cos(self.omega * s), mp.sin(self.omega * s)
        x = at["X"] * c + at["V"] / self.omega * n + zx
        v = at["V"] * c - at["X"] * self.omega * n + zv
        za = -zx - self.d * zv
        acceleration = -self.omega**2 * (x - zx) + za
        y = at["X"] + at["z"][0] - 1 + at["u"] * s
        return x - y, v - at["u"], acceleration

    def jacobian(self, beta):
        """Of the map from (phase, x, x', y') after an impact on +b to minus the same after the next, on -b."""
        at = self.orbit(beta)
        steady = (at["X"], at["V"] / self.omega)

        def mapped(turn, x, v, u):
            # The steady part, and what the excitation is later by `turn`.
            c0, s0 = mp.cos(turn), mp.sin(turn)
            X, W = steady[0] * c0 + steady[1] * s0, steady[1] * c0 - steady[0] * s0
            z = (x - X, v - W * self.omega)
            def gap(s):
                zx, zv = self.free(s, *z)
                c, n = mp.cos(self.omega * s), mp.sin(self.omega * s)
                place, speed = X * c + W * n + zx, self.omega * (W * c - X * n) + zv
                return place - (x - 1 + u * s), speed - u, place, speed
            s = self.half
            for _ in range(5):
                w, rate, _, _ = gap(s)
                s -= (w + 1) / rate
            w, rate, place, speed = gap(s)
            exchanged = (1 + self.r) * (speed - u) / (1 + self.eps)
            return turn + self.omega * s, place, speed - self.eps * exchanged, u + exchanged

        here = (mp.mpf(0), 1 - beta, at["after"], at["u"])
        matrix = mp.matrix(4, 4)
        for j in range(4):
            moved = [mapped(*[here[k] + (sign * STEP if k == j else 0) for k in range(4)]) for sign in (1, -1)]
            for i in range(4):
                d = (moved[0][i] - moved[1][i]) / (2 * STEP)
                matrix[i, j] = d if i == 0 else -d
        return matrix

    def tests(self, beta):
        """det(J + I), det(J^(2) - I), and the moduli of the multipliers."""
        j = self.jacobian(beta)
        plus = mp.det(j + mp.eye(4))
        pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
        compound = mp.matrix(6, 6)
        for row, (a, b) in enumerate(pairs):
            for column, (c, d) in enumerate(pairs):
                compound[row, column] = j[a, c] * j[b, d] - j[a, d] * j[b, c]
        return plus, mp.det(compound - mp.eye(6)), j

    def multipliers(self, beta):
        # A defective spectrum is known to a part of its digits only; 80 are enough.
        values, _ = mp.eig(self.jacobian(beta))
        return sorted(values, key=lambda value: -abs(value))

    def grazing(self):
        """beta up to which the absorber keeps off the walls: w = cos(Omega s) + beta k(s) is linear in beta."""
        one, two = self.orbit(ONE), self.orbit(mp.mpf(2))
        per_beta = {name: two[name] - one[name] for name in ("X", "V", "u")}
        per_beta["z"] = [b - a for a, b in zip(one["z"], two["z"])]

        def parts(s):
            """cos(Omega s) and k(s)."""
            c, n = mp.cos(self.omega * s), mp.sin(self.omega * s)
            zx, _ = self.free(s, *per_beta["z"])
            return c, per_beta["X"] * (c - 1) + per_beta["V"] / self.omega * n + zx - per_beta["z"][0] - per_beta["u"] * s

        def inverse(s):
            c, k = parts(s)
            return k / (1 - c), -k / (1 + c)

        radians = self.half * max(self.omega, ONE)
        count = min(int(radians * 12) + 24, 2000)
        even = [self.half * mp.mpf(k) / count for k in range(1, count)]
        close = [self.half * mp.mpf(10) ** (-mp.mpf(k) / 6) / count for k in range(1, 85)]
        places = sorted(even + close + [self.half - s for s in close])
        pairs = [inverse(s) for s in places]
        best = mp.mpf(0)
        for wall in (0, 1):
            values = [pair[wall] for pair in pairs]
            highest = max(values)
            for k in range(1, len(places) - 1):
                peak = values[k] >= values[k - 1] and values[k] > values[k + 1]
                if peak and values[k] > 0 and values[k] > highest * mp.mpf("0.9"):
                    low, high = places[k - 1], places[k + 1]
                    # A golden section to a third of the digits: the value is flat there.
                    ratio = (mp.sqrt(5) - 1) / 2
                    a, b = high - ratio * (high - low), low + ratio * (high - low)
                    fa, fb = inverse(a)[wall], inverse(b)[wall]
                    for _ in range(70):
                        if fa > fb:
                            high, b, fb = b, a, fa
                            a = high - ratio * (high - low)
                            fa = inverse(a)[wall]
                        else:
                            low, a, fa = a, b, fb
                            b = low + ratio * (high - low)
                            fb = inverse(b)[wall]
                    best = max(best, fa, fb)
        return 1 / best if best > 0 else None

    def sticking(self):
        """beta at which the wall no longer leaves behind an absorber that does not rebound."""
        if self.r != 0:
            return None
        a, b = (self.flight(self.orbit(mp.mpf(k)), mp.mpf(0))[2] for k in (1, 2))
        beta = 1 - a / (b - a)
        return beta if beta > 0 else None


def full(parameters, base):
    eps, damping, restitution, omega, gamma = parameters
    return Full(eps, damping, restitution, omega), gamma


def orbits(parameters, base):
    system, gamma = full(parameters, base)
    linear = system.linear(gamma, base)
    if linear == mp.inf:
        return {}
    constant, slope, square = system.squares()
    found = {}
    for k, beta in enumerate(one for one in roots_of(constant - linear**2, slope, square) if one > 0):
        at = system.orbit(beta)
        found[f"beta{k + 1}"] = beta
        found[f"speed{k + 1}"] = at["before"] + at["u"]
        values = system.multipliers(beta)
        found[f"radius{k + 1}"] = abs(values[0])
    return found


LOOKED_AT = (mp.mpf("0.01"), mp.mpf(5))


def limits(parameters, base):
    """gamma at which symmetric orbits begin and end, and the stretches of those that attract."""
    system, _ = full(parameters, base)
    unit = system.linear(ONE, base)
    if unit == mp.inf:
        return {}
    of = lambda beta: mp.sqrt(system.square(beta)) / unit
    constant, slope, square = system.squares()
    found = [("node", -slope / (2 * square))]
    sticking, grazing = system.sticking(), system.grazing()
    if sticking is not None:
        found.append(("sticking", sticking))
    if grazing is not None and (sticking is None or grazing < sticking):
        found.append(("grazing", grazing))
    # beta det(J + I) is a line and beta^2 det(J^(2) - I) a parabola over beta.
    plus = parabola(lambda beta: beta * system.tests(beta)[0])
    assert abs(plus[2]) < mp.mpf(10) ** -25 * (abs(plus[0]) + abs(plus[1])), plus
    if plus[1]:
        found.append(("breaking", -plus[0] / plus[1]))
    lossless = parameters[1] == 0 and parameters[2] == 1
    if not lossless:
        for beta in roots_of(*parabola(lambda beta: beta**2 * system.tests(beta)[1])):
            if beta > 0:
                values = system.multipliers(beta)
                if any(abs(mp.im(v)) > 1e-20 and abs(abs(v) - 1) < 1e-15 for v in values):
                    found.append(("torus", beta))
    found = sorted([one for one in found if LOOKED_AT[0] < one[1] < LOOKED_AT[1]], key=lambda one: one[1])
    edges = [LOOKED_AT[0]] + [beta for _, beta in found] + [LOOKED_AT[1]]
    ends = [beta for kind, beta in found if kind in ("grazing", "sticking")]
    def attracts(a, b):
        middle = (a + b) / 2
        return all(middle < end for end in ends) and all(abs(v) < 1 for v in system.multipliers(middle))
    inside = [attracts(a, b) for a, b in zip(edges, edges[1:])]
    named = {}
    for kind, beta in found:
        named[f"{kind}{1 + sum(name[:-1] == kind for name in named)}"] = of(beta)
    # Ends of the stretches that attract, in pairs.
    edge = [of(beta) for beta in edges]
    changes = [k for k, (a, b) in enumerate(zip([False] + inside, inside + [False])) if a != b]
    for k, (first, last) in enumerate(zip(changes[::2], changes[1::2])):
        for j, gamma in enumerate(sorted([edge[first], edge[last]])):
            named[f"end{2 * k + j + 1}"] = gamma
    return named


# --- Bare oscillator and tuned mass damper over a band ---------------------------------------------------------------

BAND = (0.7, 1.3)


def damper(parameters, base):
    """Largest amplitudes over the clearance between frequency ratios of 0.7 and 1.3: the bare oscillator, and one with the
    damper of the absorber's mass that Den Hartog gives."""
    eps, damping, _, _, gamma = parameters
    d = eps * damping
    force = lambda omega: eps * gamma * (mp.sqrt(1 + (d * omega) ** 2) if base else ONE)
    bare = lambda omega: force(omega) / mp.sqrt((1 - omega**2) ** 2 + (d * omega) ** 2)
    total = 1 + eps
    tuning, zeta = 1 / total, mp.sqrt(3 * eps / (8 * total))

    def tuned(omega, tuning=tuning):
        c = mp.mpc(tuning**2, 2 * zeta * tuning * omega)
        # (1 - w^2 + i d w + mu c) x - mu c y = f, -c x + (c - w^2) y = 0
        matrix = [[mp.mpc(1 - omega**2, d * omega) + eps * c, -eps * c], [-c, c - omega**2]]
        det = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0]
        return force(omega) * abs(matrix[1][1] / det)

    # Resonances are as wide as the square root of the mass ratio, or the damping.
    close = [mp.mpf(10) ** (-mp.mpf(k) / 10) for k in range(5, 160)]
    places = sorted({mp.mpf(BAND[0]), mp.mpf(BAND[1]), ONE}
                    | {ONE + s * c for s in (1, -1) for c in close if c <= 0.3})
    def largest(f):
        values = [f(omega) for omega in places]
        best = max(values)
        if best == mp.inf:
            return best
        ratio = (mp.sqrt(5) - 1) / 2
        last = len(places) - 1
        for k in range(last + 1):
            below, above = max(k - 1, 0), min(k + 1, last)
            # The two peaks of a damper are almost equal.
            if values[k] < max(values[below], values[above]) or values[k] < best * mp.mpf("0.99"):
                continue
            low, high = places[below], places[above]
            for _ in range(110):
                a, b = high - ratio * (high - low), low + ratio * (high - low)
                if f(a) > f(b):
                    high = b
                else:
                    low = a
            best = max(best, f((low + high) / 2))
        return best
    # What rounding of the tuning changes.
    damped, rounded = largest(tuned), largest(lambda omega: tuned(omega, tuning * (1 + ULP)))
    found = {"damped": (damped, abs(rounded - damped))}
    if damping > 0:
        found["bare"] = largest(bare)
    return found


# --- What is not steady ----------------------------------------------------------------------------------------------


def poles(loss):
    """x'' + loss x' + x = 0 has exp(p t); a double pole is parted by less than anybody sees."""
    loss = loss + mp.mpf(10) ** -18 if loss == 2 else loss
    root = mp.sqrt(mp.mpc(loss * loss / 4 - 1))
    return -loss / 2 + root, -loss / 2 - root


def largest(at, ends):
    """The largest |x| of a motion t -> (x, x') in [0, last], from places that are close, then where x' vanishes."""
    best = max(abs(at(t)[0]) for t in (ends[0], ends[-1]))
    for a, b in zip(ends, ends[1:]):
        low, high = at(a)[1], at(b)[1]
        best = max(best, abs(at(b)[0]))
        if low * high < 0:
            for _ in range(200):
                middle = (a + b) / 2
                if low * at(middle)[1] < 0:
                    b = middle
                else:
                    a = middle
            best = max(best, abs(at((a + b) / 2)[0]))
    return best


def release(parameters, base, rounded=(0, 0, 0)):
    """The first impacts of a structure that is let go at 1.5 clearances, the absorber at rest at w = 0.25, within 600 of
    fast time; displacement, velocity and wall at impacts may be off by so many units in the last place."""
    eps, damping, restitution = parameters[:3]
    p, q = poles(eps * damping)
    x, v, y, u, t = mp.mpf("1.5"), mp.mpf(0), mp.mpf("1.25"), mp.mpf(0), mp.mpf(0)
    found = {}
    for k in range(4 if restitution >= mp.mpf("0.01") else 1):
        a, b = (v - q * x) / (p - q), (p * x - v) / (p - q)
        def gap(s):
            return mp.re(a * mp.exp(p * s) + b * mp.exp(q * s)) - y - u * s
        def speed(s):
            return mp.re(a * p * mp.exp(p * s) + b * q * mp.exp(q * s))
        # Steps that grow where nothing swings.
        step, before = mp.mpf("0.02"), mp.mpf(10) ** -12
        while abs(gap(before + step)) < 1 and t + before < 600:
            before += step
            if abs(p.imag) < mp.mpf(10) ** -20:
                step = max(step, before / 50)
        low, high = before, before + step
        for _ in range(300):
            middle = (low + high) / 2
            if abs(gap(middle)) < 1:
                low = middle
            else:
                high = middle
        s = (low + high) / 2
        side = mp.sign(gap(s))
        x, v, t = gap(s) + y + u * s, speed(s), t + s
        if t > 600:
            break
        x, v = x * (1 + rounded[0] * ULP), v * (1 + rounded[1] * ULP)
        y = x - side * (1 - rounded[2] * ULP)
        found[f"time{k + 1}"], found[f"speed{k + 1}"] = t, abs(v - u)
        mean = (v + eps * u) / (1 + eps)
        relative = restitution * (v - u)
        v, u = mean - relative * eps / (1 + eps), mean + relative / (1 + eps)
    return found


LINES = [(0, 0), (1, "0.2"), (3, "-0.3"), (4, "0.1"), (9, "0.1"), (12, "0")]


def record(parameters, base):
    """The largest displacement under a force in straight lines, without absorber."""
    eps, damping = parameters[:2]
    loss = eps * damping
    p, q = poles(loss)
    x, v, best = mp.mpf(0), mp.mpf(0), mp.mpf(0)
    for (t0, f0), (t1, f1) in zip(LINES, LINES[1:]):
        h = mp.mpf(t1 - t0)
        c0, c1 = mp.mpf(f0), (mp.mpf(f1) - mp.mpf(f0)) / h
        level = c0 - loss * c1
        a, b = (v - c1 - q * (x - level)) / (p - q), (p * (x - level) - (v - c1)) / (p - q)
        def at(s):
            e, f = a * mp.exp(p * s), b * mp.exp(q * s)
            return mp.re(e + f) + level + c1 * s, mp.re(p * e + q * f) + c1
        best = max(best, largest(at, [h * k / 60 for k in range(61)]))
        x, v = at(h)
    return {"alone": best, "flown": best}


SWEEP = (mp.mpf("0.7"), mp.mpf("1.3"), mp.mpf("0.0038"))  # from, to, rate: 4.9 % a period at the beginning
GAUSS = None


def legendre(n, z):
    """A node of Gauss's rule, by Newton's method, and its weight."""
    for _ in range(12):
        before, now = ONE, z
        for k in range(2, n + 1):
            before, now = now, ((2 * k - 1) * z * now - (k - 1) * before) / k
        slope = n * (z * now - before) / (z * z - 1)
        z -= now / slope
    return z, 2 / ((1 - z * z) * slope**2)


def sweep(parameters, base):
    """The largest displacement without absorber in a sweep, over its whole periods, by Duhamel's integral with Gauss's
    rule of 24 points over a sixteenth of a period."""
    global GAUSS
    with mp.workdps(22):
        if GAUSS is None:
            GAUSS = [legendre(24, mp.cos(mp.pi * (k + mp.mpf("0.75")) / (24 + HALF))) for k in range(24)]
        eps, damping, forcing = parameters[0], parameters[1], parameters[4]
        loss, size = eps * damping, eps * forcing
        start, end, rate = SWEEP
        p, q = poles(loss)
        periods = int(mp.floor((end * end - start * start) / (2 * rate) / (2 * mp.pi)))
        last = 2 * 2 * mp.pi * periods / (start + mp.sqrt(start * start + 4 * mp.pi * rate * periods))
        def force(t):
            phase, omega = start * t + rate * t * t / 2, start + rate * t
            return size * (mp.sin(phase) + loss * omega * mp.cos(phase))
        # Even steps, over each of which a fast pole is resolved or has decayed: it follows the force.
        steps = 16 * periods
        h = last / steps
        stiff = abs(q) * h > 30
        za, zb, best, before = mp.mpc(0), mp.mpc(0), mp.mpf(0), mp.mpf(0)
        def state(a, b):
            return mp.re((a - b) / (p - q)), mp.re((p * a - q * b) / (p - q))
        def onward(t, a, b, h):
            times = [(t + h * (1 + z) / 2, w * h / 2) for z, w in GAUSS]
            a = a * mp.exp(p * h) + sum(w * force(s) * mp.exp(p * (t + h - s)) for s, w in times)
            if stiff:
                # The series of the force at t + h: f/(-q) - f'/q^2 ... to the second derivative.
                d = h / 1000
                f = [force(t + h + k * d) for k in (-1, 0, 1)]
                b = -f[1] / q - (f[2] - f[0]) / (2 * d) / q**2 - (f[2] - 2 * f[1] + f[0]) / d**2 / q**3
            else:
                b = b * mp.exp(q * h) + sum(w * force(s) * mp.exp(q * (t + h - s)) for s, w in times)
            return a, b
        for k in range(steps):
            t = k * h
            na, nb = onward(t, za, zb, h)
            (x0, v0), (x1, v1) = state(za, zb), state(na, nb)
            best = max(best, abs(x1))
            if v0 * v1 < 0:
                low, high = mp.mpf(0), h
                for _ in range(45):
                    middle = (low + high) / 2
                    if v0 * state(*onward(t, za, zb, middle))[1] < 0:
                        high = middle
                    else:
                        low = middle
                best = max(best, abs(state(*onward(t, za, zb, (low + high) / 2))[0]))
            za, zb = na, nb
    return {"alone": best, "flown": best}


# --- Held to what is known -------------------------------------------------------------------------------------------


def own_checks():
    """The impact pair breaks its symmetry where its half-period map has the multiplier -1; published numbers of Table 1."""
    for restitution in (mp.mpf("0.2"), mp.mpf("0.6"), mp.mpf("0.9")):
        slow = Slow(mp.mpf("0.01"), ONE, restitution, ONE, ONE)
        cosine, sine, square, _ = slow.sides(BREAKING)
        c, theta = mp.sqrt(square), mp.atan2(sine, cosine)
        # The impact on +b is where w0 = 1: C sin(t + ...) with the sawtooth at its top, t = pi/2 + Theta before.
        phase = mp.pi / 2 - theta  # x = C sin(phase) = 1 - B
        u = 2 * BREAKING / mp.pi
        def mapped(p, u):
            s = mp.pi
            for _ in range(8):
                w = c * mp.sin(p + s) - (c * mp.sin(p) - 1 + u * s) + 1
                s -= w / (c * mp.cos(p + s) - u)
            v = c * mp.cos(p + s)
            return p + s, (1 + restitution) * v - restitution * u
        d = [[(mapped(phase + a * STEP, u + b * STEP)[k] - mapped(phase - a * STEP, u - b * STEP)[k]) / (2 * STEP)
              for k in (0, 1)] for a, b in ((1, 0), (0, 1))]
        j = mp.matrix([[d[0][0], d[1][0]], [-d[0][1], -d[1][1]]])
        assert abs(mp.det(j + mp.eye(2))) < mp.mpf(10) ** -20, mp.det(j + mp.eye(2))
    at = [mp.mpf(TABLE[name]) for name in ORDER]
    found = theory(at)
    assert abs(found["P1-sigma"] + mp.mpf("0.70958")) < 1e-5 and abs(found["P1-gamma"] - mp.mpf("1.11876")) < 1e-5
    forcing = mp.mpf(TABLE["forcing"]) * mp.mpf("7.5")
    assert abs(forcing / found["breaking"] - mp.mpf("4.687")) < 1e-3
    assert abs(forcing / found["hopf"] - mp.mpf("15.346")) < 1e-3
    exact = orbits(at, True)
    assert abs(abs(mp.mpf("7.5") * (1 - exact["beta2"])) - mp.mpf("3.110")) < 1e-3, exact
    assert abs(exact["radius2"] - mp.mpf("0.9726")) < 1e-4, exact
    ends = limits(at, True)
    assert abs(forcing / ends["end2"] - mp.mpf("4.846")) < 1e-3 and abs(forcing / ends["end1"] - mp.mpf("16.695")) < 1e-3, ends


LAYERS = {
    "theory": lambda p, base: theory(p),
    "band": lambda p, base: bands(p),
    "decay": lambda p, base: decay(p),
    "orbits": orbits,
    "limits": limits,
    "damper": damper,
    "release": release,
    "sweep": sweep,
    "record": record,
}
# What a layer says of itself that its values are off by, relatively, beyond rounding: the phase of a sweep within a
# stretch, cubics between the ends of a record's pieces.
STATED = {"sweep": 2e-4, "record": 5e-6}


# What a layer's values do not depend on.
IGNORED = {"limits": ["forcing"], "decay": ["mass-ratio", "frequency", "forcing"], "damper": ["restitution", "frequency"],
           "release": ["frequency", "forcing"], "sweep": ["restitution", "frequency", "forcing"],
           "record": ["restitution", "frequency", "forcing"]}


def row(layer, varied):
    numbers = {**TABLE, **varied}
    exact = [mp.mpf(numbers[name]) for name in ORDER]
    def ask(at):
        found = LAYERS[layer](at, True)
        return {name: value if isinstance(value, tuple) else (value, 0) for name, value in found.items()}
    found = ask(exact)
    cost = {name: 2 * own for name, (_, own) in found.items()}
    found = {name: value for name, (value, _) in found.items()}
    complete = True
    for k in range(len(exact)):
        moved = list(exact)
        moved[k] *= 1 + ULP if exact[k] < 1 or ORDER[k] != "restitution" else 1 - ULP
        # What rounding changes is nothing beside what a sweep states.
        if moved[k] == exact[k] or ORDER[k] in IGNORED.get(layer, ()) or layer == "sweep":
            continue
        there = {name: value for name, (value, _) in ask(moved).items()}
        complete = complete and there.keys() == found.keys()
        for name in found:
            if name in there:
                cost[name] += abs(there[name] - found[name])
    if layer == "release":
        for rounded in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
            there = release(exact, True, rounded)
            for name in found.keys() & there.keys():
                cost[name] += abs(there[name] - found[name])
    return {
        "layer": layer,
        "varied": [[name, value] for name, value in varied.items()],
        "parameters": [numbers[name] for name in ORDER],
        # Whether all of it is there as well where a parameter is rounded.
        "settled": complete,
        "stated": STATED.get(layer, 0.0),
        "values": {name: [float(value), float(cost[name])] for name, value in found.items()},
    }


if __name__ == "__main__":
    if not sys.argv[1:]:
        own_checks()
    wanted = sys.argv[1:] or list(LAYERS)
    rows = []
    for layer in wanted:
        for varied in systems():
            if varied and set(varied) <= set(IGNORED.get(layer, ())):
                continue
            rows.append(row(layer, varied))
            print(layer, varied, file=sys.stderr)
    print("[\n" + ",\n".join(json.dumps(one) for one in rows) + "\n]")
