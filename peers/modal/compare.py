#!/usr/bin/env python3
"""Compares the motions of cases of several modes and absorbers with those of `simulate.c`, at the frequency where each load is
worst: the largest of the worst place and its root mean square, from several starts; of its displacement, and of its velocity and
acceleration where criteria ask for these.

    python3 peers/modal/compare.py target/release/vinesink cases/several/*.toml

Needs a C compiler; prints a table in Markdown."""

import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

UNITS = {"Hz": 1.0, "kg": 1.0, "g": 1e-3, "t": 1e3, "m": 1.0, "mm": 1e-3, "um": 1e-6, "N": 1.0, "kN": 1e3, "%": 1e-2}
STARTS, OUT, MEASURED = 4, 8, 1500
# What is compared: its name, where `simulate.c` prints it, and in which unit.
READINGS = [("displacement", 0, "mm"), ("velocity", 2, "mm/s"), ("acceleration", 4, "mm/s2")]


def number(value):
    """A quantity as a number in SI units."""
    if not isinstance(value, str):
        return float(value)
    size, unit = value.split()
    return float(size) * UNITS[unit]


def listed(value):
    return value if isinstance(value, list) else [value]


def simulated(program, case, load, place, frequency, seed):
    modes, absorbers = listed(case["mode"]), listed(case["absorber"])
    only = next(iter(modes[0]["shape"]))
    numbers = [len(modes), len(absorbers)]
    base = number(load["amplitude"]) if load["kind"] == "base-displacement" else 0.0
    for k, mode in enumerate(modes, 1):
        force = 0.0 if base else number(load["amplitude"])
        force *= (load["mode"] == k) if "mode" in load else mode["shape"][load.get("place", only)]
        numbers += [number(mode[key]) for key in ("frequency", "damping_ratio", "mass")]
        numbers += [force, float(mode.get("participation", 0)), mode["shape"][place]] + [mode["shape"][one.get("place", only)] for one in absorbers]
    for one in absorbers:
        numbers += [number(one[key]) for key in ("mass", "clearance", "restitution")]
    slowest = min(number(mode["damping_ratio"]) * number(mode["frequency"]) for mode in modes)
    out = max(OUT * frequency / (2 * 3.141592653589793 * slowest), 256)
    numbers += [frequency, base, seed, round(out), MEASURED]
    run = subprocess.run([program], input=" ".join(map(repr, numbers)), capture_output=True, text=True, check=True)
    return [float(one) for one in run.stdout.split()]


def main():
    vinesink, *paths = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        program = str(pathlib.Path(folder, "simulate"))
        source = str(pathlib.Path(__file__).with_name("simulate.c"))
        subprocess.run(["cc", "-O2", "-o", program, source, "-lm"], check=True)
        print("| case | load | at | place | of its | largest | independently | rms | independently |")
        print("| --- | ---: | ---: | --- | --- | ---: | ---: | ---: | ---: |")
        for path in paths:
            case = tomllib.loads(pathlib.Path(path).read_text())
            run = subprocess.run([vinesink, "simulate", path, "--format", "json"], capture_output=True, text=True)
            answer = json.loads(run.stdout)
            for k, (load, found) in enumerate(zip(listed(case["excitation"]), answer["loads"]), 1):
                worst = found["worst"]
                place, frequency = worst["place"], worst["at"]["value"]
                p = answer["places_of_shapes"].index(place)
                motions = [one["places"][p] for one in found["at_worst"] if one["kind"] != "rest"]
                other = [simulated(program, case, load, place, frequency, seed) for seed in range(1, STARTS + 1)]
                for name, column, unit in READINGS:
                    read = [one if name == "displacement" else one.get(name) for one in motions]
                    if None in read:
                        continue
                    of = lambda key, form: ", ".join(form(one[key]) for one in read) + f" {unit}"
                    told = [
                        of("peak", lambda one: f"{1e3 * one['value']:.4g} (+{1e3 * one['error']:.2g})"),
                        ", ".join(f"{1e3 * one[column]:.4g}" for one in other),
                        of("rms", lambda one: f"{1e3 * one['value']:.4g} ({1e3 * one['error']:.2g})"),
                        ", ".join(f"{1e3 * one[column + 1]:.4g}" for one in other),
                    ]
                    told = [pathlib.Path(path).stem, str(k), f"{frequency:.4g} Hz", place, name, *told]
                    print(f"| {' | '.join(told)} |", flush=True)


main()
