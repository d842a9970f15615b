"""Vibro-impact nonlinear energy sinks: theory, exact orbits, simulation impact by impact, design reports.

    import vinesink

    case = vinesink.Case.from_toml("damper.toml")
    case.analyze().area          # what the theory expects
    case.orbits()                # exact periodic orbits
    case.motions()               # every long-term motion, from many starts
    case.check()                 # whether its criteria hold, and how far
    case.optimize().case         # the absorber that serves it best
    case.report("reports/damper")

A case may be of several modes and absorbers; what is of one mode alone, such as `orbits` and `scales`, refuses it then. `ModalCase` and
`ModalOptimum` are other names of `Case` and `Optimum`, for a version.

Lengths and times are in SI for a case in physical units, and in its own units for a reduced one, unless a name or a
docstring says otherwise: states and impacts are over the clearance and in fast time tau = omega0 t, as in the files of
the program. `Case.scales` has the factors between the two.
"""

from ._case import Case, CaseWarning, Optimum, Scales, SimulationWarning
from ._errors import CaseError, FileError, InternalError, RefusedError, VinesinkError
from ._keywords import Keys, Parameters
from ._many import branch, compare, single_trajectories, sweep
from ._modal import ModalCase, ModalOptimum
from ._results import Analysis, Branch, Check, Difference, Motions, Orbits, Record, Simulation, Sweep, Table
from ._vinesink import __version__

__all__ = [
    "Analysis",
    "Branch",
    "Case",
    "CaseError",
    "CaseWarning",
    "Check",
    "Difference",
    "FileError",
    "InternalError",
    "Keys",
    "ModalCase",
    "ModalOptimum",
    "Motions",
    "Optimum",
    "Orbits",
    "Parameters",
    "Record",
    "RefusedError",
    "Scales",
    "Simulation",
    "SimulationWarning",
    "Sweep",
    "Table",
    "VinesinkError",
    "__version__",
    "branch",
    "compare",
    "single_trajectories",
    "sweep",
]
