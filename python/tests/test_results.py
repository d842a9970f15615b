"""Documents and tables as notebooks and data frames see them."""

import subprocess
import sys
from html.parser import HTMLParser

import numpy as np
import pytest
import vinesink


class Balanced(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.cells = [], 0

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        self.cells += tag == "td"

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def cells(html):
    parser = Balanced()
    parser.feed(html)
    assert not parser.open
    return parser.cells


def results(case):
    return {
        "analysis": case.analyze(),
        "orbits": case.orbits(),
        "simulation": case.simulate(),
        "branch": vinesink.branch(case, "clearance", (7e-3, 8e-3)),
        "motions": vinesink.single_trajectories(case, clearance=[4e-3, 5e-3]),
    }


def test_every_result_is_shown_and_becomes_data_frames(case):
    for name, result in results(case).items():
        assert cells(result._repr_html_()) > 5, name
        pandas, polars = result.to_pandas(), result.to_polars()
        assert len(pandas) == len(polars) > 0, name
        assert isinstance(result.to_dict(), dict) and repr(result), name
        numbers = [column for column in pandas if pandas[column].dtype == float]
        assert numbers, name
        for column in numbers:
            np.testing.assert_array_equal(pandas[column].to_numpy(), polars[column].to_numpy())
    assert "4.168 kg" in case._repr_html_()


def test_shares_of_starts(case):
    # Of starts; that of an absorber at rest is of its resting places instead.
    moving = case.simulate().to_pandas().query("kind != 'rest'").share
    assert moving.iloc[0] == 1.0 and moving.sum() == 1.0


def test_multipliers_in_polars_are_two_columns(case):
    frame = case.orbits().to_polars()
    values = frame["multipliers_0_re"].to_numpy() + 1j * frame["multipliers_0_im"].to_numpy()
    np.testing.assert_array_equal(values, case.orbits().multipliers[:, 0])


def test_records(case):
    found = case.analyze()
    assert found.manifold.fold.B == found["manifold"]["fold"]["B"]
    assert {"area", "manifold", "to_dict"} <= set(dir(found)) and "area" in found and len(found) == len(list(found))
    with pytest.raises(AttributeError, match="Analysis has no `aera`; it has area"):
        found.aera
    with pytest.raises(KeyError):
        found["aera"]
    found.to_dict()["area"] = "changed"
    assert found.area != "changed"


def test_tables(case):
    found = vinesink.single_trajectories(case, clearance=[4e-3, 5e-3])
    assert "peak" in dir(found) and (found["peak"] == found.peak).all() and len(found) == 2
    with pytest.raises(AttributeError, match="Motions has no column `paek`; it has clearance, peak"):
        found.paek


def test_titles_are_escaped(case):
    text = case.text.replace("From Python", "<b>&")
    assert "<b>" not in vinesink.Case.from_toml(text)._repr_html_()


def test_data_frames_are_no_dependencies():
    code = "import sys, vinesink; assert not {'pandas', 'polars', 'matplotlib'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


def test_versions(program):
    from importlib.metadata import requires, version

    assert vinesink.__version__ == version("vinesink")
    assert program("--version").stdout == f"vinesink {vinesink.__version__}\n"
    assert requires("vinesink") == ["numpy>=1.24"]


def test_types(tmp_path):
    """Stubs and annotations are those of the package as it is installed. Types of pandas itself would be one more package."""
    for command in (["mypy", "--strict", "--disable-error-code=import-untyped", "-p", "vinesink"], ["mypy.stubtest", "vinesink._vinesink"]):
        done = subprocess.run([sys.executable, "-m", *command], cwd=tmp_path, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stdout + done.stderr


def test_everything_public_says_what_it_is():
    for name in vinesink.__all__:
        public = getattr(vinesink, name)
        if isinstance(public, str):
            continue
        assert public.__doc__, name
        members = vars(public).items() if isinstance(public, type) else ()
        for member, value in members:
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"
