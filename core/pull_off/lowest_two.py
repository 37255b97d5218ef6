"""The lowest load examined so far, and the next one above it: how close the pull-off is to another place."""

from typing import TypeAlias

from gradhesion.core.compiler.jit import kernel

Lowest: TypeAlias = tuple[float, float, float]
"""The lowest load, its place, the second lowest load."""


@kernel()
def lower(best: Lowest, value: float, place: float) -> Lowest:
    """Return the lowest two, another trough taken in."""
    lowest, where, second = best
    if value < lowest:
        return value, place, lowest
    return lowest, where, min(second, value)
