"""Figures of a case as axes of matplotlib, in the colours of the reports."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._errors import RefusedError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._case import Case, Parameters

_BLUE, _ORANGE, _GREEN, _RED, _GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#555555"
# Regimes: green is a steady motion with an impact on each wall in every period, the one that is wanted.
_REGIMES = {"two-symmetric": "#009E73", "two-asymmetric": "#56B4E9", "at-rest": "#BBBBBB", "strongly-modulated": "#CC79A7"}
_OTHERS = ("#E69F00", "#F0E442", "#D55E00", "#0072B2", "#999999")


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(figsize=(7.2, 4.5), layout="constrained")[1]


def _unit(case: Case) -> tuple[float, str]:
    """What lengths are multiplied by on an axis, and its unit: millimetres."""
    return (1e3, "mm") if case.scales.physical else (1.0, "1")


def _steady(case: Case, what: str) -> None:
    if not case._core.steady:
        raise RefusedError(f"its structure is not driven steadily, and {what} is of one that is")


def motion(case: Case, periods: float, ax: Axes | None) -> Axes:
    _steady(case, "a motion")
    if not isinstance(periods, (int, float)) or not 0.0 < periods < 1e6:
        raise RefusedError(f"periods is {periods!r}, expected a number above 0")
    scales, (size, unit) = case.scales, _unit(case)
    found = case.simulate(times=np.linspace(0.0, periods, int(round(200 * periods)) + 1)).trajectory
    assert found is not None
    length = scales.length * size
    ax = _axes(ax)
    x, y = found.x * length, found.y * length
    for side in (-1.0, 1.0):
        ax.plot(found.periods, x + side * length, color=_GREY, linewidth=0.7, label="walls" if side > 0 else None)
    ax.plot(found.periods, y, color=_ORANGE, label="absorber")
    ax.plot(found.periods, x, color=_BLUE, label="structure")
    ax.set(xlabel="time (excitation periods)", ylabel=f"displacement ({unit})", title=case.title)
    ax.legend(loc="upper right", ncols=3)
    return ax


def _band(case: Case) -> tuple[float, float, str]:
    """Lowest and highest frequency that is of interest, and the name of the number that varies."""
    from ._case import _given_of
    import json

    given = _given_of(json.loads(case._core.document()))
    name = "frequency" if case.scales.physical else "frequency_ratio"
    own = case._core.value(name)
    if own is None:
        raise RefusedError("the case has no frequency of its excitation to vary")
    band = given.get("band", {})
    if case.scales.physical and "from" in band and band.get("of", "frequency") == "frequency":
        ends = [case.replace(frequency=band[key], band=None, criteria=None)._core.value(name) for key in ("from", "to")]
        if None not in ends:
            low, high = (float(one or 0.0) for one in ends)
            return low, high, name
    return 0.85 * own, 1.15 * own, name


def _over(name: str, values: NDArray[np.float64]) -> Parameters:
    return {"frequency": values} if name == "frequency" else {"frequency_ratio": values}


def response(case: Case, points: int, ax: Axes | None) -> Axes:
    from ._case import sweep

    _steady(case, "a response")
    low, high, name = _band(case)
    size, unit = _unit(case)
    found = sweep(case, record=["largest_peak", "bare_amplitude"], starts=8, **_over(name, np.linspace(low, high, points)))
    ax = _axes(ax)
    ax.plot(found[name], found.bare_amplitude * size, color=_GREY, linestyle="--", label="without absorber")
    ax.plot(found[name], found.largest_peak * size, ".", color=_BLUE, label="with absorber, the largest of 8 starts")
    ax.set(ylabel=f"peak displacement ({unit})", xlabel=_frequency(case), title=case.title)
    ax.set_ylim(0.0, 1.6 * float(np.nanmax(found.largest_peak)) * size)
    ax.legend(loc="best")
    return ax


def _frequency(case: Case) -> str:
    return "excitation frequency (Hz)" if case.scales.physical else "excitation frequency over the natural one"


def regimes(case: Case, points: int, ax: Axes | None) -> Axes:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    from ._case import sweep

    _steady(case, "a map")
    low, high, name = _band(case)
    size, unit = _unit(case)
    own = case._core.value("clearance") or 1.0
    clearances = np.geomspace(own / 3.0, 3.0 * own, points)
    frequencies = np.linspace(low, high, points)
    axes: Parameters = {"clearance": clearances}
    axes.update(_over(name, frequencies))
    found = sweep(case, record=["regime"], starts=4, **axes)
    words = [str(word) for word in np.unique(found.regime)]
    codes = np.searchsorted(words, found.regime).reshape(points, points)
    others = [word for word in words if word not in _REGIMES]
    colors = [_REGIMES.get(word) or _OTHERS[others.index(word) % len(_OTHERS)] for word in words]
    ax = _axes(ax)
    ax.pcolormesh(
        frequencies, clearances * size, codes, cmap=ListedColormap(colors), vmin=-0.5, vmax=len(words) - 0.5, shading="nearest"
    )
    ax.plot(case._core.value(name) or 0.0, own * size, "*", color="black", markersize=13)
    ax.set(xlabel=_frequency(case), ylabel=f"clearance ({unit})", yscale="log", title=case.title)
    named = [Patch(color=color, label=(word or "none").replace("-", " ")) for color, word in zip(colors, words)]
    ax.legend(handles=named, loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=8)
    ax.yaxis.set_major_formatter(lambda value, _: f"{value:.3g}")
    ax.yaxis.set_minor_formatter(lambda value, _: f"{value:.3g}")
    return ax
