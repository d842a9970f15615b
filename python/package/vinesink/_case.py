"""Cases, and what can be asked of them."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vinesink
from ._results import Analysis, Branch, Motions, Orbits, Simulation, Table

Progress = Callable[[int, int], object]

_SCHEMA = json.loads(_vinesink.schema())["properties"]
# Where one word is a key of two tables, or of Python: the keyword instead.
_RENAMED = {
    ("oscillator", "frequency"): "natural_frequency",
    ("absorber", "mass"): "absorber_mass",
    ("excitation", "from"): "start",
    ("reduced", "from"): "start",
}


def _keywords(table: str) -> dict[str, str]:
    """The keywords of a table, each with its key in the case file."""
    return {_RENAMED.get((table, key), key): key for key in _SCHEMA[table]["properties"]}


_PHYSICAL = {table: _keywords(table) for table in ("oscillator", "absorber", "excitation")}
_REDUCED = {"reduced": _keywords("reduced")}
# What only a reduced design has.
_ONLY_REDUCED = _REDUCED["reduced"].keys() - {keyword for keywords in _PHYSICAL.values() for keyword in keywords}
_SETTINGS = [
    name
    for name, table in _SCHEMA.items()
    if table.get("type") == "object" and name not in _PHYSICAL and name not in _REDUCED
]


class CaseWarning(UserWarning):
    """What is probably a slip in a case, such as kHz for Hz."""


class SimulationWarning(UserWarning):
    """A simulation that is not to be trusted; its document says why, in `doubts`."""


@dataclass(frozen=True)
class Scales:
    """What turns dimensionless numbers into the case's units: multiply a length over the clearance by `length`."""

    physical: bool
    """Whether the units are those of SI; else those of the reduced case."""
    length: float
    """The clearance."""
    time: float
    """Of fast time tau: 1/omega0."""
    velocity: float
    """Of clearances per fast time."""
    energy: float
    """Of m1 (b omega0)^2."""
    frequency: float
    """Of frequency ratios: the natural frequency in Hz, 1 for a reduced case."""
    period: float
    """The excitation period."""


def _toml(value: Any) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(str(key))} = {_toml(one)}" for key, one in value.items()) + " }"
    if isinstance(value, (Sequence, np.ndarray)):
        return "[" + ", ".join(_toml(one) for one in value) + "]"
    raise TypeError(f"a case has text, numbers, true and false, lists and tables, but no {type(value).__name__}")


def _text_of(title: str, source: str, given: dict[str, Any]) -> str:
    reduced = not _ONLY_REDUCED.isdisjoint(given)
    tables = _REDUCED if reduced else _PHYSICAL
    lines = [f"title = {_toml(title)}", f"source = {_toml(source)}"]
    known = {keyword for keywords in tables.values() for keyword in keywords}
    for name in given:
        if name not in known and name not in _SETTINGS:
            what = "a reduced case" if reduced else "a case in physical units"
            raise TypeError(f"{what} has no `{name}`; it has {', '.join((*sorted(known), *_SETTINGS))}")
    for table, keywords in tables.items():
        present = [f"{key} = {_toml(given[keyword])}" for keyword, key in keywords.items() if keyword in given]
        if present:
            lines += ["", f"[{table}]", *present]
    for table in _SETTINGS:
        if table in given:
            lines += ["", f"[{table}]", *(f"{json.dumps(key)} = {_toml(one)}" for key, one in given[table].items())]
    return "\n".join(lines) + "\n"


class Case:
    """A design: structure, absorber, excitation, and what is asked of them.

    Keywords are the keys of a case file, quantities with their unit as there::

        Case(mass="4.168 kg", stiffness="11.47 kN/m", damping="3.02 N s/m", absorber_mass="32 g",
             clearance="7.5 mm", restitution=0.6, kind="base-displacement", amplitude="0.25 mm", frequency="8 Hz")

    In physical units:

    - structure: `mass`, `stiffness` or `natural_frequency`, `damping` or `damping_ratio`;
    - absorber: `absorber_mass` or `mass_ratio`, `clearance`, `restitution` (a number, or one for each wall),
      `inclination`, `friction`;
    - excitation: `kind` ("base-displacement", "force", "free", "impulse", "sine-sweep", "record") and the keys of
      that kind: `amplitude`, `frequency`; `displacement`, `velocity`; `impulse`; `of`, `start` (`from` in a file), `to`,
      `rate`; `quantity`, and `file` or `spectrum`, `duration`, `seed`, `realisations`.

    Reduced, with pure numbers: `mass_ratio`, `damping`, `restitution`, `clearance`, `forcing`, `frequency_ratio` or
    `detuning`, `gravity_along`, `friction_acceleration`, and `kind`.

    Further tables of a case file are dicts: `simulation`, `report`, `accuracy`, `band`, `criteria`, `optimize`,
    `uncertainty`, `sweep`.

    `text` is the case file that the keywords make; messages name its lines.

    Raises
    ------
    CaseError
        With the program's message: what is wrong where, and what to do.
    TypeError
        A keyword that no case has.
    """

    def __init__(self, *, title: str = "From Python", source: str = "keywords of vinesink.Case", **keys: Any) -> None:
        given = {name: value for name, value in keys.items() if value is not None}
        self._read(_vinesink.Case.parse("Case(...)", _text_of(title, source, given), os.getcwd(), True))

    def _read(self, core: _vinesink.Case) -> None:
        self._core = core
        for warning in core.warnings():
            warnings.warn(warning, CaseWarning, stacklevel=3)

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str], *, allow_outside: bool = False) -> Case:
        """A case from the path of its file, or from its text: what has an `=` and a line's end is a text.

        A record that it names is below the folder of its file, or the working folder, unless `allow_outside`.

        Raises `CaseError` with everything that is wrong with it, `OSError` for a file that cannot be read.
        """
        case = cls.__new__(cls)
        text = isinstance(source, str) and "\n" in source and "=" in source
        if text:
            core = _vinesink.Case.parse("text", str(source), os.getcwd(), allow_outside)
        else:
            core = _vinesink.Case.read(source, allow_outside)
        case._read(core)
        return case

    def __repr__(self) -> str:
        return f"Case({self.title!r})"

    def _repr_html_(self) -> str:
        import html

        return f"<pre>{html.escape(self.text)}</pre>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Case.from_toml, (self.text,))

    @property
    def title(self) -> str:
        """What the case is, in a line."""
        return self._core.title

    @property
    def source(self) -> str:
        """Where its numbers come from."""
        return self._core.source

    @property
    def text(self) -> str:
        """The text of its case file."""
        return self._core.text

    @property
    def scales(self) -> Scales:
        """What turns dimensionless numbers into the case's units."""
        return Scales(**self._core.scales())

    def analyze(self, *, progress: Progress | None = None) -> Analysis:
        """What theory and exact orbits say: the document of `vinesink analyze --format json`.

        Raises `ValueError` where the case cannot be analysed, such as one that is swept.
        """
        return Analysis(json.loads(self._core.analyze(progress)))

    def orbits(self) -> Orbits:
        """The exact periodic orbits with two impacts per period: in an ideal cavity the symmetric ones, else all."""
        return Orbits(json.loads(self._core.orbits()))

    def simulate(
        self,
        *,
        periods: int | None = None,
        discard: int | None = None,
        initial: Sequence[float] | None = None,
        times: ArrayLike | None = None,
        measure: bool = True,
        progress: Progress | None = None,
    ) -> Simulation:
        """Simulates impact by impact, as `vinesink simulate`.

        Without `initial` every long-term motion is looked for: `motions` has them all, and the numbers are those of the
        moving one that most starts lead to.

        Parameters
        ----------
        periods
            Excitation periods that are measured; those of the case, or 1000.
        discard
            Excitation periods left out before; those of the case, or until the transient has faded.
        initial
            One start `(x, xdot, y, ydot)` at excitation phase 0, over the clearance, per fast time.
        times
            Times, shape (n,), ascending, in excitation periods from the start of the run (where no `initial` is given,
            from a state on the motion), at which `trajectory` has the state.
        measure
            With False the impacts alone of the run from `initial`, several times as fast; the document is empty.
        progress
            Called with the steps done and all steps, about ten times a second.

        A structure that is not driven steadily has no impacts and no trajectory here, only its document.
        Warns with `SimulationWarning` where the numbers are not to be trusted. Raises `ValueError` for a start outside
        of the cavity.
        """
        start = None if initial is None else [float(one) for one in initial]
        if start is not None and len(start) != 4:
            raise ValueError(f"initial has {len(start)} numbers, expected four: x, xdot, y, ydot")
        if not self._core.steady:
            if any(given is not None for given in (periods, discard, initial, times)) or not measure:
                raise ValueError("the structure is not driven steadily: the case itself says what becomes of it; call simulate()")
            text, _, _ = self._core.simulate(None, None, None, progress)
            return Simulation(json.loads(text), Table({}), None)
        document: dict[str, Any] = {}
        if measure:
            text, impacts, start = self._core.simulate(periods, discard, start, progress)
            document = json.loads(text)
        elif start is None:
            raise ValueError("measure=False follows one start: give initial=(x, xdot, y, ydot)")
        else:
            impacts = self._core.fly(periods, discard, start, progress)
        if not document.get("trusted", True):
            words = "; ".join(f"{one['words']}; {one['advice']}" for one in document["doubts"])
            warnings.warn(f"not to be trusted: {words}", SimulationWarning, stacklevel=2)
        trajectory = None
        if times is not None:
            at = np.ascontiguousarray(times, dtype=float).reshape(-1)
            states = self._core.trajectory(start, at).reshape(-1, 4)
            columns = dict(zip(("x", "xdot", "y", "ydot"), states.T))
            trajectory = Table({"periods": at, **columns})
        return Simulation(document, Table(impacts), trajectory)

    def report(
        self, folder: str | os.PathLike[str], *, name: str | None = None, progress: Progress | None = None
    ) -> bool:
        """Writes the design report into a folder, the same files as `vinesink report`: report.md, report.html,
        report.json and figures.

        A report appears whole or not at all; other files in the folder stay. `name` is that of the case's file, else of the
        folder. Returns whether its simulations are to be trusted and what the case asks of accuracy holds. Raises
        `OSError` where the folder cannot be written.
        """
        name = name or self._core.stem or Path(folder).resolve().name
        return self._core.report(os.fspath(folder), name, progress)


def branch(
    case: Case,
    parameter: str,
    range: Sequence[float],
    *,
    orbit: int | None = None,
    most_points: int = 2000,
) -> Branch:
    """Exact orbits along a parameter, with stability and bifurcations.

    Parameters
    ----------
    parameter
        "clearance" (m), "frequency" (Hz), "amplitude" (m or N), "restitution", "gravity_along" or
        "friction_acceleration" (over b omega0^2); in a reduced case its own units.
    range
        The lowest and the highest value; the case's own lies between.
    orbit
        The place in `case.orbits()` of the orbit to begin with; unless given the one that attracts.
    most_points
        Points in either direction after which the branch is given up.

    Raises `ValueError` where there is no such orbit or parameter, or the range leaves out the case.
    """
    low, high = (float(edge) for edge in range)
    columns, told = case._core.branch(parameter, [low, high], orbit, most_points)
    return Branch(parameter, columns, json.loads(told))


def simulate_many(
    case: Case,
    *,
    initial: ArrayLike | None = None,
    periods: int = 250,
    discard: int | None = None,
    progress: Progress | None = None,
    **parameters: ArrayLike,
) -> Motions:
    """The long-term motion of each of many systems, sixteen side by side on every processor.

        simulate_many(case, clearance=np.linspace(2e-3, 20e-3, 1000)).peak

    Parameters
    ----------
    parameters
        Arrays of numbers of the case, in SI or the units of a reduced case: `clearance`, `frequency`, `amplitude`,
        `restitution`, `mass`, `absorber_mass`, `mass_ratio`, `stiffness`, `damping`, `damping_ratio`, `inclination`,
        `friction`, or for a reduced case `detuning`, `gravity_along`, `friction_acceleration`. They are broadcast;
        everything else is as in the case.
    initial
        Starts `(x, xdot, y, ydot)`, shape (..., 4), broadcast with the parameters; unless given from rest, the absorber
        halfway between the middle and a wall.
    periods
        Excitation periods that a motion is measured over which is not seen to repeat.
    discard
        Excitation periods left out before; unless given until the transient has faded.
    progress
        Called with the number of elements done and of all, about ten times a second; what it raises ends the work.

    Other threads run meanwhile, and Ctrl-C ends it. The same input gives the same bits on any number of processors.
    Raises `ValueError`, which names the first element that is impossible and why.
    """
    arrays = {name: np.asarray(values, dtype=float) for name, values in parameters.items()}
    starts = None if initial is None else np.asarray(initial, dtype=float)
    if starts is not None and (starts.ndim == 0 or starts.shape[-1] != 4):
        raise ValueError(f"initial has the shape {starts.shape}, expected (..., 4): x, xdot, y, ydot")
    shapes = [one.shape for one in arrays.values()] + ([] if starts is None else [starts.shape[:-1]])
    shape = np.broadcast_shapes(*shapes)
    values = np.empty((len(arrays), int(np.prod(shape))))
    for row, one in zip(values, arrays.values()):
        row[:] = np.broadcast_to(one, shape).reshape(-1)
    if starts is not None:
        starts = np.ascontiguousarray(np.broadcast_to(starts, (*shape, 4)).reshape(-1, 4))
    columns = _vinesink.simulate_many(case._core, list(arrays), values, starts, periods, discard, progress)
    names: NDArray[np.str_] = np.array([*_vinesink.regimes(), ""])
    columns["regime"] = names[columns["regime"]]
    return Motions(columns, shape)
