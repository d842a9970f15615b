#!/usr/bin/env python3
"""`vinesink sweep submit --engine hyperqueue` on a real HyperQueue of two workers, one of which is lost.

    tests/cluster/on_hyperqueue.py VINESINK

Needs the package hyperqueue, and the interpreter that has it first in PATH, for the `hq` beside this file.
Server and workers are threads of this process. A worker is lost when its connection breaks, as it does when
its machine loses its power or its network: that is what is done to one, in the middle of a task.
"""

import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent.resolve()
sys.path.insert(0, str(HERE))
import common
from common import check, say, wait_for

from hyperqueue import LocalCluster
from hyperqueue.cluster import WorkerConfig


# Waits for the end of a job, and fails if one of its tasks did.
WAIT = """
import sys
from hyperqueue.client import Client
_, server, job = sys.argv
sys.exit(bool(Client(server).connection.wait_for_jobs((int(job),), lambda _: None)))
"""


def connections():
    """The TCP connections of this process: descriptor, and both ends."""
    found = {}
    for name in os.listdir("/proc/self/fd"):
        try:
            if not os.readlink(f"/proc/self/fd/{name}").startswith("socket:"):
                continue
            with socket.socket(fileno=os.dup(int(name))) as one:
                if one.family == socket.AF_INET:
                    found[int(name)] = (one.getsockname(), one.getpeername())
        except OSError:
            # Closed in the meantime, or listening and not connected.
            continue
    return found


def settled(count):
    """The connections once there are so many, and the same half a second later."""
    def same():
        first = connections()
        time.sleep(0.5)
        return first if len(first) == count and connections() == first else None

    return wait_for(f"{count} lasting ends of connections", 20, same)


def running(sweep):
    """The tasks that run: their numbers, how often each began before, and the process."""
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            parts = (part.split(b"=", 1) for part in (entry / "environ").read_bytes().split(b"\0"))
            environment = {part[0]: part[1] for part in parts if len(part) == 2}
        except OSError:
            continue
        if words[0] == str(sweep.vinesink).encode() and b"HQ_TASK_ID" in environment:
            found.append((int(environment[b"HQ_TASK_ID"]), int(environment[b"HQ_INSTANCE_ID"]),
                          int(entry.name)))
    return sorted(found)


def main(vinesink):
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    with tempfile.TemporaryDirectory(prefix="vinesink-hyperqueue-") as name:
        folder = Path(name)
        alone = common.alone(vinesink, folder / "alone")
        sweep = common.Sweep(vinesink, folder / "together")
        try:
            with LocalCluster(str(folder / "server")) as cluster:
                on(cluster, folder, sweep)
            common.compare(sweep, alone)
        except SystemExit:
            sweep.logs()
            raise
        say("HyperQueue: done")


def on(cluster, folder, sweep):
    cluster.start_worker(WorkerConfig(cores=1))
    # Both ends of a worker's connection to the server are in this process.
    first = settled(2)
    cluster.start_worker(WorkerConfig(cores=1))
    doomed = [descriptor for descriptor in settled(4) if descriptor not in first]
    say("HyperQueue has two workers")

    environment = dict(os.environ)
    environment["PATH"] = f"{HERE}:{environment['PATH']}"
    environment["HQ_SERVER_DIR"] = str(folder / "server")
    said = sweep.submit("hyperqueue", environment=environment)
    print(said, end="", flush=True)
    # "watch         hq job info 1"
    job = int(said.split("hq job info ")[1].split()[0])

    chunks = sweep.folder / "sweeps/map/chunks"
    there = lambda: len(list(chunks.glob("*.seal")))
    # Early, so that the task that is lost still has most of its share to do.
    wait_for("second chunk", 120, lambda: there() >= 2)
    tasks = wait_for("two tasks at once", 30, lambda: len(found := running(sweep)) == 2 and found)
    # One end is enough; the other follows at once.
    with socket.socket(fileno=os.dup(doomed[0])) as one:
        one.shutdown(socket.SHUT_RDWR)
    say(f"a worker is lost while tasks {tasks[0][0]} and {tasks[1][0]} run, with {there()} chunks there")
    check(not sweep.merged.exists(), "the sweep was done before the worker was lost")

    # In a process of its own: waiting holds the interpreter for seconds, in which a task may begin and end.
    waiting = subprocess.Popen([sys.executable, "-c", WAIT, str(folder / "server"), str(job)])
    again = set()

    def over():
        again.update(task for task, instance, _ in running(sweep) if instance > tasks_before[task])
        return waiting.poll() is not None

    tasks_before = {task: 0 for task in range(common.TASKS + 1)}
    tasks_before.update({task: instance for task, instance, _ in tasks})
    wait_for("end of the job", 600, over)
    say("HyperQueue has nothing left to do")
    check(waiting.returncode == 0, "tasks failed")
    check(len(again) == 1 and again < {task for task, _, _ in tasks},
          f"one of {tasks} was lost, and {again or 'none'} ran again")
    say(f"task {again.pop()} ran again on the other worker")
    sweep.restore()
    here, all_of_them = sweep.chunks()
    check(here == all_of_them, f"{here} of {all_of_them} chunks are there")
    said = sweep.submit("hyperqueue", environment=environment)
    check("nothing is submitted" in said, f"a complete sweep was submitted once more:\n{said}")


if __name__ == "__main__":
    match sys.argv[1:]:
        case [vinesink]:
            main(vinesink)
        case _:
            sys.exit(__doc__)
