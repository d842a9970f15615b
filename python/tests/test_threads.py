"""Other threads, progress, Ctrl-C, and faults."""

import os
import signal
import threading
import time

import numpy as np
import pytest
import vinesink
from conftest import TABLE_1

# Seconds of work, with most of it in the batch engine.
LONG = {"clearance": np.linspace(2e-3, 20e-3, 2_000_000)}


@pytest.fixture
def raised_after():
    """Sends SIGINT to this process a while later, as Ctrl-C does; how long ago."""
    sent = []

    def send(seconds):
        def later():
            time.sleep(seconds)
            sent.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=later)
        thread.start()
        return sent

    return send


def test_other_threads_run(case):
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.wait(0.001):
            ticks.append(time.perf_counter())

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    vinesink.single_trajectories(case, clearance=np.linspace(2e-3, 20e-3, 100_000))
    end = time.perf_counter()
    stop.set()
    thread.join()
    gaps = np.diff([begin, *(at for at in ticks if begin < at < end), end])
    # With Python's lock held there would be one gap as long as the work.
    assert end - begin > 0.2 and gaps.max() < 0.5 * (end - begin)


def work(name, case):
    if name == "many":
        return vinesink.single_trajectories(case, **LONG)
    if name == "impacts":
        return case.simulate(initial=(0, 0, 0, 1), discard=50_000_000, periods=1, measure=False)
    # Strongly modulated, so that no orbit catches a start early; some hundred starts at a time.
    modulated = {**TABLE_1, "clearance": "28 mm", "frequency": "8.5 Hz"}
    return vinesink.Case(**modulated, simulation={"starts": 10_000, "discard": 20_000}).simulate()


@pytest.mark.parametrize("name", ["many", "impacts", "starts"])
def test_ctrl_c_ends_it(name, case, raised_after):
    sent = raised_after(0.3)
    with pytest.raises(KeyboardInterrupt):
        work(name, case)
    # Looked for every tenth of a second; then pieces under way are finished.
    assert time.perf_counter() - sent[0] < 2
    assert vinesink.single_trajectories(case, clearance=[5e-3]).settled.all()


def test_progress(case):
    calls = []
    vinesink.single_trajectories(case, clearance=np.linspace(2e-3, 20e-3, 100_000), progress=lambda *call: calls.append(call))
    assert len(calls) > 2
    assert calls == sorted(calls) and calls[-1] == (100_000, 100_000)
    assert {steps for _, steps in calls} == {100_000}
    calls.clear()
    case.simulate(progress=lambda *call: calls.append(call))
    assert calls[-1] == (32, 32)
    calls.clear()
    case.simulate(initial=(0, 0, 0, 1), discard=7, periods=2000, measure=False, progress=lambda *call: calls.append(call))
    assert calls[-1] == (2007, 2007)


def test_what_progress_raises_ends_the_work(case):
    class Enough(Exception):
        pass

    def progress(done, steps):
        raise Enough

    begin = time.perf_counter()
    with pytest.raises(Enough):
        vinesink.single_trajectories(case, **LONG, progress=progress)
    assert time.perf_counter() - begin < 5


def test_a_fault_is_an_exception(capfd):
    with pytest.raises(vinesink.InternalError, match="boom; this is a fault in vinesink: please report it"):
        vinesink._vinesink._fail("boom")
    assert issubclass(vinesink.InternalError, RuntimeError)


def test_threads_share_a_case(case):
    expected = case.simulate(initial=(0, 0, 0, 1), periods=50).to_dict()
    found = []
    threads = [threading.Thread(target=lambda: found.append(case.simulate(initial=(0, 0, 0, 1), periods=50).to_dict()))
               for _ in range(8)]  # fmt: skip
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 8
