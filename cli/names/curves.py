"""The curves of curve studies: what each is called in a dataset, and what its variables are."""

from collections.abc import Container
from typing import Any, Final

from gradhesion.cli.names.outputs import SI
from gradhesion.core.problem import outputs
from gradhesion.core.problem.outputs import VARIABLES

EXTENTS: Final = {name: curve.extent for name, curve in outputs.CURVES.items()}
"""Every curve of a curve study, with the dimension along it."""
STATE: Final = "state"
"""The dimension of the states whose curves are asked for, before that along the curve."""
NAMED_STATES: Final = ("turning_point", "pull_off", "jump_out")
"""The states of a cycle that are drawn where a study gives no radii."""
STATE_CURVES: Final = tuple(name for name, curve in outputs.CURVES.items() if curve.of_a_state)
"""Curves of a state of contact, along the radius, in the place of curves of a scene."""
RAGGED: Final = {name: curve.count for name, curve in outputs.CURVES.items() if curve.count}
"""Curves kept as contiguous ragged arrays, one scene after the other, with the variable that counts what each has."""
CURVES: Final = {name: {one.name: one.about for one in curve.variables} for name, curve in outputs.CURVES.items()}
"""Every curve of a curve study: its variables, with their `long_name`."""
INTEGERS: Final = {name: one.dtype for name, one in VARIABLES.items() if one.dtype != "f8"}
"""The type of the variables of curves that are integers."""
MEANINGS: Final = {name: one.meanings for name, one in VARIABLES.items() if one.meanings}
"""What 0 and 1 mean where an integer is a flag."""


_CURVE_OF: Final = {variable: curve for curve, own in CURVES.items() for variable in own}


def curve_of(variable: str) -> str | None:
    """Name the curve that a variable belongs to, None if to none.

    >>> curve_of("path_load_si"), curve_of("dissipated_energy")
    ('path', None)
    """
    return _CURVE_OF.get(variable.removesuffix(SI))


def is_ragged(variable: str) -> bool:
    """Report whether a variable has the items of one scene after those of the other.

    >>> is_ragged("jump_energy"), is_ragged("jump_count"), is_ragged("path_load")
    (True, False, False)
    """
    count = RAGGED.get(curve_of(variable) or "")
    return count is not None and variable != count


def variables_of_curves(there: Container[Any]) -> dict[str, list[str]]:
    """List the variables of each curve among some names, those in SI after the others; a curve without any is left out.

    >>> variables_of_curves(["status", "path_load", "path_jump", "path_load_si"])
    {'path': ['path_load', 'path_jump', 'path_load_si']}
    """
    found = {
        curve: [name for end in ("", SI) for name in (own_name + end for own_name in own) if name in there]
        for curve, own in CURVES.items()
    }
    return {curve: own for curve, own in found.items() if own}
