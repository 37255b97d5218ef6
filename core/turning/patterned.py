"""Where cycles of a curve on a patterned interface turn, as turning/general.py: every branch is traced."""

import math
from typing import Any

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.cosine import force_unit
from gradhesion.core.curve.general import Basis, Patterned
from gradhesion.core.curve.patterned import are_too_many, patterned_curve
from gradhesion.core.face import measured_by, reach, window
from gradhesion.core.problem.curves import GeneralCurves, Patterns
from gradhesion.core.problem.status import CLOSE_TO_A_JUMP, NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.turning.general import is_first_contact, turn_walked
from gradhesion.core.turning.turns import Turns
from gradhesion.core.types import Harmonics, Table, Truths


@kernel()
def _turn_curve(basis: Basis, curve: Patterned, units: tuple[float, float], turns: Turns, passed: Truths) -> None:
    """Find where the cycles of a curve turn, and whether a jump has passed the target, of shape (rims,).

    `units` are those of x in R, and of the targets; lengths of `turns` are in R, and rims that are not valid NaN.
    """
    rims, targets, by_load, check, radii, flags = turns
    measured, plain, bounds = measured_by(curve, by_load), measured_by(curve, False), window(basis, curve)
    edges, reduced, reaches = rims / units[0], targets / units[1], np.empty(rims.size)
    places, chosen, alone = np.full(rims.size, math.nan), np.zeros(rims.size, np.bool_), np.zeros(rims.size, np.bool_)
    own = Turns(edges, reduced, by_load, check, places, flags)
    furthest = 0.0
    for i in range(rims.size):
        target = reduced[i]
        if not (rims[i] > 0.0 and abs(target) < math.inf and (target > 0.0 or not by_load)):
            flags[i] = NO_VALUE
            continue
        if not by_load and is_first_contact(basis.table.k, plain, target):
            flags[i] |= CLOSE_TO_A_JUMP
        if target < 0.0:
            places[i] = 0.0
            continue
        reaches[i], chosen[i] = reach(basis, measured, target), True
        furthest = max(furthest, min(edges[i], reaches[i]))
    together = not are_too_many(basis, bounds[0], min(furthest, bounds[1]))
    if not (together and turn_walked(basis, curve, bounds, own, reaches, chosen, passed)):
        for i in range(rims.size):  # too many folds up to where the furthest of them turns
            alone[i] = chosen[i]
            if alone[i] and not turn_walked(basis, curve, bounds, own, reaches, alone, passed):
                flags[i] = NO_VALUE | TOO_MANY_WAVES
            alone[i] = False
    for i in range(rims.size):
        radii[i] = rims[i] if places[i] == edges[i] else min(rims[i], places[i] * units[0])
        if math.isnan(places[i]):
            radii[i], flags[i] = math.nan, NO_VALUE | (flags[i] & TOO_MANY_WAVES)


@kernel()
def turn_scenes(
    table: Table,
    cosine_bins: Any,
    series: Harmonics,
    curves: GeneralCurves,
    patterns: Patterns,
    turns: Turns,
    passed: Truths,
) -> None:
    """Find where cycles on patterned interfaces turn, of one gradient exponent, as `turn_scenes` (turning/general.py).

    Arguments are those of `solve_scenes` (scene/patterned.py).
    """
    rims, targets, by_load, check, radii, flags = turns
    for i in curves.numbers:
        row = i if rims.shape[0] > 1 else 0
        valid, pattern, finest, curve, units = patterned_curve(table, cosine_bins, series, curves, patterns, i)
        basis, (unit, length, depth) = Basis(table, pattern, finest), units
        if not valid:
            radii[i, :], flags[i, :] = math.nan, NO_VALUE
            continue
        edges = np.where(rims[row] <= patterns.limit[i], rims[row], math.nan)
        own = (unit, force_unit(table.k, length, depth) if by_load else depth)
        _turn_curve(basis, curve, own, Turns(edges, targets[row], by_load, check, radii[i], flags[i]), passed[i])
