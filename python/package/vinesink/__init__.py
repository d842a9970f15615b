"""Vibro-impact nonlinear energy sinks: theory, exact orbits, simulation impact by impact, design reports.

    import vinesink

    case = vinesink.Case.from_toml("damper.toml")
    case.analyze().area          # what the theory expects
    case.orbits()                # exact periodic orbits
    case.simulate()              # every long-term motion, from many starts
    case.report("reports/damper")

Lengths and times are in SI for a case in physical units, and in its own units for a reduced one, unless a name or a
docstring says otherwise: states and impacts are over the clearance and in fast time tau = omega0 t, as in the files of
the program. `Case.scales` has the factors between the two.
"""

from ._case import Case, CaseWarning, Scales, SimulationWarning, branch, simulate_many
from ._results import Analysis, Branch, Motions, Orbits, Record, Simulation, Table
from ._vinesink import CaseError, InternalError, __version__

__all__ = [
    "Analysis",
    "Branch",
    "Case",
    "CaseError",
    "CaseWarning",
    "InternalError",
    "Motions",
    "Orbits",
    "Record",
    "Scales",
    "Simulation",
    "SimulationWarning",
    "Table",
    "__version__",
    "branch",
    "simulate_many",
]
