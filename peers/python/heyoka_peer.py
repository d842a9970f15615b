"""heyoka's adaptive Taylor method with a terminal event for each wall. Argument: the tolerance.

The integrator is compiled; what happens at an impact is a Python function of a dozen operations.
"""

import time

BEGAN = time.perf_counter()

import sys

import heyoka as hy

from peer import serve

TOLERANCE = float(sys.argv[1])


def prepare(system):
    x, v, y, u = hy.make_vars("x", "v", "y", "u")
    phase = system.frequency * hy.time
    force = system.sine * hy.sin(phase) + system.cosine * hy.cos(phase)
    hits = []
    rebound = system.rebound

    def struck(side):
        def at_wall(integrator, direction):
            s = integrator.state
            after_v, after_u = rebound(s[1], s[3])
            s[1], s[2], s[3] = after_v, s[0] - side, after_u
            hits.append((integrator.time, side, s[0], after_v, after_u))
            return True

        return at_wall

    directions = hy.event_direction
    integrator = hy.taylor_adaptive(
        [(x, v), (v, force - system.mass_ratio * system.damping * v - x), (y, u), (u, 0.0 * x)],
        list(system.start),
        tol=TOLERANCE,
        t_events=[
            hy.t_event(x - y - 1.0, callback=struck(1.0), direction=directions.positive),
            hy.t_event(x - y + 1.0, callback=struck(-1.0), direction=directions.negative),
        ],
    )

    def run(periods):
        integrator.time = 0.0
        integrator.state[:] = system.start
        integrator.reset_cooldowns()
        hits.clear()
        outcome = integrator.propagate_until(system.end(periods))[0]
        if outcome != hy.taylor_outcome.time_limit:
            raise RuntimeError(str(outcome))
        return list(hits)

    return run


serve(f"heyoka {hy.__version__} Taylor, {TOLERANCE:.0e}", BEGAN, prepare)
