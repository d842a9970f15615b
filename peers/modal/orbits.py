#!/usr/bin/env python3
"""Compares the impacts of exact orbits that attract with those of `simulate.c`, on random designs of several modes and absorbers,
forced in their first mode or, every second size, shaken at their base.

    python3 peers/modal/orbits.py target/release/vinesink

Needs a C compiler; prints a table in Markdown. Ends with 1 where an impact is 1e-9 of a period, or of its speed, off."""

import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

SIZES = [(1, 2), (1, 3), (2, 1), (2, 2), (2, 3), (3, 1), (3, 2), (4, 2), (5, 1), (8, 2)]
SEEDS, DESIGNS, BOUND = 12, 400, 1e-9


def design(noise, modes, absorbers, base):
    """A structure in SI units, forced in its first mode near its resonance, or shaken so that this has the same force."""
    frequency = 10.0
    case = {"modes": [], "absorbers": [], "at": frequency * noise.uniform(0.985, 1.015), "force": noise.uniform(20, 60), "base": 0.0}
    for k in range(modes):
        shape = [1.0 if k == 0 else noise.uniform(-1, 1) for _ in range(absorbers)]
        takes_part = (1.0 if k == 0 else noise.uniform(-1, 1)) if base else 0.0
        case["modes"].append((frequency, noise.uniform(0.005, 0.02), noise.uniform(80, 120), takes_part, shape))
        frequency *= noise.uniform(1.3, 2.7)
    if base:
        case["base"] = case["force"] / (100 * (2 * math.pi * 10) ** 2)
        case["force"] = 0.0
    clearance = noise.uniform(0.002, 0.03)
    for _ in range(absorbers):
        own = clearance * noise.uniform(0.6, 1.6)
        case["absorbers"].append((noise.uniform(0.5, 2.5), own, noise.uniform(0.4, 0.7)))
    return case


def text(case):
    """Its case file."""
    lines = ['title = "random"', 'source = "peers/modal/orbits.py"']
    for frequency, damping, mass, takes_part, shape in case["modes"]:
        values = ", ".join(f"p{j} = {value!r}" for j, value in enumerate(shape))
        lines += ["[[mode]]", f'frequency = "{frequency!r} Hz"', f"damping_ratio = {damping!r}", f'mass = "{mass!r} kg"']
        lines += [f"participation = {takes_part!r}", f"shape = {{ {values} }}"]
    for j, (mass, clearance, restitution) in enumerate(case["absorbers"]):
        lines += ["[[absorber]]", f'place = "p{j}"', f'mass = "{mass!r} kg"', f'clearance = "{clearance!r} m"']
        lines += [f"restitution = {restitution!r}"]
    if case["base"]:
        lines += ["[[excitation]]", 'kind = "base-displacement"', f'amplitude = "{case["base"]!r} m"']
    else:
        lines += ["[[excitation]]", 'kind = "force"', "mode = 1", f'amplitude = "{case["force"]!r} N"']
    return "\n".join([*lines, f'frequency = "{case["at"]!r} Hz"', ""])


def simulated(program, case, out, seed):
    """Impacts of each absorber in a period, and phase and speed of the last."""
    numbers = [len(case["modes"]), len(case["absorbers"])]
    for k, (frequency, damping, mass, takes_part, shape) in enumerate(case["modes"]):
        numbers += [frequency, damping, mass, case["force"] if k == 0 else 0.0, takes_part, shape[0], *shape]
    for absorber in case["absorbers"]:
        numbers += absorber
    numbers += [case["at"], case["base"], seed, out, 64]
    run = subprocess.run([program], input=" ".join(map(repr, numbers)), capture_output=True, text=True, check=True)
    found = [float(one) for one in run.stdout.split()][7:]
    count = len(case["absorbers"])
    return found[:count], found[count::2], found[count + 1 :: 2]


def compared(program, case, orbit):
    """The largest difference of phases and of speeds; None where no start leads to the orbit."""
    slowest = min(damping * frequency for frequency, damping, *_ in case["modes"])
    faded = 30 * case["at"] / (2 * math.pi * slowest)
    out = math.ceil(max(faded, -40 / math.log(orbit["largest_multiplier"]), 256))
    for seed in range(SEEDS):
        counts, phases, speeds = simulated(program, case, out, seed)
        # Half a period apart an impact is on the other wall.
        expected = [time * case["at"] for time in orbit["impact_times"]]
        apart = [abs((a - b + 0.25) % 0.5 - 0.25) for a, b in zip(phases, expected)]
        if counts == [2.0] * len(counts) and max(apart) < 1e-3:
            relative = [abs(a / b - 1) for a, b in zip(speeds, orbit["impact_speeds"])]
            return max(apart), max(relative)
    return None


def main():
    vinesink, noise, worst = sys.argv[1], random.Random(5), 0.0
    with tempfile.TemporaryDirectory() as folder:
        program, path = str(pathlib.Path(folder, "simulate")), pathlib.Path(folder, "case.toml")
        source = str(pathlib.Path(__file__).with_name("simulate.c"))
        subprocess.run(["cc", "-O2", "-o", program, source, "-lm"], check=True)
        print("| modes, absorbers | driven by | largest multiplier | phase off, periods | speed off, relative |")
        print("| --- | --- | ---: | ---: | ---: |")
        for number, (modes, absorbers) in enumerate(SIZES):
            base = number % 2 == 0
            for _ in range(DESIGNS):
                case = design(noise, modes, absorbers, base)
                path.write_text(text(case))
                run = subprocess.run([vinesink, "analyze", path, "--format", "json"], capture_output=True, text=True, check=True)
                orbits = json.loads(run.stdout)["orbits"]
                orbit = next((one for one in orbits if one["stable"] and one["admissible"]), None)
                # One that attracts slowly takes too long.
                found = orbit and orbit["largest_multiplier"] < 0.99 and compared(program, case, orbit)
                if found:
                    print(f"| {modes}, {absorbers} | {'the base' if base else 'a force'} | {orbit['largest_multiplier']:.3f} | {found[0]:.1e} | {found[1]:.1e} |", flush=True)
                    worst = max(worst, *found)
                    break
            else:
                print(f"| {modes}, {absorbers} | none found | | | |")
                worst = math.inf
    sys.exit(worst > BOUND)


if __name__ == "__main__":
    main()
