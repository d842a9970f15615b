#!/usr/bin/env python3
"""`analyze` and `check` of cases that were changed at random: the program must answer or refuse, with 0, 1 or 2, within 5 s
or else say how long it will take, and in 1 GB.

    fuzz/commands.py target/release/vinesink 1000 [SEED]

Characters are replaced, numbers moved by many powers of ten, keys dropped, doubled and exchanged between the shipped
cases. The same seed gives the same cases. What is found is left in fuzz/target/commands.
"""

import random
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CASES = sorted(path.read_text() for path in (ROOT / "cases").glob("*.toml") if "map" not in path.name)
RECORD = (ROOT / "cases" / "tower-record.csv").read_bytes()
NUMBER = re.compile(r"(?<![\w.])-?\d+(\.\d+)?(e-?\d+)?(?![\w.])")
AWKWARD = ["0", "-1", "1", "1e308", "1e-308", "1e9", "1e-9", "0.999999999", "nan", "inf", "1e400"]
TYPED = 0.7  # Of all cases; few of them are read.
TYPES = [" ", "=", '"', "[", "]", "{", "#", "\\", ".", "0", "9", "e", "-", "a", "\n", "\0", "\u00b5", "\u202e", "mm", ""]
KEY = re.compile(r"(?!title|source)\w+ *=")
FOUND = ROOT / "fuzz" / "target" / "commands"
PATIENCE, KILLED, MEMORY = 5.0, 5.5, 1 << 30
# What is said of work that is long: a line of progress, or the refusal of more than is ordinary.
TOLD = re.compile(rb"left|were expected|would take about")


def moved(random, text):
    """A number that is another one."""
    kind = random.random()
    if kind < 0.1:
        return random.choice(AWKWARD)
    if kind < 0.5:
        return repr(float(text) * random.uniform(0.5, 2.0))
    powers = 6 if kind < 0.65 else 1
    return repr(float(text) * 10.0 ** random.uniform(-powers, powers))


def changed(random):
    text = random.choice(CASES)
    if random.random() < TYPED:
        letters = list(text)
        for _ in range(random.choice([1, 2, 5, 20])):
            at = random.randrange(len(letters))
            letters[at : at + random.choice([0, 1, 1, 1, 30])] = random.choice(TYPES)
        return "".join(letters)
    lines = text.splitlines()
    for _ in range(random.choice([1, 2, 3, 5, 8])):
        at = random.randrange(len(lines))
        kind = random.random()
        numbers = [k for k, line in enumerate(lines) if NUMBER.search(line) and KEY.match(line)]
        if kind < 0.8 and numbers:
            at = random.choice(numbers)
            found = random.choice(list(NUMBER.finditer(lines[at])))
            lines[at] = lines[at][: found.start()] + moved(random, found.group()) + lines[at][found.end() :]
        elif kind < 0.85:
            del lines[at]
        elif kind < 0.95:
            lines.insert(at, random.choice(random.choice(CASES).splitlines()))
        else:
            line = bytearray(lines[at], "utf-8") or bytearray(b" ")
            line[random.randrange(len(line))] = random.randrange(32, 127)
            lines[at] = line.decode("utf-8", "replace")
        if not lines:
            lines = [""]
    return "\n".join(lines) + "\n"


def limits():
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))


def asked(program, command, folder):
    """What is wrong with how it ends, if anything; whether it read the case; seconds."""
    begin = time.monotonic()
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(
            [program, command, "case.toml"], cwd=folder, stdout=subprocess.DEVNULL, stderr=said, preexec_fn=limits
        )
        try:
            code = process.wait(timeout=KILLED)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            code = None
        seconds = time.monotonic() - begin
        said.seek(0)
        text = said.read(200_000)
    if b"panicked" in text or b"memory allocation" in text or (code is not None and code not in (0, 1, 2)):
        return f"ends with {code}: {text[:300]!r}", code, seconds
    if seconds > PATIENCE and not TOLD.search(text):
        return f"takes {seconds:.1f} s or more and does not say so: {text[:300]!r}", code, seconds
    return None, code, seconds


def main():
    program, count = str(Path(sys.argv[1]).resolve()), int(sys.argv[2])
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    codes, longest, wrong = {}, 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "tower-record.csv").write_bytes(RECORD)
        for number in range(count):
            text = changed(random.Random(seed * 1_000_003 + number))
            Path(folder, "case.toml").write_text(text, encoding="utf-8")
            for command in ("analyze", "check"):
                problem, code, seconds = asked(program, command, folder)
                codes[code] = codes.get(code, 0) + 1
                longest = max(longest, seconds)
                if problem:
                    wrong += 1
                    FOUND.mkdir(parents=True, exist_ok=True)
                    kept = FOUND / f"{command}-{seed}-{number}.toml"
                    kept.write_text(text, encoding="utf-8")
                    print(f"{kept}: {command} {problem}", flush=True)
                if code == 2:
                    break  # Nobody reads it.
    print(f"{sum(codes.values())} runs, exit codes {codes}, the longest {longest:.1f} s, {wrong} wrong")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
