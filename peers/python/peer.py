"""The conversation of a tool in Python with the table: see src/script.rs.

A tool gives `prepare(system)`, which may compile, and returns a function of the number of periods.
That function returns the impacts as a list of (time, side, x, x', y'), the velocities afterwards.
Time is taken inside.
"""

import math
import sys
import time
from typing import NamedTuple


class System(NamedTuple):
    mass_ratio: float
    damping: float
    restitution: float
    frequency: float
    sine: float
    cosine: float
    start: tuple

    def rebound(self, v, u):
        """Equation (2): velocities of oscillator and absorber after an impact."""
        exchanged = (1.0 + self.restitution) * (v - u) / (1.0 + self.mass_ratio)
        return v - self.mass_ratio * exchanged, u + exchanged

    def end(self, periods):
        return periods * 2.0 * math.pi / self.frequency


# Any system will do to have everything imported, compiled and run once before the clock counts.
REHEARSAL = System(0.01, 1.5, 0.5, 1.0, 0.05, 0.001, (0.0, 0.5, 0.0, 0.5))


def serve(name, began, prepare):
    """Answers requests; `began` is the time before the first import."""
    prepare(REHEARSAL)(3)
    print(f"ready {time.perf_counter() - began!r} {name}", flush=True)
    prepared = {}
    for line in sys.stdin:
        what, *numbers, periods = line.split()
        *numbers, x, v, y, u = map(float, numbers)
        system = System(*numbers, (x, v, y, u))
        if system not in prepared:
            prepared[system] = prepare(system)
        # What this process spends: see timed() in src/lib.rs.
        begin = time.process_time()
        hits = prepared[system](int(periods))
        took = time.process_time() - begin
        if what == "hits":
            for hit in hits:
                print(*map(repr, map(float, hit)))
        print(f"done {took!r} {len(hits)}", flush=True)
