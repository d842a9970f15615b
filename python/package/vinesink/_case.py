"""Cases, and what can be asked of them."""

from __future__ import annotations

import difflib
import json
import os
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, Optional, TypedDict, Union, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vinesink
from ._errors import RefusedError
from ._quantities import AstropyLike, PintLike, Quantity, parts, written
from ._results import Analysis, Branch, Check, Difference, Motions, Optimum, Orbits, Simulation, Sweep, Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Unpack

Progress = Union[Callable[[int, int], object], bool]
"""Called with the steps done and all steps, about ten times a second; True is a bar of `tqdm`, where that is installed."""

Pair = Sequence[float]
Settings = Optional[Mapping[str, Any]]
Word = Optional[str]
Count = Optional[int]
Number = Optional[float]
Values = Union[ArrayLike, PintLike, AstropyLike]


class Keys(TypedDict, total=False):
    """What a case has, by the keys of a case file."""

    mass: Quantity
    stiffness: Quantity
    natural_frequency: Quantity
    damping: Quantity
    damping_ratio: Quantity
    absorber_mass: Quantity
    mass_ratio: Quantity
    clearance: Quantity
    restitution: Number | Pair
    inclination: Quantity
    orientation: Word
    friction: Quantity
    support: Word
    support_frequency: Quantity
    support_room: Quantity
    contact_time: Quantity
    kind: Word
    amplitude: Quantity
    frequency: Quantity
    displacement: Quantity
    velocity: Quantity
    impulse: Quantity
    of: Word
    start: Quantity
    to: Quantity
    rate: Quantity
    quantity: Word
    file: Word
    spectrum: Sequence[Pair] | None
    duration: Quantity
    seed: Count
    realisations: Count
    forcing: Number
    frequency_ratio: Number
    detuning: Number
    gravity_along: Number
    friction_acceleration: Number
    simulation: Settings
    report: Settings
    accuracy: Settings
    band: Settings
    criteria: Settings
    alternatives: Settings
    optimize: Settings
    uncertainty: Settings
    sweep: Settings


class Parameters(TypedDict, total=False):
    """Numbers of a case that may be arrays: in SI or the units of a reduced case, or with a unit of their own."""

    mass: Values
    stiffness: Values
    damping: Values
    damping_ratio: Values
    absorber_mass: Values
    mass_ratio: Values
    natural_frequency: Values
    clearance: Values
    restitution: Values
    inclination: Values
    friction: Values
    amplitude: Values
    frequency: Values
    forcing: Values
    frequency_ratio: Values
    detuning: Values
    gravity_along: Values
    friction_acceleration: Values


# Of each of these a case has one: the other goes where one is replaced.
_EITHER = (
    {"stiffness", "natural_frequency"},
    {"damping", "damping_ratio"},
    {"absorber_mass", "mass_ratio"},
    {"inclination", "orientation"},
    {"frequency_ratio", "detuning"},
)

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
    if not isinstance(value, (str, bool, int, float, np.generic, np.ndarray, Mapping, Sequence)):
        value = written(value)
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


def _meant(name: str, names: Sequence[str]) -> str:
    """What was probably meant, in words; nothing where nothing is close."""
    close = difflib.get_close_matches(name, names, n=1, cutoff=0.7)
    return f" (did you mean `{close[0]}`?)" if close else ""


def _case_of(case: object) -> Case:
    """The case that a function is given, or what to do instead."""
    if not isinstance(case, Case):
        raise RefusedError(f"expected a Case, not a {type(case).__name__}: Case.from_toml reads one from its file")
    return case


def _level() -> int:
    """The level of the caller's frame that is not of this package, as `warnings.warn` counts from its own caller."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and Path(frame.f_code.co_filename).parent == Path(__file__).parent:
        level, frame = level + 1, frame.f_back
    return level


def _whole(name: str, value: int | None, least: int) -> int | None:
    """A count, or None; what is none is refused."""
    if value is None:
        return None
    if not isinstance(value, (int, np.integer)) or isinstance(value, bool) or value < least:
        raise RefusedError(f"{name} is {value!r}, expected a whole number from {least} on")
    return int(value)


def _told(progress: Progress | None) -> Callable[[int, int], object] | None:
    """What is called with the steps done and all steps."""
    if not isinstance(progress, bool):
        return progress
    if not progress:
        return None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    bar = tqdm(total=0, leave=False)

    def tell(done: int, steps: int) -> None:
        bar.total = steps
        bar.n = done
        bar.refresh()
        if done >= steps:
            bar.close()

    return tell


def _given_of(document: dict[str, Any]) -> dict[str, Any]:
    """The keywords of the tables of a case file."""
    given: dict[str, Any] = {}
    for table, keys in document.items():
        if table in _PHYSICAL or table in _REDUCED:
            given |= {_RENAMED.get((table, key), key): value for key, value in keys.items()}
        elif isinstance(keys, dict):
            given[table] = keys
    return given


def _text_of(title: str, source: str, given: dict[str, Any]) -> str:
    reduced = not _ONLY_REDUCED.isdisjoint(given)
    tables = _REDUCED if reduced else _PHYSICAL
    lines = [f"title = {_toml(title)}", f"source = {_toml(source)}"]
    known = {keyword for keywords in tables.values() for keyword in keywords}
    for name in given:
        if name not in known and name not in _SETTINGS:
            what = "a reduced case" if reduced else "a case in physical units"
            names = (*sorted(known), *_SETTINGS)
            raise TypeError(f"{what} has no `{name}`; it has {', '.join(names)}{_meant(name, names)}")
    for table, keywords in tables.items():
        present = [f"{key} = {_toml(given[keyword])}" for keyword, key in keywords.items() if keyword in given]
        if present:
            lines += ["", f"[{table}]", *present]
    for table in _SETTINGS:
        if table in given:
            if not isinstance(given[table], Mapping):
                raise RefusedError(f"`{table}` is a table of a case: give a dict with its keys, not a {type(given[table]).__name__}")
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

    _core: _vinesink.Case
    _folder: str
    _allow_outside: bool

    def __init__(
        self, *wrong: NoReturn, title: str = "From Python", source: str = "keywords of vinesink.Case", **keys: Unpack[Keys]
    ) -> None:
        if wrong:
            raise TypeError("Case takes keywords: Case.from_toml reads a case from its file or its text")
        given = {name: value for name, value in keys.items() if value is not None}
        self._read("Case(...)", _text_of(title, source, given), os.getcwd(), True)

    def _read(self, name: str, text: str, folder: str, allow_outside: bool) -> None:
        self._keep(_vinesink.Case.parse(name, text, folder, allow_outside), folder, allow_outside)

    def _keep(self, core: _vinesink.Case, folder: str, allow_outside: bool) -> None:
        for attribute, value in (("_core", core), ("_folder", folder), ("_allow_outside", allow_outside)):
            object.__setattr__(self, attribute, value)
        for warning in core.warnings():
            warnings.warn(warning, CaseWarning, stacklevel=_level())

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"a case does not change: case.replace({name}=...) gives another", name=name, obj=self)

    def __delattr__(self, name: str) -> NoReturn:
        self.__setattr__(name, None)

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str], *, allow_outside: bool = False) -> Case:
        """A case from the path of its file, or from its text: what has an `=` and a line's end is a text.

        A record that it names is below the folder of its file, or the working folder, unless `allow_outside`.

        Raises `CaseError` with everything that is wrong with it, `FileError` for a file that cannot be read.
        """
        case = cls.__new__(cls)
        if isinstance(source, str) and "\n" in source and "=" in source:
            case._read("text", source, os.getcwd(), allow_outside)
        else:
            case._keep(_vinesink.Case.read(source, allow_outside), str(Path(source).resolve().parent), allow_outside)
        return case

    @classmethod
    def _of_text(cls, text: str, folder: str, allow_outside: bool) -> Case:
        case = cls.__new__(cls)
        case._read("text", text, folder, allow_outside)
        return case

    def _with(self, given: Mapping[str, Any]) -> str:
        """The text of the case with other keywords."""
        document = json.loads(self._core.document())
        all_of = _given_of(document)
        for name in given:
            for either in _EITHER:
                if name in either and given[name] is not None:
                    all_of = {key: value for key, value in all_of.items() if key not in either}
        all_of |= given
        all_of = {key: value for key, value in all_of.items() if value is not None}
        return _text_of(document["title"], document["source"], all_of)

    def replace(self, **keys: Unpack[Keys]) -> Case:
        """The same case with other keywords, those of `Case`; None takes one out.

            case.replace(clearance="2 mm")

        Of two that say the same, such as `stiffness` and `natural_frequency`, the one that is given stays. Comments of its
        file are gone.
        """
        return self._of_text(self._with(keys), self._folder, self._allow_outside)

    def __repr__(self) -> str:
        return f"Case({self.title!r}, clearance={self.value('clearance'):.6g})"

    def _repr_html_(self) -> str:
        import html

        return f"<pre>{html.escape(self.text)}</pre>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Case._of_text, (self.text, self._folder, self._allow_outside))

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

    def value(self, name: str) -> float:
        """A number of the case by its keyword, such as "clearance", in SI or the units of a reduced case.

        Raises `RefusedError` where the case has no such number.
        """
        found = self._core.value(name)
        if found is None:
            raise RefusedError(f"the case has no number `{name}`{_meant(name, list(Parameters.__annotations__))}")
        return found

    @property
    def scales(self) -> Scales:
        """What turns dimensionless numbers into the case's units."""
        return Scales(**self._core.scales())

    def analyze(self, *, progress: Progress | None = None) -> Analysis:
        """What theory and exact orbits say: the document of `vinesink analyze --format json`.

        Raises `RefusedError` where the case cannot be analysed, such as one that is swept.
        """
        return Analysis(json.loads(self._core.analyze(_told(progress))))

    def motions(self, *, progress: Progress | None = None) -> Table:
        """Every long-term motion at the case's own excitation, one a row: `id`, `kind`, `regime`, `settled`, `counts` (for
        criteria), `peak` and `rms` (m) with their errors, `impacts_per_period`, `impact_speed` (m/s), `efficiency`, `starts`
        that lead to it, `share`, `repeats_after` (periods) and `largest_multiplier`; NaN where one is not defined.

        Raises `RefusedError` of a structure that is not driven steadily.
        """
        if not self._core.steady:
            raise RefusedError("its structure is not driven steadily and has no long-term motion: simulate() says what becomes of it")
        return self.simulate(progress=progress)._rows()

    def check(self, *, criteria_only: bool = False, progress: Progress | None = None) -> Check:
        """Holds the case against its criteria, over its band if it has one: what `vinesink check --format json` says of it.

        The worst of all motions counts. `criteria_only` leaves out what a tuned mass damper would do, and how far each number
        may change. Raises `RefusedError` of a case without criteria.
        """
        return Check(json.loads(self._core.check(criteria_only, _told(progress))))

    def optimize(self, *, objective: str | None = None, progress: Progress | None = None) -> Optimum:
        """The absorber that serves the case best: what `vinesink optimize --format json` says.

        `objective` is "worst-amplitude", "z3-share", "stable-share" or "margin"; what the first criterion asks unless given. The
        clearance, and what else `optimize` of the case names, is judged as `check` judges it, over the whole band.
        """
        text, better, succeeds = self._core.optimize(objective, _told(progress))
        case = None if better is None else self._of_text(better, self._folder, self._allow_outside)
        return Optimum(json.loads(text), case, succeeds)

    def plot_motion(self, *, periods: float = 6, ax: Axes | None = None) -> Axes:
        """Draws the motion that most starts lead to: structure and absorber over time, with the walls. Needs matplotlib."""
        from . import _plots

        return _plots.motion(self, periods, ax)

    def plot_response(self, *, points: int = 121, ax: Axes | None = None) -> Axes:
        """Draws the largest peak over the excitation's frequency, along the case's band or 15 % to either side: of every motion
        that starts lead to, of the structure alone and with a tuned mass damper of the same mass. Needs matplotlib."""
        from . import _plots

        return _plots.response(self, points, ax)

    def plot_map(self, *, points: int = 48, ax: Axes | None = None) -> Axes:
        """Draws what the motion does over frequency and clearance, from a third of the case's to three times it, with the case as
        a star. Needs matplotlib."""
        from . import _plots

        return _plots.regimes(self, points, ax)

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
        Warns with `SimulationWarning` where the numbers are not to be trusted. Raises `RefusedError` for a start outside
        of the cavity.
        """
        periods, discard = _whole("periods", periods, 1), _whole("discard", discard, 0)
        told = _told(progress)
        start = None if initial is None else [float(one) for one in initial]
        if start is not None and len(start) != 4:
            raise RefusedError(f"initial has {len(start)} numbers, expected four: x, xdot, y, ydot")
        if not self._core.steady:
            if any(given is not None for given in (periods, discard, initial, times)) or not measure:
                raise RefusedError("the structure is not driven steadily: the case itself says what becomes of it; call simulate()")
            text, _, _ = self._core.simulate(None, None, None, told)
            return Simulation(json.loads(text), Table({}), None)
        document: dict[str, Any] = {}
        if measure:
            text, impacts, start = self._core.simulate(periods, discard, start, told)
            document = json.loads(text)
        elif start is None:
            raise RefusedError("measure=False follows one start: give initial=(x, xdot, y, ydot)")
        else:
            impacts = self._core.fly(periods, discard, start, told)
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
        `FileError` where the folder cannot be written.
        """
        name = name or self._core.stem or Path(folder).resolve().name
        return self._core.report(os.fspath(folder), name, _told(progress))


def branch(
    case: Case,
    parameter: str,
    range: Sequence[float | str | PintLike | AstropyLike],
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

    Raises `RefusedError` where there is no such orbit or parameter, or the range leaves out the case.
    """
    case = _case_of(case)
    low, high = (float(edge) for one in range for edge in _plain(case, parameter, one).reshape(-1))
    columns, told = case._core.branch(parameter, [low, high], orbit, most_points)
    return Branch(parameter, columns, json.loads(told))


def _plain(case: Case, name: str, values: Values) -> NDArray[np.float64]:
    """Numbers in SI, or the units of a reduced case."""
    found = parts(values)
    if found is None:
        plain = np.asarray(values)
        if plain.dtype.kind not in "US":
            return np.asarray(values, dtype=float)
        each = [case._of_text(case._with({name: str(text)}), case._folder, case._allow_outside) for text in plain.reshape(-1)]
        return np.array([one.value(name) for one in each]).reshape(plain.shape)
    numbers, unit = found
    # What one of the unit is, read as a case file has it.
    text = case._with({name: f"1 {unit}" if unit else 1.0})
    one = _vinesink.Case.parse(f"one {unit} of {name}", text, case._folder, case._allow_outside).value(name)
    if one is None:
        raise RefusedError(f"the case has no `{name}`")
    return np.asarray(numbers, dtype=float) * one


def single_trajectories(
    case: Case,
    *,
    initial: ArrayLike | None = None,
    periods: int = 250,
    discard: int | None = None,
    progress: Progress | None = None,
    **parameters: Unpack[Parameters],
) -> Motions:
    """What one start of each of many systems ends in, sixteen side by side on every processor.

        single_trajectories(case, clearance=np.linspace(2e-3, 20e-3, 1000)).peak

    Another start may end in another motion with a larger peak: to choose a design, ask `check`, `optimize` or `sweep`, which
    look for every motion.

    Parameters
    ----------
    parameters
        Arrays of numbers of the case, in SI or the units of a reduced case, or quantities with a unit of their own: see
        `Parameters`. They are broadcast; everything else is as in the case.
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
    Raises `RefusedError`, which names the first element that is impossible and why.
    """
    case = _case_of(case)
    arrays = {name: _plain(case, name, cast(Values, values)) for name, values in parameters.items()}
    starts = None if initial is None else np.asarray(initial, dtype=float)
    if starts is not None and (starts.ndim == 0 or starts.shape[-1] != 4):
        raise RefusedError(f"initial has the shape {starts.shape}, expected (..., 4): x, xdot, y, ydot")
    shapes = [one.shape for one in arrays.values()] + ([] if starts is None else [starts.shape[:-1]])
    shape = np.broadcast_shapes(*shapes)
    values = np.empty((len(arrays), int(np.prod(shape))))
    for row, one in zip(values, arrays.values()):
        row[:] = np.broadcast_to(one, shape).reshape(-1)
    if starts is not None:
        starts = np.ascontiguousarray(np.broadcast_to(starts, (*shape, 4)).reshape(-1, 4))
    count, left_out = _whole("periods", periods, 1) or 1, _whole("discard", discard, 0)
    columns = _vinesink.simulate_many(case._core, list(arrays), values, starts, count, left_out, _told(progress))
    names: NDArray[np.str_] = np.array([*_vinesink.regimes(), ""])
    columns["regime"] = names[columns["regime"]]
    # What varies stands first.
    return Motions({**dict(zip(arrays, values)), **columns}, shape)


def sweep(
    case: Case,
    *,
    record: Sequence[str] | None = None,
    starts: int | None = None,
    periods: int | None = None,
    progress: Progress | None = None,
    **parameters: Unpack[Parameters],
) -> Sweep:
    """Every combination of some values, each looked at from several starts: what `vinesink sweep` records.

    Each is at the excitation of the case, or the one that varies, and not over its band: `check` and `optimize` decide over that.

        sweep(case, clearance=np.linspace(2e-3, 4e-3, 50), frequency=[8, 8.5], record=["largest_peak", "motions"])

    Parameters
    ----------
    parameters
        Ascending values of numbers of the case, in SI or the units of a reduced case, or quantities with a unit of their own:
        see `Parameters`. The last varies fastest.
    record
        Columns, such as "peak", "largest_peak", "rms", "regime", "motions", "reduction_db": the book's page on case files
        lists all. What the program records unless given.
    starts, periods
        Starts of each point, and excitation periods over which a motion is measured that does not repeat.

    Its columns are those of the parameters, then what was recorded, one row a point.
    """
    case = _case_of(case)
    table: dict[str, Any] = {}
    if record is not None:
        table["record"] = list(record)
    table |= {name: one for name, one in (("starts", starts), ("periods", periods)) if one is not None}
    if not parameters:
        raise RefusedError("nothing varies: give at least one number of the case as an array, such as clearance=[0.002, 0.003]")
    for name, values in parameters.items():
        if name not in Parameters.__annotations__:
            raise RefusedError(f"there is no `{name}` to vary{_meant(name, list(Parameters.__annotations__))}")
        plain = _plain(case, name, cast(Values, values)).reshape(-1).tolist()
        unit = case._core.unit(name)
        table[name] = {"values": plain if unit == "1" else [f"{one!r} {unit}" for one in plain]}
    planned = Case._of_text(case._with({"sweep": table}), case._folder, case._allow_outside)
    columns = planned._core.sweep(_told(progress))
    return Sweep({name: np.array(column) for name, column in columns.items() if name != "point"})


def compare(old: Case, new: Case, *, progress: Progress | None = None) -> Difference:
    """What changed from one design to another, as a reviewer of their reports would have it: the document of `vinesink diff`,
    and `markdown`."""
    document, markdown = _vinesink.compare(_case_of(old)._core, _case_of(new)._core, _told(progress))
    return Difference(json.loads(document), markdown)
