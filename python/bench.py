#!/usr/bin/env python3
"""What Python adds to the engine's time: `python bench.py` with the package installed, and cargo at hand.

The same work natively (`native/bench.rs`) and from Python in turns, the best of each. Prints ratios; asserts nothing.
"""

import os
import subprocess
import time
from pathlib import Path

import numpy as np
import vinesink

HERE = Path(__file__).resolve().parent
PERIODS = 500_000  # two impacts in each
SYSTEMS = 100_000
TURNS, RUNS = 5, 1

CASE = vinesink.Case(
    mass="4.168 kg", stiffness="11.47 kN/m", damping="3.02 N s/m",
    absorber_mass="32 g", clearance="7.5 mm", restitution=0.6,
    kind="base-displacement", amplitude="0.25 mm", frequency="8 Hz",
)  # fmt: skip


def native() -> list[float]:
    command = ["cargo", "run", "--quiet", "--release", "--locked", "--example", "bench", "--"]
    numbers = [CASE.text, str(PERIODS), str(SYSTEMS), str(RUNS)]
    environment = {**os.environ, "PYO3_BUILD_EXTENSION_MODULE": "1"}
    done = subprocess.run(command + numbers, cwd=HERE, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    return [float(number) for number in done.stdout.split()]


def python() -> list[float]:
    def seconds(work: object) -> float:
        begin = time.perf_counter()
        work()
        return time.perf_counter() - begin

    follow = {"initial": (0, 0, 0, 1), "discard": 0, "periods": PERIODS}
    clearance = np.linspace(2e-3, 20e-3, SYSTEMS)
    return [
        seconds(lambda: CASE.simulate(**follow, measure=False)),
        seconds(lambda: CASE.simulate(**follow)),
        seconds(lambda: vinesink.single_trajectories(CASE, clearance=clearance)),
    ]


def main() -> None:
    turns = [(native(), python()) for _ in range(TURNS)]
    impacts = turns[0][0][0]
    names = [f"{impacts:.0f} impacts", f"{impacts:.0f} impacts, measured", f"{SYSTEMS} systems"]
    for k, name in enumerate(names):
        rust = min(one[k + 1] for one, _ in turns)
        ours = min(one[k] for _, one in turns)
        print(f"{name}: native {rust:.3f} s, from Python {ours:.3f} s, {100 * (ours / rust - 1):+.1f} %")


if __name__ == "__main__":
    main()
