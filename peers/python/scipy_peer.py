"""scipy's DOP853 with terminal events, restarted after each impact. Argument: the relative
tolerance; the absolute one is a thousandth of it, as in src/diffsol.rs."""

import time

BEGAN = time.perf_counter()

import math
import sys

import scipy
from scipy.integrate import solve_ivp

from peer import serve

TOLERANCE = float(sys.argv[1])


def upper(t, s):
    return s[0] - s[2] - 1.0


def lower(t, s):
    return s[0] - s[2] + 1.0


# A direction each, so that a start on a wall, moving away from it, is no event.
upper.terminal, upper.direction = True, 1.0
lower.terminal, lower.direction = True, -1.0


def prepare(system):
    damping = system.mass_ratio * system.damping

    def rate(t, s):
        x, v, _, u = s
        phase = system.frequency * t
        force = system.sine * math.sin(phase) + system.cosine * math.cos(phase)
        return (v, force - damping * v - x, u, 0.0)

    def run(periods):
        t, s, end, hits = 0.0, system.start, system.end(periods), []
        while True:
            flight = solve_ivp(
                rate, (t, end), s, method="DOP853", rtol=TOLERANCE, atol=TOLERANCE * 1e-3,
                events=(upper, lower),
            )
            if flight.status == 0:
                return hits
            if flight.status < 0:
                raise RuntimeError(flight.message)
            side = 1.0 if len(flight.t_events[0]) else -1.0
            t = float(flight.t[-1])
            x, v, _, u = map(float, flight.y[:, -1])
            v, u = system.rebound(v, u)
            s = (x, v, x - side, u)
            hits.append((t, side, x, v, u))

    return run


serve(f"scipy {scipy.__version__} DOP853, {TOLERANCE:.0e}".replace("e-0", "e-"), BEGAN, prepare)
