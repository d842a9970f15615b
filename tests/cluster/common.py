"""What the tests on engines share: a sweep that takes a while, and what must come of it."""

import filecmp
import os
import subprocess
import sys
import time
from pathlib import Path

SHIPPED = Path(__file__).resolve().parents[2] / "cases/li2016-map.toml"


def design():
    """The shipped case up to its table [sweep]."""
    head, line, _ = SHIPPED.read_text().partition("\n[sweep]\n")
    if not line:
        sys.exit(f"FAILED: {SHIPPED} has no line [sweep] that its design ends at")
    return head + "\n"


# Points and effort such that a chunk takes about a second of one processor in a release build: a node can
# be killed in the middle of one, and all of them take less than a minute on two.
CASE = design() + """\
[sweep]
starts = 16
periods = 100
clearance = { from = "5 mm", to = "40 mm", count = 192, scale = "logarithmic" }
frequency = { from = "8 Hz", to = "8.7 Hz", count = 192 }
"""

# Each has several chunks, so that a lost one can be in the middle of its share.
TASKS = 9


def fail(message):
    print(f"FAILED: {message}", flush=True)
    sys.exit(1)


def check(holds, message):
    if not holds:
        fail(message)


def say(message):
    print(f"{time.monotonic() - BEGIN:6.1f} s  {message}", flush=True)


BEGIN = time.monotonic()


def wait_for(what, seconds, holds):
    """Looks until something holds; returns what it was."""
    end = time.monotonic() + seconds
    while True:
        found = holds()
        if found:
            return found
        check(time.monotonic() < end, f"no {what} within {seconds} s")
        time.sleep(0.2)


class Sweep:
    """A sweep of CASE in a folder of its own."""

    def __init__(self, vinesink, folder):
        self.vinesink = Path(vinesink).resolve()
        self.folder = Path(folder)
        self.folder.mkdir()
        self.case = self.folder / "map.toml"
        self.case.write_text(CASE)
        self.merged = self.folder / "sweeps/map/sweep.parquet"

    def run(self, *words, codes=(0,), environment=None):
        done = subprocess.run(
            [self.vinesink, "sweep", *words],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        if done.returncode not in codes:
            fail(f"sweep {' '.join(words)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
        return done.stdout

    def chunks(self):
        """How many chunks are there, and of how many."""
        # As in "3 of 36 chunks are there"; exit code 1 while some are not.
        words = self.run("status", "map.toml", codes=(0, 1)).split()
        return int(words[0]), int(words[2])

    def submit(self, engine, *words, environment=None):
        """Submits the case, then spoils it: what runs must not look at it again."""
        said = self.run("submit", "map.toml", "--engine", engine, "--tasks", str(TASKS), *words,
                        environment=environment)
        self.case.write_text("edited while the sweep runs\n")
        return said

    def restore(self):
        self.case.write_text(CASE)

    def logs(self):
        for log in sorted(self.folder.glob("sweeps/map/submit/*/*.log")):
            text = log.read_text().strip()
            if text:
                print(f"-- {log.name}\n{text[-2000:]}")


def alone(vinesink, folder):
    """The sweep on one machine, by one command."""
    sweep = Sweep(vinesink, folder)
    sweep.run("map.toml")
    say(f"one machine alone has worked out {sweep.chunks()[1]} chunks")
    return sweep


def compare(found, wanted):
    """The engine's own merge must have made the very same file."""
    check(found.merged.is_file(), "the merge after the tasks left no sweep.parquet")
    same = filecmp.cmp(found.merged, wanted.merged, shallow=False)
    check(same, f"{found.merged} differs from {wanted.merged}")
    say(f"same {os.path.getsize(found.merged)} bytes as on one machine")
