"""Cases of several modes or absorbers: Python and the program say the same, to the bit."""

import pickle

import pytest
import vinesink
from conftest import CASES

SEVERAL = CASES / "several"
# One load at one frequency.
SHORT = """
title = "A floor"
source = "test"
[[mode]]
frequency = "2 Hz"
damping_ratio = "1 %"
mass = "100 kg"
shape = { middle = 1.0, quarter = 0.7 }
[[mode]]
frequency = "7 Hz"
damping_ratio = "1 %"
mass = "100 kg"
shape = { middle = 0.0, quarter = 1.0 }
[[absorber]]
place = "middle"
mass = "3 kg"
clearance = "4 mm"
restitution = 0.5
[[excitation]]
kind = "force"
place = "middle"
amplitude = "10 N"
frequency = "2 Hz"
[criteria]
peak_displacement = "<= 9 mm"
"""


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "floor.toml"
    path.write_text(SHORT)
    return path


def test_commands(path, printed):
    case = vinesink.Case.from_toml(path)
    assert case.places == ["middle", "quarter"] and case.title == "A floor"
    assert case.analyze().to_dict() == printed("analyze", path)
    assert case.simulate().to_dict() == printed("simulate", path)
    (expected,) = printed("check", path)["cases"]
    found = case.check()
    assert found.to_dict() == expected
    assert bool(found) == expected["holds"]
    assert list(found.to_pandas().name) == [one["name"] for one in expected["criteria"]]


def test_impacts_are_those_of_the_file(path, program, tmp_path):
    found = vinesink.Case.from_toml(path).simulate(periods=9).impact_log
    assert program("simulate", path, "--periods", "9", "--impacts", tmp_path / "impacts.csv").returncode == 0
    head, *rows = (tmp_path / "impacts.csv").read_text().splitlines()
    assert head.split(",") == found.columns and len(rows) == len(found.tau) > 9
    for column, name in enumerate(found.columns):
        written = [row.split(",")[column] for row in rows]
        assert list(found[name]) == (written if name == "motion" else [float(one) for one in written]), name


def test_compare_is_of_any_structure(path):
    case = vinesink.Case.from_toml(path)
    other = vinesink.Case.from_toml(SHORT.replace("4 mm", "6 mm"))
    changed = vinesink.compare(case, other)
    assert "clearance" in changed.markdown and "clearance" not in vinesink.compare(case, case).markdown


def test_motions_are_rows_as_of_one_mode(path):
    found = vinesink.Case.from_toml(path).motions()
    assert set(found.load) == {1} and set(found.kind) <= {"orbit", "rest", "repeats", "wanders"}
    assert (found.peak > 0.0).all() and ((found.efficiency >= 0.0) & (found.efficiency <= 1.0)).all()
    assert list(found.to_pandas().columns)[1:] == vinesink.Case.from_toml(CASES / "mast-mode-1.toml").motions().columns


def test_names_of_the_version_before(path):
    case = vinesink.ModalCase.from_toml(path)
    assert isinstance(case, vinesink.Case) and pickle.loads(pickle.dumps(case)).text == case.text
    assert vinesink.ModalCase(SHORT).places == case.places and vinesink.ModalOptimum is vinesink.Optimum


def test_ranges(tmp_path, printed):
    path = tmp_path / "floor.toml"
    path.write_text(SHORT.replace("9 mm", "16 mm") + "[uncertainty]\nclearance = '0.1 mm'\nsamples = 20\n")
    case = vinesink.Case.from_toml(path)
    (expected,) = printed("check", path)["cases"]
    found = case.check()
    assert found and found.to_dict() == expected
    assert {one["parameter"] for one in expected["holds_for"]} >= {"amplitude", "clearance", "natural-frequency"}
    assert expected["reliability"]["samples"] == 20
    assert {one["which"] for one in expected["alternatives"]} >= {"absorber", "no-absorber", "damper", "damper-in-equal-room"}
    alone = case.check(criteria_only=True).to_dict()
    assert alone["holds"] and "alternatives" not in alone and "holds_for" not in alone and "reliability" not in alone


def test_optimize(path, printed):
    expected = printed("optimize", path)
    found = vinesink.Case.from_toml(path).optimize()
    assert repr(found).startswith("Optimum(clearance=")
    with pytest.raises(vinesink.RefusedError, match="area of the theory of one mode"):
        vinesink.Case.from_toml(path).optimize(objective="z3-share")
    with pytest.raises(vinesink.RefusedError, match="there is no objective"):
        vinesink.Case.from_toml(path).optimize(objective="best")
    assert found.to_dict() == expected
    assert found.succeeds == bool(found) == (found.case is not None)
    if found:
        assert isinstance(found.case, vinesink.Case) and found.case.check()


def test_sweep(tmp_path, program):
    with pytest.raises(vinesink.RefusedError, match="no table"):
        vinesink.Case.from_toml(SHORT).sweep()
    path = tmp_path / "floor.toml"
    path.write_text(SHORT + '[sweep]\nclearance = { from = "2 mm", to = "6 mm", count = 3 }\n')
    found = vinesink.Case.from_toml(path).sweep()
    assert program("sweep", path, "--csv", "--out", tmp_path / "out").returncode == 0
    head, *rows = (tmp_path / "out/floor/sweep.csv").read_text().splitlines()
    names = [name.split(" [")[0] for name in head.split(",")][1:]
    for column, name in enumerate(names, 1):
        written = [row.split(",")[column] for row in rows]
        if name == "limits":
            assert list(found[name]) == written
        else:
            assert list(found[name]) == [float(one) for one in written]


def test_report(path, tmp_path, program):
    vinesink.Case.from_toml(path).report(tmp_path / "python")
    assert program("report", path, "--out", tmp_path / "program").returncode == 0
    files = {one.relative_to(tmp_path / "python") for one in (tmp_path / "python").rglob("*") if one.is_file()}
    assert {str(one) for one in files} >= {"report.md", "report.html", "report.json"}
    for one in files:
        assert (tmp_path / "python" / one).read_bytes() == (tmp_path / "program" / "floor" / one).read_bytes(), one


def test_modes_in_a_file_and_other_processes():
    case = vinesink.Case.from_toml(SEVERAL / "mast-two.toml")
    assert case.places == ["tip", "middle"]
    assert pickle.loads(pickle.dumps(case)).analyze() == case.analyze()


def test_what_it_is_not(path):
    case = vinesink.Case.from_toml(path)
    for ask in (case.orbits, case.plot_map, lambda: case.scales, lambda: case.value("clearance"), lambda: case.replace(clearance="1 mm")):
        with pytest.raises(vinesink.RefusedError, match="several modes or absorbers"):
            ask()
    with pytest.raises(vinesink.RefusedError, match="starts are those of the search"):
        case.simulate(discard=9)
    with pytest.raises(vinesink.RefusedError, match="several modes or absorbers"):
        vinesink.branch(case, "clearance", ["1 mm", "9 mm"])
    with pytest.raises(vinesink.CaseError, match="place at which no mode has a shape") as raised:
        vinesink.Case.from_toml(SHORT.replace('place = "middle"\nmass', 'place = "midle"\nmass'))
    assert raised.value.problems[0]["line"] == 15
    with pytest.raises(vinesink.RefusedError, match="no criteria"):
        vinesink.Case.from_toml(SHORT[: SHORT.index("[criteria]")]).check()
    with pytest.raises(AttributeError):
        vinesink.Case.from_toml(path).clearance = "2 mm"
    with pytest.raises(vinesink.FileError):
        vinesink.Case.from_toml("no/such.toml")


def test_a_slip_is_warned_of_where_the_case_is_read(path):
    path.write_text(SHORT.replace('"1 %"', "0.5", 1))
    for read in (lambda: vinesink.Case.from_toml(path), lambda: vinesink.ModalCase(path.read_text())):
        with pytest.warns(vinesink.CaseWarning, match="a damping ratio is 50 %") as warned:
            read()
        assert [one.filename for one in warned] == [__file__]
