"""The curves of curve studies: what each is called in a dataset, and what its variables are."""

from collections.abc import Container
from typing import Any, Final

from gradhesion.cli.names.outputs import SI

EXTENTS: Final = {
    "equilibrium": "point",
    "closing_equilibrium": "closing_point",
    "path": "path_point",
    "asymptotic": "asymptotic_point",
    "envelope": "envelope_point",
    "effective": "effective_point",
    "smooth": "smooth_point",
    "jumps": "jump",
    "pressure": "pressure_point",
    "surface": "surface_point",
}
"""Every curve of a curve study, with the dimension along it."""

STATE: Final = "state"
"""The dimension of the states whose curves are asked for, before that along the curve."""

NAMED_STATES: Final = ("turning_point", "pull_off", "jump_out")
"""The states of a cycle that are drawn where a study gives no radii."""

STATE_CURVES: Final = ("pressure", "surface")
"""Curves of a state of contact, along the radius, in the place of curves of a scene."""

GENERAL_CURVES: Final = ("equilibrium", "closing_equilibrium", "path", "smooth", "jumps", *STATE_CURVES)
"""Curves under any control; the others are those of short waves, at a prescribed depth."""

RAGGED: Final = {"jumps": "jump_count"}
"""Curves kept as contiguous ragged arrays, one scene after the other, with the variable that counts what each has."""

CURVES: Final = {
    "equilibrium": {
        "contact_radius": "contact radius a/R",
        "indentation": "indentation depth delta/R in equilibrium",
        "load": "load P/(1.5 pi R dgamma) in equilibrium, negative if it pulls",
        "stable": "whether the equilibrium is stable under the control of the study",
    },
    "closing_equilibrium": {
        "closing_contact_radius": "contact radius a/R of an edge that closes",
        "closing_indentation": "indentation depth delta/R in equilibrium of an edge that closes",
        "closing_load": "load P/(1.5 pi R dgamma) in equilibrium of an edge that closes",
        "closing_stable": "whether the equilibrium of an edge that closes is stable under the control of the study",
    },
    "path": {
        "path_contact_radius": "contact radius a/R on the path of a loading cycle",
        "path_indentation": "indentation depth delta/R on the path of a loading cycle",
        "path_load": "load P/(1.5 pi R dgamma) on the path of a loading cycle",
        "path_branch": "stable branch of the path, counted from inside (0: out of contact)",
        "path_jump": "whether the point is reached by a jump",
        "path_unloading": "whether the path is loading or unloading",
    },
    "asymptotic": {
        "asymptotic_contact_radius": "contact radius a/R of the asymptotic curve",
        "asymptotic_indentation": "indentation depth delta/R of the asymptotic curve",
        "asymptotic_load": "load P/(1.5 pi R dgamma) of the asymptotic curve",
    },
    "envelope": {
        "envelope_contact_radius": "contact radius a/R of the envelopes",
        "loading_envelope_indentation": "indentation depth delta/R of the loading envelope",
        "loading_envelope_load": "load P/(1.5 pi R dgamma) of the loading envelope",
        "unloading_envelope_indentation": "indentation depth delta/R of the unloading envelope",
        "unloading_envelope_load": "load P/(1.5 pi R dgamma) of the unloading envelope",
    },
    "effective": {
        "effective_contact_radius": "contact radius a/R on the effective path between the envelopes",
        "effective_indentation": "indentation depth delta/R on the effective path",
        "effective_load": "load P/(1.5 pi R dgamma) on the effective path",
        "effective_jump": "whether the point of the effective path is reached by a jump",
    },
    "smooth": {
        "smooth_contact_radius": "contact radius a/R of the punch without waviness",
        "smooth_indentation": "indentation depth delta/R of the punch without waviness",
        "smooth_load": "load P/(1.5 pi R dgamma) of the punch without waviness",
    },
    "jumps": {
        "jump_count": "number of jumps of a loading cycle; those of all scenes follow one another",
        "jump_indentation": "indentation depth delta/R before the jump; constant under displacement control",
        "jump_radius_before": "contact radius a/R before the jump (0: no contact)",
        "jump_radius_after": "contact radius a/R after the jump (0: no contact)",
        "jump_energy": "energy dissipated by the jump over R^2 dgamma (negative: gained)",
        "jump_load_before": "load P/(1.5 pi R dgamma) before the jump",
        "jump_load_after": "load P/(1.5 pi R dgamma) after the jump",
        "jump_unloading": "whether the jump is on loading or on unloading",
        "jump_at_rim": "whether the jump starts or ends at the rim",
    },
    "pressure": {
        "pressure_radius": "distance r/R from the axis under the punch",
        "pressure": "contact pressure p R/dgamma, positive in compression",
    },
    "surface": {
        "surface_radius": "distance r/R from the axis",
        "surface_displacement": "displacement u_z/R of the surface, positive into the half-space",
        "surface_gap": "gap/R between the surfaces (missing beyond the rim)",
    },
}
"""Every curve of a curve study: its variables, with their `long_name`."""

INTEGERS: Final = {
    "stable": "i1",
    "closing_stable": "i1",
    "path_branch": "i4",
    "path_jump": "i1",
    "path_unloading": "i1",
    "effective_jump": "i1",
    "jump_count": "i4",
    "jump_unloading": "i1",
    "jump_at_rim": "i1",
}
"""The type of the variables of curves that are integers."""

MEANINGS: Final = {
    "stable": "unstable stable",
    "closing_stable": "unstable stable",
    "path_jump": "along_a_branch by_a_jump",
    "path_unloading": "loading unloading",
    "effective_jump": "along_an_envelope by_a_jump",
    "jump_unloading": "loading unloading",
    "jump_at_rim": "within_the_rim at_the_rim",
}
"""What 0 and 1 mean where an integer is a flag."""


def is_of_a_state(variable: str) -> bool:
    """
    Report whether a variable belongs to a curve of a state.

    >>> is_of_a_state("surface_gap_si"), is_of_a_state("path_load")
    (True, False)
    """
    return any(variable.removesuffix(SI) in CURVES[curve] for curve in STATE_CURVES)


def variables_of_curves(there: Container[Any]) -> dict[str, list[str]]:
    """
    List the variables of each curve among some names, those in SI after the others; a curve without any is left out.

    >>> variables_of_curves(["status", "path_load", "path_jump", "path_load_si"])
    {'path': ['path_load', 'path_jump', 'path_load_si']}
    """
    found = {
        curve: [name for end in ("", SI) for name in (own_name + end for own_name in own) if name in there]
        for curve, own in CURVES.items()
    }
    return {curve: own for curve, own in found.items() if own}


def curve_of(variable: str) -> str | None:
    """
    Name the curve that a variable belongs to, None if to none.

    >>> curve_of("path_load_si"), curve_of("dissipated_energy")
    ('path', None)
    """
    return next((curve for curve, own in CURVES.items() if variable.removesuffix(SI) in own), None)


def extent_of(variable: str) -> str:
    """
    Name the dimension along the curve that a variable belongs to.

    >>> extent_of("path_load")
    'path_point'
    """
    return next(EXTENTS[curve] for curve, own in CURVES.items() if variable.removesuffix(SI) in own)


def is_ragged(variable: str) -> bool:
    """
    Report whether a variable has the items of one scene after those of the other.

    >>> is_ragged("jump_energy"), is_ragged("jump_count"), is_ragged("path_load")
    (True, False, False)
    """
    return any(variable.removesuffix(SI) in CURVES[curve] and variable != count for curve, count in RAGGED.items())
