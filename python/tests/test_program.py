"""Python and the program say the same, to the bit: every number is compared with `==`."""

import numpy as np
import pandas
import pytest
import vinesink
from conftest import CASES, TABLE_1

STEADY = ["li2016-8hz-b7p5mm", "li2016-8hz-b15mm", "li2016-8p5hz-fig4d", "force-on-mass", "reduced-unit-clearance"]
TILTED = (CASES / "li2016-8hz-b7p5mm.toml").read_text().replace(
    "restitution = 0.6", 'restitution = [0.65, 0.55]\ninclination = "0.3 deg"\nfriction = 0.01'
)


def read(name):
    return vinesink.Case.from_toml(CASES / f"{name}.toml")


@pytest.mark.parametrize("name", [*STEADY, "footbridge-jump"])
def test_analyze(name, printed):
    expected = printed("analyze", CASES / f"{name}.toml")
    assert read(name).analyze().to_dict() == expected


def test_accuracy_is_answered(tmp_path, printed):
    path = tmp_path / "case.toml"
    path.write_text((CASES / "li2016-8hz-b7p5mm.toml").read_text() + "\n[accuracy]\namplitude = \"1 %\"\n")
    expected = printed("analyze", path)
    assert "answers" in expected
    assert vinesink.Case.from_toml(path).analyze().to_dict() == expected


@pytest.mark.parametrize("name", STEADY)
def test_orbits_are_those_of_analyze(name, printed):
    expected = printed("analyze", CASES / f"{name}.toml")["orbits"]
    orbits = read(name).orbits()
    assert len(orbits) == len(expected)
    for one, other in zip(orbits, expected):
        assert {key: one.to_dict()[key] for key in other} == other
        assert complex(*other["multipliers"][0]) in orbits.multipliers[:, 0]


def test_orbits_of_a_real_cavity(tmp_path, printed):
    path = tmp_path / "tilted.toml"
    path.write_text(TILTED)
    expected = printed("analyze", path)["exact"]["two_impact"]["orbits"]
    orbits = vinesink.Case.from_toml(path).orbits()
    assert len(orbits) == len(expected) > 0
    for one, other in zip(orbits, expected):
        assert one["multipliers"] == other["multipliers"]["values"]
        assert one.admissible == other["admissibility"]["admissible"]


@pytest.mark.parametrize("name", [*STEADY[:3], "sweep-fast", "footbridge-jump", "tower-record"])
def test_simulate_from_many_starts(name, printed):
    expected = printed("simulate", CASES / f"{name}.toml")
    assert read(name).simulate().to_dict() == expected


@pytest.mark.parametrize("text", [(CASES / "li2016-8p5hz-fig4d.toml").read_text(), TILTED])
def test_one_start_and_its_impacts(text, tmp_path, printed):
    (tmp_path / "case.toml").write_text(text)
    file = tmp_path / "impacts.csv"
    options = ["--periods", 300, "--discard", 10, "--initial", "0,0.01,0.2,-0.5", "--impacts", file]
    expected = printed("simulate", tmp_path / "case.toml", *options)
    given = {"periods": 300, "discard": 10, "initial": (0, 0.01, 0.2, -0.5)}
    case = vinesink.Case.from_toml(text)
    found = case.simulate(**given)
    assert found.to_dict() == expected
    written = pandas.DataFrame(np.genfromtxt(file, delimiter=",", names=True))
    assert len(written) > 100
    for log in (found.impact_log, case.simulate(**given, measure=False).impact_log):
        assert log.columns == list(written.columns)
        pandas.testing.assert_frame_equal(log.to_pandas(), written, check_dtype=False, check_exact=True)


# A band with criteria, a transient, one with every further figure, one that a record drives, accuracy.
@pytest.mark.parametrize("name", ["li2016-8p5hz-fig4c", "li2016-band", "sweep-fast", "tower-record", "force-on-mass"])
def test_report(name, tmp_path, program):
    done = program("report", CASES / f"{name}.toml", "--out", tmp_path / "program")
    assert done.returncode == 0, done.stderr
    assert read(name).report(tmp_path / "python" / name) is True
    files = [{one.relative_to(top): one.read_bytes() for one in top.rglob("*") if one.is_file()}
             for top in (tmp_path / "program" / name, tmp_path / "python" / name)]  # fmt: skip
    assert len(files[0]) > 3
    assert files[0] == files[1]


@pytest.mark.parametrize("old,new", [("source =", "#"), ('"7.5 mm"', '"7.5 Hz"'), ("restitution", "restituton"), ('"4.168 kg"', '"-1 kg"')])
def test_errors_are_the_programs(old, new, tmp_path, program):
    path = tmp_path / "case.toml"
    path.write_text((CASES / "li2016-8hz-b7p5mm.toml").read_text().replace(old, new))
    done = program("analyze", path)
    assert done.returncode == 2
    with pytest.raises(vinesink.CaseError) as raised:
        vinesink.Case.from_toml(path)
    assert str(raised.value).split() == done.stderr.split()
    assert [line.rstrip() for line in str(raised.value).splitlines()] == [
        line.rstrip() for line in done.stderr.rstrip("\n").splitlines()
    ]
    first = raised.value.problems[0]
    assert first["line"] >= 1 and first["message"] in str(raised.value) and first["help"]
    assert isinstance(raised.value, ValueError)


def test_slips_are_warned_of(program, tmp_path):
    with pytest.warns(vinesink.CaseWarning, match="kHz|Hz") as warned:
        case = vinesink.Case(**{**TABLE_1, "frequency": "8 kHz"})
    path = tmp_path / "Case(...)"
    path.write_text(case.text)
    assert str(warned[0].message).splitlines()[0] in program("analyze", path).stderr
    assert warned[0].filename == __file__


def test_keywords_make_the_case_of_the_file(printed):
    """The shipped case has the same numbers, so that all results are the same."""
    found = vinesink.Case(**TABLE_1).analyze().to_dict()
    shipped = printed("analyze", CASES / "li2016-8hz-b7p5mm.toml")
    for document in (found, shipped):
        # What says which text it is of.
        for key in ("title", "source", "provenance"):
            document.pop(key)
    assert found == shipped


def test_a_simulation_that_is_not_to_be_trusted_warns(program, tmp_path):
    # Undamped and driven at resonance, it grows until rounding hides the walls.
    huge = {**TABLE_1, "stiffness": None, "natural_frequency": "8 Hz", "damping": "0 N s/m", "amplitude": "1e12 m"}
    case = vinesink.Case(**huge)
    with pytest.warns(vinesink.SimulationWarning, match="not to be trusted"):
        found = case.simulate(initial=(0, 0, 0.5, 0), periods=100, discard=0)
    assert found.trusted is False
