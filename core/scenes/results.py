"""What the loops over scenes store, and in which row: no value, no contact, a pull-off, what a cycle loses."""

import math
from typing import Final

from gradhesion.core.curve.folds import CLOSE
from gradhesion.core.curve.values import Curve, softness
from gradhesion.core.cycle.path import Cycle
from gradhesion.core.cycle.pull_off import Lowest
from gradhesion.core.edge.pattern import Pattern, edge_area, toughness_at
from gradhesion.core.jit import kernel, leaf
from gradhesion.core.problem.names import EDGE, OUTPUTS, REACH
from gradhesion.core.problem.status import (
    CLOSE_TO_A_JUMP,
    JUMP_IN_TO_RIM,
    LOADING_NOT_ONE_DISC,
    NO_CONTACT,
    PULL_OFF_AT_RIM,
)
from gradhesion.core.scenes import rows as at
from gradhesion.core.scenes.reduced import UNIT_OF_FORCE
from gradhesion.core.types import Floats

NAMES: Final = (*OUTPUTS, *EDGE, REACH, "energy_residual", "saturation_radius")
"""Names of results, in the order of their rows but for the status, which is the last."""
RESULT_ROWS: Final = len(NAMES) + 1
# Forces in 1.5 pi R dgamma, lengths in R, energies in R^2 dgamma.
(
    FORCE, PULL_OFF_RADIUS, ENERGY, LOADING_JUMPS, UNLOADING_JUMPS, DEEPEST, JUMP_OUT, LOADING, UNLOADING,
    TURN, FRONT, SNAP, PINNED, FURTHEST, RESIDUAL, SATURATION, STATUS,
) = range(RESULT_ROWS)  # fmt: skip
SHORT: Final = -1.0
"""In the place of a status: the table is too short."""


@leaf
def no_value(out: Floats, i: int, status: float) -> None:
    """Store that a scene has no value."""
    out[:, i] = math.nan
    out[STATUS, i] = status


@kernel
def put_no_contact(scenes: Floats, i: int, out: Floats) -> None:
    """Store a cycle that turns before contact is made."""
    out[:, i] = 0.0
    out[PULL_OFF_RADIUS, i] = out[JUMP_OUT, i] = out[SNAP, i] = math.nan
    out[DEEPEST, i], out[STATUS, i] = scenes[at.TARGET, i], NO_CONTACT


@kernel
def put_pull_off(lowest: Lowest, y: float, reduced: Floats, i: int, out: Floats) -> int:
    """Store the pull-off of a cycle that turns at y; return its bits of status."""
    if not lowest.load < 0.0:  # a centre without toughness: the contact shrinks to a point, and never pulls
        out[FORCE, i], out[PULL_OFF_RADIUS, i] = 0.0, math.nan
        return 0
    out[FORCE, i] = -lowest.load * reduced[at.LOAD, i] * UNIT_OF_FORCE
    out[PULL_OFF_RADIUS, i] = lowest.y * reduced[at.LENGTH, i]
    tied = lowest.second < lowest.load * (1.0 - CLOSE) and lowest.second_y != lowest.y
    return (PULL_OFF_AT_RIM if lowest.y == y else 0) | (CLOSE_TO_A_JUMP if tied else 0)


@kernel
def _put_edge(opening: Curve, pattern: Pattern, ratio: float, y: float, reduced: Floats, i: int, out: Floats) -> None:
    """Store what it costs scene i, which turns at y, that its edge opens at more work than it closes at.

    FRONT, in R^2 dgamma: the difference of the two works over the contact area, (1 - ratio) int kappa^2 2 pi a da.
    PINNED, in R: how far the punch (or the far end of its spring) moves back at the turn, at constant radius, before
    the edge opens: the difference of the two stretches, times 1 + the stiffness of the contact over that of the
    machine. `ratio` is w_c/w_o: at 1 both are 0. A cycle that never turns, y = inf, has inf.
    """
    root, k = math.sqrt(ratio), opening.table.k
    out[FRONT, i] = out[PINNED, i] = 0.0
    if ratio == 1.0:
        return
    out[FRONT, i] = out[PINNED, i] = math.inf
    if y < math.inf:
        area = 2.0 * math.pi * reduced[at.LENGTH, i] ** 2
        out[FRONT, i] = (1.0 - ratio) * area * edge_area(opening.table, pattern, y)
        stretch = toughness_at(pattern, y) * y ** (0.5 * (1.0 - k)) * reduced[at.DEPTH, i]
        by_machine = softness(opening, y ** (1.0 + k)) if opening.by_depth > 0.0 else 1.0
        out[PINNED, i] = (1.0 - root) * stretch * by_machine


@leaf
def put_losses(
    cycle: Cycle, opening: Curve, pattern: Pattern, ratio: float, reduced: Floats, i: int, out: Floats
) -> int:
    """Store what the cycle of scene i loses; return its bits of status."""
    area, root = 2.0 * math.pi * reduced[at.LENGTH, i] ** 2, math.sqrt(ratio)
    loaded, unloaded = cycle.loaded, cycle.unloaded
    out[LOADING, i], out[UNLOADING, i] = loaded.lost * area * ratio, unloaded.lost * area
    out[LOADING_JUMPS, i], out[UNLOADING_JUMPS, i] = loaded.jumps, unloaded.jumps
    out[DEEPEST, i] = loaded.deepest * reduced[at.DEPTH, i] * root
    out[JUMP_OUT, i] = unloaded.last * reduced[at.DEPTH, i]
    out[SNAP, i] = cycle.snap * root * reduced[at.LOAD, i] * UNIT_OF_FORCE if opening.by_depth > 0.0 else 0.0
    _put_edge(opening, pattern, ratio, cycle.turn, reduced, i, out)
    out[ENERGY, i] = out[LOADING, i] + out[UNLOADING, i] + out[FRONT, i]
    out[TURN, i], out[FURTHEST, i] = cycle.turn * reduced[at.LENGTH, i], cycle.reach * reduced[at.LENGTH, i]
    bits = JUMP_IN_TO_RIM if loaded.in_to_rim and cycle.turn == reduced[at.RIM_Y, i] else 0
    return bits | (CLOSE_TO_A_JUMP if cycle.tied else 0) | (0 if cycle.one_disc else LOADING_NOT_ONE_DISC)


@kernel
def put_force(lowest: Lowest, reduced: Floats, i: int, out: Floats) -> None:
    """Store the pull-off of scene i, whose cycle ends at its rim; the rest of its column is left as it is."""
    out[TURN, i] = reduced[at.RIM_Y, i] * reduced[at.LENGTH, i]
    out[STATUS, i] = put_pull_off(lowest, reduced[at.RIM_Y, i], reduced, i, out) if lowest.known else SHORT
