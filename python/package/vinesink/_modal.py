"""Names of version 0.1 for cases of several modes or absorbers, which `Case` reads."""

from __future__ import annotations

import os

from ._case import Case, Optimum

ModalOptimum = Optimum
"""The same as `Optimum`."""


class ModalCase(Case):
    """The same as `Case`, from a text: `Case.from_toml` reads any case."""

    def __init__(self, text: str, *, folder: str | os.PathLike[str] = ".", allow_outside: bool = False) -> None:
        self._read("text", text, os.fspath(folder), allow_outside)
