"""The compiled part of the package. Users call `vinesink.Case` and the functions beside it."""

import os
from collections.abc import Callable, Sequence
from typing import Any, Final, TypedDict, final

import numpy as np
from numpy.typing import NDArray

__all__ = ["__version__", "CaseError", "InternalError", "Case", "simulate_many", "regimes", "_fail", "schema"]

__version__: Final[str]

_Columns = dict[str, NDArray[Any]]
_State = tuple[float, float, float, float]
_Progress = Callable[[int, int], object]

class _Problem(TypedDict):
    line: int
    column: int
    underlined: str
    message: str
    expected: str
    help: str | None

class CaseError(ValueError):
    """A case that cannot be read. Its message is the program's; `problems` has each one's place and advice."""

    problems: list[_Problem]

class InternalError(RuntimeError):
    """A fault in vinesink itself."""

@final
class Case:
    @staticmethod
    def parse(name: str, text: str, folder: str | os.PathLike[str], allow_outside: bool) -> Case: ...
    @staticmethod
    def read(path: str | os.PathLike[str], allow_outside: bool) -> Case: ...
    @property
    def title(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def stem(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def steady(self) -> bool: ...
    def warnings(self) -> list[str]: ...
    def scales(self) -> dict[str, Any]: ...
    def analyze(self, progress: _Progress | None) -> str: ...
    def orbits(self) -> str: ...
    def simulate(
        self,
        periods: int | None,
        discard: int | None,
        initial: Sequence[float] | None,
        progress: _Progress | None,
    ) -> tuple[str, _Columns, list[float]]: ...
    def fly(
        self,
        periods: int | None,
        discard: int | None,
        initial: Sequence[float],
        progress: _Progress | None,
    ) -> _Columns: ...
    def trajectory(self, initial: Sequence[float], times: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]: ...
    def report(self, folder: str | os.PathLike[str], name: str, progress: _Progress | None) -> bool: ...
    def branch(
        self, parameter: str, range: Sequence[float], orbit: int | None, most_points: int
    ) -> tuple[_Columns, str]: ...

def schema() -> str: ...
def simulate_many(
    case: Case,
    names: Sequence[str],
    values: NDArray[np.float64],
    initial: NDArray[np.float64] | None,
    periods: int,
    discard: int | None,
    progress: _Progress | None,
) -> _Columns: ...
def regimes() -> list[str]: ...
def _fail(message: str) -> None: ...
