"""What functions return: documents with attributes, and tables of NumPy arrays."""

from __future__ import annotations

import copy
import html
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas
    import polars

_SHOWN = 10
"""Rows of a table that a notebook shows."""


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return [_wrapped(one) for one in value]
    return value


def _text(value: Any) -> str:
    if isinstance(value, (float, np.floating)):
        return f"{value:.6g}"
    return str(value)


def _html_table(head: Sequence[str], rows: Sequence[Sequence[Any]], caption: str) -> str:
    def line(tag: str, row: Sequence[Any]) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(_text(one))}</{tag}>" for one in row) + "</tr>"

    body = "".join(line("td", row) for row in rows)
    return (
        f"<table><caption>{html.escape(caption)}</caption>"
        f"<thead>{line('th', head)}</thead><tbody>{body}</tbody></table>"
    )


class Record(Mapping[str, Any]):
    """A document of the program, as its `--format json` prints it: `record["area"]` and `record.area` are the same.

    Objects within it are records, lists are lists of them. A name that it has not raises `AttributeError` or
    `KeyError`.
    """

    def __init__(self, document: dict[str, Any]) -> None:
        self._document = document

    def __getitem__(self, key: str) -> Any:
        return _wrapped(self._document[key])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._document:
            has = ", ".join(self._document) if not name.startswith("_") else ""
            raise AttributeError(f"{type(self).__name__} has no `{name}`; it has {has}", name=name, obj=self)
        return self[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._document)

    def __len__(self) -> int:
        return len(self._document)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._document]

    def __repr__(self) -> str:
        def short(value: Any) -> str:
            if isinstance(value, dict):
                return "{...}"
            return f"[{len(value)}]" if isinstance(value, list) else repr(value)

        inside = ", ".join(f"{key}={short(value)}" for key, value in self._document.items())
        return f"{type(self).__name__}({inside})"

    def _repr_html_(self) -> str:
        plain = {key: value for key, value in self._document.items() if not isinstance(value, (dict, list))}
        return _html_table(["", ""], list(plain.items()), type(self).__name__)

    def to_dict(self) -> dict[str, Any]:
        """The document as plain dicts and lists, a copy."""
        return copy.deepcopy(self._document)


class Table:
    """Columns of one length: NumPy arrays, as attributes and by name.

    The first axis of each counts rows; a column of complex numbers or states has a second one.
    """

    _caption = "Table"

    def __init__(self, columns: Mapping[str, NDArray[Any]]) -> None:
        self._columns = dict(columns)

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return list(self._columns)

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._columns[name]

    def __getattr__(self, name: str) -> NDArray[Any]:
        if name.startswith("_") or name not in self._columns:
            has = ", ".join(self._columns) if not name.startswith("_") else ""
            raise AttributeError(f"{type(self).__name__} has no column `{name}`; it has {has}", name=name, obj=self)
        return self._columns[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._columns]

    def __len__(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self)} rows: {', '.join(self._columns)})"

    def _flat(self) -> dict[str, NDArray[Any]]:
        """Columns of one axis each: rows of an array of several axes in one, those of a second axis counted from 0."""
        flat: dict[str, NDArray[Any]] = {}
        for name, column in self._columns.items():
            if column.ndim == 1:
                flat[name] = column
            else:
                flat.update({f"{name}_{k}": column[:, k] for k in range(column.shape[1])})
        return flat

    def _repr_html_(self) -> str:
        flat = self._flat()
        count = len(next(iter(flat.values()), ()))
        rows = list(zip(*(column[:_SHOWN] for column in flat.values())))
        left = f", the first {_SHOWN}" if count > _SHOWN else ""
        return _html_table(list(flat), rows, f"{self._caption}: {count} rows{left}")

    def to_dict(self) -> dict[str, list[Any]]:
        """The columns as plain lists."""
        return {name: column.tolist() for name, column in self._columns.items()}

    def to_pandas(self) -> pandas.DataFrame:
        """A `pandas.DataFrame`; pandas has to be installed."""
        import pandas

        return pandas.DataFrame(self._flat())

    def to_polars(self) -> polars.DataFrame:
        """A `polars.DataFrame`; polars has to be installed. Complex columns become one of real and one of imaginary parts."""
        import polars

        parts: dict[str, NDArray[Any]] = {}
        for name, column in self._flat().items():
            if np.iscomplexobj(column):
                parts |= {f"{name}_re": column.real.copy(), f"{name}_im": column.imag.copy()}
            else:
                parts[name] = column
        return polars.DataFrame(parts)


def _of_records(records: Sequence[Mapping[str, Any]], names: Sequence[str]) -> dict[str, NDArray[Any]]:
    return {name: np.array([one[name] for one in records]) for name in names}


class _WithRows(Record):
    """A document with a list that is a table: of an analysis the fixed points, of a simulation the motions found."""

    def _rows(self) -> Table:
        raise NotImplementedError

    def to_pandas(self) -> pandas.DataFrame:
        """Its list, one entry a row."""
        return self._rows().to_pandas()

    def to_polars(self) -> polars.DataFrame:
        """Its list, one entry a row."""
        return self._rows().to_polars()

    def _repr_html_(self) -> str:
        return super()._repr_html_() + self._rows()._repr_html_()


class Analysis(_WithRows):
    """What theory and exact orbits say of a case: the document of `vinesink analyze --format json`.

    `area` and `strip` of the theory; `manifold`, with `fold` and `symmetry_breaking`; `fixed_points`, a list with `B`,
    `C` (over the clearance), `eta` (rad), `branch`, `stable`; `boundaries`, clearances in m; `orbits`; `reduced`, the
    dimensionless numbers. Of a structure that is released it is what theory says of its decay.
    """

    def _rows(self) -> Table:
        names = ("B", "C", "eta", "branch", "kind", "stable", "trace", "determinant", "residual")
        return Table(_of_records(self._document.get("fixed_points", []), names))


class Orbits(Table):
    """Exact periodic orbits with two impacts per period, one a row; `orbits[0]` is one of them as a `Record`.

    Columns: `impact_displacement`, `peak_displacement` (m), `phase` (rad), `spectral_radius`, `radius_per_period`
    (largest multiplier over a period), `admissible` (it is a motion), `stable`, `residual`, `sequence` (walls hit, as
    `+-`), `multipliers`, shape (n, 4), complex: of the half-period map for a symmetric orbit.
    """

    _caption = "Exact orbits"

    def __init__(self, records: list[dict[str, Any]]) -> None:
        names = ("impact_displacement", "peak_displacement", "phase", "spectral_radius", "radius_per_period")
        columns = _of_records(records, (*names, "admissible", "stable", "residual", "sequence"))
        pairs = np.array([one["multipliers"] for one in records], dtype=float).reshape(-1, 4, 2)
        super().__init__({**columns, "multipliers": pairs[:, :, 0] + 1j * pairs[:, :, 1]})
        self._records = records

    def __getitem__(self, key: Any) -> Any:
        return super().__getitem__(key) if isinstance(key, str) else Record(self._records[key])

    def __iter__(self) -> Iterator[Record]:
        return (Record(one) for one in self._records)


class Simulation(_WithRows):
    """A simulated motion: the document of `vinesink simulate --format json`, with arrays beside it.

    `regime`, `impacts` (their number), `impacts_per_period`, `displacement.peak` and `.rms` (m), `impact_speed` (m/s), `energy`, `settled`,
    `trusted`; `motions`, every long-term motion, where no start was given. It has none of these where
    nothing was measured (`measure=False`). Of several modes `loads` has the motions `at_worst` of each, and their `places`.
    """

    def __init__(self, document: dict[str, Any], impacts: Table, trajectory: Table | None) -> None:
        super().__init__(document)
        self._impacts = impacts
        self._trajectory = trajectory

    @property
    def impact_log(self) -> Table:
        """The impacts of the measured window, one a row: `tau`, fast time since the start of the run; `side`, +1 where
        x - y = +b; `x` over the clearance; `xdot_before`, `xdot_after`, `ydot_before`, `ydot_after` per fast time. Of several
        modes or absorbers also `absorber` and `load` by their numbers from 1, the `frequency` (Hz) and the `motion` in the list there;
        lengths are over the absorber's own clearance."""
        return self._impacts

    @property
    def trajectory(self) -> Table | None:
        """The motion at the times that were asked for: `periods`, `x`, `xdot`, `y`, `ydot`; lengths over the clearance,
        fast time. None without `times`."""
        return self._trajectory

    def _rows(self) -> Table:
        if "loads" in self._document:
            loads = self._document["loads"]
            rows = [{"load": of["load"], **_motion_row(one)} for of in loads for one in of["at_worst"]]
            return Table(_of_records(rows, ("load", *_MOTION)))
        rows = [_motion_row(one) for one in self._document.get("motions") or []]
        if not rows and "regime" in self._document:
            rows = [_motion_row(self._document["motion"])]
        return Table(_of_records(rows, _MOTION))


_MOTION = (
    "id",
    "kind",
    "regime",
    "settled",
    "counts",
    "peak",
    "peak_error",
    "rms",
    "rms_error",
    "impacts_per_period",
    "impact_speed",
    "efficiency",
    "starts",
    "share",
    "repeats_after",
    "largest_multiplier",
)


def _motion_row(one: dict[str, Any]) -> dict[str, Any]:
    """A motion of a list in one row: numbers in SI, NaN where one is not defined."""

    def number(key: str, part: str = "value") -> float:
        found = one.get(key)
        return np.nan if found is None else found[part]

    plain = {key: one.get(key, "") for key in ("id", "kind", "regime")}
    plain |= {"settled": one["settled"], "counts": one.get("counts", True)}
    rest = {key: np.nan if one.get(key) is None else one[key] for key in _MOTION[-4:]}
    errors = {"peak_error": number("peak", "error"), "rms_error": number("rms", "error")}
    values = {key: number(key) for key in ("peak", "rms", "impacts_per_period", "impact_speed", "efficiency")}
    return {**plain, **values, **errors, **rest}


class Check(_WithRows):
    """A case held against its criteria: what `vinesink check --format json` says of it.

    `holds` says whether all criteria do, as does its truth: `if case.check(): ...`; `criteria`, a list with `name`, `asked`,
    `found` in `unit`, `error`, `margin`, `holds`, `decided`; `alternatives`, the devices beside it; `holds_for`, how far each
    number may change; `reliability`.
    """

    def __bool__(self) -> bool:
        return bool(self._document["holds"])

    def _rows(self) -> Table:
        names = ("name", "asked", "found", "unit", "error", "margin", "holds", "near_limit")
        rows = [{name: np.nan if one.get(name) is None else one[name] for name in names} for one in self._document["criteria"]]
        return Table(_of_records(rows, names))


class Difference(Record):
    """What changed from one design to another: the document of `vinesink diff --format json`."""

    def __init__(self, document: dict[str, Any], markdown: str) -> None:
        super().__init__(document)
        self._markdown = markdown

    @property
    def markdown(self) -> str:
        """The same for a reader, as for a comment on a pull request."""
        return self._markdown

    def _repr_markdown_(self) -> str:
        return self._markdown


class Sweep(Table):
    """What was recorded of every combination of some values, one row a point: the parameters, then the columns that were asked
    for. NaN, or an empty word, where a point has none."""

    _caption = "Sweep"

    def __init__(self, columns: Mapping[str, NDArray[Any]], units: Mapping[str, str]) -> None:
        super().__init__(columns)
        self._units = {name: units[name] for name in self._columns}

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column: "1" of a plain number, "" of words."""
        return dict(self._units)

    def to_pandas(self) -> pandas.DataFrame:
        """A `pandas.DataFrame`, whose `attrs["units"]` are the units; pandas has to be installed."""
        frame = super().to_pandas()
        frame.attrs["units"] = self.units
        return frame


class Branch(Table):
    """Exact orbits along a parameter, in order along the branch.

    Columns, one row an orbit: `value` of the parameter, in SI or the case's own units; `peak` displacement of the
    oscillator (m); `stable`; `admissible`; `radius_per_period`; `multipliers`, shape (n, 4), complex.
    """

    _caption = "Branch of exact orbits"

    def __init__(self, parameter: str, columns: Mapping[str, NDArray[Any]], told: dict[str, Any]) -> None:
        super().__init__(columns)
        self._parameter = parameter
        self._told = told

    @property
    def parameter(self) -> str:
        """What varies."""
        return self._parameter

    @property
    def bifurcations(self) -> list[Record]:
        """Each with its `kind`, `value` of the parameter, `peak`, `bracket`, `sequence` of walls, and whether it
        `converged`; in order along the branch."""
        return [Record(one) for one in self._told["bifurcations"]]

    @property
    def ends(self) -> list[Record]:
        """`why` the branch ends, and at which `value`: at its lower end and at its upper; one where it is closed."""
        return [Record(one) for one in self._told["ends"]]

    def to_dict(self) -> dict[str, Any]:
        """Columns as lists, with `parameter`, `bifurcations` and `ends`."""
        return {"parameter": self._parameter, **super().to_dict(), **copy.deepcopy(self._told)}


class Motions(Table):
    """What one start of each of many systems ended in. Arrays have the shape of the elements, `state` one axis more.

    What varied, in SI or the units of a reduced case; `peak`, `rms` (m) with `peak_error`, `rms_error` (how far chaotic ones scatter), `impacts_per_period`,
    `impact_speed` (m/s), `efficiency` (share of the work that impacts dissipate), `regime` (a word), `repeats_after`
    (excitation periods; 0 where it was not seen to repeat), `settled` (its transient is over), `whole` (its
    measurement was not cut short), `state` on it at excitation phase 0 (over the clearance, fast time). A motion that
    could not be followed is NaN, its regime empty.
    """

    _caption = "Motions"

    def __init__(self, columns: Mapping[str, NDArray[Any]], shape: tuple[int, ...]) -> None:
        super().__init__({name: one.reshape(shape + one.shape[1:]) for name, one in columns.items()})
        self._shape = shape

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the elements."""
        return self._shape

    def _flat(self) -> dict[str, NDArray[Any]]:
        axes = len(self._shape)
        return Table({n: c.reshape(-1, *c.shape[axes:]) for n, c in self._columns.items()})._flat()
