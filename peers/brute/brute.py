#!/usr/bin/env python3
"""What brute force says of a design (see README.md). Compiles brute.c and asks it; standard library only.

brute.py scan CASE [--clearance METRES]   the largest long-term motion at one clearance, over the case's band
brute.py curve CASE [--clearances N]      the same at N clearances between the bounds of [optimize], as CSV
brute.py table CASE...                    best clearance of each case and five clearances densely scanned, as CSV
brute.py ends CASE... [--after N,N,...]   what starts at the case's own excitation are like after N periods, as Markdown
"""
import argparse, csv, functools, io, math, os, re, subprocess, sys, tempfile, tomllib

HERE = os.path.dirname(os.path.abspath(__file__))
PREFIX = {"": 1, "k": 1e3, "M": 1e6, "m": 1e-3, "u": 1e-6, "c": 1e-2}
CONVENTIONS = ("impacts", "inactive", "inactive-from-rest")


def number(value, unit):
    """A quantity of a case file in SI; a bare number stays as it is."""
    if isinstance(value, (int, float)):
        return float(value)
    m = re.fullmatch(r"\s*([-+0-9.eE]+)\s*(%|\S.*)?\s*", value)
    size, text = float(m[1]), (m[2] or "")
    if text == "%":
        return size / 100
    if text in ("g", "kg", "mg", "t"):
        return size * {"mg": 1e-6, "g": 1e-3, "kg": 1, "t": 1e3}[text]
    if not text.endswith(unit) or text[: -len(unit)] not in PREFIX:
        raise SystemExit(f"{value!r}: expected a quantity in {unit}")
    return size * PREFIX[text[: -len(unit)]]


class Design:
    def __init__(self, path):
        with open(path, "rb") as file:
            case = tomllib.load(file)
        o, a, e = case["oscillator"], case["absorber"], case["excitation"]
        self.name = os.path.splitext(os.path.basename(path))[0]
        m1 = number(o["mass"], "kg")
        k1 = number(o["stiffness"], "N/m") if "stiffness" in o else m1 * (2 * math.pi * number(o["frequency"], "Hz")) ** 2
        c1 = number(o["damping"], "N s/m") if "damping" in o else 2 * number(o["damping_ratio"], "%") * math.sqrt(k1 * m1)
        m2 = number(a["mass"], "kg") if "mass" in a else m1 * number(a["mass_ratio"], "%")
        base = e["kind"] == "base-displacement"
        self.keys = {"m1": m1, "k1": k1, "c1": c1, "m2": m2, "r": a["restitution"], "kind": "base" if base else "force",
                     "F": number(e["amplitude"], "m" if base else "N"),
                     **{end: number(case["band"][end], "Hz") for end in ("from", "to") if "band" in case}}
        self.frequency = number(e["frequency"], "Hz")
        self.ideal = set(a) <= {"mass", "mass_ratio", "clearance", "restitution"}
        self.clearance = number(a["clearance"], "m")
        self.bounds = [number(v, "m") for v in case["optimize"]["clearance"]] if "optimize" in case else None
        self.transients = None

    def ask(self, verb, **keys):
        words = [f"{k}={v!r}" if isinstance(v, float) else f"{k}={v}" for k, v in {**self.keys, **keys}.items()]
        out = subprocess.run([BINARY, verb, *words], check=True, capture_output=True, text=True).stdout
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(io.StringIO(out))]

    @functools.cache
    def inactive(self, b):
        """{convention: (amplitude, frequency)} of the motions without impacts that a convention counts."""
        if self.transients is None:
            self.transients = self.ask("bare", n=2000)
        none = (0.0, self.keys["from"])
        return {"impacts": none,
                **{name: max([(t["amplitude"], t["f"]) for t in self.transients if t[bounded] < b], default=none)
                   for name, bounded in (("inactive", "amplitude"), ("inactive-from-rest", "transient"))}}


def dense(design, b, frequencies=400, starts=6):
    """`summary` of motions with impacts, and the largest peak of the first scan. The eight largest places are looked
    at again, closer and for 2,000 periods."""
    lo, hi = design.keys["from"], design.keys["to"]
    rows = design.ask("scan", b=b, n=frequencies, starts=starts)
    if not rows:
        return summary(rows) + (0.0,)
    rows.sort(key=lambda row: -row["worst"])
    step, first = (hi - lo) / (frequencies - 1), rows[0]["worst"]
    for f in [row["f"] for row in rows[:8]]:
        rows += design.ask("scan", b=b, n=5, starts=4, windows=10, seed=2, carry=0,
                           **{"from": max(lo, f - 0.5 * step), "to": min(hi, f + 0.5 * step)})
    return summary(rows) + (first,)


def summary(rows):
    """(value, where, what one window shows on average, impacts per period) of the largest peak of a scan's rows."""
    if not rows:
        return (0.0, 0.0, 0.0, 0.0)
    top = max(rows, key=lambda row: row["worst"])
    return (top["worst"], top["f"], top["typical"], top["impacts_per_period"])


# Passes over one clearance before the dense scan, each of which can only raise what the one before found.
PASSES = [{"n": 61, "starts": 3, "window": 100, "windows": 1}, {"n": 121, "starts": 4, "windows": 2, "seed": 5}]


class Search:
    """The best of `count` clearances, by lower bounds `found`: a pass stops where the clearance can no longer be the
    best, and the clearance with the lowest bound gets the next pass, until that is within 1 % of the best dense scan."""

    def __init__(self, design, count):
        lo, hi = design.bounds
        self.design, self.dense = design, {}
        self.grid = [lo * (hi / lo) ** (i / (count - 1)) for i in range(count)]
        self.found, self.passes = {}, {}
        # Coarse to fine, from large to small.
        for i in sorted(range(count), key=lambda i: (-(i & -i) if i else -count, -i)):
            b = self.grid[i]
            self.passes[b] = 0
            stops = [(c, 1.02 * self.lowest(c)[0]) for c in CONVENTIONS]
            self.next_pass(b, max(stop for c, stop in stops if self.rest(b, c) <= stop))

    def rest(self, b, convention):
        return self.design.inactive(b)[convention][0]

    def value(self, b, convention):
        return max(self.found[b][0], self.rest(b, convention))

    def lowest(self, convention):
        return min(((self.value(b, convention), b) for b in self.grid if self.passes.get(b)), default=(math.inf, 0))

    def next_pass(self, b, stop):
        if self.passes[b] < len(PASSES):
            rows = self.design.ask("scan", b=b, carry=0, stop=stop, **PASSES[self.passes[b]])
            self.found[b] = max(self.found.get(b, summary([])), summary(rows))
        else:
            self.judge(b)
        self.passes[b] += 1

    def judge(self, b):
        if b not in self.dense:
            *seen, first = dense(self.design, b)
            self.found[b] = max(self.found.get(b, summary([])), tuple(seen))
            self.dense[b] = self.found[b] + (first,)
        return self.dense[b]

    def best(self, convention):
        while True:
            value, b = self.lowest(convention)
            judged = min(((self.value(o, convention), o) for o in self.dense if o in self.passes), default=(math.inf, 0))
            if judged[0] <= 1.01 * value:
                return judged[1]
            # A pass can end as soon as the clearance can no longer be the best.
            others = min(self.value(o, convention) for o in self.grid if o != b)
            self.next_pass(b, 1.05 * max(value, others))


def table(design, out, count):
    search = Search(design, count)
    lo, hi = design.bounds
    others = [("case", design.clearance)] + [(f"other {i}", float(f"{lo * (hi / lo) ** (i / 4):.3g}")) for i in (1, 2, 3)]
    for c in CONVENTIONS:
        for what, b in [("best", search.best(c))] + others:
            value, f, typical, rate, first = search.judge(b)
            rest, at = design.inactive(b)[c]
            if rest >= value:
                value, f, typical, first, rate = rest, at, rest, rest, 0.0
            row = [f"{b:.5g}", f"{value:.5g}", f"{f:.6g}", f"{rate:.3g}", f"{typical:.5g}", f"{first:.5g}"]
            out.writerow([design.name, c, what, *row])
    print(f"{design.name}: {len(search.dense)} dense scans", file=sys.stderr)


def scan(design, b, args):
    v, f, typical, _, first = dense(design, b, args.frequencies, args.starts or 6)
    rest = [max(v, design.inactive(b)[c][0]) for c in CONVENTIONS[1:]]
    return [f"{b:.5g}", f"{v:.5g}", f"{f:.7g}", *(f"{x:.5g}" for x in (typical, first, *rest))]


# Windows that repeat and agree this closely are of one motion; it is far below what tells motions apart.
ALIKE = 1e-3


def ends(design, starts, after):
    """Lines of a table: the motions that at least two starts agree on to `ALIKE`, and the rest together."""
    if not design.ideal:
        raise SystemExit(f"{design.name}: brute force knows the ideal cavity alone")
    rows = design.ask("ends", f=design.frequency, b=design.clearance, starts=starts, after=after)
    for periods in map(int, after.split(",")):
        groups = []
        for row in sorted((row for row in rows if row["after"] == periods), key=lambda row: row["peak"]):
            if groups and row["peak"] <= (1 + ALIKE) * groups[-1][0]["peak"]:
                groups[-1].append(row)
            else:
                groups.append([row])
        settled = [group for group in groups if len(group) > 1 and len({round(row["impacts_per_period"], 1) for row in group}) == 1]
        told = [f"{len(group)}: {1e3 * group[0]['peak']:.4g} mm, {group[0]['impacts_per_period']:.2f} impacts" for group in settled]
        told.append(f"{starts - sum(map(len, settled))} others")
        yield f"| {design.name} | {periods} | {'; '.join(told)} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("verb", choices=["scan", "curve", "table", "ends"])
    parser.add_argument("case", nargs="+")
    parser.add_argument("--clearance", type=float)
    parser.add_argument("--clearances", type=int, default=200)
    parser.add_argument("--frequencies", type=int, default=400)
    parser.add_argument("--starts", type=int, help="6, or 24 for ends")
    parser.add_argument("--after", default="300,3000,30000")
    args = parser.parse_args()
    global BINARY
    with tempfile.TemporaryDirectory() as folder:
        BINARY = os.path.join(folder, "brute")
        compiler = [os.environ.get("CC", "cc"), "-O3", "-march=native", "-ffp-contract=off"]
        subprocess.run([*compiler, "-o", BINARY, f"{HERE}/brute.c", "-lm"], check=True)
        out = csv.writer(sys.stdout, lineterminator="\n")
        columns = "clearance_m impacts_m frequency_hz typical_m one_scan_m inactive_m inactive_from_rest_m"
        if args.verb == "ends":
            print("| design | after periods | starts: peak, impacts per period |\n|---|---:|---|")
            for path in args.case:
                print("\n".join(ends(Design(path), args.starts or 24, args.after)), flush=True)
            return
        if args.verb == "table":
            columns = "design convention what clearance_m worst_m frequency_hz impacts_per_period typical_m one_scan_m"
        out.writerow(columns.split())
        for path in args.case:
            design = Design(path)
            if args.verb == "table":
                table(design, out, args.clearances)
            elif args.verb == "scan":
                out.writerow(scan(design, args.clearance or design.clearance, args))
            else:
                (lo, hi), n = design.bounds, args.clearances
                for i in range(n):
                    out.writerow(scan(design, lo * (hi / lo) ** (i / (n - 1)), args))
                    sys.stdout.flush()
            sys.stdout.flush()


if __name__ == "__main__":
    main()
