"""How what a cycle gives changes with the numbers of its curves, at fixed radii.

Folds are stationary points, and the integrand of a jump vanishes where it lands (physics 11): the first derivatives of
the loss are those of what jumps between the same radii lose, and those of the pull-off of the load at its place. At
fixed radii a loss is of the second degree in B and g, and a load of the first. The turn alone moves.
"""

import math
from typing import Final, NamedTuple

from gradhesion.core.curve.energy import jump_energy
from gradhesion.core.curve.values import (
    Curve,
    coordinate_of,
    depth_and_load,
    load_curve,
    place_of,
    slope_near,
    softness,
)
from gradhesion.core.cycle.jumps import LANDED, LANDED_BRANCH, LEFT, LEFT_DEPTH, LEFT_LOAD, frozen_loss
from gradhesion.core.cycle.turning import value_at
from gradhesion.core.edge.pattern import Pattern, edge_area
from gradhesion.core.jit import kernel
from gradhesion.core.scenes.cycles import measured_curve
from gradhesion.core.table.layout import HALF
from gradhesion.core.types import Floats

# What is observed at frozen radii, in the units of the curves.
PULL, LOADING, UNLOADING, AREA, GAP = range(5)
# load of the pull-off; losses of loading (in units of closing) and of unloading; the area of the edge up to the turn;
# what is measured there, less that at the fold which a jump has left, if it has passed the target (which itself is
# taken off by derivatives.py)
OBSERVED: Final = 5


class Frozen(NamedTuple):
    """The radii of a cycle, which stay where they are while the numbers of its curves change.

    pull        of the lowest load
    turn        at which the cycle turns
    moves       whether that moves with the numbers
    passed      whether it lies where a jump lands that has passed the target: what is prescribed is then that at `left`
    left        the radius from which this jump came, 0 for no contact
    target      which kind it is (scenes/reduced.py): AT_DEPTH or AT_A_LOAD
    jumps       those of the cycle (jumps.py), of loading first
    loading     the number of these
    total       of all jumps
    """

    pull: float
    turn: float
    moves: bool
    passed: bool
    left: float
    target: int
    jumps: Floats
    loading: int
    total: int


@kernel
def measured_by(closing: Curve, frozen: Frozen) -> Curve:
    """Return the curve of closing with what decides on the turn as what is prescribed."""
    if frozen.passed:
        return closing
    return measured_curve(closing, frozen.target)


@kernel
def observe(closing: Curve, opening: Curve, pattern: Pattern, frozen: Frozen, weight: float, out: Floats) -> None:
    """Add what is observed at frozen radii, times `weight`, to `out` (OBSERVED,): a difference is a sum of such terms.

    PULL is the lowest load, on the curve of opening; LOADING and UNLOADING are losses in 2 pi l^2 dgamma, of the work
    of closing and of that of opening, and AREA is int y kappa^2 dy up to a turn. If that
    moves, GAP is what is measured there on the curve of closing, less that at `frozen.left` where a jump has passed the
    target. The row LOSS of `frozen.jumps` is overwritten.
    """
    out[PULL] += weight * value_at(load_curve(opening), frozen.pull)
    out[LOADING] += weight * frozen_loss(closing, frozen.jumps, 0, frozen.loading)
    out[UNLOADING] += weight * frozen_loss(opening, frozen.jumps, frozen.loading, frozen.total)
    if frozen.turn < math.inf:
        out[AREA] += weight * edge_area(opening.table, pattern, frozen.turn)
    if frozen.moves:
        measured = measured_by(closing, frozen)
        aim = value_at(measured, frozen.left) if frozen.passed and frozen.left > 0.0 else 0.0
        out[GAP] += weight * (value_at(measured, frozen.turn) - aim)


@kernel
def rate_at(curve: Curve, y: float) -> float:
    """Return d(what is prescribed)/d ln y on a curve."""
    i, t = place_of(curve.table, y)
    D, _, _, _ = slope_near(curve, i, t)
    return float(D * softness(curve, y ** (1.0 + curve.table.k)) * y / curve.table.nodes[HALF, i])


@kernel
def loading_by_turn(closing: Curve, kappa: float, frozen: Frozen) -> float:
    """Return d(loss of loading)/d ln y of a turn that cuts a jump short; `kappa` is the toughness there."""
    y, n = frozen.turn, frozen.loading - 1
    if n < 0 or frozen.jumps[LANDED_BRANCH, n] >= 0.0:
        return 0.0
    k = closing.table.k
    over = coordinate_of(closing, frozen.jumps[LEFT_DEPTH, n], frozen.jumps[LEFT_LOAD, n]) - value_at(closing, y)
    rho = kappa - over / (softness(closing, y ** (1.0 + k)) * y ** (0.5 * (1.0 - k)))
    return float(y * y * (kappa * kappa - rho * rho))


@kernel
def unloading_by_turn(opening: Curve, frozen: Frozen) -> float:
    """Return d(loss of unloading)/d ln y of a turn from which unloading jumps at once: the state it leaves moves."""
    y, n = frozen.turn, frozen.loading
    if n >= frozen.total or frozen.jumps[LEFT, n] != y:
        return 0.0
    landing = frozen.jumps[LANDED, n]
    if landing == 0.0 and opening.by_depth == 0.0:
        return 0.0
    i, t = place_of(opening.table, y)
    depth, load = depth_and_load(opening, i, t)
    half_depth = 0.5 * rate_at(Curve(opening.table, opening.B, opening.g, 1.0, 0.0), y)
    half_load = 0.5 * rate_at(load_curve(opening), y)
    above = jump_energy(opening, y, depth + half_depth, load + half_load, landing)
    return above - jump_energy(opening, y, depth - half_depth, load - half_load, landing)
