"""Quantities with a unit: text as in a case file, or objects of `pint`, `astropy` and the like."""

from __future__ import annotations

from typing import Any, Protocol, Union

import numpy as np

from ._errors import RefusedError


class PintLike(Protocol):
    """A quantity of `pint`."""

    @property
    def magnitude(self) -> Any: ...
    @property
    def units(self) -> Any: ...


class AstropyLike(Protocol):
    """A quantity of `astropy.units`."""

    @property
    def value(self) -> Any: ...
    @property
    def unit(self) -> Any: ...


Quantity = Union[str, float, PintLike, AstropyLike, None]
"""None is one that is not given."""


def parts(value: Any) -> tuple[Any, str] | None:
    """The numbers and the unit of an object that has one, the unit as a case file writes it; None of another."""
    if hasattr(value, "magnitude") and hasattr(value, "units"):
        return value.magnitude, _unit(format(value.units, "~P"))
    if hasattr(value, "unit") and hasattr(value, "value"):
        return value.value, _unit(str(value.unit))
    for name in ("units", "unit", "dimensionality"):
        if hasattr(value, name):
            raise RefusedError(
                f"a {type(value).__name__} has `{name}`, and vinesink does not know how to read it: "
                'give text with its unit, such as "1.5 mm"'
            )
    return None


def _unit(text: str) -> str:
    text = text.replace("·", " ").replace("*", " ").replace(" / ", "/").strip()
    return {"percent": "%", "dimensionless": "", "1/s": "Hz"}.get(text, text)


def written(value: Any) -> Any:
    """What a case file says for a value: text for one with a unit."""
    found = parts(value)
    if found is None:
        return value
    number, unit = found
    if np.ndim(number) != 0:
        raise RefusedError("a case has one value of each number, and here are several: `sweep` takes arrays")
    return f"{float(number)!r} {unit}" if unit else float(number)
