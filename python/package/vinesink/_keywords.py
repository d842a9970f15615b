"""Keywords of a case, and the text that they make: the keys of a case file, whose schema the program has."""

from __future__ import annotations

import difflib
import json
from collections.abc import Mapping, Sequence
from typing import Any, Optional, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _vinesink
from ._errors import RefusedError
from ._quantities import AstropyLike, PintLike, Quantity, written

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
EITHER = (
    {"stiffness", "natural_frequency"},
    {"damping", "damping_ratio"},
    {"absorber_mass", "mass_ratio"},
    {"inclination", "orientation"},
    {"frequency_ratio", "detuning"},
)

_SCHEMA = json.loads(_vinesink.schema())["$defs"]["one"]["properties"]
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


def meant(name: str, names: Sequence[str]) -> str:
    """What was probably meant, in words; nothing where nothing is close."""
    close = difflib.get_close_matches(name, names, n=1, cutoff=0.7)
    return f" (did you mean `{close[0]}`?)" if close else ""


def given_of(document: dict[str, Any]) -> dict[str, Any]:
    """The keywords of the tables of a case file."""
    given: dict[str, Any] = {}
    for table, keys in document.items():
        if table in _PHYSICAL or table in _REDUCED:
            given |= {_RENAMED.get((table, key), key): value for key, value in keys.items()}
        elif isinstance(keys, dict):
            given[table] = keys
    return given


def text_of(title: str, source: str, given: dict[str, Any]) -> str:
    reduced = not _ONLY_REDUCED.isdisjoint(given)
    tables = _REDUCED if reduced else _PHYSICAL
    lines = [f"title = {_toml(title)}", f"source = {_toml(source)}"]
    known = {keyword for keywords in tables.values() for keyword in keywords}
    for name in given:
        if name not in known and name not in _SETTINGS:
            what = "a reduced case" if reduced else "a case in physical units"
            names = (*sorted(known), *_SETTINGS)
            raise TypeError(f"{what} has no `{name}`; it has {', '.join(names)}{meant(name, names)}")
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
