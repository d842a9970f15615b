#!/usr/bin/env python3
"""`vinesink sweep submit --engine slurm` on a real Slurm of two nodes, one of which loses its power.

    tests/cluster/on_slurm.py VINESINK

Runs as root on Linux with Debian's slurmctld, slurmd, slurm-client and iproute2. The Slurm is started here,
in a temporary folder and in namespaces of its own: its ports and processes are seen by nobody else and end
with it, whatever happens. Each node has its own process namespace within, so that killing its first process
ends all of them at once, as a power cut would.
"""

import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import common
from common import check, fail, say, wait_for

# Of everything; it takes about two minutes.
LONGEST = 900

ADDRESS = "10.99.0.1"

CONFIGURATION = """\
ClusterName=vinesink
SlurmctldHost={host}({address})
SlurmctldPort=6817
AuthType=auth/none
CredType=cred/none
SlurmUser=root
SlurmdUser=root
MailProg=/bin/true
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
# As many sites have it: a job must ask to run again after its node is lost.
JobRequeue=0
# A silent node is given up after seconds and not minutes, and what ran there begins again soon after.
SlurmdTimeout=5
AuthInfo=cred_expire=5
SchedulerParameters=sched_interval=1,sched_min_interval=0
NodeName=node1 NodeHostname={host} NodeAddr={address} Port=17001 CPUs=1
NodeName=node2 NodeHostname={host} NodeAddr={address} Port=17002 CPUs=1
PartitionName=all Nodes=node1,node2 Default=YES State=UP
"""


def outside(vinesink):
    check(os.geteuid() == 0, "Slurm's nodes start jobs as their owners: run this as root")
    for program in ["slurmctld", "slurmd", "sbatch", "ip", "unshare"]:
        check(shutil.which(program), f"there is no {program}: install slurmctld, slurmd, slurm-client, "
              "iproute2 and util-linux")
    # So that what is started below ends when this is told to end.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    with tempfile.TemporaryDirectory(prefix="vinesink-slurm-") as folder:
        common.alone(vinesink, Path(folder) / "alone")
        apart = ["unshare", "--net", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]
        try:
            done = subprocess.run([*apart, sys.executable, __file__, vinesink, "--in", folder],
                                  timeout=LONGEST)
        except subprocess.TimeoutExpired:
            fail(f"not done within {LONGEST} s")
        if done.returncode != 0:
            fail("as said above")
        say("Slurm: done")


def told(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def start(folder):
    """Slurm's controller and its two nodes; returns the processes of the nodes."""
    (folder / "state").mkdir()
    for node in ["node1", "node2"]:
        (folder / f"spool-{node}").mkdir()
    configuration = folder / "slurm.conf"
    configuration.write_text(
        CONFIGURATION.format(host=socket.gethostname(), address=ADDRESS, folder=folder))
    os.environ["SLURM_CONF"] = str(configuration)
    # Slurm does not listen on the loopback alone.
    for words in ["link set lo up", "link add here type veth peer name there",
                  f"address add {ADDRESS}/24 dev here", "link set here up", "link set there up"]:
        subprocess.run(["ip", *words.split()], check=True)
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.Popen(["slurmctld", "-D"], **quiet)
    apart = ["unshare", "--pid", "--fork", "--kill-child", "--mount-proc"]
    nodes = {node: subprocess.Popen([*apart, "slurmd", "-D", "-N", node], **quiet)
             for node in ["node1", "node2"]}

    def idle():
        found = subprocess.run(["sinfo", "--noheader", "--Node", "--format=%N=%t"],
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        return found.stdout.split() == ["node1=idle", "node2=idle"]

    wait_for("two idle nodes", 60, idle)
    say("Slurm has two idle nodes")
    return nodes


def inside(vinesink, folder):
    nodes = start(folder)
    sweep = common.Sweep(vinesink, folder / "together")
    try:
        print(sweep.submit("slurm", "--retries", "0", "--", "--partition=all"), end="", flush=True)
        kept = next(sweep.folder.glob("sweeps/map/submit/*/map.toml"))
        chunks = sweep.folder / "sweeps/map/chunks"
        # By its files, since the case is spoilt; each has a seal.
        there = lambda: len(list(chunks.glob("*.seal")))
        check(kept.read_text() == common.CASE, "the copy of the case differs")
        # Early, so that the task that is lost still has most of its share to do.
        wait_for("second chunk", 120, lambda: there() >= 2)
        running = lambda: told("squeue", "--noheader", "--states=R", "--nodelist=node1", "--format=%K")
        lost = wait_for("task on node1", 30, running).split()
        nodes["node1"].kill()
        nodes["node1"].wait()
        say(f"node1 is killed while it runs task {', '.join(lost)}, with {there()} chunks there")
        check(not sweep.merged.exists(), "the sweep was done before the node was killed")
        wait_for("end of all jobs", 600, lambda: not told("squeue", "--noheader"))
        say("Slurm has nothing left to do")
        check("down" in told("sinfo", "--noheader", "--nodes=node1", "--format=%t"),
              "Slurm has not noticed that node1 is lost")
        again = [line for line in told("scontrol", "--oneliner", "show", "job").splitlines()
                 if " Restarts=0 " not in line]
        tasks = sorted(word.split("=")[1] for line in again for word in line.split()
                       if word.startswith("ArrayTaskId="))
        check(tasks == lost, f"task {lost} was lost, and {tasks} ran again")
        say(f"task {', '.join(tasks)} ran again on the other node")
        sweep.restore()
        there, all_of_them = sweep.chunks()
        check(there == all_of_them, f"{there} of {all_of_them} chunks are there")
        alone = common.Sweep.__new__(common.Sweep)
        alone.merged = folder / "alone/sweeps/map/sweep.parquet"
        common.compare(sweep, alone)
        said = sweep.submit("slurm")
        check("nothing is submitted" in said and not told("squeue", "--noheader"),
              f"a complete sweep was submitted once more:\n{said}")
    except SystemExit:
        sweep.logs()
        for log in sorted(folder.glob("*.log")):
            print(f"-- {log.name}\n{log.read_text()[-3000:]}")
        raise


if __name__ == "__main__":
    match sys.argv[1:]:
        case [vinesink]:
            outside(vinesink)
        case [vinesink, "--in", folder]:
            inside(vinesink, Path(folder))
        case _:
            sys.exit(__doc__)
