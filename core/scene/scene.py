"""One curve as its rims see it: its units, and how the results of a rim are stored."""

import math
from typing import NamedTuple

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine_folds import CLOSE
from gradhesion.core.problem.results import (
    CONTACT,
    ENERGY,
    FORCE,
    LAST,
    LOADED,
    LOADING,
    RADIUS,
    UNLOADED,
    UNLOADING,
    Cycle,
    Results,
    put,
)
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, LEFT, NO_VALUE, PULL_OFF_AT_RIM
from gradhesion.core.types import Bits


class Scene(NamedTuple):
    """The units of a curve, and where the results of its rims go."""

    wavelength: float  # lambda/R
    length: float  # l = lambda/2 pi over R
    energy: float  # the unit of energy, 2 pi l^2, in R^2 dgamma
    depth: float  # the unit of depth, s l^c, in R
    results: Results  # slots, values and status of all rims


@kernel()
def refuse(results: Results, i: int) -> None:
    """Give rim number i, out of range, no value."""
    for row in range(CONTACT):
        put(results, row, i, math.nan)
    results.status[i] = NO_VALUE


@kernel()
def has_left(status: Bits) -> bool:
    """Return whether any rim of a curve, of shape (rims,), is marked as left for the loop of long curves."""
    left = False
    for i in range(status.size):
        left = left or status[i] & LEFT != 0
    return left


@kernel()
def put_pull_off(
    results: Results, force: float, wavelength: float, rim: float, pull_off: tuple[float, float, float], i: int
) -> None:
    """Store the pull-off of rim number i, a_max/R: the lowest load, its place in wavelengths, the second lowest load.

    `force` is the unit of load in 1.5 pi R dgamma. A pull-off at the rim stands at rim/wavelength.
    """
    lowest, place, second = pull_off
    at_rim = place == rim / wavelength
    if second < lowest * (1.0 - CLOSE):
        results.status[i] |= CLOSE_TO_A_JUMP
    put(results, FORCE, i, -force * lowest)
    put(results, RADIUS, i, rim if at_rim else place * wavelength)
    if at_rim:
        results.status[i] |= PULL_OFF_AT_RIM


@kernel()
def put_cycle(scene: Scene, cycle: Cycle, i: int) -> bool:
    """Store the cycle of rim number i but for its depth; return whether it has a value: one that overflows has none."""
    results = scene.results
    energy = scene.energy * (cycle.loaded + cycle.unloaded)
    if not abs(energy) < math.inf:
        refuse(results, i)
        return False
    put(results, ENERGY, i, energy)
    put(results, LOADED, i, scene.energy * cycle.loaded)
    put(results, UNLOADED, i, scene.energy * cycle.unloaded)
    put(results, LOADING, i, cycle.loading_jumps)
    put(results, UNLOADING, i, cycle.unloading_jumps)
    put(results, LAST, i, scene.depth * cycle.last)
    return True
