#!/usr/bin/env python3
"""Twenty structures that are not driven steadily, drawn at random, beside transients.c (see README.md).

transients.py table [--seed N]      what brute force says of them, as CSV: minutes, on one core
transients.py confront PROGRAM      what PROGRAM says of them against transients.csv, as Markdown; fails below 95 %

Standard library and a C compiler only. Of every design the largest displacement and the fastest impact are compared, of
released ones the time to come to rest as well. A number of the program is the worst of some places of the absorber,
plus its error; it says which share of all places is worse at the most. It is inside where no larger share of the dense
places of brute force is worse."""
import argparse, csv, io, json, math, os, random, subprocess, sys, tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
TABLE = os.path.join(HERE, "transients.csv")
SEED, COUNT = 34, 20
# Places of the absorber by brute force.
DENSE = {"release": 1500, "sine-sweep": 400, "record": 400}
# Of two simulators, one in small steps: relative.
NUMERICAL = 1e-4


def designs(seed=SEED):
    """A bridge, a machine's foot and a circuit board, and what happens to them."""
    draw = random.Random(seed)
    for n in range(COUNT):
        mass, hertz = draw.choice([(4000.0, 2.0), (120.0, 12.0), (0.4, 180.0)])
        hertz *= draw.uniform(0.8, 1.25)
        omega, zeta = 2 * math.pi * hertz, draw.uniform(0.004, 0.02)
        design = {
            "name": f"{n + 1}", "scene": ["release", "sine-sweep", "record"][n % 3], "mass": mass, "frequency": hertz,
            "damping_ratio": zeta, "absorber": mass * draw.uniform(0.01, 0.06), "restitution": draw.uniform(0.3, 0.85),
            "clearance": 9.81 / omega**2 * draw.uniform(0.02, 0.1),
        }
        b = design["clearance"]
        if design["scene"] == "release":
            size, angle = b * draw.uniform(0.8, 3), draw.uniform(0, math.pi / 2)
            design |= {"displacement": size * math.cos(angle), "velocity": size * omega * math.sin(angle),
                       "level": draw.choice([0.1, 0.2, 0.3])}
        elif design["scene"] == "sine-sweep":
            # From a force whose steady resonance is some clearances, at up to the fastest rate that is allowed.
            force = draw.uniform(1, 4) * b * 2 * zeta * mass * omega**2
            ends = [0.85 * hertz, 1.2 * hertz]
            draw.shuffle(ends)
            design |= {"force": force, "from": ends[0], "to": ends[1],
                       "rate": min(ends) ** 2 * 10 ** draw.uniform(-3.3, -1.9)}
        else:
            # A shock of noise under an envelope, straight between samples.
            step, count = 1 / hertz / 16, 640
            tones = [(draw.uniform(0.7, 1.4) * omega, draw.uniform(0, 2 * math.pi)) for _ in range(8)]
            envelope = lambda t: (t / (count * step)) * math.exp(1 - 5 * t / (count * step)) * 2
            size = draw.uniform(0.5, 2) * b * omega**2 * 0.2
            values = [(k * step, size * envelope(k * step) * sum(math.sin(w * k * step + p) for w, p in tones))
                      for k in range(count + 1)]
            design["samples"] = [(float(repr(t)), float(repr(a))) for t, a in values]
        yield design


def brute(binary, design, folder):
    mass, omega = design["mass"], 2 * math.pi * design["frequency"]
    keys = {"m1": mass, "k1": mass * omega**2, "c1": 2 * design["damping_ratio"] * mass * omega, "m2": design["absorber"],
            "r": design["restitution"], "b": design["clearance"], "places": DENSE[design["scene"]]}
    words = []
    if design["scene"] == "release":
        x, v = design["displacement"], design["velocity"]
        keys |= {"x": x, "v": v, "level": design["level"] * math.hypot(x, v / omega),
                 "end": -1.5 * math.log(design["level"]) / design["damping_ratio"] / omega + 40 * math.pi / omega}
        verb = "release"
    elif design["scene"] == "sine-sweep":
        keys |= {"F": design["force"], "from": design["from"], "to": design["to"], "rate": design["rate"]}
        verb, words = "sweep", ["kind=force"]
    else:
        verb, words = "record", ["kind=base", "file=" + samples(design, folder)]
    words += [f"{name}={value!r}" for name, value in keys.items()]
    out = subprocess.run([binary, verb, *words], check=True, capture_output=True, text=True).stdout
    rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(io.StringIO(out))]
    return [row for row in rows if row["impacts"] > 0] or rows


def samples(design, folder):
    path = os.path.join(folder, design["name"] + ".csv")
    with open(path, "w") as file:
        file.write("time (s),acceleration (m/s^2)\n")
        file.writelines(f"{t!r},{a!r}\n" for t, a in design["samples"])
    return path


def case(design, folder):
    """Its case file."""
    lines = ['title = "drawn at random"', 'source = "peers/brute/transients.py"', "[oscillator]",
             f'mass = "{design["mass"]!r} kg"', f'frequency = "{design["frequency"]!r} Hz"',
             f'damping_ratio = {design["damping_ratio"]!r}', "[absorber]", f'mass = "{design["absorber"]!r} kg"',
             f'clearance = "{design["clearance"]!r} m"', f'restitution = {design["restitution"]!r}', "[excitation]"]
    if design["scene"] == "release":
        lines += ['kind = "free"', f'displacement = "{design["displacement"]!r} m"', f'velocity = "{design["velocity"]!r} m/s"',
                  "[criteria]", f'decay_level = {design["level"]!r}', "count_inactive = false"]
    elif design["scene"] == "sine-sweep":
        lines += ['kind = "sine-sweep"', 'of = "force"', f'amplitude = "{design["force"]!r} N"', f'from = "{design["from"]!r} Hz"',
                  f'to = "{design["to"]!r} Hz"', f'rate = "{design["rate"]!r} Hz/s"', "[criteria]", "count_inactive = false"]
    else:
        samples(design, folder)
        lines += ['kind = "record"', 'quantity = "base-acceleration"', f'file = "{design["name"]}.csv"',
                  "[criteria]", "count_inactive = false"]
    path = os.path.join(folder, design["name"] + ".toml")
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")
    return path


MEASURES = {"decay_time": "time", "peak_displacement": "peak", "impact_speed": "speed"}


def table(seed):
    with tempfile.TemporaryDirectory() as folder:
        binary = os.path.join(folder, "transients")
        subprocess.run([os.environ.get("CC", "cc"), "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror",
                        "-o", binary, os.path.join(HERE, "transients.c"), "-lm"], check=True)
        out = csv.writer(sys.stdout, lineterminator="\n")
        out.writerow(["design", "scene", "number", "places", *(f"q{q}" for q in QUANTILES)])
        for design in designs(seed):
            rows = brute(binary, design, folder)
            for number, column in MEASURES.items():
                if number == "decay_time" and design["scene"] != "release":
                    continue
                values = sorted(row[column] for row in rows)
                at = [values[min(len(values) - 1, int(q / 100 * len(values)))] for q in QUANTILES]
                out.writerow([design["name"], design["scene"], number, len(values), *(f"{v:.9g}" for v in at)])
            sys.stdout.flush()


# Of the dense places so many per cent are below: the whole upper part of their distribution.
QUANTILES = [0, 50, *(x / 10 for x in range(800, 1000, 5)), 100]


def confront(program):
    with open(TABLE) as file:
        expected = list(csv.DictReader(file))
    by_name = {design["name"]: design for design in designs()}
    inside = 0
    print("| Design | Number | Program | Dense places: worst | Worse than the program's | Said, at most | |")
    print("| --- | --- | ---: | ---: | ---: | ---: | --- |")
    with tempfile.TemporaryDirectory() as folder:
        said = {}
        for row in expected:
            name = row["design"]
            if name not in said:
                path = case(by_name[name], folder)
                out = subprocess.run([program, "simulate", path, "--format", "json"], capture_output=True, text=True)
                if out.returncode:
                    raise SystemExit(f"{name}: {out.stderr}")
                said[name] = json.loads(out.stdout)
            document = said[name]
            found = document.get({"peak_displacement": "peak"}.get(row["number"], row["number"])) or document["quantities"][row["number"]]
            limit = (found["value"] + found["error"]) * (1 + NUMERICAL)
            above = [q for q in QUANTILES if float(row[f"q{q}"]) > limit]
            worse = (100 - min(above)) / 100 if above else 0.0
            least = float(row["q0"]) * (1 - NUMERICAL)
            # A share between two quantiles is the larger one.
            holds = worse <= document["sample"]["share_above"] and found["value"] >= least
            inside += holds
            print(f"| {name} {row['scene']} | {row['number']} | {found['value']:.5g} (+{found['error']:.2g}) | {float(row['q100']):.5g} "
                  f"| {100 * worse:.1f} % | {100 * document['sample']['share_above']:.1f} % | {'' if holds else '**outside**'} |")
    print(f"\n{inside} of {len(expected)} numbers are inside.")
    return 0 if inside >= 0.95 * len(expected) else 1


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["table", "confront"])
    parser.add_argument("program", nargs="?")
    parser.add_argument("--seed", type=int, default=SEED)
    asked = parser.parse_args()
    if asked.what == "table":
        table(asked.seed)
    else:
        sys.exit(confront(asked.program))
