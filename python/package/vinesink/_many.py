"""Many systems at once, along a parameter, or two beside one another."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vinesink
from ._case import Case, Progress, _told, _whole
from ._errors import RefusedError
from ._keywords import Parameters, Values
from ._quantities import AstropyLike, PintLike
from ._results import Branch, Difference, Motions, Sweep

if TYPE_CHECKING:
    from typing_extensions import Unpack


def _case_of(case: object) -> Case:
    """The case that a function is given, or what to do instead."""
    if not isinstance(case, Case):
        raise RefusedError(f"expected a Case, not a {type(case).__name__}: Case.from_toml reads one from its file")
    return case


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
    low, high = (float(edge) for one in range for edge in case._numbers(parameter, one).reshape(-1))
    columns, told = case._core.branch(parameter, [low, high], orbit, most_points)
    return Branch(parameter, columns, json.loads(told))


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
    arrays = {name: case._numbers(name, cast(Values, values)) for name, values in parameters.items()}
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
    if not parameters:
        raise RefusedError("nothing varies: give at least one number of the case as an array, such as clearance=[0.002, 0.003]")
    settings: dict[str, Any] = {"record": record and list(record), "starts": starts, "periods": periods}
    given = {name: one for name, one in settings.items() if one is not None}
    return case._sweep(given, parameters, progress)


def compare(old: Case, new: Case, *, progress: Progress | None = None) -> Difference:
    """What changed from one design to another, as a reviewer of their reports would have it: the document of `vinesink diff`,
    and `markdown`."""
    document, markdown = _vinesink.compare(_case_of(old)._core, _case_of(new)._core, _told(progress))
    return Difference(json.loads(document), markdown)
