"""Adhesive contact of a wavy axisymmetric punch on a power-law graded half-space: arrays in, arrays out.

A name is imported when it is first used: neither a name of a parameter nor a profile needs the compiler.

The arrays of the kernels are listed in docs/architecture.md; where they are made, each row is named.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from gradhesion.core.closed.applicability import validity
    from gradhesion.core.draw.draw import draw_curves
    from gradhesion.core.jit import SOURCES, place
    from gradhesion.core.problem.control import CONTROLS, Loading
    from gradhesion.core.problem.names import (
        CURVES,
        OUTPUTS,
        PARAMETERS,
        RANGE,
        REPORTS,
        SENSITIVITIES,
        SOLVERS,
        TURNS,
        VALIDITY,
    )
    from gradhesion.core.problem.profile import Harmonic, Profile
    from gradhesion.core.problem.status import DOUBTFUL, FAILED, FLAGS, doubts_about
    from gradhesion.core.sweep import solve
    from gradhesion.core.warmup import warm_up

__all__ = [
    "CONTROLS",
    "CURVES",
    "DOUBTFUL",
    "FAILED",
    "FLAGS",
    "OUTPUTS",
    "PARAMETERS",
    "RANGE",
    "REPORTS",
    "SENSITIVITIES",
    "SOLVERS",
    "SOURCES",
    "TURNS",
    "VALIDITY",
    "Harmonic",
    "Loading",
    "Profile",
    "doubts_about",
    "draw_curves",
    "place",
    "solve",
    "validity",
    "warm_up",
]

_HOMES: Final = {
    "draw.draw": "draw_curves",
    "jit": "SOURCES place",
    "problem.control": "CONTROLS Loading",
    "problem.names": "CURVES OUTPUTS PARAMETERS RANGE REPORTS SENSITIVITIES SOLVERS TURNS VALIDITY",
    "problem.profile": "Harmonic Profile",
    "problem.status": "DOUBTFUL FAILED FLAGS doubts_about",
    "sweep": "solve",
    "closed.applicability": "validity",
    "warmup": "warm_up",
}
"""What stands in each module."""
_HOME_OF: Final = {name: home for home, names in _HOMES.items() for name in names.split()}


def __getattr__(name: str) -> Any:
    """Import a name from where it stands."""
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """List all names, also those that nobody has used yet."""
    return sorted({*globals(), *__all__})
