#!/usr/bin/env python3
"""Holds what `vinesink optimize` promises of random structures of several modes against `simulate.c`: with the absorbers that it
writes no start at any of many frequencies may move a place farther than the limit that they are said to meet.

    python3 peers/modal/better.py target/release/vinesink [FIRST [LAST]]

Each number is a design of `cover.py`, whose absorbers miss a limit by up to a third. Needs a C compiler; prints a line for
each design, and those that do not keep their word."""

import json
import pathlib
import random
import subprocess
import sys
import tempfile
import tomllib

import cover

# Of what the case's own absorbers come to.
ASKED = [0.75, 0.98]


def asked(text, limit):
    """A case with one limit, of any place."""
    return text[: text.index("[criteria]")] + f"[criteria]\npeak_displacement = '<= {limit!r} m'\n[optimize]\nrestitution = [0.1, 0.8]\n"


def main():
    vinesink, *bounds = sys.argv[1:]
    first = int(bounds[0]) if bounds else 0
    last = int(bounds[1]) if bounds[1:] else first + 19
    met = broken = 0
    with tempfile.TemporaryDirectory() as folder:
        program, case, better = cover.compiled(folder), pathlib.Path(folder, "case.toml"), pathlib.Path(folder, "better.toml")
        told = lambda *all: json.loads(subprocess.run([vinesink, *all, "--format", "json", "--long"], capture_output=True, text=True).stdout)
        for number in range(first, last + 1):
            modes, bodies, loads = cover.design(number)
            text = cover.text(modes, bodies, loads)
            case.write_text(asked(text, 1e3))
            (own,) = told("check", str(case), "--criteria-only")["cases"][0]["criteria"]
            limit = random.Random(number).uniform(*ASKED) * own["found"]
            case.write_text(asked(text, limit))
            better.unlink(missing_ok=True)
            found = told("optimize", str(case), "--write", str(better))
            if not better.exists():
                print(f"{number}: {found['answer']} for {1e3 * limit:.4g} mm", flush=True)
                continue
            written = [{**one, "clearance": metres(new["clearance"]), "restitution": new["restitution"]} for one, new in zip(bodies, tomllib.loads(better.read_text())["absorber"])]
            reaches, _ = cover.independently(program, modes, written, loads)
            claimed = found["best"][0]["criteria"]["all"][0]["found"]
            worst = max(reaches)
            over = worst > limit * (1 + 1e-9)
            met, broken = met + 1, broken + over
            beside = f"claimed {1e3 * claimed['value']:.4g} (+{1e3 * claimed['error']:.2g}) mm"
            print(f"{number}: asked {1e3 * limit:.4g} mm, {beside}, independently {1e3 * worst:.4g} mm{' BROKEN' if over else ''}", flush=True)
    print(f"{met} said to meet their limit, {broken} do not")


def metres(text):
    value, unit = text.split()
    return float(value) * {"m": 1.0, "mm": 1e-3, "um": 1e-6}[unit]


if __name__ == "__main__":
    main()
