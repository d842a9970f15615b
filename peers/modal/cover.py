#!/usr/bin/env python3
"""Holds what `vinesink simulate` says of random structures of several modes against `simulate.c`: under each load no start at any
of many frequencies may move a place farther, or faster, or accelerate it more, than the largest value with its error.

    python3 peers/modal/cover.py target/release/vinesink [FIRST [LAST]]

Each number is a design: one to four modes, one to three absorbers, one or two loads in a mode or at a place. Starts are drawn, and
for each set of absorbers there are some in which these rest anywhere in their cavities while the others impact. Needs a C compiler;
prints a line for each load, with a word where one is exceeded, or where the error alone covers it."""

import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

FREQUENCIES, STARTS, OUT, MEASURED = 24, 2, 8, 600
READINGS = [(None, "peak", "<= 1 km", 0), ("velocity", "peak_velocity", "<= 1 km/s", 2), ("acceleration", "acceleration", "<= 9e9 m/s2", 4)]


def design(number):
    """A structure, as numbers in SI units."""
    draw = random.Random(number)
    log = lambda low, high: low * (high / low) ** draw.random()
    count, absorbers, places = draw.choice([1, 2, 2, 3, 4]), draw.choice([1, 2, 2, 3]), 2
    first, modes = log(0.5, 50), []
    for k in range(count):
        frequency = first if k == 0 else modes[-1]["frequency"] * log(1.3, 5)
        shape = [draw.uniform(-1, 1) for _ in range(places)]
        largest = max(range(places), key=lambda p: abs(shape[p]))
        shape = [value / abs(shape[largest]) for value in shape]
        modes.append({"frequency": frequency, "damping": log(0.003, 0.03), "mass": log(10, 40), "shape": shape, "participation": draw.uniform(-1.5, 1.5)})
    loads = []
    for k in draw.sample(range(count), min(count, draw.choice([1, 2]))):
        mode = modes[k]
        # Static deflection of the mode, and where it acts.
        force = log(1e-5, 1e-3) * mode["mass"] * (2 * math.pi * mode["frequency"]) ** 2
        at = draw.choice([None, *range(places)])
        # Every third load is a base that moves: by as much as its mode is deflected.
        base = log(1e-5, 1e-3) if draw.random() < 0.33 else None
        loads.append({"mode": k, "place": at, "base": base, "amplitude": force, "range": [mode["frequency"] * log(0.85, 0.97), mode["frequency"] * log(1.03, 1.15)]})
    # Some over all modes at once.
    if draw.random() < 0.25:
        loads = [{**loads[0], "place": 0, "range": [first * 0.9, modes[-1]["frequency"] * 1.1]}]
    bodies = []
    for _ in range(absorbers):
        k = draw.choice(loads)["mode"]
        place = max(range(places), key=lambda p: abs(modes[k]["shape"][p]))
        deflected = lambda load: load["amplitude"] / modes[load["mode"]]["mass"] / (2 * math.pi * modes[load["mode"]]["frequency"]) ** 2
        static = max(load["base"] or deflected(load) for load in loads)
        bodies.append({"place": place, "mass": log(0.01, 0.1) * modes[k]["mass"], "clearance": static * log(2, 40), "restitution": draw.uniform(0.1, 0.8)})
    return modes, bodies, loads


def text(modes, bodies, loads):
    lines = ["title = 'random'", "source = 'random'"]
    for mode in modes:
        shape = ", ".join(f"p{p} = {value!r}" for p, value in enumerate(mode["shape"]))
        lines += ["[[mode]]", f"frequency = '{mode['frequency']!r} Hz'", f"damping_ratio = {mode['damping']!r}"]
        lines += [f"mass = '{mode['mass']!r} kg'", f"participation = {mode['participation']!r}", f"shape = {{ {shape} }}"]
    for one in bodies:
        lines += ["[[absorber]]", f"place = 'p{one['place']}'", f"mass = '{one['mass']!r} kg'"]
        lines += [f"clearance = '{one['clearance']!r} m'", f"restitution = {one['restitution']!r}"]
    for load in loads:
        where = f"mode = {load['mode'] + 1}" if load["place"] is None else f"place = 'p{load['place']}'"
        force = ["kind = 'force'", where, f"amplitude = '{load['amplitude']!r} N'"]
        lines += ["[[excitation]]", *(force if load["base"] is None else ["kind = 'base-displacement'", f"amplitude = '{load['base']!r} m'"])]
        lines += [f"from = '{load['range'][0]!r} Hz'", f"to = '{load['range'][1]!r} Hz'"]
    lines.append("[criteria]")
    lines += [f"{'peak_displacement' if key == 'peak' else key} = '{limit}'" for _, key, limit, _ in READINGS]
    return "\n".join(lines) + "\n"


def simulated(program, modes, bodies, load, place, frequency, seed, rest):
    numbers = [len(modes), len(bodies)]
    for k, mode in enumerate(modes):
        force = load["amplitude"] * ((k == load["mode"]) if load["place"] is None else mode["shape"][load["place"]])
        force *= load["base"] is None
        numbers += [mode["frequency"], mode["damping"], mode["mass"], force, mode["participation"], mode["shape"][place]]
        numbers += [mode["shape"][one["place"]] for one in bodies]
    for one in bodies:
        numbers += [one["mass"], one["clearance"], one["restitution"]]
    slowest = min(mode["damping"] * mode["frequency"] for mode in modes)
    out = min(max(OUT * frequency / (2 * math.pi * slowest), 256), 20000)
    numbers += [frequency, load["base"] or 0.0, seed, round(out), MEASURED, rest]
    run = subprocess.run([program], input=" ".join(map(repr, numbers)), capture_output=True, text=True, check=True)
    return [float(one) for one in run.stdout.split()][:6]


def independently(program, modes, bodies, loads):
    """The largest displacement under each load, and of each reading under all, from many starts at many frequencies."""
    reaches, most = [], {key: 0.0 for _, key, _, _ in READINGS}
    for load in loads:
        [low, high], reach = load["range"], 0.0
        # Between what the program looks at: no multiple of a twelfth; and around each mode in the range.
        along = [low + (high - low) * (step + 0.37) / FREQUENCIES for step in range(FREQUENCIES)]
        around = [mode["frequency"] * (1 + 0.013 * step) for mode in modes for step in range(-6, 7)]
        wide = len([mode for mode in modes if low < mode["frequency"] < high]) > 1
        for frequency in [*along, *(at for at in around if wide and low < at < high)]:
            # Each set of those that rest, none and some.
            for seed in range(1, STARTS + 2 ** len(bodies)):
                rest = max(0, seed - STARTS)
                for place in range(2):
                    found = simulated(program, modes, bodies, load, place, frequency, seed, rest)
                    reach = max(reach, found[0])
                    for _, key, _, column in READINGS:
                        most[key] = max(most[key], found[column])
        reaches.append(reach)
    return reaches, most


def beyond(seen, told):
    return seen > (told["found"] + told["error"]) * (1 + 1e-9)


def word(seen, told):
    """What is wrong: that the error does not cover it, or that the error alone does."""
    return " EXCEEDED" if beyond(seen, told) else " LOW" if seen > 2 * told["found"] else ""


def compiled(folder):
    """The independent simulation."""
    program = str(pathlib.Path(folder, "simulate"))
    subprocess.run(["cc", "-O2", "-o", program, str(pathlib.Path(__file__).with_name("simulate.c")), "-lm"], check=True)
    return program


def main():
    vinesink, *bounds = sys.argv[1:]
    first = int(bounds[0]) if bounds else 0
    last = int(bounds[1]) if bounds[1:] else first + 9
    exceeded = compared = 0
    with tempfile.TemporaryDirectory() as folder:
        program, case = compiled(folder), pathlib.Path(folder, "case.toml")
        for number in range(first, last + 1):
            modes, bodies, loads = design(number)
            case.write_text(text(modes, bodies, loads))
            run = subprocess.run([vinesink, "simulate", str(case), "--format", "json", "--long"], capture_output=True, text=True)
            if run.returncode != 0:
                print(f"{number}: {run.stderr.strip()}", flush=True)
                exceeded += 1
                continue
            answer = json.loads(run.stdout)
            checked = subprocess.run([vinesink, "check", str(case), "--format", "json", "--criteria-only", "--long"], capture_output=True, text=True)
            criteria = {one["name"]: one for one in json.loads(checked.stdout)["cases"][0]["criteria"]}
            reaches, most = independently(program, modes, bodies, loads)
            for k, reach in enumerate(reaches):
                told = answer["loads"][k]["worst"]
                told = {"found": told["peak"]["value"], "error": told["peak"]["error"], "at": told["at"]["value"]}
                exceeded, compared = exceeded + beyond(reach, told), compared + 1
                where = f"{told['at']:.4g} Hz"
                print(f"{number}, load {k + 1}: {1e3 * told['found']:.4g} (+{1e3 * told['error']:.2g}) mm at {where}, independently {1e3 * reach:.4g} mm{word(reach, told)}", flush=True)
            for _, key, _, _ in READINGS[1:]:
                one = criteria[key]
                exceeded, compared = exceeded + beyond(most[key], one), compared + 1
                print(f"{number}, {key}: {one['found']:.4g} (+{one['error']:.2g}), independently {most[key]:.4g}{word(most[key], one)}", flush=True)
    print(f"{compared} compared, {exceeded} exceeded")


if __name__ == "__main__":
    main()
