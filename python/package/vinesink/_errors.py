"""Exceptions of the package. Their messages are those of the program."""

from __future__ import annotations

from typing import TypedDict


class Problem(TypedDict):
    """What is wrong in a case, where, and what to do."""

    line: int
    column: int
    underlined: str
    message: str
    expected: str
    help: str | None


class VinesinkError(Exception):
    """Every exception of the package is one."""


class CaseError(VinesinkError, ValueError):
    """A case that cannot be read. Its message is the program's; `problems` has each one's place and advice."""

    problems: list[Problem]


class RefusedError(VinesinkError, ValueError):
    """What cannot be asked of this case, or not in this way."""


class FileError(VinesinkError, OSError):
    """A file or folder that cannot be read or written."""


class InternalError(VinesinkError, RuntimeError):
    """A fault in vinesink itself."""
