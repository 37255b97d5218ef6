"""The variables of each curve that a dataset holds: without a unit, and in SI."""

from collections.abc import Container
from typing import Any

from gradhesion.cli.names import CURVES, SI


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
