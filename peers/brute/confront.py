#!/usr/bin/env python3
"""Holds `check` and `optimize` to what brute force says of designs that nobody tuned to; standard library only.

confront.py PROGRAM DESIGN... [--scan]    a Markdown table; exit code 1 where one of these does not hold:

- check at the case's own clearance within 10 % of brute force,
- what optimize claims within 3 % of a check of the file that it wrote,
- the winner not worse than the case, by check,
- the winner within 5 % of the best of 200 clearances by brute force.

Both sides give intervals: check its value and value plus error, brute force a typical and a largest peak. They
are as far apart as their nearest ends. --scan also scans the winner by brute force, which takes some seconds.
"""
import argparse, csv, json, os, re, subprocess, sys, tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
TABLE = os.path.join(HERE, "..", "..", "tests", "designs", "brute_force.csv")
CONVENTION = "inactive"


def apart(a, b):
    """Relative distance of two intervals."""
    gap = max(a[0] - b[1], b[0] - a[1], 0.0)
    return gap / min(a[1], b[1])


def run(program, *words):
    done = subprocess.run([program, *words], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{' '.join(words)}: {done.stderr}")
    return json.loads(done.stdout)


def peak(program, path):
    criteria = run(program, "check", path, "--format", "json")["cases"][0]["criteria"]
    found = next(one for one in criteria if one["name"] == "peak_displacement")
    return found["found"], found["found"] + found["error"]


def brute(rows, what):
    row = next(row for row in rows if row["what"] == what)
    return float(row["typical_m"]), float(row["worst_m"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("designs", nargs="+")
    parser.add_argument("--scan", action="store_true")
    args = parser.parse_args()
    table = list(csv.DictReader(open(TABLE)))
    failed = []
    print("| design | case: check, brute force (mm) | winner: clearance, check, best of brute force (mm) |"
          + (" winner scanned (mm) |" if args.scan else "") + "\n|---|---|---|" + ("---|" if args.scan else ""))
    for path in args.designs:
        name = os.path.splitext(os.path.basename(path))[0]
        rows = [row for row in table if row["design"] == name and row["convention"] == CONVENTION]
        own, case = peak(args.program, path), brute(rows, "case")
        best = brute(rows, "best")
        with tempfile.TemporaryDirectory() as folder:
            new = os.path.join(folder, name + ".toml")
            found = run(args.program, "optimize", path, "--write", new, "--format", "json")
            if not os.path.exists(new):
                # Nothing meets the criteria, or nothing is better than the case's own absorber: its winner all the same.
                clearance = f'clearance = "{found["optimum"]["clearance"]!r} m"'
                text = re.sub(r'^clearance = "[^"]*"$', clearance, open(path).read(), count=1, flags=re.MULTILINE)
                open(new, "w").write(text)
            winner = peak(args.program, new)
            holds = {
                "check within 10 % of brute force": apart(own, case) <= 0.10,
                "claim within 3 % of check": abs(found["claimed"]["value"] / winner[0] - 1) <= 0.03,
                "winner not worse than the case": winner[1] <= own[1],
                "winner within 5 % of brute force": winner[0] <= 1.05 * best[1],
            }
            line = f"| {name} | {span(own)}, {span(case)} | {1e3 * found['optimum']['clearance']:.4g}, {span(winner)}, {span(best)} |"
            if args.scan:
                words = [sys.executable, os.path.join(HERE, "brute.py"), "scan", new]
                lines = subprocess.run(words, check=True, capture_output=True, text=True).stdout.splitlines()
                row = next(csv.DictReader(lines))
                worst = float(row["inactive_m"])
                # Where an inactive absorber is worst its amplitude is exact.
                typical = float(row["typical_m"]) if worst == float(row["impacts_m"]) else worst
                scanned = typical, worst
                holds["winner by check within 10 % of brute force"] = apart(winner, scanned) <= 0.10
                line += f" {span(scanned)} |"
        print(line, flush=True)
        failed += [f"{name}: {what} does not hold" for what, holds_ in holds.items() if not holds_]
    print("\n".join(failed), file=sys.stderr)
    sys.exit(bool(failed))


def span(interval):
    low, high = (1e3 * end for end in interval)
    return f"{low:.3g}" if high < 1.005 * low else f"{low:.3g} to {high:.3g}"


if __name__ == "__main__":
    main()
