"""Shapes, units, errors and determinism of what takes and returns arrays."""

import hashlib
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest
import vinesink
from conftest import TABLE_1


def test_impacts_and_trajectory_are_of_one_motion(case):
    found = case.simulate(initial=(0, 0, 0, 1), discard=0, periods=40)
    log, scales = found.impact_log, case.scales
    period = scales.period / scales.time
    assert [log[name].dtype for name in ("tau", "side", "x")] == [np.float64, np.int8, np.float64]
    assert all(log[name].shape == (found.impacts,) for name in log.columns)
    # Just before an impact the absorber is on the wall, with the velocities before it. 1e-11 periods earlier is
    # farther than a time of 40 periods is rounded, and moves what has velocities and accelerations of about 1 by 1e-10.
    times = log.tau / period - 1e-11
    at = case.simulate(initial=(0, 0, 0, 1), discard=0, periods=1, times=times).trajectory
    assert np.allclose(at.x - at.y, log.side, rtol=0, atol=1e-9)
    assert np.allclose(at.xdot, log.xdot_before, rtol=0, atol=1e-9)
    assert np.allclose(at.ydot, log.ydot_before, rtol=0, atol=1e-9)
    # Momentum is handed over, and the wall leaves the absorber with r times the speed.
    relative = (log.xdot_after - log.ydot_after) / (log.xdot_before - log.ydot_before)
    assert np.allclose(relative, -0.6, rtol=1e-10)


def test_a_trajectory_begins_at_its_start_and_goes_on_beyond_the_window(case):
    start = (0.1, -0.2, 0.3, 0.4)
    found = case.simulate(initial=start, discard=0, periods=2, times=[0, 0, 0.5, 3, 7])
    assert found.trajectory.columns == ["periods", "x", "xdot", "y", "ydot"]
    rows = np.column_stack([found.trajectory[name] for name in ("x", "xdot", "y", "ydot")])
    assert rows.shape == (5, 4)
    assert rows[0].tolist() == rows[1].tolist() == list(start)
    # On from the state after three periods, as excitation phase 0 comes again.
    later = case.simulate(initial=rows[3], discard=0, periods=1, times=[4]).trajectory
    assert np.allclose([later.x[0], later.y[0]], [rows[4, 0], rows[4, 2]], rtol=0, atol=1e-12)


def test_without_a_start_the_trajectory_is_the_motion_itself(case):
    found = case.simulate(times=np.linspace(0, 1, 201))
    assert len(found.impact_log) == found.impacts == 2000
    highest = case.scales.length * np.abs(found.trajectory.x).max()
    # The largest of 200 samples of a sine is within 1 - cos(pi/200) of its peak.
    assert highest == pytest.approx(found.displacement.peak, rel=2e-4)
    assert found.trajectory.x[0] == pytest.approx(found.trajectory.x[-1], abs=1e-9)


@pytest.mark.parametrize("times", [[1, 0], [-1.0], [0, np.nan], [np.inf]])
def test_times_that_are_none(case, times):
    with pytest.raises(ValueError, match="ascending"):
        case.simulate(initial=(0, 0, 0, 1), times=times)


def test_starts_that_are_none(case):
    with pytest.raises(ValueError, match="outside the cavity"):
        case.simulate(initial=(0, 0, 1.5, 0))
    with pytest.raises(ValueError, match="not finite"):
        case.simulate(initial=(0, np.nan, 0, 0))
    with pytest.raises(ValueError, match="has 3 numbers"):
        case.simulate(initial=(0, 0, 0))
    with pytest.raises(ValueError, match="measure=False"):
        case.simulate(measure=False)


def test_many_are_each_as_if_alone(case):
    clearance = np.array([2e-3, 5e-3, 7.5e-3, 12e-3, 20e-3])
    start = (0.3, 0.0, -0.2, 0.8)
    found = vinesink.single_trajectories(case, clearance=clearance, initial=start)
    for k, metres in enumerate(clearance):
        alone = vinesink.single_trajectories(vinesink.Case(**{**TABLE_1, "clearance": f"{metres} m"}), initial=start)
        assert alone.shape == () and found.peak[k] == alone.peak[()] and found.regime[k] == alone.regime[()]
        assert (found.state[k] == alone.state).all()
    # A motion that simulate finds, in the same unit: both see it repeat to 1e-6.
    listed = case.simulate().to_pandas()
    assert found.regime[2] in set(listed.regime)
    assert found.peak[2] == pytest.approx(listed.peak[listed.regime == found.regime[2]].item(), rel=1e-6)


def test_values_are_those_of_the_case_file():
    case = vinesink.Case(**TABLE_1)
    same = {"mass": 4.168, "stiffness": 11470.0, "damping": 3.02, "absorber_mass": 0.032, "clearance": 7.5e-3,
            "restitution": 0.6, "amplitude": 0.25e-3, "frequency": 8.0}  # fmt: skip
    plain = vinesink.single_trajectories(case, initial=(0, 0, 0, 1))
    given = vinesink.single_trajectories(case, initial=(0, 0, 0, 1), **same)
    assert plain.peak == pytest.approx(given.peak, rel=1e-12)
    other = vinesink.single_trajectories(case, initial=(0, 0, 0, 1), mass_ratio=0.01, absorber_mass=[0.032])
    heavier = vinesink.Case(**{**TABLE_1, "absorber_mass": None, "mass_ratio": 0.01})
    assert other.peak[0] == pytest.approx(vinesink.single_trajectories(heavier, initial=(0, 0, 0, 1)).peak, rel=1e-9)


def test_shapes_are_broadcast(case):
    found = vinesink.single_trajectories(
        case, clearance=np.array([[4e-3], [8e-3]]), frequency=[7.9, 8.0, 8.1], initial=np.zeros((2, 1, 4)), periods=20
    )
    assert found.shape == found.peak.shape == found.regime.shape == (2, 3)
    assert found.state.shape == (2, 3, 4)
    assert len(found.to_pandas()) == 6
    with pytest.raises(ValueError):
        vinesink.single_trajectories(case, clearance=np.ones(2), frequency=np.ones(3))
    with pytest.raises(ValueError, match=r"\(\.\.\., 4\)"):
        vinesink.single_trajectories(case, initial=np.zeros((5, 3)))


def test_of_nothing_comes_nothing(case):
    found = vinesink.single_trajectories(case, clearance=[])
    assert found.shape == (0,) and found.peak.shape == (0,) and found.state.shape == (0, 4)
    assert len(found.to_pandas()) == len(found.to_polars()) == 0
    assert "0 rows" in found._repr_html_()
    grid = vinesink.single_trajectories(case, clearance=np.empty((3, 0)), initial=np.empty((3, 0, 4)))
    assert grid.shape == (3, 0)
    none = case.simulate(initial=(0, 0, 0, 0), discard=0, periods=3, times=[], measure=False)
    assert len(none.impact_log) == 0 and len(none.trajectory) == 0


@pytest.mark.parametrize(
    "parameters,message",
    [
        ({"clearance": [1e-3, 2e-3, -1e-3, -2e-3]}, r"element 2 \(clearance = -0.001\): .*expected"),
        ({"restitution": [0.5, 1.5]}, r"element 1 \(restitution = 1.5\): restitution is 1.5, expected a number from 0 to 1"),
        ({"frequency": [8.0, np.nan]}, r"element 1 \(frequency = NaN\)"),
        ({"frequency": [8.0, 8.1], "initial": [[0, 0, 0, 0], [0, 0, 2, 0]]}, r"element 1 \(frequency = 8.1\): .*outside the cavity"),
        ({"initial": [[0, 0, np.inf, 0]]}, "element 0: .*not finite"),
        ({"clerance": [1.0]}, "no `clerance` to vary; choose from clearance, frequency"),
        ({"detuning": [1.0]}, "no `detuning` to vary"),
    ],
)  # fmt: skip
def test_the_first_bad_element_is_named(case, parameters, message):
    with pytest.raises(ValueError, match=message):
        vinesink.single_trajectories(case, **parameters)


DIGEST = """
import hashlib, sys, numpy as np, vinesink
sys.path.insert(0, "tests")
from conftest import TABLE_1
found = vinesink.single_trajectories(vinesink.Case(**TABLE_1), clearance=np.linspace(1e-3, 20e-3, 2000), periods=60)
print(hashlib.sha256(b"".join(found[name].tobytes() for name in found.columns)).hexdigest())
"""


def test_the_same_bytes_on_any_number_of_processors(case):
    folder = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

    def digest(threads):
        environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
        done = subprocess.run([sys.executable, "-c", DIGEST], cwd=folder, env=environment, check=True, capture_output=True, timeout=120)
        return done.stdout

    assert digest(1) == digest(3) == digest(3)


def test_branch(case):
    found = vinesink.branch(case, "clearance", (2e-3, 25e-3))
    assert found.value.shape == found.peak.shape == found.stable.shape == (len(found),)
    assert found.multipliers.shape == (len(found), 4) and found.multipliers.dtype == np.complex128
    assert (found.stable == (found.admissible & (found.radius_per_period < 1))).all()
    # Exact clearances of the boundaries, which analyze has by another way: closed-form limits, not continuation.
    limits = case.analyze().exact.boundaries.symmetric.limits
    known = {one.kind: one.clearance * case.scales.length for one in limits}
    kinds = {one.kind: one.value for one in found.bifurcations}
    for kind in ("symmetry-breaking", "saddle-node"):
        assert kinds[kind] == pytest.approx(known[kind], rel=1e-9)
    # It is stable between these two; the orbit of the case itself is on it.
    inside = (found.value > kinds["symmetry-breaking"]) & (found.value < kinds["saddle-node"])
    assert (found.stable <= inside).all() and found.stable.any()
    stable = case.orbits().peak_displacement[case.orbits().stable]
    nearest = np.argmin(np.abs(found.value - 7.5e-3) + np.abs(found.peak - stable))
    assert found.value[nearest] == pytest.approx(7.5e-3, rel=1e-12)
    assert found.peak[nearest] == pytest.approx(stable.item(), rel=1e-9)
    assert [end.why for end in found.ends] == ["range", "grazing"]
    # Elsewhere it is the orbit of the case that has the value there: solved in closed form, not followed.
    for k in np.flatnonzero(found.stable)[::15]:
        there = vinesink.Case(**{**TABLE_1, "clearance": f"{found.value[k]:.17g} m"}).orbits()
        assert found.peak[k] == pytest.approx(there.peak_displacement[there.stable].item(), rel=1e-9)
    assert set(found.to_dict()) > {"parameter", "value", "bifurcations", "ends"}


def test_a_branch_in_the_units_of_its_parameter(case):
    by_frequency = vinesink.branch(case, "frequency", (7.5, 8.4))
    assert 7.4 < by_frequency.value.min() and by_frequency.value.max() < 8.5
    wider = vinesink.branch(case, "clearance", (5e-3, 10e-3))
    driven = vinesink.branch(case, "amplitude", (0.1e-3, 0.5e-3))
    # Twice the drive in twice the cavity is the same system, twice as large.
    breaks = [one.value for one in wider.bifurcations if one.kind == "saddle-node"]
    meets = [one.value for one in driven.bifurcations if one.kind == "saddle-node"]
    exact = case.analyze().exact.boundaries.symmetric.limits
    node = next(one.clearance for one in exact if one.kind == "saddle-node")
    assert not breaks and meets == [pytest.approx(0.25e-3 / node, rel=1e-9)]
    for found, key, unit in ((by_frequency, "frequency", "Hz"), (driven, "amplitude", "m")):
        k = np.flatnonzero(found.stable)[2]
        there = vinesink.Case(**{**TABLE_1, key: f"{found.value[k]:.17g} {unit}"}).orbits()
        assert found.peak[k] == pytest.approx(there.peak_displacement[there.stable].item(), rel=1e-9)


def test_branches_that_are_none(case):
    with pytest.raises(ValueError, match="no branch is followed along `mass`; choose one of clearance, frequency"):
        vinesink.branch(case, "mass", (1, 2))
    with pytest.raises(ValueError, match="the case's clearance is 0.0075, outside of 0.008 to 0.01"):
        vinesink.branch(case, "clearance", (8e-3, 10e-3))
    with pytest.raises(ValueError, match="there is no orbit 2; the case has 2"):
        vinesink.branch(case, "clearance", (5e-3, 10e-3), orbit=2)
    unstable = vinesink.branch(case, "clearance", (7e-3, 8e-3), orbit=0)
    assert not unstable.stable.any()


def test_reduced():
    case = vinesink.Case(mass_ratio=0.0076775, damping=1.799, restitution=0.6, clearance=1.0, forcing=4.342, detuning=-5.446)
    assert case.analyze().reduced.detuning == -5.446 and not case.scales.physical
    found = vinesink.single_trajectories(case, detuning=[-5.446, -5.0], initial=(0, 0, 0, 1))
    assert found.peak.shape == (2,) and (found.impacts_per_period > 0).all()
    tilted = vinesink.Case(mass_ratio=0.01, damping=1.8, restitution=[0.65, 0.55], clearance=1.0, forcing=4.3,
                           frequency_ratio=1.0, gravity_along=0.004, friction_acceleration=0.002)  # fmt: skip
    assert tilted.analyze().reduced.gravity_along == 0.004


def test_tables_and_other_excitations():
    case = vinesink.Case(
        **TABLE_1, simulation={"periods": 50, "starts": 4}
    )
    found = case.simulate()
    assert found.periods == 50
    released = {**TABLE_1, "kind": "free", "displacement": "15 mm", "amplitude": None, "frequency": None}
    assert vinesink.Case(**released).simulate().quantities
    swept = {**released, "kind": "sine-sweep", "displacement": None, "of": "base-displacement", "amplitude": "0.25 mm",
             "start": "7.5 Hz", "to": "9 Hz", "rate": "0.5 Hz/s"}  # fmt: skip
    noise = {**released, "kind": "record", "displacement": None, "quantity": "base-acceleration", "seed": 1,
             "spectrum": [[5, 0.02], [12, 0.02]], "duration": "20 s", "realisations": 2}  # fmt: skip
    assert "realisations = 2" in vinesink.Case(**noise).text
    case = vinesink.Case(**swept)
    with pytest.raises(ValueError, match="swept through resonance, and an analysis is about one that is driven steadily"):
        case.analyze()
    for refused in (case.orbits, lambda: vinesink.branch(case, "clearance", (1e-3, 1e-2)), lambda: vinesink.single_trajectories(case)):
        with pytest.raises(ValueError, match="swept through resonance"):
            refused()
    with pytest.raises(ValueError, match="not driven steadily"):
        case.simulate(periods=3)


def test_keywords_that_no_case_has():
    with pytest.raises(TypeError, match="no `clearence`; it has .*clearance"):
        vinesink.Case(**TABLE_1, clearence="1 mm")
    with pytest.raises(TypeError, match="a reduced case has no `mass`"):
        vinesink.Case(**TABLE_1, forcing=1.0)
    with pytest.raises(TypeError, match="no object"):
        vinesink.Case(**{**TABLE_1, "mass": object()})


def test_files_that_are_none(tmp_path):
    with pytest.raises(OSError, match="cannot read"):
        vinesink.Case.from_toml(tmp_path / "none.toml")
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="cannot"):
        vinesink.Case(**TABLE_1).report(tmp_path / "file" / "report")


def test_a_case_is_pickled(case):
    again = pickle.loads(pickle.dumps(case))
    assert again.text == case.text and again.title == case.title == "From Python"
    assert hashlib.sha256(again.text.encode()).digest() == hashlib.sha256(case.text.encode()).digest()
