import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import vinesink

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "cases"

# Table 1 of Li, Seguy, Berlioz (2016) at 8 Hz; the amplitude is inferred.
TABLE_1 = {
    "mass": "4.168 kg",
    "stiffness": "11.47 kN/m",
    "damping": "3.02 N s/m",
    "absorber_mass": "32 g",
    "clearance": "7.5 mm",
    "restitution": 0.6,
    "kind": "base-displacement",
    "amplitude": "0.25 mm",
    "frequency": "8 Hz",
}


@pytest.fixture
def case() -> vinesink.Case:
    return vinesink.Case(**TABLE_1)


@pytest.fixture(scope="session")
def program() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the program, which VINESINK_PROGRAM names, in the repository."""
    path = os.environ["VINESINK_PROGRAM"]

    def run(*arguments: object) -> subprocess.CompletedProcess[str]:
        command = [path, *(str(one) for one in arguments)]
        return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=120)

    return run


@pytest.fixture(scope="session")
def printed(program: Callable[..., subprocess.CompletedProcess[str]]) -> Callable[..., dict[str, Any]]:
    """The document that a command prints."""

    def document(*arguments: object) -> dict[str, Any]:
        done = program(*arguments, "--format", "json")
        assert done.returncode in (0, 1), done.stderr
        found: dict[str, Any] = json.loads(done.stdout)
        return found

    return document
