"""Cases of several modes or absorbers, and what can be asked of them."""

from __future__ import annotations

import json
import os
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from . import _vinesink
from ._case import CaseWarning, Progress, _level, _told
from ._results import Check, Record, Sweep


class ModalOptimum(Record):
    """The absorbers that serve a case of several modes or absorbers best: the document of `vinesink optimize --format json`.

    `case` is the case with them, None where none are better than the case's own and meet all criteria; its truth says whether
    there are.
    """

    def __init__(self, document: dict[str, Any], case: ModalCase | None, succeeds: bool) -> None:
        super().__init__(document)
        self._case = case
        self._succeeds = succeeds

    @property
    def case(self) -> ModalCase | None:
        """The case with them."""
        return self._case

    @property
    def succeeds(self) -> bool:
        """Whether there are some that are better than the case's own and meet all criteria."""
        return self._succeeds

    def __bool__(self) -> bool:
        return self._succeeds


class ModalCase:
    """A structure of several modes with several absorbers, read from a case file with `[[mode]]` or `[modes]`, `[[absorber]]` and
    `[[excitation]]`.

        case = vinesink.ModalCase.from_toml("mast.toml")
        case.check()                  # every long-term motion along each load, held against its limits
        case.optimize().case          # clearances, restitution, places, a split of the mass
        case.report("reports/mast")

    Numbers are in SI. `text` is the case file; messages name its lines.
    """

    # What else is assigned is refused: a case does not change.
    __slots__ = ("_allow_outside", "_core", "_folder")
    _core: _vinesink.ModalCase
    _folder: str
    _allow_outside: bool

    def __init__(self, text: str, *, folder: str | os.PathLike[str] = ".", allow_outside: bool = False) -> None:
        folder = os.fspath(folder)
        self._keep(_vinesink.ModalCase.parse("text", text, folder, allow_outside), folder, allow_outside)

    def _keep(self, core: _vinesink.ModalCase, folder: str, allow_outside: bool) -> None:
        self._core, self._folder, self._allow_outside = core, folder, allow_outside
        for warning in core.warnings():
            warnings.warn(warning, CaseWarning, stacklevel=_level())

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str], *, allow_outside: bool = False) -> ModalCase:
        """A case from the path of its file, or from its text: what has an `=` and a line's end is a text.

        A file of its modes is below the folder of the case, or the working folder, unless `allow_outside`.

        Raises `CaseError` with everything that is wrong with it, `FileError` for a file that cannot be read.
        """
        if isinstance(source, str) and "\n" in source and "=" in source:
            return cls(source, allow_outside=allow_outside)
        case = cls.__new__(cls)
        folder = str(Path(source).resolve().parent)
        case._keep(_vinesink.ModalCase.read(source, allow_outside), folder, allow_outside)
        return case

    def __repr__(self) -> str:
        return f"ModalCase({self.title!r}, places={self.places!r})"

    def _repr_html_(self) -> str:
        import html

        return f"<pre>{html.escape(self.text)}</pre>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (_of_text, (self.text, self._folder, self._allow_outside))

    @property
    def title(self) -> str:
        """What the case is."""
        return self._core.title

    @property
    def source(self) -> str:
        """Where its numbers come from."""
        return self._core.source

    @property
    def text(self) -> str:
        """The case file."""
        return self._core.text

    @property
    def places(self) -> list[str]:
        """The places at which its modes have a shape."""
        return self._core.places

    def analyze(self, *, progress: Progress | None = None) -> Record:
        """Exact orbits with two impacts of each absorber in a period, under each load: what `vinesink analyze --format json` says."""
        return Record(json.loads(self._core.analyze(_told(progress))))

    def simulate(self, *, progress: Progress | None = None) -> Record:
        """Every long-term motion along each load: what `vinesink simulate --format json` says; `loads` has them."""
        return Record(json.loads(self._core.simulate(_told(progress))))

    def check(self, *, criteria_only: bool = False, long: bool = False, progress: Progress | None = None) -> Check:
        """Holds the case against its limits, along every load: what `vinesink check --format json` says of it.

        That has what tuned mass dampers would do, `alternatives`, and where no criterion fails how far each number may change, and with a table `[uncertainty]` the probability that
        all hold: fifteen times the work for each number, and once for each design that is drawn. Where they would take more than
        one minute, and three, they are left out unless `long` is given; `criteria_only` leaves them out.
        Raises `RefusedError` of a case without criteria.
        """
        return Check(json.loads(self._core.check(criteria_only, long, _told(progress))))

    def optimize(self, *, objective: str | None = None, progress: Progress | None = None) -> ModalOptimum:
        """The absorbers that serve the case best: what `vinesink optimize --format json` says.

        `objective` is "worst-amplitude", "stable-share" or "margin"; what the first criterion asks unless given, or else that all
        criteria hold with the most room. The clearances are looked for, and what its table `[optimize]` names; each is judged as `check` judges it.
        """
        text, better, succeeds = self._core.optimize(objective, _told(progress))
        case = None if better is None else _of_text(better, self._folder, self._allow_outside)
        return ModalOptimum(json.loads(text), case, succeeds)

    def sweep(self, *, progress: Progress | None = None) -> Sweep:
        """Every point of its table `[sweep]`: the columns of `vinesink sweep`, one row a point.

        Raises `RefusedError` of a case without that table.
        """
        columns, units = self._core.sweep(_told(progress))
        return Sweep({name: np.array(column) for name, column in columns.items() if name != "point"}, units)

    def report(
        self, folder: str | os.PathLike[str], *, name: str | None = None, long: bool = False, progress: Progress | None = None
    ) -> None:
        """Writes the design report into a folder, the same files as `vinesink report`, or with `long` as with `--long`.

        `name` is that of the case's file, else of the folder. Raises `FileError` where the folder cannot be written.
        """
        name = name or self._core.stem or Path(folder).resolve().name
        self._core.report(os.fspath(folder), name, long, _told(progress))


def _of_text(text: str, folder: str, allow_outside: bool) -> ModalCase:
    return ModalCase(text, folder=folder, allow_outside=allow_outside)
