"""The classical Runge-Kutta method with fixed steps and bisection, compiled by numba. Argument: steps
per period."""

import time

BEGAN = time.perf_counter()

import math
import sys

import numba
import numpy as np
from numba import njit

from peer import serve

STEPS = int(sys.argv[1])
HALVINGS = 50


@njit(inline="always")
def acceleration(p, t, x, v):
    _, _, frequency, damping, sine, cosine = p
    phase = frequency * t
    return sine * math.sin(phase) + cosine * math.cos(phase) - damping * v - x


@njit
def step(p, t, s, h):
    x, v, y, u = s
    half = 0.5 * h
    a1 = acceleration(p, t, x, v)
    v2 = v + half * a1
    a2 = acceleration(p, t + half, x + half * v, v2)
    v3 = v + half * a2
    a3 = acceleration(p, t + half, x + half * v2, v3)
    v4 = v + h * a3
    a4 = acceleration(p, t + h, x + h * v3, v4)
    return (
        x + h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4),
        v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4),
        y + u * h,
        u,
    )


@njit
def simulate(p, s, h, count, hits):
    mass_ratio, restitution = p[0], p[1]
    impacts = 0
    for k in range(count):
        t, left = k * h, h
        while True:
            x, v, y, u = after_step = step(p, t, s, left)
            gap = x - y
            if abs(gap) <= 1.0 or gap * (v - u) <= 0.0:
                s = after_step
                break
            before, after = 0.0, left
            for _ in range(HALVINGS):
                middle = 0.5 * (before + after)
                x, v, y, u = step(p, t, s, middle)
                if abs(x - y) > 1.0:
                    after = middle
                else:
                    before = middle
            x, v, y, u = step(p, t, s, after)
            side = 1.0 if x > y else -1.0
            exchanged = (1.0 + restitution) * (v - u) / (1.0 + mass_ratio)
            v, u = v - mass_ratio * exchanged, u + exchanged
            s = (x, v, x - side, u)
            t, left = t + after, left - after
            hits[impacts, 0] = t
            hits[impacts, 1] = side
            hits[impacts, 2] = x
            hits[impacts, 3] = v
            hits[impacts, 4] = u
            impacts += 1
    return impacts


def prepare(system):
    damping = system.mass_ratio * system.damping
    p = (
        system.mass_ratio, system.restitution, system.frequency, damping, system.sine,
        system.cosine,
    )

    def run(periods):
        # Room for one impact in twenty steps, far more than happen.
        hits = np.empty((periods * STEPS // 20 + 10, 5))
        count = simulate(p, system.start, system.end(1) / STEPS, periods * STEPS, hits)
        return hits[:count]

    return run


serve(f"numba {numba.__version__}, RK4 with bisection, T/{STEPS}", BEGAN, prepare)
