"""Cases, and what can be asked of them."""

from __future__ import annotations

import json
import os
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _plots, _vinesink
from ._errors import RefusedError
from ._keywords import EITHER, Keys, Parameters, Values, given_of, meant, text_of
from ._quantities import parts
from ._results import Analysis, Check, Orbits, Record, Simulation, Sweep, Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from typing_extensions import Unpack

Progress = Union[Callable[[int, int], object], bool]
"""Called with the steps done and all steps, about ten times a second; True is a bar of `tqdm`, where that is installed."""


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


class Optimum(Record):
    """The absorber that serves a case best: the document of `vinesink optimize --format json`.

    `optimum` has its `clearance` (m) and what else was looked for; `claimed` and `checked` its objective.
    """

    def __init__(self, document: dict[str, Any], case: Case | None, succeeds: bool) -> None:
        super().__init__(document)
        self._case = case
        self._succeeds = succeeds

    @property
    def case(self) -> Case | None:
        """The case with it; None where no absorber is better than the case's own and meets all criteria."""
        return self._case

    def __repr__(self) -> str:
        found = self._document["optimum"] or {}
        clearance = f"clearance={found['clearance']:.6g}, " if "clearance" in found else ""
        return f"Optimum({clearance}succeeds={self._succeeds})"

    @property
    def succeeds(self) -> bool:
        """Whether there is one that is better than the case's own and meets all criteria."""
        return self._succeeds

    def __bool__(self) -> bool:
        return self._succeeds


class Case:
    """A design: structure, absorbers, excitation, and what is asked of them. `Case.from_toml` reads any case file; keywords make one of
    one mode with one absorber.

    Keywords are the keys of a case file, quantities with their unit as there::

        Case(mass="4.168 kg", stiffness="11.47 kN/m", damping="3.02 N s/m", absorber_mass="32 g",
             clearance="7.5 mm", restitution=0.6, kind="base-displacement", amplitude="0.25 mm", frequency="8 Hz")

    In physical units:

    - structure: `mass`, `stiffness` or `natural_frequency`, `damping` or `damping_ratio`;
    - absorber: `absorber_mass` or `mass_ratio`, `clearance`, `restitution` (a number, or one for each wall),
      `inclination`, `friction`;
    - excitation: `kind` ("base-displacement", "force", "free", "impulse", "sine-sweep", "record") and the keys of
      that kind: `amplitude`, `frequency`; `displacement`, `velocity`; `impulse`; `of`, `start` (`from` in a file), `to`,
      `rate`; `quantity`, and `file`, `column`, `time_column`, `rate`, `unit`, `gaps`, or `spectrum`, `duration`, `seed`,
      `realisations`.

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
        self._read("Case(...)", text_of(title, source, given), os.getcwd(), True)

    def _read(self, name: str, text: str, folder: str, allow_outside: bool) -> None:
        self._keep(_vinesink.parse(name, text, folder, allow_outside), folder, allow_outside)

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
            case._keep(_vinesink.read(source, allow_outside), str(Path(source).resolve().parent), allow_outside)
        return case

    @classmethod
    def _of_text(cls, text: str, folder: str, allow_outside: bool) -> Case:
        case = cls.__new__(cls)
        case._read("text", text, folder, allow_outside)
        return case

    def _with(self, given: Mapping[str, Any]) -> str:
        """The text of the case with other keywords."""
        document = json.loads(self._core.document())
        all_of = given_of(document)
        for name in given:
            for either in EITHER:
                if name in either and given[name] is not None:
                    all_of = {key: value for key, value in all_of.items() if key not in either}
        all_of |= given
        all_of = {key: value for key, value in all_of.items() if value is not None}
        return text_of(document["title"], document["source"], all_of)

    def replace(self, **keys: Unpack[Keys]) -> Case:
        """The same case with other keywords, those of `Case`; None takes one out.

            case.replace(clearance="2 mm")

        Of two that say the same, such as `stiffness` and `natural_frequency`, the one that is given stays. Comments of its
        file are gone.
        """
        return self._of_text(self._with(keys), self._folder, self._allow_outside)

    def __repr__(self) -> str:
        own = f"places={self.places!r}" if self.places else f"clearance={self.value('clearance'):.6g}"
        return f"Case({self.title!r}, {own})"

    def _repr_html_(self) -> str:
        import html

        return f"<pre>{html.escape(self.text)}</pre>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self)._of_text, (self.text, self._folder, self._allow_outside))

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
    def places(self) -> list[str]:
        """The places at which its modes have a shape; none of one mode with one absorber."""
        return self._core.places

    def value(self, name: str) -> float:
        """A number of the case by its keyword, such as "clearance", in SI or the units of a reduced case.

        Raises `RefusedError` where the case has no such number.
        """
        found = self._core.value(name)
        if found is None:
            raise RefusedError(f"the case has no number `{name}`{meant(name, list(Parameters.__annotations__))}")
        return found

    @property
    def scales(self) -> Scales:
        """What turns dimensionless numbers into the case's units."""
        return Scales(**self._core.scales())

    def analyze(self, *, progress: Progress | None = None) -> Analysis:
        """What theory and exact orbits say: the document of `vinesink analyze --format json`; of several modes the orbits with two
        impacts of each absorber in a period, and the theory of the mode that each load drives.

        Raises `RefusedError` where the case cannot be analysed, such as one that is swept.
        """
        return Analysis(json.loads(self._core.analyze(_told(progress))))

    def motions(self, *, progress: Progress | None = None) -> Table:
        """Every long-term motion at the case's own excitation, of several modes where each load displaces most, one a row: there `load` (from 1), `id`, `kind`, `regime`, `settled`, `counts` (for
        criteria), `peak` and `rms` (m) with their errors, `impacts_per_period`, `impact_speed` (m/s), `efficiency`, `starts`
        that lead to it, `share`, `repeats_after` (periods) and `largest_multiplier`; NaN where one is not defined.

        Raises `RefusedError` of a structure that is not driven steadily.
        """
        if not self._core.steady:
            raise RefusedError("its structure is not driven steadily and has no long-term motion: simulate() says what becomes of it")
        return self.simulate(progress=progress)._rows()

    def check(self, *, criteria_only: bool = False, long: bool = False, progress: Progress | None = None) -> Check:
        """Holds the case against its criteria, over its band or along its loads: what `vinesink check --format json` says of it.

        The worst of all motions counts. `criteria_only` leaves out what a tuned mass damper would do, and how far each number
        may change. Of several modes what would take more than some minutes is left out unless `long` is given.
        Raises `RefusedError` of a case without criteria.
        """
        return Check(json.loads(self._core.check(criteria_only, long, _told(progress))))

    def optimize(self, *, objective: str | None = None, progress: Progress | None = None) -> Optimum:
        """The absorber that serves the case best: what `vinesink optimize --format json` says.

        `objective` is "worst-amplitude", "z3-share" (of one mode), "stable-share" or "margin"; what the first criterion asks unless
        given. The clearance, and what else `optimize` of the case names, is judged as `check` judges it, over the whole band or all
        loads.
        """
        text, better, succeeds = self._core.optimize(objective, _told(progress))
        case = None if better is None else self._of_text(better, self._folder, self._allow_outside)
        return Optimum(json.loads(text), case, succeeds)

    def sweep(self, *, progress: Progress | None = None) -> Sweep:
        """Every point of its table `[sweep]`: the columns of `vinesink sweep`, one row a point.

        Raises `RefusedError` of a case without that table.
        """
        columns, units = self._core.sweep(_told(progress))
        return Sweep({name: np.array(column) for name, column in columns.items() if name != "point"}, units)

    def plot_motion(self, *, periods: float = 6, ax: Axes | None = None) -> Axes:
        """Draws the motion that most starts lead to: structure and absorber over time, with the walls. Needs matplotlib."""
        self._needs_steady("a motion")
        size, unit = self._millimetres()
        if not isinstance(periods, (int, float)) or not 0.0 < periods < 1e6:
            raise RefusedError(f"periods is {periods!r}, expected a number above 0")
        found = self.simulate(times=np.linspace(0.0, periods, int(round(200 * periods)) + 1)).trajectory
        assert found is not None
        length = size * self.scales.length
        labels = {"xlabel": "time (excitation periods)", "ylabel": f"displacement ({unit})", "title": self.title}
        return _plots.motion(ax, found.periods, found.x * length, found.y * length, length, labels)

    def plot_response(self, *, points: int = 121, ax: Axes | None = None) -> Axes:
        """Draws the largest peak over the excitation's frequency, along the case's band or 15 % to either side: of every motion
        that starts lead to, and of the structure alone. Needs matplotlib."""
        at = self._frequencies("a response", points)
        found = self._sweep({"record": ["largest_peak", "bare_amplitude"], "starts": 8}, at, None)
        size, unit = self._millimetres()
        labels = {"xlabel": self._frequency_label(), "ylabel": f"peak displacement ({unit})", "title": self.title}
        (axis,) = at.values()
        return _plots.response(ax, axis, found.largest_peak * size, found.bare_amplitude * size, labels)

    def plot_map(self, *, points: int = 48, ax: Axes | None = None) -> Axes:
        """Draws what the motion does over frequency and clearance, from a third of the case's to three times it, with the case as
        a star. Needs matplotlib."""
        at = self._frequencies("a map", points)
        own = self.value("clearance")
        clearances = np.geomspace(own / 3.0, 3.0 * own, points)
        found = self._sweep({"record": ["regime"], "starts": 4}, {"clearance": clearances, **at}, None)
        size, unit = self._millimetres()
        labels = {"xlabel": self._frequency_label(), "ylabel": f"clearance ({unit})", "title": self.title}
        ((name, axis),) = at.items()
        words = found.regime.reshape(points, points)
        return _plots.regimes(ax, (axis, clearances * size), words, (self.value(name), own * size), labels)

    def _needs_steady(self, what: str) -> None:
        if not self._core.steady:
            raise RefusedError(f"its structure is not driven steadily, and {what} is of one that is")

    def _millimetres(self) -> tuple[float, str]:
        """What lengths are multiplied by on an axis, and its unit."""
        return (1e3, "mm") if self.scales.physical else (1.0, "1")

    def _frequency_label(self) -> str:
        return "excitation frequency (Hz)" if self.scales.physical else "excitation frequency over the natural one"

    def _frequencies(self, what: str, points: int) -> dict[str, NDArray[np.float64]]:
        """Frequencies of the case's band, or 15 % to either side of its own, by the name of the number that varies."""
        self._needs_steady(what)
        name = "frequency" if self.scales.physical else "frequency_ratio"
        own = self.value(name)
        low, high = 0.85 * own, 1.15 * own
        band = given_of(json.loads(self._core.document())).get("band", {})
        if self.scales.physical and "from" in band and band.get("of", "frequency") == "frequency":
            low, high = self._numbers(name, [band["from"], band["to"]])
        return {name: np.linspace(low, high, points)}

    def _numbers(self, name: str, values: Values) -> NDArray[np.float64]:
        """Numbers in SI, or the units of a reduced case."""

        def one(written: str | float) -> float:
            # Read as a case file has it; what else the case asks for does not matter.
            given = {name: written, "band": None, "criteria": None, "sweep": None}
            found = _vinesink.parse(f"{name} = {written}", self._with(given), self._folder, self._allow_outside)
            number = found.value(name)
            if number is None:
                raise RefusedError(f"the case has no `{name}`")
            return number

        found = parts(values)
        if found is not None:
            numbers, unit = found
            return np.asarray(numbers, dtype=float) * one(f"1 {unit}" if unit else 1.0)
        plain = np.asarray(values)
        if plain.dtype.kind not in "US":
            return np.asarray(values, dtype=float)
        return np.array([one(str(text)) for text in plain.reshape(-1)]).reshape(plain.shape)

    def _sweep(self, settings: dict[str, Any], parameters: Mapping[str, Any], progress: Progress | None) -> Sweep:
        """The sweep of a case with these settings, over these values."""
        table = dict(settings)
        for name, values in parameters.items():
            if name not in Parameters.__annotations__:
                raise RefusedError(f"there is no `{name}` to vary{meant(name, list(Parameters.__annotations__))}")
            plain = self._numbers(name, values).reshape(-1).tolist()
            unit = self._core.unit(name)
            table[name] = {"values": plain if unit == "1" else [f"{one!r} {unit}" for one in plain]}
        planned = self._of_text(self._with({"sweep": table}), self._folder, self._allow_outside)
        return planned.sweep(progress=progress)

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

        A structure that is not driven steadily has no impacts and no trajectory here, only its document. One that has several modes or
        absorbers has the impacts of so many `periods` of the motion in which it moves farthest under each load, and no trajectory.
        Warns with `SimulationWarning` where the numbers are not to be trusted. Raises `RefusedError` for a start outside
        of the cavity.
        """
        periods, discard = _whole("periods", periods, 1), _whole("discard", discard, 0)
        told = _told(progress)
        start = None if initial is None else [float(one) for one in initial]
        if start is not None and len(start) != 4:
            raise RefusedError(f"initial has {len(start)} numbers, expected four: x, xdot, y, ydot")
        other = any(given is not None for given in (discard, initial, times)) or not measure
        self._core.needs_run(periods is not None, other)
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
        self, folder: str | os.PathLike[str], *, name: str | None = None, long: bool = False, progress: Progress | None = None
    ) -> bool:
        """Writes the design report into a folder, the same files as `vinesink report`: report.md, report.html,
        report.json and figures.

        A report appears whole or not at all; other files in the folder stay. `name` is that of the case's file, else of the
        folder; of several modes what would take long is left out unless `long` is given. Returns whether its simulations are to be trusted and what the case asks of accuracy holds. Raises
        `FileError` where the folder cannot be written.
        """
        name = name or self._core.stem or Path(folder).resolve().name
        return self._core.report(os.fspath(folder), name, long, _told(progress))
