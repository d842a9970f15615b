"""Figures as axes of matplotlib, in the colours of the reports: what is drawn comes as numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Numbers = NDArray[np.float64]

_BLUE, _ORANGE, _GREY = "#0072B2", "#E69F00", "#555555"
# Regimes: green is a steady motion with an impact on each wall in every period, the one that is wanted.
_REGIMES = {"two-symmetric": "#009E73", "two-asymmetric": "#56B4E9", "at-rest": "#BBBBBB"}
_OTHERS = ("#E69F00", "#CC79A7", "#F0E442", "#D55E00", "#0072B2", "#999999")


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(figsize=(7.2, 4.5), layout="constrained")[1]


def motion(ax: Axes | None, periods: Numbers, x: Numbers, y: Numbers, wall: float, labels: dict[str, str]) -> Axes:
    """Displacements of structure and absorber, and of the walls, so far from the structure."""
    ax = _axes(ax)
    for side in (-wall, wall):
        ax.plot(periods, x + side, color=_GREY, linewidth=0.7, label="walls" if side > 0 else None)
    ax.plot(periods, y, color=_ORANGE, label="absorber")
    ax.plot(periods, x, color=_BLUE, label="structure")
    ax.set(**labels)
    ax.legend(loc="upper right", ncols=3)
    return ax


def response(ax: Axes | None, at: Numbers, peak: Numbers, bare: Numbers, labels: dict[str, str]) -> Axes:
    """Largest peaks with and without absorber."""
    ax = _axes(ax)
    ax.plot(at, bare, color=_GREY, linestyle="--", label="without absorber")
    ax.plot(at, peak, ".", color=_BLUE, label="with absorber, the largest of 8 starts")
    ax.set(**labels)
    ax.set_ylim(0.0, 1.6 * float(np.nanmax(peak)))
    ax.legend(loc="best")
    return ax


def regimes(
    ax: Axes | None, axes: tuple[Numbers, Numbers], words: NDArray[np.str_], star: tuple[float, float], labels: dict[str, str]
) -> Axes:
    """Words over two axes, the second logarithmic: `words` has a row for each value of the second."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    names = [str(word) for word in np.unique(words)]
    others = [word for word in names if word not in _REGIMES]
    colors = [_REGIMES.get(word) or _OTHERS[others.index(word) % len(_OTHERS)] for word in names]
    ax = _axes(ax)
    codes = np.searchsorted(names, words)
    ax.pcolormesh(*axes, codes, cmap=ListedColormap(colors), vmin=-0.5, vmax=len(names) - 0.5, shading="nearest")
    ax.plot(*star, "*", color="black", markersize=13)
    ax.set(yscale="log", **labels)
    named = [Patch(color=color, label=(word or "none").replace("-", " ")) for color, word in zip(colors, names)]
    ax.legend(handles=named, loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=8)
    for format_of in (ax.yaxis.set_major_formatter, ax.yaxis.set_minor_formatter):
        format_of(lambda value, _: f"{value:.3g}")
    return ax
