"""Compares an integrator with events, SciPy's, with vinesink: impact times, an exact orbit, its multipliers.

python3 examples/your_code.py CASE.toml PERIODS
"""

import csv
import json
import subprocess
import sys
import tempfile
from math import cos, pi, sin

import numpy as np
from scipy.integrate import solve_ivp


def vinesink(*arguments: str) -> str:
    return subprocess.run(["vinesink", *arguments], check=True, stdout=subprocess.PIPE, text=True).stdout


case = sys.argv[1]
theirs = json.loads(vinesink("analyze", case, "--format", "json"))
eps, lam, r, omega, gamma = (
    theirs["reduced"][key] for key in ("mass_ratio", "damping", "restitution", "frequency_ratio", "forcing_over_clearance")
)
moving = theirs["reduced"]["excitation"] == "base-displacement"  # then the damper transmits it too


def motion(tau, s):  # s is x, x', y, y'; lengths over the clearance, time over 1/omega_0
    base = eps * gamma * sin(omega * tau) + moving * eps**2 * lam * omega * gamma * cos(omega * tau)
    return [s[1], base - s[0] - eps * lam * s[1], s[3], 0.0]


def wall(tau, s):  # rises through 0 where the absorber comes to either wall
    return (s[0] - s[2]) ** 2 - 1


wall.terminal, wall.direction = True, 1


def flight(tau, s, end):
    """The next impact, with the state after it; None where there is none."""
    run = solve_ivp(motion, (tau, end), s, "DOP853", events=wall, rtol=1e-12, atol=1e-14, max_step=0.1)
    if not run.t_events[0].size:
        return None
    x, v, y, u = run.y_events[0][0]
    after, momentum = -r * (v - u), v + eps * u
    return run.t_events[0][0], np.array([x, (momentum + eps * after) / (1 + eps), y, (momentum - after) / (1 + eps)])


# 1. Impact times of one start, from phase 0.
periods = int(sys.argv[2])
with tempfile.NamedTemporaryFile("r", suffix=".csv") as impacts:
    run = ("--initial", "0,0,0,1", "--discard", "0", "--periods", str(periods), "--impacts", impacts.name)
    vinesink("simulate", case, *run)
    expected = np.array([float(row["tau"]) for row in csv.DictReader(open(impacts.name))])
state, times = (0.0, np.array([0.0, 0.0, 0.0, 1.0])), []
while (state := flight(*state, periods * 2 * pi / omega)) is not None:
    times.append(state[0])
assert len(times) == len(expected), f"{len(times)} impacts instead of {len(expected)}"
late = abs(np.array(times) - expected).max()
print(f"{len(times)} impact times of {periods} periods: largest difference {late:.0e}")

# 2. The stable exact orbit: half a period later the mirrored state, with the next impact on the other wall.
if not any(orbit["stable"] for orbit in theirs["orbits"]):
    sys.exit("no symmetric orbit is stable")
place = next(place for place, orbit in enumerate(theirs["orbits"]) if orbit["stable"])
impact = theirs["exact"]["orbits"][place]["orbit"]["cycle"]["impacts"][0]
sign = 1.0 if impact["wall"] == "+" else -1.0
start = np.array([impact["phase"] / omega, impact["x"], impact["x_velocity"], impact["y_velocity"]])


def half(p):  # from after one impact to after the next, mirrored; p is tau, x, x', y'
    tau, s = flight(p[0], [p[1], p[2], p[1] - sign, p[3]], p[0] + 10)
    return np.array([tau - pi / omega, -s[0], -s[1], -s[3]])


closed = abs(half(start) - start).max()
print(f"exact orbit: differs from itself half a period later by {closed:.0e}")

# 3. Its multipliers: eigenvalues of the derivative of that map, by central differences.
step = 1e-5
jacobian = np.column_stack([(half(start + step * e) - half(start - step * e)) / (2 * step) for e in np.eye(4)])
found = np.sort_complex(np.linalg.eigvals(jacobian))
given = np.sort_complex([complex(*value) for value in theirs["orbits"][place]["multipliers"]])
off = abs(found - given).max()
print(f"multipliers: largest modulus {abs(found).max():.6f}, largest difference {off:.0e}")

# What SciPy's tolerance leaves after 30 impacts; of a flight; of a difference quotient with this step.
sys.exit(not (late < 1e-7 and closed < 1e-9 and off < 1e-5))
