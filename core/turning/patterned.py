"""Where cycles on a patterned interface turn, as turning/general.py: every branch is traced."""

import numpy as np

from gradhesion.core.compiler.jit import kernel
from gradhesion.core.curve.general import Basis, Patterned
from gradhesion.core.curve.patterned import are_too_many
from gradhesion.core.face import measured_by, reach, window
from gradhesion.core.problem.status import NO_VALUE, TOO_MANY_WAVES
from gradhesion.core.turning import general
from gradhesion.core.turning.turns import Turns
from gradhesion.core.types import Truths


@general.turn_chosen.answers(Patterned)
@kernel()
def turn_chosen(basis: Basis, curve: Patterned, turns: Turns, chosen: Truths, passed: Truths) -> None:
    """Flag those that have too many waves as well."""
    edges, targets, by_load, _, _, flags = turns
    measured, bounds = measured_by(curve, by_load), window(basis, curve)
    reaches, alone, furthest = np.empty(edges.size), np.zeros(edges.size, np.bool_), 0.0
    for i in range(edges.size):
        if chosen[i]:
            reaches[i] = reach(basis, measured, targets[i])
            furthest = max(furthest, min(edges[i], reaches[i]))
    together = not are_too_many(basis, bounds[0], min(furthest, bounds[1]))
    if together and general.turn_walked(basis, curve, bounds, turns, reaches, chosen, passed):
        return
    for i in range(edges.size):  # too many folds up to where the furthest of them turns
        alone[i] = chosen[i]
        if alone[i] and not general.turn_walked(basis, curve, bounds, turns, reaches, alone, passed):
            flags[i] = NO_VALUE | TOO_MANY_WAVES
        alone[i] = False
